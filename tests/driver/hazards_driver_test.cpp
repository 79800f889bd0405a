// SPDX-License-Identifier: MIT
// Freedoms of a driver that llvmpipe does not take: garbage in new storage, writes that are seen
// late without a barrier, workgroups in another order.

#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/readback.h"
#include "tests/driver/barrier_watch.h"
#include "tests/driver/poison.h"
#include "tests/driver/rewritten_shaders.h"
#include "tests/driver/workload.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/sequence.h"

#include <doctest/doctest.h>

#include <functional>
#include <set>
#include <string>
#include <utility>

using namespace afterglow;
using namespace afterglow::test;

namespace {

/// Textures that are cleared right before each use of them: what they count or sum up begins at 0.
const std::set<std::string> kClearedForUse{"sum", "sum, lost", "counters", "reason counts"};

/// Everything that the renderer does, as it comes out without any hazard.
const Outputs& plainOutputs() {
    static const Outputs outputs = renderEverything(samplerShaders());
    return outputs;
}

/// Frames of a filter with a shader that somebody has spoilt.
Outputs renderSpoilt(std::string_view file, std::string_view from, std::string_view to,
                     const Settings& settings, ShaderLibrary shaders = freshShaders()) {
    const RewrittenShaders rewritten([&](std::string_view name, std::string text) {
        return name == file ? replaced(std::move(text), from, to) : text;
    });
    return renderFilter(shaders, settings);
}

/// An error in the commands: every barrier lacks these bits.
class WeakBarriers {
public:
    explicit WeakBarriers(GLbitfield missing) : barrier_(glad_glMemoryBarrier, barrier) {
        active = this;
        missing_ = missing;
    }

private:
    static void GLAPIENTRY barrier(GLbitfield bits) {
        active->barrier_.before()(bits & ~active->missing_);
    }
    static inline WeakBarriers* active = nullptr;
    GLbitfield missing_ = 0;
    GlOverride<PFNGLMEMORYBARRIERPROC> barrier_;
};

ComputeProgram programOf(std::string_view body) {
    const ShaderLibrary& shaders = samplerShaders();
    return ComputeProgram("test program",
                          shaders.source().expandText(
                              "test program", "#version 450 core\n#include \"lib/fetch.glsl\"\n"
                                              "layout(local_size_x = 8, local_size_y = 8) in;\n" +
                                                  std::string(body)));
}

} // namespace

TEST_CASE("no frame depends on what new textures and buffers hold, or on their first clear") {
    const GlCheck noGlMessages;
    const Outputs& plain = plainOutputs();
    REQUIRE(plain.size() > 1000);
    const PoisonedStorage poisoned(kClearedForUse);
    CHECK(differences(plain, renderEverything(samplerShaders())) == "");
    MESSAGE(poisoned.texturesPoisoned(), " textures and ", poisoned.buffersPoisoned(),
            " buffers held garbage");
    CHECK(poisoned.texturesPoisoned() > 500);
    CHECK(poisoned.buffersPoisoned() > 10);
}

TEST_CASE(
    "two pixels a thread do not depend on garbage in new storage or on the workgroups' order") {
    const GlCheck noGlMessages;
    for (const Kernel kernel : {Kernel::B3Spline5x5, Kernel::Box3x3}) {
        CAPTURE(int(kernel));
        Settings settings = settingsOf(Filter::Asvgf);
        settings.denoiser.kernel = int(kernel);
        ShaderLibrary shaders = freshImageShaders();
        const Outputs plain = renderFilter(shaders, settings);
        {
            const PoisonedStorage poisoned(kClearedForUse);
            CHECK(differences(plain, renderFilter(shaders, settings)) == "");
        }
        ShaderLibrary reversed = freshImageShaders();
        const RewrittenShaders rewritten(
            [](std::string_view, std::string text) { return withReversedGroups(std::move(text)); });
        CHECK(differences(plain, renderFilter(reversed, settings)) == "");
        CHECK(rewritten.changed() > 10);
    }
}

