// SPDX-License-Identifier: MIT
#include "virtual_display.h"

#include "program.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xcb/xcb.h>

namespace afterglow::test {
namespace {

using Clock = std::chrono::steady_clock;

void pauseShortly() {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

constexpr int kNotFound = 127;

struct Root {
    xcb_window_t id;
    bool managed; ///< somebody wants to be asked before a window is shown: that is a window manager
};

Root rootOf(const std::string& display) {
    int screen = 0;
    const std::unique_ptr<xcb_connection_t, void (*)(xcb_connection_t*)> x(
        xcb_connect(display.c_str(), &screen), xcb_disconnect);
    if (xcb_connection_has_error(x.get()))
        throw std::runtime_error("no X server at " + display);
    Root root{xcb_setup_roots_iterator(xcb_get_setup(x.get())).data->root, false};
    const std::unique_ptr<xcb_get_window_attributes_reply_t, void (*)(void*)> attributes(
        xcb_get_window_attributes_reply(x.get(), xcb_get_window_attributes(x.get(), root.id),
                                        nullptr),
        std::free);
    root.managed =
        attributes && (attributes->all_event_masks & XCB_EVENT_MASK_SUBSTRUCTURE_REDIRECT);
    return root;
}

} // namespace

Process::Process(const std::vector<std::string>& words, const std::filesystem::path& folder,
                 const std::string& display, const std::string& log, int kept,
                 const std::map<std::string, std::string>& environment) {
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
    for (const auto& [name, value] : environment)
        setenv(name.c_str(), value.c_str(), 1);
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

// proc(5): /proc/PID/stat holds, counted from 1, utime and stime as its words 14 and 15. The second
// is a name in brackets that may have blanks in it.
double Process::processorSeconds() const {
    const std::string stat = bytesOf("/proc/" + std::to_string(child_) + "/stat");
    std::istringstream words(stat.substr(stat.rfind(')') + 1));
    std::string word;
    for (int i = 3; i < 14; ++i)
        words >> word;
    double user = 0.0, system = 0.0;
    if (!(words >> user >> system))
        throw std::runtime_error("/proc tells no processor time: " + stat);
    return (user + system) / double(sysconf(_SC_CLK_TCK));
}

VirtualDisplay::VirtualDisplay(int width, int height, const std::filesystem::path& folder,
                               WindowManager manager)
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
    root_ = std::to_string(rootOf(name_).id);
    if (manager == WindowManager::Plain)
        startManager();
}

// One that needs neither fonts nor settings, does what WM_CHANGE_STATE asks for and leaves windows
// the size they want.
void VirtualDisplay::startManager() {
    manager_.emplace(std::vector<std::string>{"9wm"}, folder_, name_, "9wm.log");
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (!rootOf(name_).managed) {
        if (Clock::now() >= end || !manager_->isRunning())
            throw std::runtime_error("no window manager: the Debian package 9wm is needed "
                                     "(third_party/install.sh --tests); it said: " +
                                     bytesOf(folder_ / "9wm.log"));
        pauseShortly();
    }
}

void VirtualDisplay::act(std::initializer_list<std::string> words) const {
    act(std::vector<std::string>(words));
}

void VirtualDisplay::act(const std::vector<std::string>& words) const {
    ask(words);
}

std::string VirtualDisplay::ask(const std::vector<std::string>& words) const {
    std::vector<std::string> all{"xdotool"};
    all.insert(all.end(), words.begin(), words.end());
    Process hands(all, folder_, name_, "xdotool.log");
    const std::optional<int> code = hands.wait(20.0);
    const std::string said = bytesOf(folder_ / "xdotool.log");
    if (code != 0)
        throw std::runtime_error("xdotool " + words.front() + " failed; it said: " + said);
    return said;
}

std::string VirtualDisplay::windowTitled(const std::string& title, double seconds,
                                         Process* program) const {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end && (!program || program->isRunning())) {
        Process hands({"xdotool", "search", "--onlyvisible", "--name", "^" + title}, folder_, name_,
                      "xdotool.log");
        if (hands.wait(20.0) == 0) {
            const std::string found = bytesOf(folder_ / "xdotool.log");
            return found.substr(0, found.find('\n'));
        }
        pauseShortly();
    }
    throw std::runtime_error("no window titled " + title + " in time");
}

} // namespace afterglow::test
