// SPDX-License-Identifier: MIT
#include "shared/debug_view_params.h"
#include "shared/denoise_params.h"
#include "shared/frame.h"
#include "shared/instrument_params.h"
#include "shared/post_params.h"
#include "tests/support/gl_fixture.h"

#include <algorithm>
#include <cstddef>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

struct Member {
    const char* name; ///< as GLSL reflects it: "inner.value", "values[0]"
    std::size_t offset;
    bool operator==(const Member& other) const {
        return std::string_view(name) == other.name && offset == other.offset;
    }
};

/// A struct of shaders/shared that is given to shaders as a uniform block.
struct SharedStruct {
    const char* name;
    const char* header;
    std::size_t bytes;
    std::vector<Member> members; ///< every one
};

// Members by their names in both languages, so that neither can be written wrongly.
#define SHARED_STRUCT(Struct, header, ...)                                                         \
    [] {                                                                                           \
        using S = gpu::Struct;                                                                     \
        return SharedStruct{#Struct, header, sizeof(S), {__VA_ARGS__}};                            \
    }()
#define MEMBER(name)                                                                               \
    { #name, offsetof(S, name) }
#define TAP(i)                                                                                     \
    MEMBER(taps[i].pixel), MEMBER(taps[i].weight), MEMBER(taps[i].reason),                         \
        MEMBER(taps[i].instance), MEMBER(taps[i].depth), MEMBER(taps[i].cosine),                   \
        MEMBER(taps[i].unused0)

// Add a struct here when it is added to shaders/shared; a member that is missing fails the test.
const std::vector<SharedStruct>& sharedStructs() {
    static const std::vector<SharedStruct> structs{
        SHARED_STRUCT(EdgeStopping, "shared/denoise_params.h", MEMBER(sigmaLuminance),
                      MEMBER(sigmaNormal), MEMBER(sigmaDepth), MEMBER(step)),
        SHARED_STRUCT(
            TemporalParams, "shared/denoise_params.h", MEMBER(alpha), MEMBER(alphaMoments),
            MEMBER(maxHistory), MEMBER(depthTolerance), MEMBER(normalTolerance),
            MEMBER(lambdaFetch), MEMBER(historyLaw), MEMBER(lambdaSource), MEMBER(lambdaUse),
            MEMBER(percentileSlope), MEMBER(clampSigmas), MEMBER(clampRadius), MEMBER(reactivity),
            MEMBER(historyDuringChange), MEMBER(historyBetweenPixels), MEMBER(countReusedOnce)),
        SHARED_STRUCT(PercentileParams, "shared/denoise_params.h", MEMBER(lowPercentile),
                      MEMBER(highPercentile), MEMBER(unused0), MEMBER(unused1)),
        SHARED_STRUCT(GradientParams, "shared/denoise_params.h", MEMBER(deltaFloor),
                      MEMBER(forceLambda), MEMBER(magnitude), MEMBER(unused0)),
        SHARED_STRUCT(VarianceParams, "shared/denoise_params.h", MEMBER(sigmaNormal),
                      MEMBER(sigmaDepth), MEMBER(minHistory), MEMBER(varianceExponent),
                      MEMBER(shortHistoryBoost), MEMBER(unused0), MEMBER(unused1), MEMBER(unused2)),
        SHARED_STRUCT(ChangeParams, "shared/denoise_params.h", MEMBER(deltaFloor),
                      MEMBER(forceLambda), MEMBER(over), MEMBER(scaleHistory), MEMBER(scaleDoubt),
                      MEMBER(unused0), MEMBER(unused1), MEMBER(unused2)),
        SHARED_STRUCT(MeanParams, "shared/post_params.h", MEMBER(scale), MEMBER(unused0),
                      MEMBER(unused1), MEMBER(unused2)),
        SHARED_STRUCT(TonemapParams, "shared/post_params.h", MEMBER(exposure), MEMBER(encodes),
                      MEMBER(unused0), MEMBER(unused1)),
        SHARED_STRUCT(ExposureParams, "shared/post_params.h", MEMBER(adaptation), MEMBER(limit),
                      MEMBER(unused0), MEMBER(unused1)),
        SHARED_STRUCT(TaaParams, "shared/post_params.h", MEMBER(blend), MEMBER(clip),
                      MEMBER(exposure), MEMBER(weighted)),
        SHARED_STRUCT(DebugViewParams, "shared/debug_view_params.h", MEMBER(map), MEMBER(channel),
                      MEMBER(pixelsPerTexel), MEMBER(isFloatBits), MEMBER(low), MEMBER(high),
                      MEMBER(unused0), MEMBER(unused1)),
        SHARED_STRUCT(ProbeParams, "shared/instrument_params.h", MEMBER(first), MEMBER(end)),
        SHARED_STRUCT(HistoryTap, "shared/instrument_params.h", MEMBER(pixel), MEMBER(weight),
                      MEMBER(reason), MEMBER(instance), MEMBER(depth), MEMBER(cosine),
                      MEMBER(unused0)),
        SHARED_STRUCT(TemporalFindings, "shared/instrument_params.h", MEMBER(texel),
                      MEMBER(position), TAP(0), TAP(1), TAP(2), TAP(3), MEMBER(depth),
                      MEMBER(depthTolerance), MEMBER(validWeight), MEMBER(leastWeight),
                      MEMBER(fetchedColor), MEMBER(fetchedSamples), MEMBER(fetchedMoments),
                      MEMBER(lambdaStratum), MEMBER(range), MEMBER(outside), MEMBER(newSamples),
                      MEMBER(clampLow), MEMBER(unused1), MEMBER(clampHigh), MEMBER(unused2),
                      MEMBER(usedColor), MEMBER(usedSamples), MEMBER(change), MEMBER(accumulated),
                      MEMBER(moments), MEMBER(control)),
        SHARED_STRUCT(GradientFindings, "shared/instrument_params.h", MEMBER(texel), MEMBER(before),
                      MEMBER(now), MEMBER(gradient)),
        SHARED_STRUCT(DifferenceParams, "shared/instrument_params.h", MEMBER(isAbsolute),
                      MEMBER(unused0), MEMBER(unused1), MEMBER(unused2)),
        SHARED_STRUCT(FrameUniforms, "shared/frame.h", MEMBER(clipFromWorld),
                      MEMBER(previousClipFromWorld), MEMBER(viewFromWorld),
                      MEMBER(previousViewFromWorld), MEMBER(cameraPosition), MEMBER(tanHalfFov),
                      MEMBER(ambient), MEMBER(extent), MEMBER(size), MEMBER(strata), MEMBER(frame),
                      MEMBER(seed), MEMBER(historyValid), MEMBER(lightTriangleCount),
                      MEMBER(aoRadius), MEMBER(signalClamp), MEMBER(sampleIndex),
                      MEMBER(regularization), MEMBER(previousCameraPosition), MEMBER(unused0),
                      MEMBER(jitter), MEMBER(unused1), MEMBER(unused2)),
    };
    return structs;
}

struct Layout {
    std::size_t bytes = 0;
    std::vector<Member> members; ///< names point into `names`
    std::vector<std::string> names;
};

/// How this driver lays out the struct as a member of a std140 block.
Layout driverLayout(const std::string& name, const std::string& include) {
    const std::string text = "#version 450 core\n" + include +
                             "layout(local_size_x = 8) in;\n"
                             "layout(std140, binding = 1) uniform Params { " +
                             name +
                             " value; };\n"
                             "layout(std430, binding = 0) buffer Sink { " +
                             name + " sink; };\nvoid main() { sink = value; }\n";
    const ComputeProgram program(name, testShaders().source().expandText(name, text));

    Layout layout;
    GLint bytes = 0, count = 0;
    const GLenum size = GL_BUFFER_DATA_SIZE;
    const GLuint block = glGetProgramResourceIndex(program.id(), GL_UNIFORM_BLOCK, "Params");
    REQUIRE(block != GL_INVALID_INDEX);
    glGetProgramResourceiv(program.id(), GL_UNIFORM_BLOCK, block, 1, &size, 1, nullptr, &bytes);
    layout.bytes = std::size_t(bytes);
    glGetProgramInterfaceiv(program.id(), GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    std::vector<std::size_t> offsets;
    for (GLuint i = 0; i < GLuint(count); ++i) {
        char member[128] = "";
        glGetProgramResourceName(program.id(), GL_UNIFORM, i, sizeof(member), nullptr, member);
        GLint offset = -1;
        const GLenum wanted = GL_OFFSET;
        glGetProgramResourceiv(program.id(), GL_UNIFORM, i, 1, &wanted, 1, nullptr, &offset);
        layout.names.emplace_back(std::string_view(member).substr(sizeof("value.") - 1));
        offsets.push_back(std::size_t(offset));
    }
    for (std::size_t i = 0; i < offsets.size(); ++i)
        layout.members.push_back({layout.names[i].c_str(), offsets[i]});
    return layout;
}

/// What the two languages do not agree on, in words; empty when they agree.
std::string disagreement(const SharedStruct& shared, const Layout& driver) {
    std::string text;
    if (shared.bytes != driver.bytes)
        text += "C++ has " + std::to_string(shared.bytes) + " bytes, the driver " +
                std::to_string(driver.bytes) + "; ";
    for (const Member& member : shared.members)
        if (!std::ranges::count(driver.members, member))
            text +=
                std::string(member.name) + " is at " + std::to_string(member.offset) + " in C++; ";
    for (const Member& member : driver.members)
        if (!std::ranges::count(shared.members, member))
            text +=
                std::string(member.name) + " is at " + std::to_string(member.offset) + " in GLSL; ";
    return text;
}

} // namespace

TEST_CASE("every member of every shared struct is where both languages think it is") {
    testContext();
    const GlCheck check;
    for (const SharedStruct& shared : sharedStructs()) {
        CAPTURE(shared.name);
        const Layout driver =
            driverLayout(shared.name, "#include \"" + std::string(shared.header) + "\"\n");
        CHECK(disagreement(shared, driver) == "");
    }
}

namespace afterglow::gpu {
// Laid out by C++ as if GLSL had no rules of alignment.
struct Careless {
    float first;
    glm::vec3 second; // at 4; GLSL puts it at 16
    glm::vec4 third;  // at 16; GLSL: 32
};
} // namespace afterglow::gpu

TEST_CASE("a struct that C++ and GLSL lay out differently is found out") {
    testContext();
    const Layout driver =
        driverLayout("Careless", "struct Careless { float first; vec3 second; vec4 third; };\n");
    const SharedStruct careless =
        SHARED_STRUCT(Careless, "", MEMBER(first), MEMBER(second), MEMBER(third));
    CHECK(disagreement(careless, driver) ==
          "C++ has 32 bytes, the driver 48; second is at 4 in C++; third is at 16 in C++; "
          "second is at 16 in GLSL; third is at 32 in GLSL; ");
}

TEST_CASE("a member that is not listed is found out") {
    testContext();
    SharedStruct shared = sharedStructs().front();
    shared.members.pop_back();
    const Layout driver =
        driverLayout(shared.name, "#include \"" + std::string(shared.header) + "\"\n");
    CHECK(disagreement(shared, driver) == "step is at 12 in GLSL; ");
}
