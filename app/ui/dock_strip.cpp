// SPDX-License-Identifier: MIT
// The timeline: what happened in the last frames, what is recorded, and the take that plays.

#include "app/ui/draw.h"
#include "app/ui/panels.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace afterglow {
namespace {

// Where there is little room, what is impossible now is left out.
void buttons(const PanelContext& panel, bool narrow) {
    ViewState& state = panel.state;
    const Transport& time = state.time;
    if (iconButton("pause", time.paused ? Icon::Play : Icon::Pause, time.paused))
        press(state, plain('P'));
    tooltip(tipOf(*actionOf(plain('P'))));
    ImGui::SameLine(0.0f, 0.3f * em());
    if (iconButton("step", Icon::Step, false))
        press(state, plain('N'));
    tooltip(tipOf(*actionOf(plain('N'))));
    for (const auto& [stroke, width] : {std::pair{plain('I'), 2.3f},
                                        {plain('O'), 2.9f},
                                        {shift('O'), 4.1f},
                                        {KeyStroke{Key::Backspace}, 3.8f}}) {
        const Action& action = *actionOf(stroke);
        const bool isPossible = !action.isPossible || action.isPossible(state);
        const bool isLess = stroke == shift('O') && time.playing;
        if (narrow && (!isPossible || isLess))
            continue;
        ImGui::SameLine(0.0f, 0.3f * em());
        actionButton(state, stroke, width * em());
    }
}

/// Frames from left to right, one after the other.
struct Rail {
    UiRect bar;
    float textTop = 0.0f; ///< of the names of marks; negative: there is no room for them
    float step = 1.0f;    ///< from frame to frame
    float begin = 0.0f;   ///< of the first one

    float x(std::size_t index) const { return begin + step * float(index); }
    std::optional<std::size_t> under(ImVec2 mouse, std::size_t count) const {
        const float place = std::floor((mouse.x - begin) / step);
        return place >= 0.0f && place < float(count) ? std::optional(std::size_t(place))
                                                     : std::nullopt;
    }
};

std::string joined(const std::vector<std::string>& marks) {
    std::string all;
    for (const std::string& mark : marks)
        all += (all.empty() ? "" : ", ") + mark;
    return all;
}

/// A diamond, and its name as long as that does not reach into `right`, which becomes its begin.
void drawMark(ImDrawList& draw, const Rail& rail, float x, const std::vector<std::string>& marks,
              bool step, float& right) {
    const float s = 0.34f * em(), y = rail.bar.min.y + 0.5f * rail.bar.size.y;
    const ImVec4 tint = step ? color::kAccent : color::kPanes[1];
    draw.AddQuadFilled({x, y - s}, {x + s, y}, {x, y + s}, {x - s, y}, packed(tint));
    const std::string text = joined(marks);
    // Beside the diamond, or before the right end.
    const float width = widthOf(text), begin = std::min(x - s, rail.bar.end().x - width);
    if (rail.textTop < 0.0f || begin + width > right || begin < rail.bar.min.x)
        return;
    draw.AddText({std::round(begin), rail.textTop}, packed(step ? color::kAccent : color::kDim),
                 text.c_str());
    right = begin - 0.8f * em();
}

void drawTicks(ImDrawList& draw, const Rail& rail, std::size_t index, std::uint32_t number) {
    const float x = std::round(rail.x(index));
    if (number % 10 != 0 && rail.step < 4.0f)
        return;
    const float share = number % 60 == 0 ? 1.0f : number % 10 == 0 ? 0.5f : 0.2f;
    draw.AddRectFilled({x, rail.bar.end().y - share * rail.bar.size.y},
                       {x + 1.0f, rail.bar.end().y},
                       packed(share == 1.0f ? color::kFaint : color::kFrameActive));
}

// The frames that were rendered last, the newest at the right.
std::optional<std::string> drawPast(const PanelContext& panel, Rail rail,
                                    std::optional<ImVec2> mouse) {
    const Transport& time = panel.state.time;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    rail.step = std::max(0.2f * em(), rail.bar.size.x / float(kPast));
    const std::size_t all = time.past.size();
    const auto count = std::min(all, std::size_t(rail.bar.size.x / rail.step));
    const std::size_t first = all - count;
    rail.begin = rail.bar.end().x - rail.step * float(count);
    draw.AddRectFilled({rail.begin, rail.bar.min.y}, rail.bar.end(), packed(color::kFrame));
    if (time.recording) {
        const std::size_t recorded = std::min(time.recording->frames.size(), count);
        const float x = rail.x(count - recorded);
        draw.AddRectFilled({x, rail.bar.min.y}, rail.bar.end(),
                           faded(packed(color::kRecording), 0.55f));
        draw.AddRectFilled({x - 1.0f, rail.bar.min.y - 2.0f}, {x + 1.0f, rail.bar.end().y + 2.0f},
                           packed(color::kRecording));
    }
    for (std::size_t i = 0; i < count; ++i) {
        drawTicks(draw, rail, i, time.past[first + i].frame);
        const bool jump =
            first + i > 0 && time.past[first + i].frame != time.past[first + i - 1].frame + 1;
        if (jump) // a take began, or was left
            draw.AddRectFilled({std::round(rail.x(i)) - 1.0f, rail.bar.min.y},
                               {std::round(rail.x(i)) + 1.0f, rail.bar.end().y},
                               packed(color::kPanel));
    }
    float right = rail.bar.end().x;
    for (std::size_t i = count; i-- > 0;)
        if (const SceneFrame& past = time.past[first + i]; !past.marks.empty())
            drawMark(draw, rail, rail.x(i) + 0.5f * rail.step, past.marks, past.step, right);
    if (!mouse)
        return {};
    const auto under = rail.under(*mouse, count);
    if (!under)
        return "The last frames; what happens in one gets a mark.\nIn and out point: I and O.";
    const SceneFrame& past = time.past[first + *under];
    return formatted("Frame %u", past.frame) +
           (past.marks.empty() ? "" : ": " + joined(past.marks));
}

// A take from its first frame to its last.
std::optional<std::string> drawTake(const Playing& playing, Rail rail,
                                    std::optional<ImVec2> mouse) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const auto& frames = playing.take.frames;
    rail.step = rail.bar.size.x / float(std::max<std::size_t>(frames.size(), 1));
    rail.begin = rail.bar.min.x;
    draw.AddRectFilled(rail.bar.min, rail.bar.end(), packed(color::kFrame));
    const float head = rail.x(playing.next);
    draw.AddRectFilled(rail.bar.min, {head, rail.bar.end().y}, packed(color::kFill));
    if (10.0f * rail.step >= 3.0f)
        for (std::size_t i = 0; i < frames.size(); ++i)
            drawTicks(draw, rail, i, std::uint32_t(i));
    float right = rail.bar.end().x + 0.5f;
    for (std::size_t i = frames.size(); i-- > 0;)
        if (!frames[i].marks.empty())
            drawMark(draw, rail, rail.x(i) + 0.5f * rail.step, frames[i].marks, frames[i].step,
                     right);
    const float x = std::clamp(std::round(head), rail.bar.min.x + 1.0f, rail.bar.end().x - 1.0f);
    const float s = 0.3f * em();
    draw.AddRectFilled({x - 1.0f, rail.bar.min.y}, {x + 1.0f, rail.bar.end().y},
                       packed(color::kText));
    draw.AddTriangleFilled({x - s, rail.bar.end().y + 1.2f * s}, {x, rail.bar.end().y},
                           {x + s, rail.bar.end().y + 1.2f * s}, packed(color::kText));
    if (!mouse)
        return {};
    const auto under = rail.under(*mouse, frames.size());
    if (!under)
        return {};
    return formatted("Frame %zu of %zu", *under + 1, frames.size()) +
           (frames[*under].marks.empty() ? "" : ": " + joined(frames[*under].marks));
}

