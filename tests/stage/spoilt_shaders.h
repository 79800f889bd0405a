// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/gl_fixture.h"
#include "tests/support/source_dir.h"
#include "tests/support/temporary_folder.h"

namespace afterglow::test {

/// A copy of the shader folder in which one file at a time can be spoilt.
class SpoiltShaders {
public:
    SpoiltShaders() {
        std::filesystem::copy(source(), root_, std::filesystem::copy_options::recursive);
    }

    /// How often `from` stands in the file; replaced by `to` where it does.
    int spoil(const std::string& file, const std::string& from, const std::string& to) {
        std::ifstream stream(root_ / file);
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        int count = 0;
        for (std::size_t at = text.find(from); at != std::string::npos;
             at = text.find(from, at + to.size())) {
            text.replace(at, from.size(), to);
            ++count;
        }
        std::ofstream(root_ / file) << text;
        return count;
    }
    void mend(const std::string& file) {
        std::filesystem::copy_file(source() / file, root_ / file,
                                   std::filesystem::copy_options::overwrite_existing);
    }
    ShaderLibrary library() const {
        return ShaderLibrary(ShaderSource::fromDirectory(root_), testShaders().common());
    }

private:
    static std::filesystem::path source() { return sourceDir() / "shaders"; }

    TemporaryFolder folder_;
    std::filesystem::path root_ = folder_.path();
};

} // namespace afterglow::test
