// SPDX-License-Identifier: MIT
#include "renderer/base/error.h"
#include "renderer/gl/context_backends.h"

#include <algorithm>
#include <array>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace afterglow {

namespace {

struct Egl {
    RuntimeLibrary library{"libEGL.so.1"};
    decltype(eglQueryString)* queryString = function<decltype(eglQueryString)>("eglQueryString");
    decltype(eglGetDisplay)* getDisplay = function<decltype(eglGetDisplay)>("eglGetDisplay");
    decltype(eglInitialize)* initialize = function<decltype(eglInitialize)>("eglInitialize");
    decltype(eglTerminate)* terminate = function<decltype(eglTerminate)>("eglTerminate");
    decltype(eglBindAPI)* bindApi = function<decltype(eglBindAPI)>("eglBindAPI");
    decltype(eglChooseConfig)* chooseConfig =
        function<decltype(eglChooseConfig)>("eglChooseConfig");
    decltype(eglCreateContext)* createContext =
        function<decltype(eglCreateContext)>("eglCreateContext");
    decltype(eglDestroyContext)* destroyContext =
        function<decltype(eglDestroyContext)>("eglDestroyContext");
    decltype(eglMakeCurrent)* makeCurrent = function<decltype(eglMakeCurrent)>("eglMakeCurrent");
    decltype(eglReleaseThread)* releaseThread =
        function<decltype(eglReleaseThread)>("eglReleaseThread");
    decltype(eglGetProcAddress)* procAddress =
        function<decltype(eglGetProcAddress)>("eglGetProcAddress");

    template <class Function>
    Function* function(const char* name) const {
        return library.function<Function>(name);
    }
    template <class Function>
    Function extension(const char* name) const {
        return reinterpret_cast<Function>(procAddress(name));
    }
};

/// Returns whether a list of words separated by spaces has this word.
bool hasWord(const char* list, std::string_view word) {
    std::string_view rest = list ? list : "";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == word)
            return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

struct Device {
    EGLDeviceEXT handle;
    bool isSoftware;
    std::string description;
};

/// Returns all devices that EGL can enumerate (NVIDIA's driver wants to be asked like this), in its
/// own order.
std::vector<Device> devicesOf(const Egl& egl) {
    const char* client = egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!hasWord(client, "EGL_EXT_platform_base") || !hasWord(client, "EGL_EXT_platform_device") ||
        (!hasWord(client, "EGL_EXT_device_enumeration") && !hasWord(client, "EGL_EXT_device_base")))
        return {};
    const auto queryDevices = egl.extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto deviceString =
        egl.extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    std::array<EGLDeviceEXT, 16> handles{};
    EGLint count = 0;
    if (!queryDevices || !queryDevices(EGLint(handles.size()), handles.data(), &count))
        return {};
    std::vector<Device> devices;
    for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT handle = handles[std::size_t(i)];
        const auto text = [&](EGLint name) {
            const char* value = deviceString ? deviceString(handle, name) : nullptr;
            return std::string(value ? value : "");
        };
        const std::string extensions = text(EGL_EXTENSIONS);
        const auto textOf = [&](const char* extension, EGLint name) {
            return hasWord(extensions.c_str(), extension) ? text(name) : "";
        };
        const bool isSoftware = hasWord(extensions.c_str(), "EGL_MESA_device_software");
        std::string description;
        for (const std::string& part : {textOf("EGL_EXT_device_query_name", EGL_RENDERER_EXT),
                                        textOf("EGL_EXT_device_query_name", EGL_VENDOR),
                                        textOf("EGL_EXT_device_drm", EGL_DRM_DEVICE_FILE_EXT),
                                        std::string(isSoftware ? "Mesa's software renderer" : "")})
            if (!part.empty())
                description += (description.empty() ? "" : ", ") + part;
        devices.push_back(
            {handle, isSoftware, description.empty() ? "tells nothing of itself" : description});
    }
    return devices;
}

struct Candidate {
    std::string name;
    EGLDisplay display;
};

