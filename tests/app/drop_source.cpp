// SPDX-License-Identifier: MIT
// The source's half of "Drag-and-Drop Protocol for the X Window System" (XDND), version 5, and as
// much of the ICCCM's selections as it needs.

#include "drop_source.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

#include <poll.h>
#include <xcb/xcb.h>

namespace afterglow::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kVersion = 5;

struct Free {
    void operator()(void* reply) const { std::free(reply); }
};
template <class T>
using Reply = std::unique_ptr<T, Free>;

// RFC 8089 and RFC 3986: all but what may stand for itself is written as %XX.
std::string uriOf(const std::filesystem::path& file) {
    std::string uri = "file://";
    for (const unsigned char c : std::filesystem::absolute(file).string()) {
        if (std::isalnum(c) || std::strchr("/-._~", c)) {
            uri += char(c);
        } else {
            char escaped[4];
            std::snprintf(escaped, sizeof escaped, "%%%02X", unsigned(c));
            uri += escaped;
        }
    }
    return uri;
}

/// One drag over one window, from entering to leaving it.
class Drag {
public:
    Drag(const std::string& display, xcb_window_t target,
         const std::vector<std::filesystem::path>& files, double seconds)
        : target_(target), end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(seconds))) {
        for (const std::filesystem::path& file : files)
            list_ += uriOf(file) + "\r\n";
        int screen = 0;
        x_.reset(xcb_connect(display.c_str(), &screen));
        if (xcb_connection_has_error(x_.get()))
            throw std::runtime_error("no X server at " + display);
        root_ = xcb_setup_roots_iterator(xcb_get_setup(x_.get())).data->root;
        source_ = xcb_generate_id(x_.get());
        const std::uint32_t events = XCB_EVENT_MASK_PROPERTY_CHANGE;
        xcb_create_window(x_.get(), XCB_COPY_FROM_PARENT, source_, root_, 0, 0, 1, 1, 0,
                          XCB_WINDOW_CLASS_INPUT_ONLY, XCB_COPY_FROM_PARENT, XCB_CW_EVENT_MASK,
                          &events);
        time_ = serverTime();
    }

    void drop(glm::ivec2 at) {
        requireAware();
        xcb_set_selection_owner(x_.get(), source_, atom("XdndSelection"), time_);
        send("XdndEnter", {source_, kVersion << 24, atom("text/uri-list"), 0, 0});
        const glm::uvec2 place = onScreen(at);
        send("XdndPosition",
             {source_, 0, (place.x << 16) | place.y, time_, atom("XdndActionCopy")});
        if (!(answer("XdndStatus")[1] & 1u)) {
            send("XdndLeave", {source_, 0, 0, 0, 0});
            xcb_flush(x_.get());
            throw std::runtime_error("the window refuses what is dragged over it");
        }
        send("XdndDrop", {source_, 0, time_, 0, 0});
        // Bit 0 would be enough. GLFW 3.3 puts the length of the list there, which is 0 only if it
        // could not be read.
        if (answer("XdndFinished")[1] == 0)
            throw std::runtime_error("the window did not use what was dropped on it");
    }

