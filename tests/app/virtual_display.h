#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace afterglow::test {

/// A child process. Killed and waited for with the object.
class Process {
public:
    Process() = default;
    /// Runs in `folder`, with stdout and stderr in the file `log` there. A descriptor in `kept`
    /// stays open for it. `display`: the environment's DISPLAY; empty removes it.
    Process(const std::vector<std::string>& words, const std::filesystem::path& folder,
            const std::string& display, const std::string& log, int kept = -1);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// The exit code, 128 + signal if it was killed; nothing if it still runs after so long.
    std::optional<int> wait(double seconds);
    bool isRunning() { return !wait(0.0); }

private:
    pid_t child_ = -1;
    std::optional<int> exitCode_;
};

/// An X server without a screen, with hands on its keyboard and mouse. Throws std::runtime_error
/// that names the package when one of the programs is missing.
class VirtualDisplay {
public:
    VirtualDisplay(int width, int height, const std::filesystem::path& folder);

    const std::string& name() const { return name_; } ///< ":99"
    /// xdotool with these words; std::runtime_error if it fails.
    void act(std::initializer_list<std::string> words) const;
    void act(const std::vector<std::string>& words) const;
    /// The id of the one window whose title begins so, waiting for it as long as the program runs.
    std::string windowTitled(const std::string& title, Process& program, double seconds) const;

private:
    std::filesystem::path folder_;
    std::optional<Process> server_;
    std::string name_;
};

} // namespace afterglow::test
