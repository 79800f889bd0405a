// SPDX-License-Identifier: MIT
#include "tests/driver/program_needs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>
#include <regex>
#include <stdexcept>

namespace afterglow::test {

LinkedPrograms* LinkedPrograms::active = nullptr;

LinkedPrograms::LinkedPrograms() : link_(glad_glLinkProgram, link) {
    active = this;
}

LinkedPrograms::~LinkedPrograms() {
    active = nullptr;
}

namespace {

/// Of a uniform that is not a texture: floats, integers, their vectors and square matrices.
int componentsOf(GLenum type) {
    switch (type) {
    case GL_FLOAT:
    case GL_INT:
    case GL_UNSIGNED_INT:
    case GL_BOOL: return 1;
    case GL_FLOAT_VEC2: return 2;
    case GL_FLOAT_VEC3: return 3;
    case GL_FLOAT_VEC4: return 4;
    case GL_FLOAT_MAT3: return 9;
    case GL_FLOAT_MAT4: return 16;
    default: throw std::logic_error("a loose uniform of type " + std::to_string(type));
    }
}

int activeResources(GLuint program, GLenum interface) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return count;
}

GLint property(GLuint program, GLenum interface, GLuint index, GLenum what) {
    GLint value = 0;
    glGetProgramResourceiv(program, interface, index, 1, &what, 1, nullptr, &value);
    return value;
}

void addUniforms(ProgramNeeds& needs, GLuint program) {
    for (GLuint i = 0; i < GLuint(activeResources(program, GL_UNIFORM)); ++i) {
        if (property(program, GL_UNIFORM, i, GL_BLOCK_INDEX) >= 0)
            continue;
        const int elements = property(program, GL_UNIFORM, i, GL_ARRAY_SIZE);
        switch (const auto type = GLenum(property(program, GL_UNIFORM, i, GL_TYPE))) {
        case GL_SAMPLER_BUFFER:
        case GL_UNSIGNED_INT_SAMPLER_BUFFER: needs.texelBuffers += elements; [[fallthrough]];
        case GL_SAMPLER_2D:
        case GL_UNSIGNED_INT_SAMPLER_2D:
        case GL_SAMPLER_2D_ARRAY:
        case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY: needs.samplers += elements; break;
        case GL_IMAGE_BUFFER:
        case GL_UNSIGNED_INT_IMAGE_BUFFER: needs.texelBuffers += elements; [[fallthrough]];
        case GL_IMAGE_2D:
        case GL_UNSIGNED_INT_IMAGE_2D:
        case GL_IMAGE_2D_ARRAY:
        case GL_UNSIGNED_INT_IMAGE_2D_ARRAY: needs.images += elements; break;
        default: needs.looseUniforms += elements * componentsOf(type);
        }
    }
}

std::string sourceOf(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_SHADER_SOURCE_LENGTH, &length);
    std::string text(std::size_t(std::max(length, 1)), '\0');
    glGetShaderSource(shader, length, nullptr, text.data());
    return text;
}

ProgramNeeds needsOf(GLuint program, const std::vector<GLuint>& shaders) {
    ProgramNeeds needs;
    std::array<char, 256> label{};
    glGetObjectLabel(GL_PROGRAM, program, GLsizei(label.size()), nullptr, label.data());
    needs.name = label.data();
    addUniforms(needs, program);
    needs.uniformBlocks = activeResources(program, GL_UNIFORM_BLOCK);
    needs.storageBlocks = activeResources(program, GL_SHADER_STORAGE_BLOCK);
    for (GLuint i = 0; i < GLuint(needs.uniformBlocks); ++i)
        needs.largestBlock = std::max(needs.largestBlock,
                                      property(program, GL_UNIFORM_BLOCK, i, GL_BUFFER_DATA_SIZE));
    for (const GLuint shader : shaders) {
        GLint type = 0;
        glGetShaderiv(shader, GL_SHADER_TYPE, &type);
        needs.isCompute = needs.isCompute || type == GL_COMPUTE_SHADER;
        needs.sharedBytes += sharedBytes(sourceOf(shader));
    }
    if (needs.isCompute) {
        std::array<GLint, 3> edges{};
        glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, edges.data());
        needs.threads = edges[0] * edges[1] * edges[2];
        needs.longestEdge = std::max(edges[0], edges[1]);
    }
    return needs;
}

} // namespace