private:
    using Data = std::array<std::uint32_t, 5>;
    struct Disconnect {
        void operator()(xcb_connection_t* x) const { xcb_disconnect(x); }
    };

    xcb_atom_t atom(const std::string& name) {
        const Reply<xcb_intern_atom_reply_t> reply(xcb_intern_atom_reply(
            x_.get(), xcb_intern_atom(x_.get(), false, std::uint16_t(name.size()), name.c_str()),
            nullptr));
        if (!reply)
            throw std::runtime_error("the X server ended");
        return reply->atom;
    }

    // Every change of a property comes back with the time at which it was made.
    xcb_timestamp_t serverTime() {
        xcb_change_property(x_.get(), XCB_PROP_MODE_APPEND, source_, XCB_ATOM_WM_NAME,
                            XCB_ATOM_STRING, 8, 0, nullptr);
        for (;;) {
            const Reply<xcb_generic_event_t> event = next("the time of the server");
            if ((event->response_type & 0x7f) == XCB_PROPERTY_NOTIFY)
                return reinterpret_cast<const xcb_property_notify_event_t&>(*event).time;
        }
    }

    void requireAware() {
        const Reply<xcb_get_property_reply_t> reply(xcb_get_property_reply(
            x_.get(),
            xcb_get_property(x_.get(), false, target_, atom("XdndAware"), XCB_ATOM_ANY, 0, 1),
            nullptr));
        if (!reply)
            throw std::runtime_error("there is no window to drop on");
        if (xcb_get_property_value_length(reply.get()) != 4)
            throw std::runtime_error("the window takes no files: it has no property XdndAware");
        std::uint32_t version = 0;
        std::memcpy(&version, xcb_get_property_value(reply.get()), sizeof version);
        if (version < kVersion)
            throw std::runtime_error("the window speaks XDND " + std::to_string(version) + ", " +
                                     std::to_string(kVersion) + " is needed");
    }

    glm::uvec2 onScreen(glm::ivec2 at) {
        const Reply<xcb_translate_coordinates_reply_t> reply(xcb_translate_coordinates_reply(
            x_.get(),
            xcb_translate_coordinates(x_.get(), target_, root_, std::int16_t(at.x),
                                      std::int16_t(at.y)),
            nullptr));
        if (!reply)
            throw std::runtime_error("there is no window to drop on");
        return {std::uint16_t(reply->dst_x), std::uint16_t(reply->dst_y)};
    }

    void send(const std::string& type, const Data& data) {
        xcb_client_message_event_t message{};
        message.response_type = XCB_CLIENT_MESSAGE;
        message.format = 32;
        message.window = target_;
        message.type = atom(type);
        std::memcpy(message.data.data32, data.data(), sizeof message.data.data32);
        xcb_send_event(x_.get(), false, target_, XCB_EVENT_MASK_NO_EVENT,
                       reinterpret_cast<const char*>(&message));
    }

    // Waits for this message and hands out the list of files to whoever asks meanwhile.
    Data answer(const std::string& type) {
        const xcb_atom_t wanted = atom(type);
        for (;;) {
            const Reply<xcb_generic_event_t> event = next(type);
            switch (event->response_type & 0x7f) {
            case XCB_SELECTION_REQUEST:
                give(reinterpret_cast<const xcb_selection_request_event_t&>(*event));
                break;
            case XCB_CLIENT_MESSAGE: {
                const auto& message = reinterpret_cast<const xcb_client_message_event_t&>(*event);
                Data data;
                std::memcpy(data.data(), message.data.data32, sizeof data);
                if (message.type == wanted)
                    return data;
                break;
            }
            }
        }
    }

    void give(const xcb_selection_request_event_t& request) {
        xcb_selection_notify_event_t reply{};
        reply.response_type = XCB_SELECTION_NOTIFY;
        reply.time = request.time;
        reply.requestor = request.requestor;
        reply.selection = request.selection;
        reply.target = request.target;
        if (request.target == atom("text/uri-list")) { // else: nothing of that kind
            reply.property = request.property;
            xcb_change_property(x_.get(), XCB_PROP_MODE_REPLACE, request.requestor,
                                request.property, request.target, 8, std::uint32_t(list_.size()),
                                list_.data());
        }
        xcb_send_event(x_.get(), false, request.requestor, XCB_EVENT_MASK_NO_EVENT,
                       reinterpret_cast<const char*>(&reply));
    }

    Reply<xcb_generic_event_t> next(const std::string& what) {
        xcb_flush(x_.get());
        for (;;) {
            if (Reply<xcb_generic_event_t> event{xcb_poll_for_event(x_.get())}) {
                if (event->response_type == 0)
                    throw std::runtime_error("the window that was dropped on is gone");
                return event;
            }
            if (xcb_connection_has_error(x_.get()))
                throw std::runtime_error("the X server ended");
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now());
            if (left.count() <= 0)
                throw std::runtime_error("in vain was waited for " + what);
            pollfd waiting{xcb_get_file_descriptor(x_.get()), POLLIN, 0};
            poll(&waiting, 1, int(left.count()) + 1);
        }
    }

    std::unique_ptr<xcb_connection_t, Disconnect> x_;
    xcb_window_t root_ = 0, source_ = 0, target_;
    std::string list_; ///< as text/uri-list, RFC 2483
    Clock::time_point end_;
    xcb_timestamp_t time_ = 0;
};

} // namespace

void dropFiles(const std::string& display, const std::string& window,
               const std::vector<std::filesystem::path>& files, glm::ivec2 at, double seconds) {
    Drag(display, xcb_window_t(std::stoul(window)), files, seconds).drop(at);
}

} // namespace afterglow::test
