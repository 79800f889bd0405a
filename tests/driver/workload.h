// SPDX-License-Identifier: MIT
#pragma once

#include "renderer/gl/shader_library.h"
#include "renderer/pipeline/settings.h"

#include <string>
#include <utility>
#include <vector>

namespace afterglow::test {

/// Images of frames by name, each as a hash of its bits.
using Outputs = std::vector<std::pair<std::string, std::string>>;

/// Three frames of one filter, after frames of another size: camera, bodies and lights change.
Outputs renderFilter(ShaderLibrary& shaders, const Settings& settings);

/// Everything that the renderer does, in small: every filter, with merged samples and with extra
/// ones; several filters, one of which joins late; frames rendered again from a checkpoint; both
/// kinds of reference; what the window measures and shows.
Outputs renderEverything(ShaderLibrary& shaders);

/// The names of outputs that are not the same in both, or that one of them lacks; at most ten.
std::string differences(const Outputs& a, const Outputs& b);

/// The shaders as a GPU would be given them: textures are fetched through samplers.
ShaderLibrary& samplerShaders();
/// The same in a library of its own, whose programs are compiled anew.
ShaderLibrary freshShaders();
/// As that, with images in place of samplers, as llvmpipe is given them. The a-trous filter then
/// has another form.
ShaderLibrary freshImageShaders();

} // namespace afterglow::test
