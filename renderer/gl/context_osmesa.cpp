// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/gl/context_backends.h"

#include <array>

#include <GL/osmesa.h>

namespace afterglow {

namespace {

struct OsMesa {
    RuntimeLibrary library{"libOSMesa.so.8"};
    decltype(OSMesaCreateContextAttribs)* createContext =
        library.function<decltype(OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
    decltype(OSMesaDestroyContext)* destroyContext =
        library.function<decltype(OSMesaDestroyContext)>("OSMesaDestroyContext");
    decltype(OSMesaMakeCurrent)* makeCurrent =
        library.function<decltype(OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    decltype(OSMesaGetProcAddress)* procAddress =
        library.function<decltype(OSMesaGetProcAddress)>("OSMesaGetProcAddress");
};

class OsMesaContext final : public GlContext {
public:
    explicit OsMesaContext(const ContextOptions& options) {
        const std::array core45{OSMESA_FORMAT,
                                OSMESA_RGBA,
                                OSMESA_PROFILE,
                                OSMESA_CORE_PROFILE,
                                OSMESA_CONTEXT_MAJOR_VERSION,
                                4,
                                OSMESA_CONTEXT_MINOR_VERSION,
                                5,
                                0};
        const std::array anyVersion{OSMESA_FORMAT, OSMESA_RGBA, 0};
        context_ = mesa_.createContext(core45.data(), nullptr);
        if (!context_) // an older one serves to say what there is
            context_ = mesa_.createContext(anyVersion.data(), nullptr);
        if (!context_)
            throw ContextError("libOSMesa.so.8 creates no context");
        try {
            // OSMesa insists on a buffer to draw into; a pixel will do, as nothing is drawn there.
            if (!mesa_.makeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1))
                throw ContextError("libOSMesa.so.8 does not make its context current");
            // It has no contexts for debugging, and reports as it goes.
            initializeGl(mesa_.procAddress, backend(), options.debug);
        } catch (...) {
            release();
            throw;
        }
    }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;
    ~OsMesaContext() override { release(); }

    std::string_view backend() const override { return "OSMesa"; }

private:
    void release() {
        mesa_.makeCurrent(nullptr, nullptr, 0, 0, 0);
        mesa_.destroyContext(context_);
    }

    OsMesa mesa_;
    OSMesaContext context_ = nullptr;
    std::array<GLubyte, 4> pixel_{};
};

} // namespace

std::unique_ptr<GlContext> createOsMesaContext(const ContextOptions& options) {
    return std::make_unique<OsMesaContext>(options);
}

} // namespace afterglow
