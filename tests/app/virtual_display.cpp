#include "virtual_display.h"

#include "program.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace afterglow::test {
namespace {

using Clock = std::chrono::steady_clock;

void pauseShortly() {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

constexpr int kNotFound = 127;

} // namespace

Process::Process(const std::vector<std::string>& words, const std::filesystem::path& folder,
                 const std::string& display, const std::string& log, int kept) {
    std::vector<char*> arguments;
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    child_ = fork();
    if (child_ < 0)
        throw std::runtime_error("fork failed");
    if (child_ > 0)
        return;
    if (chdir(folder.c_str()) != 0)
        _exit(kNotFound);
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    if (kept >= 0)
        fcntl(kept, F_SETFD, 0);
    display.empty() ? unsetenv("DISPLAY") : setenv("DISPLAY", display.c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    execvp(arguments[0], arguments.data());
    _exit(kNotFound);
}

Process::~Process() {
    if (child_ > 0 && isRunning()) {
        kill(child_, SIGTERM);
        if (!wait(5.0)) {
            kill(child_, SIGKILL);
            wait(5.0);
        }
    }
}

std::optional<int> Process::wait(double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (!exitCode_ && child_ > 0) {
        int status = 0;
        if (waitpid(child_, &status, WNOHANG) == child_)
            exitCode_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        else if (Clock::now() >= end)
            return {};
        else
            pauseShortly();
    }
    return exitCode_;
}

VirtualDisplay::VirtualDisplay(int width, int height, const std::filesystem::path& folder)
    : folder_(folder) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw std::runtime_error("no pipe");
    const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
    // It finds a free number itself and says which once it listens.
    server_.emplace(std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]),
                                             "-screen", "0", screen, "-nolisten", "tcp",
                                             "-noreset"},
                    folder, "", "xvfb.log", ends[1]);
    close(ends[1]);
    std::string number;
    pollfd waiting{ends[0], POLLIN, 0};
    char byte = 0;
    while (poll(&waiting, 1, 20000) > 0 && read(ends[0], &byte, 1) == 1 && byte != '\n')
        number += byte;
    close(ends[0]);
    if (number.empty())
        throw std::runtime_error(
            "no X server: the Debian packages xvfb and xdotool are needed (third_party/install.sh "
            "--tests); Xvfb said: " +
            bytesOf(folder / "xvfb.log"));
    name_ = ":" + number;
}

void VirtualDisplay::act(std::initializer_list<std::string> words) const {
    act(std::vector<std::string>(words));
}

void VirtualDisplay::act(const std::vector<std::string>& words) const {
    std::vector<std::string> all{"xdotool"};
    all.insert(all.end(), words.begin(), words.end());
    Process hands(all, folder_, name_, "xdotool.log");
    if (hands.wait(20.0) != 0)
        throw std::runtime_error("xdotool " + words.front() +
                                 " failed; it said: " + bytesOf(folder_ / "xdotool.log"));
}

std::string VirtualDisplay::windowTitled(const std::string& title, Process& program,
                                         double seconds) const {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end && program.isRunning()) {
        Process hands({"xdotool", "search", "--onlyvisible", "--name", "^" + title}, folder_, name_,
                      "xdotool.log");
        if (hands.wait(20.0) == 0) {
            const std::string found = bytesOf(folder_ / "xdotool.log");
            return found.substr(0, found.find('\n'));
        }
        pauseShortly();
    }
    throw std::runtime_error("no window titled " + title +
                             (program.isRunning() ? " in time" : ": the program ended"));
}

} // namespace afterglow::test
