// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
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
    /// stays open for it. `display`: the environment's DISPLAY; empty removes it. `environment`:
    /// more of it.
    Process(const std::vector<std::string>& words, const std::filesystem::path& folder,
            const std::string& display, const std::string& log, int kept = -1,
            const std::map<std::string, std::string>& environment = {});
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// The exit code, 128 + signal if it was killed; nothing if it still runs after so long.
    std::optional<int> wait(double seconds);
    bool isRunning() { return !wait(0.0); }
    /// Seconds of processor time of all its threads so far. std::runtime_error once it has ended.
    double processorSeconds() const;

private:
    pid_t child_ = -1;
    std::optional<int> exitCode_;
};

/// Whether somebody sees to the windows of a display. Bare, a window is where and as large as the
/// program wants it, and nothing can be minimized.
enum class WindowManager { None, Plain };

/// An X server without a screen, with hands on its keyboard and mouse. Throws std::runtime_error
/// that names the package when one of the programs is missing.
class VirtualDisplay {
public:
    VirtualDisplay(int width, int height, const std::filesystem::path& folder,
                   WindowManager manager = WindowManager::None);

    const std::string& name() const { return name_; } ///< ":99"
    const std::string& root() const { return root_; } ///< the id of the window behind all others
    /// xdotool with these words; std::runtime_error if it fails.
    void act(std::initializer_list<std::string> words) const;
    void act(const std::vector<std::string>& words) const;
    std::string ask(const std::vector<std::string>& words) const; ///< and what it says
    /// The id of the one window whose title begins with this regular expression, waiting for it as
    /// long as the program, if one is given, runs.
    std::string windowTitled(const std::string& title, double seconds = 20.0,
                             Process* program = nullptr) const;

private:
    void startManager();

    std::filesystem::path folder_;
    std::optional<Process> manager_; // which ends only when it is asked to after its server is gone
    std::optional<Process> server_;
    std::string name_, root_;
};

} // namespace afterglow::test