/// Returns displays that need no window system, best first: GPUs, Mesa without a surface, Mesa's
/// software device. Only the one of `device` if that is given.
std::vector<Candidate> candidates(const Egl& egl, std::optional<int> device) {
    const char* client = egl.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto platformDisplay =
        egl.extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    const std::vector<Device> devices = platformDisplay ? devicesOf(egl) : std::vector<Device>{};
    const auto candidate = [&](std::size_t i) {
        return Candidate{"device " + std::to_string(i),
                         platformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i].handle, nullptr)};
    };
    if (device) {
        if (*device < 0 || std::size_t(*device) >= devices.size())
            throw ContextError("libEGL.so.1 has no device " + std::to_string(*device));
        return {candidate(std::size_t(*device))};
    }
    if (!platformDisplay || !hasWord(client, "EGL_EXT_platform_base"))
        return {{"default display", egl.getDisplay(EGL_DEFAULT_DISPLAY)}};

    std::vector<Candidate> all, software;
    for (std::size_t i = 0; i < devices.size(); ++i)
        (devices[i].isSoftware ? software : all).push_back(candidate(i));
    if (hasWord(client, "EGL_MESA_platform_surfaceless"))
        all.push_back({"surfaceless platform",
                       platformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                       reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr)});
    all.insert(all.end(), software.begin(), software.end());
    return all;
}

class EglContext final : public GlContext {
public:
    /// Throws ContextError, with nothing left behind.
    EglContext(const Egl& egl, EGLDisplay display, const ContextOptions& options)
        : egl_(egl), display_(display) {
        if (display_ == EGL_NO_DISPLAY || !egl_.initialize(display_, nullptr, nullptr))
            throw ContextError("cannot be initialized");
        try {
            create(options.debug);
            initializeGl(egl_.procAddress, backend(), options.debug);
        } catch (...) {
            release();
            throw;
        }
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext() override { release(); }

    std::string_view backend() const override { return "EGL"; }

private:
    void create(bool debug) {
        const char* extensions = egl_.queryString(display_, EGL_EXTENSIONS);
        if (!hasWord(extensions, "EGL_KHR_surfaceless_context"))
            throw ContextError("has no EGL_KHR_surfaceless_context");
        if (!egl_.bindApi(EGL_OPENGL_API))
            throw ContextError("has no desktop OpenGL");

        EGLConfig config = nullptr; // EGL_NO_CONFIG_KHR
        if (!hasWord(extensions, "EGL_KHR_no_config_context")) {
            const std::array wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                    EGL_NONE};
            EGLint count = 0;
            if (!egl_.chooseConfig(display_, wanted.data(), &config, 1, &count) || count == 0)
                throw ContextError("has no configuration for desktop OpenGL");
        }

        const auto contextOf = [&](EGLint major, EGLint minor) {
            const std::array wanted{EGL_CONTEXT_MAJOR_VERSION,
                                    major,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    minor,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_CONTEXT_OPENGL_DEBUG,
                                    debug ? EGL_TRUE : EGL_FALSE,
                                    EGL_NONE};
            return egl_.createContext(display_, config, EGL_NO_CONTEXT, wanted.data());
        };
        context_ = contextOf(4, 5);
        if (context_ == EGL_NO_CONTEXT) // an older one serves to say what there is
            context_ = contextOf(3, 2);
        if (context_ == EGL_NO_CONTEXT)
            throw ContextError("creates no OpenGL core context");
        if (!egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw ContextError("does not make its context current");
    }

    void release() {
        egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT)
            egl_.destroyContext(display_, context_);
        egl_.terminate(display_);
        egl_.releaseThread();
    }

    Egl egl_;
    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::vector<std::string> eglDevices() {
    std::vector<std::string> descriptions;
    try {
        for (const Device& device : devicesOf(Egl()))
            descriptions.push_back(device.description);
    } catch (const ContextError&) { // no EGL: no devices
    }
    return descriptions;
}

std::unique_ptr<GlContext> createEglContext(const ContextOptions& options) {
    const Egl egl;
    std::string failures;
    for (const auto& [name, display] : candidates(egl, options.device)) {
        try {
            return std::make_unique<EglContext>(egl, display, options);
        } catch (const ContextError& error) {
            const std::string reason = error.what(); // one reason is named once
            if (failures.find(reason) == std::string::npos)
                failures += (failures.empty() ? "" : ", ") + name + ": " + reason;
        }
    }
    throw ContextError("libEGL.so.1 gives no context (" +
                       (failures.empty() ? std::string("it has no displays") : failures) + ")");
}

} // namespace afterglow
