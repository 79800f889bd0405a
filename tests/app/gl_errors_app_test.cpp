// SPDX-License-Identifier: MIT
#include "app/commands/command_line.h"
#include "program.h"
#include "renderer/base/error.h"
#include "renderer/gl/errors.h"
#include "tests/support/gl_fixture.h"

#include <doctest/doctest.h>

namespace afterglow::test {

namespace {

std::unique_ptr<GlContext> soundContext() {
    return createHeadlessContext(Backend::OsMesa, {.debug = true});
}

/// A context in which something went wrong that the driver reported.
std::unique_ptr<GlContext> reportingContext() {
    auto context = soundContext();
    glEnable(GL_TEXTURE_2D); // not in a core profile
    return context;
}

/// The same in one whose driver reports nothing.
std::unique_ptr<GlContext> silentContext() {
    auto context = soundContext();
    glDisable(GL_DEBUG_OUTPUT);
    glEnable(GL_TEXTURE_2D);
    return context;
}

void finishBadly() {
    glEnable(GL_TEXTURE_2D);
}

/// One that reports nothing, and in which each glFinish() fails: also the last, after which no
/// storage is made.
std::unique_ptr<GlContext> lateContext() {
    auto context = soundContext();
    glDisable(GL_DEBUG_OUTPUT);
    glFinish = finishBadly; // the next context loads its own
    return context;
}

int runIn(HiddenContextFactory context, std::vector<const char*> words) {
    words.insert(words.begin(), "afterglow");
    words.insert(words.end(), {"--context", "glfw"}); // the one that is handed in
    return runCommandLine(int(words.size()), words.data(), context);
}

} // namespace

TEST_CASE("any error of OpenGL ends a command with exit code 1, reported or not") {
    releaseTestContext();
    const ExpectGlMessages expected;
    const TemporaryFolder folder;
    const std::string out = folder / "out", noise = folder / "noise", score = folder / "score";
    const std::vector<std::vector<const char*>> commands{
        {"render", "tiny", "--size", "16x9", "--frames", "1", "--out", out.c_str()},
        {"render", "light-off", "--export", "--size", "16x9", "--frames", "1", "--out",
         noise.c_str()},
        {"bench", "tiny", "--size", "16x9", "--frames", "4", "--filter", "none", "--what", "passes",
         "--repeat", "1"},
        {"experiment", "static", "--size", "16x9", "--frames", "1", "--spp", "8", "--no-cache",
         "--fresh", "--filter", "fixed", "--out", score.c_str()}};
    for (const auto& command : commands) {
        CAPTURE(command.front());
        for (const HiddenContextFactory context : {reportingContext, silentContext}) {
            const int before = glErrorCount();
            CHECK(runIn(context, command) == 1);
            CHECK(glErrorCount() == before + 1);
        }
        CHECK(runIn(lateContext, command) == 1);
        CHECK(runIn(soundContext, command) == 0); // what went wrong before is no fault of its own
    }
}

TEST_CASE("an experiment that is started again does over what OpenGL has failed at") {
    releaseTestContext();
    const ExpectGlMessages expected;
    for (const HiddenContextFactory failing : {reportingContext, silentContext, lateContext}) {
        const TemporaryFolder folder;
        const std::string out = folder / "out", cache = folder / "cache";
        const std::vector<const char*> command{
            "experiment", "static",  "--size",      "16x9",     "--frames", "2",     "--spp",
            "8",          "--cache", cache.c_str(), "--filter", "fixed",    "--out", out.c_str()};
        const auto finished = std::filesystem::path(out) / "fixed" / "timing.json";
        CHECK(runIn(failing, command) == 1);
        CHECK_FALSE(std::filesystem::exists(finished));
        CHECK(std::filesystem::is_empty(cache));
        CHECK(runIn(soundContext, command) == 0);
        CHECK(std::filesystem::exists(finished));
        CHECK_FALSE(std::filesystem::is_empty(cache));
    }
}

TEST_CASE("a context is asked for on the device that was chosen") {
    releaseTestContext();
    for (const ContextChoice choice : {ContextChoice::Egl, ContextChoice::Auto})
        CHECK_THROWS_WITH_AS(Headless({choice, 999}, nullptr), "libEGL.so.1 has no device 999",
                             ContextError);
}

} // namespace afterglow::test