void LinkedPrograms::link(GLuint program) {
    std::array<GLuint, 2> shaders{};
    GLsizei count = 0;
    glGetAttachedShaders(program, GLsizei(shaders.size()), &count, shaders.data());
    active->link_.before()(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked)
        active->all_.push_back(needsOf(program, {shaders.begin(), shaders.begin() + count}));
}

int sharedBytes(std::string_view shaderText) {
    const std::string text(shaderText);
    // Constants by name: numbers, and products of others.
    std::map<std::string, std::string> constants;
    const std::regex constant(R"(\nconst u?int (\w+)\s*=\s*([^;]+);)");
    for (std::sregex_iterator i(text.begin(), text.end(), constant), end; i != end; ++i)
        constants[(*i)[1].str()] = (*i)[2].str();
    const std::function<int(const std::string&)> valueOf = [&](const std::string& expression) {
        const std::regex product(R"([\w\s*()]*)"), factor(R"(\w+)");
        if (!std::regex_match(expression, product))
            throw std::logic_error("the size of shared memory is no product: " + expression);
        int value = 1;
        for (std::sregex_iterator i(expression.begin(), expression.end(), factor), end; i != end;
             ++i)
            if (const std::string word = i->str(); word != "int" && word != "uint")
                value *= std::isdigit(static_cast<unsigned char>(word[0]))
                             ? std::stoi(word)
                             : valueOf(constants.at(word));
        return value;
    };

    int bytes = 0;
    const std::map<std::string, int> sizes{{"float", 4}, {"int", 4},   {"uint", 4},
                                           {"vec2", 8},  {"vec3", 16}, {"vec4", 16}};
    const std::regex variable(R"(\nshared (\w+) \w+(\[([^\]]+)\])?;)");
    for (std::sregex_iterator i(text.begin(), text.end(), variable), end; i != end; ++i)
        bytes += sizes.at((*i)[1].str()) * ((*i)[3].matched ? valueOf((*i)[3].str()) : 1);
    return bytes;
}

std::string beyondMinima(const ProgramNeeds& needs) {
    std::string beyond;
    const auto atMost = [&](const char* what, int need, int promised) {
        if (need > promised)
            beyond += needs.name + " needs " + std::to_string(need) + " " + what +
                      "; OpenGL 4.5 promises " + std::to_string(promised) + "\n";
    };
    // OpenGL 4.5 core, chapter 23: the least values of what depends on the implementation.
    atMost("samplers in a stage", needs.samplers, 16); // MAX_COMPUTE_TEXTURE_IMAGE_UNITS
    // MAX_IMAGE_UNITS, MAX_COMPUTE_IMAGE_UNIFORMS; MAX_VERTEX_IMAGE_UNIFORMS is 0.
    atMost("images", needs.images, needs.isCompute ? 8 : 0);
    atMost("uniform blocks", needs.uniformBlocks, 14); // MAX_COMPUTE_UNIFORM_BLOCKS
    // MAX_COMPUTE_SHADER_STORAGE_BLOCKS; MAX_VERTEX_SHADER_STORAGE_BLOCKS is 0.
    atMost("storage blocks", needs.storageBlocks, needs.isCompute ? 8 : 0);
    atMost("bytes in a uniform block", needs.largestBlock, 16384); // MAX_UNIFORM_BLOCK_SIZE
    atMost("components of uniforms", needs.looseUniforms,
           needs.isCompute ? 512 : 1024); // MAX_COMPUTE_, MAX_VERTEX_UNIFORM_COMPONENTS
    atMost("threads in a workgroup", needs.threads, 1024); // MAX_COMPUTE_WORK_GROUP_INVOCATIONS
    atMost("threads along an edge of a workgroup", needs.longestEdge, 1024);
    atMost("bytes of shared memory", needs.sharedBytes, 32768); // MAX_COMPUTE_SHARED_MEMORY_SIZE
    return beyond;
}

} // namespace afterglow::test
