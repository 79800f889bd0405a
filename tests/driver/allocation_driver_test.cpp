// SPDX-License-Identifier: MIT
// A device without the memory for an image: whichever it is, the renderer ends with an error that
// names it, and never with a picture.

#include "renderer/base/error.h"
#include "renderer/scene/procedural.h"
#include "tests/driver/gl_override.h"
#include "tests/driver/workload.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// While it lives, the storage of the n-th texture from here is too large for any device.
class FailingStorage {
public:
    explicit FailingStorage(int nth) : storage_(glad_glTextureStorage2D, storage) {
        active = this;
        left_ = nth;
    }
    FailingStorage(const FailingStorage&) = delete;
    FailingStorage& operator=(const FailingStorage&) = delete;
    ~FailingStorage() { active = nullptr; }

    bool hasFailed() const { return left_ < 0; }

private:
    static void GLAPIENTRY storage(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                                   GLsizei height) {
        const bool fails = active->left_-- == 0;
        const GLsizei size = 16384; // 4 GiB of RGBA32F, which llvmpipe refuses
        active->storage_.before()(texture, levels, fails ? GLenum(GL_RGBA32F) : format,
                                  fails ? size : width, fails ? size : height);
    }

    static FailingStorage* active;
    GlOverride<PFNGLTEXTURESTORAGE2DPROC> storage_;
    int left_ = 0;
};

FailingStorage* FailingStorage::active = nullptr;

} // namespace

TEST_CASE("an image that the device has no memory for ends with an error that names it") {
    testContext();
    const ExpectGlMessages expected; // the driver reports what it cannot give
    std::set<std::string> named;
    int errors = 0;
    for (int nth = 0;; ++nth) {
        CAPTURE(nth);
        Sequence sequence(makeProceduralScene("tiny"), {8, 5},
                          settingsOf(Filter::Asvgf, Signal::Separate));
        const FailingStorage failing(nth);
        std::string message;
        try {
            sequence.renderer().resize({61, 37});
            sequence.run(2);
        } catch (const Error& error) {
            message = error.what();
        }
        CHECK(message.empty() == !failing.hasFailed());
        if (!failing.hasFailed())
            break;
        ++errors;
        CHECK(message.find("the driver has no memory for ") != message.npos);
        named.insert(message.substr(0, message.find(':')));
    }
    CHECK(errors > 30); // of two signals, with histories, strata and filters
    CHECK(named.contains("texture moments (previous)"));
    CHECK(named.contains("texture strata guides"));
    CHECK(named.contains("texture filtered 1"));
}
