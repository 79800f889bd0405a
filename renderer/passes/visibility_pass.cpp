// SPDX-License-Identifier: MIT
#include "renderer/passes/visibility_pass.h"

#include <cstddef>

namespace afterglow {

VisibilityPass::VisibilityPass(ShaderLibrary& shaders)
    : raster_(shaders.raster("scene/visibility.vert", "scene/visibility.frag")),
      resolve_(shaders.compute("scene/resolve.comp")),
      vertexArray_(GlObject<VertexArrayKind>::create("visibility")) {
    glEnableVertexArrayAttrib(vertexArray_.id(), 0);
    glVertexArrayAttribFormat(vertexArray_.id(), 0, 3, GL_FLOAT, GL_FALSE,
                              offsetof(gpu::Vertex, position));
    glVertexArrayAttribBinding(vertexArray_.id(), 0, 0);
}

void VisibilityPass::run(FrameContext& frame, const SceneGpu& scene, const Outputs& out) {
    {
        const auto scope = frame.pass("visibility", {&out.ids});
        rasterize(frame, scene, out.framebuffer);
    }
    const auto scope = frame.pass("resolve", {&out.visibility, &out.seeds});
    resolve(frame, scene, out);
}

void VisibilityPass::resolve(const FrameContext& frame, const SceneGpu& scene, const Outputs& out) {
    resolve_.dispatch(out.ids.size(),
                      {frame.block(),
                       {"ids", out.ids},
                       {"vertices", scene.vertices},
                       {"triangles", scene.triangles},
                       {"instances", scene.instances}},
                      {{"visibility", out.visibility}, {"seeds", out.seeds}});
}

void VisibilityPass::rasterize(const FrameContext& frame, const SceneGpu& scene,
                               const Framebuffer& framebuffer) {
    framebuffer.bind();
    framebuffer.clearColor(0, glm::uvec4(0u));
    framebuffer.clearDepth(0.0f); // depth is reversed: 0 is far
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glBindVertexArray(vertexArray_.id());
    glVertexArrayVertexBuffer(vertexArray_.id(), 0, scene.vertexBuffer().id(), 0,
                              sizeof(gpu::Vertex));
    glVertexArrayElementBuffer(vertexArray_.id(), scene.indexBuffer().id());
    raster_.use({frame.block()});
    for (const SceneGpu::Draw& draw : scene.draws()) {
        // glTF 2.0, section 3.7.4: back faces of single-sided materials are culled; a mirroring
        // transform turns front into back.
        if (draw.doubleSided)
            glDisable(GL_CULL_FACE);
        else
            glEnable(GL_CULL_FACE);
        glFrontFace(draw.mirrored ? GL_CW : GL_CCW);
        raster_.set("worldFromObject", draw.worldFromObject);
        raster_.set("instance", draw.instance);
        glDrawElements(GL_TRIANGLES, draw.indexCount, GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(draw.firstIndex * sizeof(std::uint32_t)));
    }
    glBindVertexArray(0);
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

} // namespace afterglow
