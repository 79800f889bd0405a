// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/shader_source.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/texture_array.h"

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afterglow {

/// A texture, an array of them, a buffer seen as texels, or a buffer that holds a block, under the
/// name that the shader knows it by. For the duration of a call.
struct Binding {
    Binding(std::string_view shaderName, const GpuTexture& source)
        : name(shaderName), texture(&source) {}
    Binding(std::string_view shaderName, const GpuTextureArray& source)
        : name(shaderName), array(&source) {}
    Binding(std::string_view shaderName, const TexelBuffer& source)
        : name(shaderName), buffer(&source) {}
    Binding(std::string_view blockName, const GpuBuffer& source)
        : name(blockName), block(&source) {}

    std::string_view name;
    const GpuTexture* texture = nullptr; ///< one of the four
    const GpuTextureArray* array = nullptr;
    const TexelBuffer* buffer = nullptr;
    const GpuBuffer* block = nullptr; ///< a uniform block; a shader storage block where written
};

/// Hears of each dispatch of a compute program, right after it.
class DispatchListener {
public:
    virtual ~DispatchListener() = default;
    virtual void dispatched(std::span<const Binding> reads, std::span<const Binding> writes) = 0;
};
/// From the next dispatch on; null: nobody. Must outlive its use.
void setDispatchListener(DispatchListener* listener);

/// Sets whether names must match: one that a program does not use, or that it uses and was not
/// given, is then std::logic_error. On from the start in builds that take shaders from the source
/// folder, and in tests; off elsewhere: a driver may drop a texture that it proves unused, or keep
/// one whose use the defines removed, and drivers prove different things.
void setStrictBindings(bool strict);

/// A linked program with its inputs by name: textures, uniform blocks, and one block named Params
/// that it owns.
/// Units and sizes are asked from the driver; they are written nowhere else.
class LinkedProgram {
public:
    struct Stage {
        GLenum type; ///< GL_COMPUTE_SHADER, ...
        const ExpandedShader& source;
    };
    /// Throws Error "lib/bad.glsl:3: no function with name 'dott'".
    LinkedProgram(std::string_view name, std::initializer_list<Stage> stages);

    GLuint id() const { return program_.id(); }
    const std::string& name() const { return name_; }

    /// Binds textures and blocks. `reads` may be samplers or images in the shader, `writes` are
    /// images. A name that is not given is left without a texture. Throws std::logic_error when a
    /// name is missing or surplus (see setStrictBindings), given twice, or of another kind than the
    /// shader declares.
    void bind(std::span<const Binding> reads, std::span<const Binding> writes);
    /// Replaces the block Params. Throws std::logic_error unless it is of the size of the block; no
    /// bytes for no block.
    void setParams(std::span<const std::byte> params);

private:
    struct Slot {
        std::string name;
        GLenum type; ///< GL_SAMPLER_2D, GL_UNSIGNED_INT_IMAGE_BUFFER, ...; of a block
                     ///< GL_UNIFORM_BUFFER or GL_SHADER_STORAGE_BUFFER
        GLint unit;
    };

    void reflect();
    void reflectBlocks(GLenum interface, GLenum type);
    const Slot* find(std::string_view name) const;
    void bindOne(const Slot& slot, const Binding& binding, bool written) const;
    void unbind(const Slot& slot) const;
    std::string slotNames() const;

    std::string name_;
    GlObject<ProgramKind> program_;
    GpuBuffer params_;
    std::vector<Slot> slots_;
};

/// A compute shader, its textures and its one parameter block.
///
/// The shader has `layout(std140, binding = kPassBlock) uniform Params { ... };` or no parameters.
/// Other blocks, as that of the frame, are read under their names.
class ComputeProgram {
public:
    ComputeProgram(std::string_view name, const ExpandedShader& source);

    /// Runs it over `size` threads or a little more, in whole workgroups, and lets later commands
    /// see what it wrote. Throws std::logic_error as LinkedProgram does.
    template <class Params>
    void dispatch(glm::ivec3 size, const Params& params, std::initializer_list<Binding> reads,
                  std::initializer_list<Binding> writes) {
        static_assert(std::is_trivially_copyable_v<Params>);
        static_assert(sizeof(Params) % 16 == 0, "GLSL rounds block sizes up to 16 bytes; pad");
        dispatchBytes(size, std::as_bytes(std::span(&params, 1)), reads, writes);
    }
    void dispatch(glm::ivec3 size, std::initializer_list<Binding> reads,
                  std::initializer_list<Binding> writes) {
        dispatchBytes(size, {}, reads, writes);
    }
    // Runs it over one layer of threads.
    template <class Params>
    void dispatch(glm::ivec2 size, const Params& params, std::initializer_list<Binding> reads,
                  std::initializer_list<Binding> writes) {
        dispatch(glm::ivec3(size, 1), params, reads, writes);
    }
    void dispatch(glm::ivec2 size, std::initializer_list<Binding> reads,
                  std::initializer_list<Binding> writes) {
        dispatch(glm::ivec3(size, 1), reads, writes);
    }
    // Runs it with lists whose length is not known at compile time.
    template <class Params>
    void dispatch(glm::ivec2 size, const Params& params, std::span<const Binding> reads,
                  std::span<const Binding> writes) {
        static_assert(sizeof(Params) % 16 == 0, "GLSL rounds block sizes up to 16 bytes; pad");
        dispatchBytes(glm::ivec3(size, 1), std::as_bytes(std::span(&params, 1)), reads, writes);
    }
    void dispatch(glm::ivec2 size, std::span<const Binding> reads,
                  std::span<const Binding> writes) {
        dispatchBytes(glm::ivec3(size, 1), {}, reads, writes);
    }

    glm::ivec3 groupSize() const { return groupSize_; } ///< threads in a workgroup
    const std::string& name() const { return program_.name(); }
    GLuint id() const { return program_.id(); }

private:
    void dispatchBytes(glm::ivec3 size, std::span<const std::byte> params,
                       std::span<const Binding> reads, std::span<const Binding> writes);

    LinkedProgram program_;
    glm::ivec3 groupSize_{1};
};

/// A vertex and a fragment shader. Draw calls and their state are the caller's.
class RasterProgram {
public:
    RasterProgram(std::string_view name, const ExpandedShader& vertexSource,
                  const ExpandedShader& fragmentSource);

    /// Makes it current, with its textures and its parameters in place.
    template <class Params>
    void use(const Params& params, std::initializer_list<Binding> reads = {}) {
        static_assert(std::is_trivially_copyable_v<Params>);
        static_assert(sizeof(Params) % 16 == 0, "GLSL rounds block sizes up to 16 bytes; pad");
        useBytes(std::as_bytes(std::span(&params, 1)), reads);
    }
    void use(std::initializer_list<Binding> reads = {}) { useBytes({}, reads); }

    /// Sets a uniform outside any block, for what changes from draw to draw. A name that the
    /// program does not have is std::logic_error where bindings are strict.
    void set(std::string_view uniform, int value);
    void set(std::string_view uniform, std::uint32_t value);
    void set(std::string_view uniform, float value);
    void set(std::string_view uniform, glm::vec2 value);
    void set(std::string_view uniform, glm::vec4 value);
    void set(std::string_view uniform, const glm::mat4& value);

    const std::string& name() const { return program_.name(); }
    GLuint id() const { return program_.id(); }

private:
    void useBytes(std::span<const std::byte> params, std::span<const Binding> reads);
    GLint location(std::string_view uniform) const;

    LinkedProgram program_;
};

} // namespace afterglow
