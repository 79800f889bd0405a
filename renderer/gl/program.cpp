// SPDX-License-Identifier: MIT
#include "renderer/gl/program.h"

#include "renderer/base/error.h"
#include "shared/bindings.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace afterglow {

namespace {

#ifdef AFTERGLOW_SHADER_DIR
bool strictBindings = true;
#else
bool strictBindings = false;
#endif

DispatchListener* dispatchListener = nullptr;

bool isBlock(GLenum type) {
    return type == GL_UNIFORM_BUFFER || type == GL_SHADER_STORAGE_BUFFER;
}

bool isImage(GLenum type) {
    return type >= GL_IMAGE_1D && type <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY;
}

/// Returns the kind of texture that a Binding can stand for; empty for any other type of uniform.
std::string_view kindName(GLenum type) {
    switch (type) {
    case GL_SAMPLER_2D: return "sampler2D";
    case GL_UNSIGNED_INT_SAMPLER_2D: return "usampler2D";
    case GL_SAMPLER_2D_ARRAY: return "sampler2DArray";
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY: return "usampler2DArray";
    case GL_SAMPLER_BUFFER: return "samplerBuffer";
    case GL_UNSIGNED_INT_SAMPLER_BUFFER: return "usamplerBuffer";
    case GL_IMAGE_2D: return "image2D";
    case GL_UNSIGNED_INT_IMAGE_2D: return "uimage2D";
    case GL_IMAGE_2D_ARRAY: return "image2DArray";
    case GL_UNSIGNED_INT_IMAGE_2D_ARRAY: return "uimage2DArray";
    case GL_IMAGE_BUFFER: return "imageBuffer";
    case GL_UNSIGNED_INT_IMAGE_BUFFER: return "uimageBuffer";
    // No types of GLSL have these numbers.
    case GL_UNIFORM_BUFFER: return "a uniform block";
    case GL_SHADER_STORAGE_BUFFER: return "a storage block";
    default: return {};
    }
}

PixelFormat formatOf(const Binding& binding) {
    return binding.buffer  ? binding.buffer->format()
           : binding.array ? binding.array->format()
                           : binding.texture->format();
}

GLuint idOf(const Binding& binding) {
    return binding.block    ? binding.block->id()
           : binding.buffer ? binding.buffer->texture()
           : binding.array  ? binding.array->id()
                            : binding.texture->id();
}

/// Returns whether a uniform of this type can take this texture, array or buffer.
bool fits(GLenum type, const Binding& binding) {
    if (binding.block || isBlock(type))
        return binding.block && isBlock(type);
    const FormatInfo format = info(formatOf(binding));
    if (isImage(type) && !format.isImage)
        return false;
    const auto isOneOf = [&](GLenum sampler, GLenum image, GLenum uintSampler, GLenum uintImage) {
        return format.isInteger ? type == uintSampler || type == uintImage
                                : type == sampler || type == image;
    };
    if (binding.buffer)
        return isOneOf(GL_SAMPLER_BUFFER, GL_IMAGE_BUFFER, GL_UNSIGNED_INT_SAMPLER_BUFFER,
                       GL_UNSIGNED_INT_IMAGE_BUFFER);
    if (binding.array)
        return isOneOf(GL_SAMPLER_2D_ARRAY, GL_IMAGE_2D_ARRAY, GL_UNSIGNED_INT_SAMPLER_2D_ARRAY,
                       GL_UNSIGNED_INT_IMAGE_2D_ARRAY);
    return isOneOf(GL_SAMPLER_2D, GL_IMAGE_2D, GL_UNSIGNED_INT_SAMPLER_2D,
                   GL_UNSIGNED_INT_IMAGE_2D);
}

std::string describe(const Binding& binding) {
    if (binding.block)
        return "a buffer with a block";
    return (binding.buffer  ? "a buffer of texels of format "
            : binding.array ? "an array of textures of format "
                            : "a texture of format ") +
           std::string(info(formatOf(binding)).name);
}

std::string infoLog(GLuint id, auto getParameter, auto getLog) {
    GLint length = 0;
    getParameter(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    getLog(id, GLsizei(log.size()), nullptr, log.data());
    return log.substr(0, log.find('\0'));
}

GlObject<ShaderKind> compile(const LinkedProgram::Stage& stage) {
    auto shader = GlObject<ShaderKind>::create(stage.source.name(), stage.type);
    const char* text = stage.source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint compiled = 0;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (!compiled)
        throw Error(describeCompileError(stage.source,
                                         infoLog(shader.id(), glGetShaderiv, glGetShaderInfoLog)));
    return shader;
}

GlObject<ProgramKind> link(std::string_view name,
                           std::initializer_list<LinkedProgram::Stage> stages) {
    std::vector<GlObject<ShaderKind>> shaders;
    for (const LinkedProgram::Stage& stage : stages)
        shaders.push_back(compile(stage));
    auto program = GlObject<ProgramKind>::create(name);
    for (const auto& shader : shaders)
        glAttachShader(program.id(), shader.id());
    glLinkProgram(program.id());
    for (const auto& shader : shaders)
        glDetachShader(program.id(), shader.id());
    GLint linked = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (!linked)
        throw Error(describeCompileError(
            stages.begin()->source, infoLog(program.id(), glGetProgramiv, glGetProgramInfoLog)));
    return program;
}

} // namespace

void setStrictBindings(bool strict) {
    strictBindings = strict;
}

void setDispatchListener(DispatchListener* listener) {
    dispatchListener = listener;
}

LinkedProgram::LinkedProgram(std::string_view name, std::initializer_list<Stage> stages)
    : name_(name), program_(link(name, stages)) {
    reflect();
}

void LinkedProgram::reflect() {
    GLint count = 0;
    glGetProgramInterfaceiv(id(), GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    GLint samplers = 0, images = 0;
    for (GLuint i = 0; i < GLuint(count); ++i) {
        const std::array<GLenum, 4> wanted{GL_TYPE, GL_LOCATION, GL_BLOCK_INDEX, GL_ARRAY_SIZE};
        std::array<GLint, 4> got{};
        glGetProgramResourceiv(id(), GL_UNIFORM, i, GLsizei(wanted.size()), wanted.data(),
                               GLsizei(got.size()), nullptr, got.data());
        const auto [type, location, block, elements] = got;
        if (block >= 0 || kindName(GLenum(type)).empty())
            continue; // a member of a block, or a loose uniform
        std::array<char, 128> slotName{};
        glGetProgramResourceName(id(), GL_UNIFORM, i, GLsizei(slotName.size()), nullptr,
                                 slotName.data());
        if (elements > 1)
            throw std::logic_error(name_ + ": " + slotName.data() +
                                   " is an array of textures; a name stands for one");
        const GLint unit = isImage(GLenum(type)) ? images++ : samplers++;
        slots_.push_back({slotName.data(), GLenum(type), unit});
        glProgramUniform1i(id(), location, unit);
    }
    reflectBlocks(GL_UNIFORM_BLOCK, GL_UNIFORM_BUFFER);
    reflectBlocks(GL_SHADER_STORAGE_BLOCK, GL_SHADER_STORAGE_BUFFER);
    // Drivers list them in orders of their own; messages shall not depend on that.
    std::ranges::sort(slots_, {}, &Slot::name);
}

void LinkedProgram::reflectBlocks(GLenum interface, GLenum type) {
    GLint count = 0;
    glGetProgramInterfaceiv(id(), interface, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < GLuint(count); ++i) {
        const std::array<GLenum, 2> wanted{GL_BUFFER_BINDING, GL_BUFFER_DATA_SIZE};
        std::array<GLint, 2> got{};
        glGetProgramResourceiv(id(), interface, i, GLsizei(wanted.size()), wanted.data(),
                               GLsizei(got.size()), nullptr, got.data());
        std::array<char, 128> blockName{};
        glGetProgramResourceName(id(), interface, i, GLsizei(blockName.size()), nullptr,
                                 blockName.data());
        if (std::string_view(blockName.data()) == "Params")
            params_ = GpuBuffer(name_ + " Params", std::size_t(got[1]));
        else
            slots_.push_back({blockName.data(), type, got[0]});
    }
}

const LinkedProgram::Slot* LinkedProgram::find(std::string_view name) const {
    const auto slot = std::ranges::find(slots_, name, &Slot::name);
    return slot == slots_.end() ? nullptr : &*slot;
}

std::string LinkedProgram::slotNames() const {
    std::string names;
    for (const Slot& slot : slots_)
        names += (names.empty() ? "" : ", ") + slot.name;
    return names.empty() ? "none" : names;
}

void LinkedProgram::bindOne(const Slot& slot, const Binding& binding, bool written) const {
    if (!fits(slot.type, binding))
        throw std::logic_error(name_ + " declares " + slot.name + " as " +
                               std::string(kindName(slot.type)) + ", but was given " +
                               describe(binding));
    const bool isWritable = isImage(slot.type) || slot.type == GL_SHADER_STORAGE_BUFFER;
    if (written && !isWritable)
        throw std::logic_error(name_ + " samples " + slot.name + "; it cannot be written");
    const GLuint texture = idOf(binding);
    if (texture == 0)
        throw std::logic_error(name_ + " was given nothing as " + slot.name +
                               ": the texture was never made");
    if (isBlock(slot.type)) {
        glBindBufferBase(slot.type, GLuint(slot.unit), texture);
        return;
    }
    if (!isImage(slot.type)) {
        glBindTextureUnit(GLuint(slot.unit), texture);
        return;
    }
    glBindImageTexture(GLuint(slot.unit), texture, 0, binding.array ? GL_TRUE : GL_FALSE, 0,
                       written ? GL_READ_WRITE : GL_READ_ONLY, info(formatOf(binding)).internal);
}

// Leaves nothing bound: reads then give zero, and stores do nothing. Never the texture of a program
// before.
void LinkedProgram::unbind(const Slot& slot) const {
    if (isBlock(slot.type))
        glBindBufferBase(slot.type, GLuint(slot.unit), 0);
    else if (isImage(slot.type))
        glBindImageTexture(GLuint(slot.unit), 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    else
        glBindTextureUnit(GLuint(slot.unit), 0);
}

void LinkedProgram::bind(std::span<const Binding> reads, std::span<const Binding> writes) {
    std::vector<const Slot*> given;
    const auto bindAll = [&](std::span<const Binding> bindings, bool written) {
        for (const Binding& binding : bindings) {
            const Slot* slot = find(binding.name);
            if (!slot) {
                if (strictBindings)
                    throw std::logic_error(name_ + " has no texture named " +
                                           std::string(binding.name) + "; it has " + slotNames());
                continue;
            }
            if (std::ranges::count(given, slot))
                throw std::logic_error(name_ + " was given " + slot->name + " twice");
            given.push_back(slot);
            bindOne(*slot, binding, written);
        }
    };
    bindAll(reads, false);
    bindAll(writes, true);

    std::string missing;
    for (const Slot& slot : slots_)
        if (!std::ranges::count(given, &slot)) {
            unbind(slot);
            missing += (missing.empty() ? "" : ", ") + slot.name;
        }
    if (!missing.empty() && strictBindings)
        throw std::logic_error(name_ + " uses " + slotNames() + " but was not given " + missing);
}

void LinkedProgram::setParams(std::span<const std::byte> params) {
    if (params.size() != params_.bytes()) {
        if (params_.empty())
            throw std::logic_error(name_ + " has no Params block, but " +
                                   std::to_string(params.size()) + " bytes were given");
        throw std::logic_error(name_ + ": its Params block is " + std::to_string(params_.bytes()) +
                               " bytes, but " + std::to_string(params.size()) + " were given");
    }
    if (params.empty())
        return;
    params_.write(params);
    glBindBufferBase(GL_UNIFORM_BUFFER, gpu::kPassBlock, params_.id());
}

ComputeProgram::ComputeProgram(std::string_view name, const ExpandedShader& source)
    : program_(name, {{GL_COMPUTE_SHADER, source}}) {
    glGetProgramiv(id(), GL_COMPUTE_WORK_GROUP_SIZE, &groupSize_.x);
}

void ComputeProgram::dispatchBytes(glm::ivec3 size, std::span<const std::byte> params,
                                   std::span<const Binding> reads,
                                   std::span<const Binding> writes) {
    program_.bind(reads, writes);
    program_.setParams(params);

    glUseProgram(id());
    const glm::ivec3 groups = (size + groupSize_ - 1) / groupSize_;
    glDispatchCompute(GLuint(groups.x), GLuint(groups.y), GLuint(groups.z));

    // Passes read what the passes before them wrote. A barrier here, after every dispatch, means no
    // pass has to think about it.
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    if (dispatchListener)
        dispatchListener->dispatched(reads, writes);
}

RasterProgram::RasterProgram(std::string_view name, const ExpandedShader& vertexSource,
                             const ExpandedShader& fragmentSource)
    : program_(name, {{GL_VERTEX_SHADER, vertexSource}, {GL_FRAGMENT_SHADER, fragmentSource}}) {}

void RasterProgram::useBytes(std::span<const std::byte> params, std::span<const Binding> reads) {
    program_.bind(reads, {});
    program_.setParams(params);
    glUseProgram(id());
}

GLint RasterProgram::location(std::string_view uniform) const {
    const GLint found = glGetUniformLocation(id(), std::string(uniform).c_str());
    if (found < 0 && strictBindings)
        throw std::logic_error(name() + " has no uniform named " + std::string(uniform));
    return found; // OpenGL ignores -1
}

void RasterProgram::set(std::string_view uniform, int value) {
    glProgramUniform1i(id(), location(uniform), value);
}
void RasterProgram::set(std::string_view uniform, std::uint32_t value) {
    glProgramUniform1ui(id(), location(uniform), value);
}
void RasterProgram::set(std::string_view uniform, float value) {
    glProgramUniform1f(id(), location(uniform), value);
}
void RasterProgram::set(std::string_view uniform, glm::vec2 value) {
    glProgramUniform2fv(id(), location(uniform), 1, &value.x);
}
void RasterProgram::set(std::string_view uniform, glm::vec4 value) {
    glProgramUniform4fv(id(), location(uniform), 1, &value.x);
}
void RasterProgram::set(std::string_view uniform, const glm::mat4& value) {
    glProgramUniformMatrix4fv(id(), location(uniform), 1, GL_FALSE, &value[0][0]);
}

} // namespace afterglow