TEST_CASE("a clear that is missing shows where storage holds garbage") {
    const GlCheck noGlMessages;
    const Outputs& plain = plainOutputs();
    for (const auto& [texture, output] : {std::pair{"sum", "reference: mean"},
                                          {"sum, lost", "reference: mean"},
                                          {"counters", "svgf: stats 0"},
                                          {"reason counts", "instruments: reasons"}}) {
        CAPTURE(std::string(texture));
        std::set<std::string> others = kClearedForUse;
        REQUIRE(others.erase(texture) == 1);
        const PoisonedStorage poisoned(others);
        CHECK(differences(plain, renderEverything(samplerShaders())).find(output) !=
              std::string::npos);
    }
}

TEST_CASE("pixels that are never written show where storage holds garbage") {
    const GlCheck noGlMessages;
    const auto shows = [&](std::string_view from, std::string_view to, auto makeShaders) {
        const auto render = [&] {
            return renderSpoilt("denoise/atrous.comp", from, to, settingsOf(Filter::Svgf),
                                makeShaders());
        };
        const Outputs zeros = render();
        const PoisonedStorage poisoned(kClearedForUse);
        return differences(zeros, render()) != "";
    };
    CHECK(shows("any(greaterThan(p, last))", "any(greaterThan(p, last - ivec2(0, 1)))",
                freshShaders));
    // Of two pixels a thread, the lower one in the last row.
    CHECK(shows("below.y <= last.y", "below.y < last.y", freshImageShaders));
    CHECK_FALSE(shows("below.y <= last.y", "last.y >= below.y", freshImageShaders));
}

TEST_CASE("what a shader wrote is used only after the barrier that it needs") {
    const GlCheck noGlMessages;
    for (ShaderLibrary* shaders : {&samplerShaders(), &testShaders()}) {
        const BarrierWatch watch;
        renderEverything(*shaders);
        CHECK(watch.text() == "");
        CHECK(watch.dispatches() > 500);
    }
}

TEST_CASE("a barrier without one of its bits is found, with the way in which it was needed") {
    const GlCheck noGlMessages;
    struct Mutant {
        GLbitfield missing;
        const char* found;
    };
    for (const Mutant& mutant :
         {Mutant{GL_TEXTURE_FETCH_BARRIER_BIT,
                 "in 'denoise/temporal.comp': fetching texture 'raw'"},
          {GL_SHADER_IMAGE_ACCESS_BARRIER_BIT,
           "in 'denoise/forward_merge.comp': image access to texture 'visibility'"},
          {GL_TEXTURE_UPDATE_BARRIER_BIT, "reading back texture 'raw'"},
          {GL_ALL_BARRIER_BITS, "clearing texture 'counters'"}}) {
        CAPTURE(mutant.found);
        const BarrierWatch watch;
        const WeakBarriers weak(mutant.missing);
        renderFilter(samplerShaders(), settingsOf(Filter::Asvgf));
        CHECK_MESSAGE(watch.text().find(mutant.found) != std::string::npos, watch.text());
    }
}

