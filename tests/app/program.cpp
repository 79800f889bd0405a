// SPDX-License-Identifier: MIT
#include "program.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace afterglow::test {

namespace {

void redirect(int stream, const std::string& file) {
    const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (descriptor < 0 || dup2(descriptor, stream) < 0)
        _exit(125);
}

} // namespace

std::string programPath() {
    const char* const program = std::getenv("AFTERGLOW_BIN");
    if (!program)
        throw std::runtime_error("AFTERGLOW_BIN is not set: which program is to be tested?");
    return program;
}

Run afterglow(const std::vector<std::string>& words,
              const std::map<std::string, std::string>& environment) {
    const std::string program = programPath();
    const TemporaryFolder folder;
    const std::string out = folder / "out", err = folder / "err";
    std::vector<char*> arguments{const_cast<char*>(program.c_str())};
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);

    const pid_t child = fork();
    if (child < 0)
        throw std::runtime_error("fork failed");
    if (child == 0) {
        for (const auto& [name, value] : environment)
            setenv(name.c_str(), value.c_str(), 1);
        redirect(STDOUT_FILENO, out);
        redirect(STDERR_FILENO, err);
        execv(program.c_str(), arguments.data());
        _exit(126);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), bytesOf(out),
            bytesOf(err)};
}

std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw std::runtime_error(file.string() + ": cannot be opened");
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

std::vector<std::string> filesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.is_regular_file())
                names.push_back(std::filesystem::relative(entry.path(), folder).string());
    std::ranges::sort(names);
    return names;
}

bool tellsTimes(std::string_view file) {
    return file.ends_with("timing.json") || file.ends_with("contact_sheet.png") ||
           file.ends_with("report.html");
}

bool isOneErrorLine(std::string_view text) {
    return text.starts_with("afterglow: ") && text.size() > 12 &&
           text.find('\n') == text.size() - 1;
}

} // namespace afterglow::test
