// SPDX-License-Identifier: MIT
#include "tests/driver/barrier_watch.h"

#include <array>
#include <string_view>

namespace afterglow::test {

namespace {

bool isImage(GLenum type) {
    return type >= GL_IMAGE_1D && type <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY;
}

bool isSampler(GLenum type) {
    return (type >= GL_SAMPLER_1D && type <= GL_SAMPLER_2D_RECT_SHADOW) ||
           (type >= GL_SAMPLER_1D_ARRAY && type <= GL_SAMPLER_CUBE_SHADOW) ||
           (type >= GL_INT_SAMPLER_1D && type <= GL_UNSIGNED_INT_SAMPLER_BUFFER);
}

std::string labelOf(GLenum kind, GLuint object) {
    std::array<char, 256> label{};
    if (object != 0)
        glGetObjectLabel(kind, object, GLsizei(label.size()), nullptr, label.data());
    return "'" + std::string(label.data()) + "'";
}

std::string textureName(GLuint texture) {
    return "texture " + labelOf(GL_TEXTURE, texture);
}

} // namespace

BarrierWatch* BarrierWatch::active = nullptr;

// Every command by which the renderer reaches a texture or a buffer. Each looks first, then calls
// the driver.
struct BarrierWatch::Overrides {
#define STAND_IN(member, Type, Name, parameters, arguments, look)                                  \
    static void GLAPIENTRY call##Name parameters {                                                 \
        BarrierWatch& w = *active;                                                                 \
        look;                                                                                      \
        w.overrides_->member.before() arguments;                                                   \
    }                                                                                              \
    GlOverride<Type> member{glad_gl##Name, call##Name};

    STAND_IN(useProgram, PFNGLUSEPROGRAMPROC, UseProgram, (GLuint program), (program),
             w.program_ = program)
    STAND_IN(deleteProgram, PFNGLDELETEPROGRAMPROC, DeleteProgram, (GLuint program), (program),
             w.slots_.erase(program))
    STAND_IN(bindTexture, PFNGLBINDTEXTUREUNITPROC, BindTextureUnit, (GLuint unit, GLuint texture),
             (unit, texture), w.sampled_[unit] = texture)
    STAND_IN(bindImage, PFNGLBINDIMAGETEXTUREPROC, BindImageTexture,
             (GLuint unit, GLuint texture, GLint level, GLboolean layered, GLint layer,
              GLenum access, GLenum format),
             (unit, texture, level, layered, layer, access, format),
             (w.images_[unit] = {texture, access}))
    STAND_IN(dispatch, PFNGLDISPATCHCOMPUTEPROC, DispatchCompute, (GLuint x, GLuint y, GLuint z),
             (x, y, z), w.useProgram())
    STAND_IN(barrier, PFNGLMEMORYBARRIERPROC, MemoryBarrier, (GLbitfield bits), (bits),
             for (auto* const all
                  : {&w.missing_, &w.missingOfBuffer_}) for (auto& [object, missing]
                                                             : *all) missing &= ~bits)
    STAND_IN(bindBlock, PFNGLBINDBUFFERBASEPROC, BindBufferBase,
             (GLenum target, GLuint index, GLuint buffer), (target, index, buffer),
             if (target == GL_SHADER_STORAGE_BUFFER) w.storage_[index] = buffer)
    STAND_IN(
        deleteTextures, PFNGLDELETETEXTURESPROC, DeleteTextures,
        (GLsizei count, const GLuint* textures), (count, textures),
        for (GLsizei i = 0; i < count; ++i) {
            w.missing_.erase(textures[i]);
            for (auto& [unit, texture] : w.sampled_)
                texture = texture == textures[i] ? 0 : texture;
            for (auto& [unit, image] : w.images_)
                image.texture = image.texture == textures[i] ? 0 : image.texture;
        })

    STAND_IN(
        deleteBuffers, PFNGLDELETEBUFFERSPROC, DeleteBuffers,
        (GLsizei count, const GLuint* buffers), (count, buffers),
        for (GLsizei i = 0; i < count; ++i) {
            w.viewOfBuffer_.erase(buffers[i]);
            w.missingOfBuffer_.erase(buffers[i]);
        })
    STAND_IN(writeBuffer, PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData,
             (GLuint buffer, GLintptr offset, GLsizeiptr size, const void* data),
             (buffer, offset, size, data),
             w.useBuffer(buffer, GL_BUFFER_UPDATE_BARRIER_BIT, "writing"))
    STAND_IN(readBuffer, PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData,
             (GLuint buffer, GLintptr offset, GLsizeiptr size, void* data),
             (buffer, offset, size, data),
             w.useBuffer(buffer, GL_BUFFER_UPDATE_BARRIER_BIT, "reading back"))
    STAND_IN(copyBuffer, PFNGLCOPYNAMEDBUFFERSUBDATAPROC, CopyNamedBufferSubData,
             (GLuint from, GLuint to, GLintptr fromOffset, GLintptr toOffset, GLsizeiptr size),
             (from, to, fromOffset, toOffset, size),
             w.useBuffer(from, GL_BUFFER_UPDATE_BARRIER_BIT, "copying"))

    STAND_IN(attach, PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture,
             (GLuint framebuffer, GLenum point, GLuint texture, GLint level),
             (framebuffer, point, texture, level), w.attachments_[framebuffer].insert(texture))
    STAND_IN(deleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers,
             (GLsizei count, const GLuint* framebuffers), (count, framebuffers),
             for (GLsizei i = 0; i < count; ++i) w.attachments_.erase(framebuffers[i]))
    STAND_IN(bindFramebuffer, PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer,
             (GLenum target, GLuint framebuffer), (target, framebuffer),
             w.framebuffer_ = framebuffer)
    STAND_IN(draw, PFNGLDRAWELEMENTSPROC, DrawElements,
             (GLenum mode, GLsizei count, GLenum type, const void* indices),
             (mode, count, type, indices), (w.useProgram(), w.useAttachments("drawing into")))
    STAND_IN(clearColor, PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv,
             (GLuint framebuffer, GLenum buffer, GLint index, const GLuint* value),
             (framebuffer, buffer, index, value),
             (w.framebuffer_ = framebuffer, w.useAttachments("clearing the attachment")))
    STAND_IN(clearFloat, PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv,
             (GLuint framebuffer, GLenum buffer, GLint index, const GLfloat* value),
             (framebuffer, buffer, index, value),
             (w.framebuffer_ = framebuffer, w.useAttachments("clearing the attachment")))

    STAND_IN(read, PFNGLGETTEXTUREIMAGEPROC, GetTextureImage,
             (GLuint texture, GLint level, GLenum format, GLenum type, GLsizei size, void* pixels),
             (texture, level, format, type, size, pixels),
             w.use(texture, GL_TEXTURE_UPDATE_BARRIER_BIT, "reading back"))
    STAND_IN(readPart, PFNGLGETTEXTURESUBIMAGEPROC, GetTextureSubImage,
             (GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei width, GLsizei height,
              GLsizei depth, GLenum format, GLenum type, GLsizei size, void* pixels),
             (texture, level, x, y, z, width, height, depth, format, type, size, pixels),
             w.use(texture, GL_TEXTURE_UPDATE_BARRIER_BIT, "reading back a part"))
    STAND_IN(write, PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D,
             (GLuint texture, GLint level, GLint x, GLint y, GLsizei width, GLsizei height,
              GLenum format, GLenum type, const void* pixels),
             (texture, level, x, y, width, height, format, type, pixels),
             w.use(texture, GL_TEXTURE_UPDATE_BARRIER_BIT, "writing"))
    STAND_IN(writeLayer, PFNGLTEXTURESUBIMAGE3DPROC, TextureSubImage3D,
             (GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei width, GLsizei height,
              GLsizei depth, GLenum format, GLenum type, const void* pixels),
             (texture, level, x, y, z, width, height, depth, format, type, pixels),
             w.use(texture, GL_TEXTURE_UPDATE_BARRIER_BIT, "writing a layer of"))
    STAND_IN(clear, PFNGLCLEARTEXIMAGEPROC, ClearTexImage,
             (GLuint texture, GLint level, GLenum format, GLenum type, const void* data),
             (texture, level, format, type, data),
             w.use(texture, GL_TEXTURE_UPDATE_BARRIER_BIT, "clearing"))
    STAND_IN(copy, PFNGLCOPYIMAGESUBDATAPROC, CopyImageSubData,
             (GLuint from, GLenum fromTarget, GLint fromLevel, GLint fromX, GLint fromY,
              GLint fromZ, GLuint to, GLenum toTarget, GLint toLevel, GLint toX, GLint toY,
              GLint toZ, GLsizei width, GLsizei height, GLsizei depth),
             (from, fromTarget, fromLevel, fromX, fromY, fromZ, to, toTarget, toLevel, toX, toY,
              toZ, width, height, depth),
             (w.use(from, GL_TEXTURE_UPDATE_BARRIER_BIT, "copying from"),
              w.use(to, GL_TEXTURE_UPDATE_BARRIER_BIT, "copying to")))
#undef STAND_IN
};

BarrierWatch::BarrierWatch() : overrides_(new Overrides) {
    active = this;
}

BarrierWatch::~BarrierWatch() {
    delete overrides_;
    active = nullptr;
}

std::string BarrierWatch::text() const {
    std::string all;
    for (const std::string& fault : faults_)
        all += fault + "\n";
    return all;
}

std::string BarrierWatch::programName() const {
    return labelOf(GL_PROGRAM, program_);
}

const std::vector<BarrierWatch::Slot>& BarrierWatch::slotsOf(GLuint program) {
    const auto [found, isNew] = slots_.try_emplace(program);
    if (!isNew)
        return found->second;
    GLint count = 0;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        std::array<char, 128> name{};
        GLint size = 0, unit = 0;
        GLenum type = 0;
        glGetActiveUniform(program, GLuint(i), GLsizei(name.size()), nullptr, &size, &type,
                           name.data());
        if (!isImage(type) && !isSampler(type))
            continue;
        glGetUniformiv(program, glGetUniformLocation(program, name.data()), &unit);
        found->second.push_back({name.data(), isImage(type) ? Kind::Image : Kind::Sampler, unit});
    }
    glGetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; ++i) {
        std::array<char, 128> name{};
        glGetProgramResourceName(program, GL_SHADER_STORAGE_BLOCK, GLuint(i), GLsizei(name.size()),
                                 nullptr, name.data());
        const GLenum wanted = GL_BUFFER_BINDING;
        GLint binding = 0;
        glGetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, GLuint(i), 1, &wanted, 1, nullptr,
                               &binding);
        found->second.push_back({name.data(), Kind::Storage, binding});
    }
    return found->second;
}