std::string stateLine(const ViewState& state) {
    const Transport& time = state.time;
    std::string line;
    if (time.playing) {
        line = time.playing->take.name + ": ";
        if (isFinished(time))
            line += "finished";
        else
            line += formatted("%zu of %zu", time.playing->next, time.playing->take.frames.size());
        if (time.playing->loops)
            line += ", loops";
    }
    if (time.recording)
        line +=
            (line.empty() ? "" : ", ") + formatted("recording %zu", time.recording->frames.size());
    if (!line.empty())
        return line;
    return state.frozen ? "frozen" : time.paused ? "paused" : "live";
}

// The newest frame, and what is going on.
void numbers(const PanelContext& panel, const UiRect& where) {
    const ViewState& state = panel.state;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float middle = where.min.y + 0.5f * where.size.y;
    ImGui::PushFont(panel.fonts.strong);
    const float above = std::round(middle - 1.15f * em());
    if (!state.time.past.empty())
        draw.AddText({where.min.x, above}, packed(color::kText),
                     formatted("Frame %u", state.time.past.back().frame).c_str());
    ImGui::PopFont();
    const WithFont letters(panel.fonts.small);
    const bool busy = state.time.recording.has_value();
    draw.AddText({where.min.x, std::round(middle + 0.12f * em())},
                 packed(busy ? color::kError : color::kDim),
                 clipped(stateLine(state), where.size.x).c_str());
}

} // namespace

void dockStrip(const PanelContext& panel) {
    const UiRect where = inUnits(panel, panel.frame.layout.strip);
    drawEdge(where.min, {where.end().x, where.min.y});
    const float button = ImGui::GetFrameHeight();
    ImGui::SetCursorPosY(std::round(0.5f * (where.size.y - button)));
    const bool narrow = where.size.x < 46.0f * em();
    buttons(panel, narrow);
    ImGui::SameLine(0.0f, 1.2f * em());

    const float info = (narrow ? 7.5f : 10.5f) * em(), left = ImGui::GetCursorScreenPos().x;
    const float end = where.end().x - ImGui::GetStyle().WindowPadding.x;
    const float width = end - info - 1.0f * em() - left;
    if (width > 6.0f * em()) {
        ImGui::SetCursorScreenPos({left, where.min.y + 2.0f});
        ImGui::InvisibleButton("frames", {width, where.size.y - 4.0f});
        const bool hovered = ImGui::IsItemHovered();
        const auto mouse = hovered ? std::optional(ImGui::GetMousePos()) : std::nullopt;
        ImGui::PushFont(panel.fonts.small);
        const float height = 0.9f * em();
        const bool hasText = where.size.y > height + 2.2f * em();
        Rail rail;
        const float block = hasText ? height + 1.5f * em() : height;
        const float top = where.min.y + 0.5f * (where.size.y - block);
        rail.textTop = hasText ? std::round(top) : -1.0f;
        rail.bar = {{left, std::round(top + block - height)}, {width, height}};
        const ImVec2 edge = rail.bar.end();
        ImGui::PushClipRect({left, where.min.y}, {edge.x + 1.0f, where.end().y}, true);
        ImGui::GetWindowDrawList()->AddRectFilled(rail.bar.min, edge, packed(color::kRaised));
        const auto help = panel.state.time.playing
                              ? drawTake(*panel.state.time.playing, rail, mouse)
                              : drawPast(panel, rail, mouse);
        ImGui::PopClipRect();
        ImGui::PopFont();
        if (help)
            tooltip(*help);
    }
    if (end - info > left)
        numbers(panel, {{end - info, where.min.y}, {info, where.size.y}});
}

} // namespace afterglow