TEST_CASE("framebuffers, buffers of texels, storage blocks and copies are watched as well") {
    const GlCheck noGlMessages;
    GpuTexture image("image", PixelFormat::RGBA32F, {8, 8});
    GpuTexture other("other", PixelFormat::RGBA32F, {8, 8});
    TexelBuffer texels("texels", 64 * 16);
    ComputeProgram write = programOf("writeonly uniform image2D target;\n"
                                     "void main() { imageStore(target, ivec2(0), vec4(1.0)); }");
    ComputeProgram fill = programOf("layout(rgba32ui) writeonly uniform uimageBuffer target;\n"
                                    "void main() { imageStore(target, 0, uvec4(1u)); }");
    GpuBuffer block("block", 16);
    ComputeProgram store = programOf("layout(std430) buffer Block { vec4 value; };\n"
                                     "void main() { value += 1.0; }");
    const auto faultOf = [&](GLbitfield missing, const auto& commands) {
        const BarrierWatch watch;
        const WeakBarriers weak(missing);
        commands();
        return watch.text();
    };
    const auto clearAttached = [&] {
        const Framebuffer framebuffer("target", {&image}, nullptr);
        write.dispatch({8, 8}, {}, {{"target", image}});
        framebuffer.clearColor(0, glm::vec4(0.5f));
    };
    const auto writeBuffer = [&] {
        fill.dispatch({8, 8}, {}, {{"target", texels}});
        texels.write(std::vector<glm::uvec4>(64));
    };
    const auto readBuffer = [&] {
        fill.dispatch({8, 8}, {}, {{"target", texels}});
        texels.read<glm::uvec4>();
    };
    const auto storeTwice = [&] {
        store.dispatch({8, 8}, {}, {{"Block", block}});
        store.dispatch({8, 8}, {}, {{"Block", block}});
    };
    const auto copyBlock = [&] {
        store.dispatch({8, 8}, {}, {{"Block", block}});
        PixelReadback readback;
        readback.add<glm::vec4>(block);
    };
    const auto copyImage = [&] {
        write.dispatch({8, 8}, {}, {{"target", image}});
        other.copyFrom(image);
    };
    for (const auto& commands : {std::function<void()>(clearAttached),
                                 {writeBuffer},
                                 {readBuffer},
                                 {storeTwice},
                                 {copyBlock},
                                 {copyImage}})
        CHECK(faultOf(0, commands) == "");
    CHECK(faultOf(GL_FRAMEBUFFER_BARRIER_BIT, clearAttached) ==
          "clearing the attachment texture 'image' without its barrier\n");
    CHECK(faultOf(GL_BUFFER_UPDATE_BARRIER_BIT, writeBuffer) ==
          "writing the buffer of texture 'texels' without its barrier\n");
    CHECK(faultOf(GL_BUFFER_UPDATE_BARRIER_BIT, readBuffer) ==
          "reading back the buffer of texture 'texels' without its barrier\n");
    CHECK(faultOf(GL_SHADER_STORAGE_BARRIER_BIT, storeTwice) ==
          "in 'test program': using buffer 'block' without its barrier\n");
    CHECK(faultOf(GL_BUFFER_UPDATE_BARRIER_BIT, copyBlock) ==
          "copying buffer 'block' without its barrier\n");
    CHECK(faultOf(GL_TEXTURE_UPDATE_BARRIER_BIT, copyImage) ==
          "copying from texture 'image' without its barrier\n");
}

TEST_CASE("one texture as two images, or sampled and written, is found") {
    const GlCheck noGlMessages;
    GpuTexture image("image", PixelFormat::RGBA32F, {8, 8});
    ComputeProgram twice =
        programOf("layout(rgba32f) readonly uniform image2D a;\nwriteonly uniform image2D b;\n"
                  "void main() { imageStore(b, ivec2(0), imageLoad(a, ivec2(1))); }");
    ComputeProgram feedback =
        programOf("uniform sampler2D a;\nwriteonly uniform image2D b;\n"
                  "void main() { imageStore(b, ivec2(0), texelFetch(a, ivec2(1), 0)); }");
    const BarrierWatch watch;
    twice.dispatch({8, 8}, {{"a", image}}, {{"b", image}});
    feedback.dispatch({8, 8}, {{"a", image}}, {{"b", image}});
    CHECK(watch.text() ==
          "in 'test program': texture 'image' is sampled and written\n"
          "in 'test program': texture 'image' is written, and another image as well\n");
}

TEST_CASE("every frame has the same bits when workgroups run in the reverse order") {
    const GlCheck noGlMessages;
    const Outputs& plain = plainOutputs();
    ShaderLibrary shaders = freshShaders();
    const RewrittenShaders rewritten(
        [](std::string_view, std::string text) { return withReversedGroups(std::move(text)); });
    CHECK(differences(plain, renderEverything(shaders)) == "");
    CHECK(rewritten.changed() > 20);
}

TEST_CASE("a result that depends on the order of workgroups shows in the reverse order") {
    const GlCheck noGlMessages;
    // All samples want the same few strata. Those with the largest keys have them, or in the mutant
    // the first to arrive.
    const auto render = [&](bool firstWins, bool reversed) {
        ShaderLibrary shaders = freshShaders();
        const RewrittenShaders rewritten([&](std::string_view name, std::string text) {
            if (name == "denoise/forward_claim.comp") {
                text = replaced(std::move(text), "stratumOf(landed)", "stratumOf(landed) % 2");
                if (firstWins)
                    text = replaced(
                        replaced(std::move(text), "imageAtomicMax(", "imageAtomicCompSwap("),
                        ", claimKey(s))", ", 0u, claimKey(s))");
            }
            return reversed ? withReversedGroups(std::move(text)) : text;
        });
        return renderFilter(shaders, settingsOf(Filter::Asvgf));
    };
    CHECK(differences(render(false, false), render(false, true)) == "");
    CHECK(differences(render(true, false), render(true, true)) != "");
}