void BarrierWatch::use(GLuint texture, GLbitfield bit, const std::string& how) {
    const auto missing = missing_.find(texture);
    if (missing != missing_.end() && (missing->second & bit))
        fault(how + " " + textureName(texture) + " without its barrier");
}

void BarrierWatch::useAttachments(const char* how) {
    for (const GLuint texture : attachments_[framebuffer_])
        use(texture, GL_FRAMEBUFFER_BARRIER_BIT, how);
}

void BarrierWatch::useBuffer(GLuint buffer, GLbitfield bit, const std::string& how) {
    const auto view = viewOfBuffer_.find(buffer);
    if (view != viewOfBuffer_.end())
        use(view->second, bit, how + " the buffer of");
    const auto missing = missingOfBuffer_.find(buffer);
    if (missing != missingOfBuffer_.end() && (missing->second & bit))
        fault(how + " buffer " + labelOf(GL_BUFFER, buffer) + " without its barrier");
}

// Every storage block counts as read and written.
void BarrierWatch::useStorage(const Slot& slot) {
    const std::string in = "in " + programName() + ": ";
    const GLuint buffer = storage_[GLuint(slot.unit)];
    if (buffer == 0)
        return fault(in + slot.name + " is not bound");
    useBuffer(buffer, GL_SHADER_STORAGE_BARRIER_BIT, in + "using");
    missingOfBuffer_[buffer] = ~GLbitfield(0);
}

void BarrierWatch::useProgram() {
    ++dispatches_;
    const std::string in = "in " + programName() + ": ";
    std::set<GLuint> sampled, written;
    std::multiset<GLuint> asImage;
    for (const Slot& slot : slotsOf(program_)) {
        if (slot.kind == Kind::Storage) {
            useStorage(slot);
            continue;
        }
        const bool isImage = slot.kind == Kind::Image;
        const Image image = isImage ? images_[GLuint(slot.unit)] : Image{};
        const GLuint texture = isImage ? image.texture : sampled_[GLuint(slot.unit)];
        if (texture == 0) {
            fault(in + slot.name + " is not bound");
            continue;
        }
        use(texture, isImage ? GL_SHADER_IMAGE_ACCESS_BARRIER_BIT : GL_TEXTURE_FETCH_BARRIER_BIT,
            in + (isImage ? "image access to" : "fetching"));
        if (isImage && image.access != GL_READ_ONLY)
            written.insert(texture);
        if (isImage)
            asImage.insert(texture);
        else
            sampled.insert(texture);
    }
    for (const GLuint texture : written) {
        if (asImage.count(texture) > 1)
            fault(in + textureName(texture) + " is written, and another image as well");
        if (sampled.count(texture))
            fault(in + textureName(texture) + " is sampled and written");
        missing_[texture] = ~GLbitfield(0);
        GLint buffer = 0; // of whose texels the texture is a view; none: 0
        glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
        if (buffer != 0)
            viewOfBuffer_[GLuint(buffer)] = texture;
    }
}

} // namespace afterglow::test
