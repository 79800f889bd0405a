// SPDX-License-Identifier: MIT
#include "app/ui/curves.h"

#include "app/ui/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace afterglow {
namespace {

/// Values from the bottom of the chart to its top, with a mark at both and one between.
struct Axis {
    double low = 0.0, high = 1.0;
    bool logarithmic = false;

    double middle() const { return logarithmic ? std::sqrt(low * high) : 0.5 * (low + high); }
    /// 0 at the bottom, 1 at the top.
    float place(double value) const {
        const double t = logarithmic ? std::log(std::max(value, low) / low) / std::log(high / low)
                                     : (value - low) / (high - low);
        return float(std::clamp(t, 0.0, 1.0));
    }
};

// A round number, not smaller.
double roundedUp(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
        if (value <= step * power * (1.0 + 1e-9))
            return step * power;
    return 10.0 * power;
}

Axis axisOf(const CurveChart& chart, std::size_t first) {
    if (chart.quantity.range)
        return {chart.quantity.range->x, chart.quantity.range->y, chart.quantity.logarithmic};
    const bool logarithmic = chart.quantity.logarithmic;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const CurveLine& line : chart.lines)
        for (std::size_t i = first; i < line.values.size(); ++i) {
            const double value = double(line.values[i]);
            if (!std::isfinite(value) || (logarithmic && value <= 0.0))
                continue;
            low = std::min(low, value);
            high = std::max(high, value);
        }
    if (low > high)
        return logarithmic ? Axis{1e-4, 1.0, true} : Axis{};
    if (logarithmic) { // whole powers of a hundred between both ends, so that the middle is round
        constexpr double kMostDecades = 6.0;
        const double top = std::ceil(std::log10(high) + 1e-9);
        double bottom = std::max(std::floor(std::log10(low)), top - kMostDecades);
        if (std::fmod(top - bottom, 2.0) != 0.0)
            bottom -= 1.0;
        return {std::pow(10.0, bottom), std::pow(10.0, top), true};
    }
    // From zero, unless all values are far from it and near each other.
    if (low >= 0.0 && low < 0.6 * high)
        low = 0.0;
    if (high - low < 1e-3 * std::max(std::abs(high), std::abs(low)) || high <= low)
        low = std::min(0.0, low), high = std::max(high, high > 0.0 ? high : low + 1.0);
    double step = roundedUp(0.5 * (high - low));
    double begin = std::floor(low / step) * step;
    while (begin + 2.0 * step < high) {
        step = roundedUp(1.01 * step);
        begin = std::floor(low / step) * step;
    }
    return {begin, begin + 2.0 * step, false};
}

/// Lengths of dashes and gaps, one after the other, in em; empty: a line without gaps.
std::span<const float> dashesOf(std::size_t probe) {
    static constexpr std::array kDashes{0.5f, 0.28f};
    static constexpr std::array kDots{0.12f, 0.26f};
    static constexpr std::array kBoth{0.6f, 0.24f, 0.12f, 0.24f};
    switch (probe) {
    case 1: return kDashes;
    case 2: return kDots;
    case 3: return kBoth;
    default: return {};
    }
}

void drawPath(ImDrawList& draw, std::span<const ImVec2> points, ImU32 tint, float thick,
              std::size_t probe) {
    if (points.empty())
        return;
    if (points.size() == 1)
        return draw.AddCircleFilled(points[0], thick, tint, 8);
    const auto dashes = dashesOf(probe);
    if (dashes.empty())
        return draw.AddPolyline(points.data(), int(points.size()), tint, 0, thick);
    std::vector<ImVec2> dash{points[0]};
    std::size_t part = 0;
    float left = dashes[0] * em();
    for (std::size_t i = 1; i < points.size(); ++i) {
        ImVec2 at = points[i - 1];
        const ImVec2 end = points[i];
        float length = std::hypot(end.x - at.x, end.y - at.y);
        while (length > left) {
            const float t = left / length;
            at = {at.x + t * (end.x - at.x), at.y + t * (end.y - at.y)};
            length -= left;
            if (part % 2 == 0) {
                dash.push_back(at);
                draw.AddPolyline(dash.data(), int(dash.size()), tint, 0, thick);
                dash.clear();
            } else {
                dash = {at};
            }
            part = (part + 1) % dashes.size();
            left = dashes[part] * em();
        }
        left -= length;
        if (part % 2 == 0)
            dash.push_back(end);
    }
    if (dash.size() > 1)
        draw.AddPolyline(dash.data(), int(dash.size()), tint, 0, thick);
}

/// Where frames and values are on the screen.
struct Plot {
    UiRect area;
    Axis axis;
    std::size_t first = 0, count = 0; ///< frames of the log that are shown
    int span = 2;                     ///< frames that there is room for

    float step() const { return area.size.x / float(span - 1); }
    float x(std::size_t index) const {
        return area.end().x - step() * (float(first + count) - 1.0f - float(index));
    }
    float y(double value) const { return area.end().y - axis.place(value) * area.size.y; }
};

// Of frames that share a pixel, the least and the greatest value are kept. Lines end where there is
// no value, and where a take begins anew.
void drawLine(ImDrawList& draw, const Plot& plot, const ProbeLog& log, const CurveLine& line,
              bool strong) {
    const ImU32 tint = faded(paneColor(line.pane), strong ? 1.0f : 0.6f);
    const float thick = strong ? 2.0f : 1.4f;
    const auto together = std::size_t(std::max(1.0f, std::floor(1.0f / plot.step())));
    std::vector<ImVec2> points;
    const auto end = std::min(plot.first + plot.count, line.values.size());
    const auto isJump = [&](std::size_t i) {
        return i > plot.first && log.frames()[i].frame != log.frames()[i - 1].frame + 1;
    };
    for (std::size_t i = plot.first; i < end; i += together) {
        if (isJump(i)) {
            drawPath(draw, points, tint, thick, line.probe);
            points.clear();
        }
        std::size_t low = i, high = i;
        bool gap = false;
        for (std::size_t j = i; j < std::min(i + together, end); ++j) {
            gap = gap || !std::isfinite(line.values[j]);
            low = line.values[j] < line.values[low] ? j : low;
            high = line.values[j] > line.values[high] ? j : high;
        }
        if (gap) {
            drawPath(draw, points, tint, thick, line.probe);
            points.clear();
            continue;
        }
        points.push_back(
            {plot.x(std::min(low, high)), plot.y(double(line.values[std::min(low, high)]))});
        if (low != high)
            points.push_back(
                {plot.x(std::max(low, high)), plot.y(double(line.values[std::max(low, high)]))});
    }
    drawPath(draw, points, tint, thick, line.probe);
}

// Where half and nine tenths of a change of light were reached.
void drawReached(ImDrawList& draw, const Plot& plot, const CurveLine& line) {
    for (const auto& [frames, radius] : {std::pair{line.t50, 0.2f}, std::pair{line.t90, 0.28f}}) {
        if (!line.event || !frames)
            continue;
        const std::size_t index = *line.event + std::size_t(*frames);
        if (index < plot.first || index >= line.values.size() || !std::isfinite(line.values[index]))
            continue;
        const ImVec2 at{plot.x(index), plot.y(double(line.values[index]))};
        draw.AddCircleFilled(at, radius * em(), packed(color::kPanel), 16);
        draw.AddCircle(at, radius * em(), paneColor(line.pane), 16, 1.6f);
    }
}

// The newest text is whole; older ones have the room that is left beside it.
void drawMarks(ImDrawList& draw, const Plot& plot, const ProbeLog& log, float top) {
    const auto& frames = log.frames();
    float right = plot.area.end().x;
    for (std::size_t i = plot.first + plot.count; i-- > plot.first;) {
        if (frames[i].marks.empty())
            continue;
        std::string text;
        bool step = false;
        for (const ProbeMark& mark : frames[i].marks) {
            text += (text.empty() ? "" : ", ") + mark.text;
            step = step || mark.step;
        }
        const float x = std::round(plot.x(i));
        const ImU32 tint = packed(step ? color::kAccentDeep : color::kFrameActive);
        draw.AddRectFilled({x - 0.5f, top + em()}, {x + 0.5f, plot.area.end().y}, tint);
        const float width = widthOf(text);
        // Beside the line, or before it at the right end.
        const float begin = std::min(x + 0.25f * em(), plot.area.end().x - width);
        if (begin < plot.area.min.x || begin + width > right)
            continue;
        draw.AddText({std::round(begin), top}, packed(step ? color::kAccent : color::kDim),
                     text.c_str());
        right = begin - 0.7f * em();
    }
}

void drawAxis(ImDrawList& draw, const Plot& plot) {
    const Axis& axis = plot.axis;
    const double values[] = {axis.low, axis.middle(), axis.high};
    for (int i = 0; i < 3; ++i) {
        const float y = std::round(plot.y(values[i]));
        draw.AddRectFilled({plot.area.min.x, y}, {plot.area.end().x, y + 1.0f},
                           packed(color::kLine));
        const float lift = i == 0 ? 1.0f : i == 1 ? 0.5f : 0.0f; // inside the chart's height
        textUpTo(draw, {plot.area.min.x - 0.5f * em(), y - lift * em()}, packed(color::kDim),
                 axis.logarithmic ? formatted("1e%.0f", std::log10(values[i]))
                                  : formatted("%.4g", values[i]));
    }
}

} // namespace

std::optional<std::size_t> drawCurves(const PanelContext& panel, const CurveChart& chart,
                                      const UiRect& where, std::optional<ImVec2> mouse) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const WithFont letters(panel.fonts.small);
    const float left = 3.6f * em(), texts = 1.35f * em(), below = 1.25f * em();
    Plot plot;
    plot.area = {{where.min.x + left, where.min.y + texts},
                 {where.size.x - left, where.size.y - texts - below}};
    plot.span = std::max(chart.frames, 2);
    const std::size_t all = chart.log.frames().size();
    plot.count = std::min(all, std::size_t(plot.span));
    plot.first = all - plot.count;
    if (plot.area.size.x < 4.0f * em() || plot.area.size.y < 2.0f * em())
        return {};
    plot.axis = axisOf(chart, plot.first);
    draw.AddRectFilled(plot.area.min, plot.area.end(), packed(color::rgb(0x0f1114)));
    drawAxis(draw, plot);
    draw.AddText({plot.area.min.x, plot.area.end().y + 0.2f * em()}, packed(color::kFaint),
                 formatted("%d frames ago", plot.span - 1).c_str());
    textUpTo(draw, {plot.area.end().x, plot.area.end().y + 0.2f * em()}, packed(color::kFaint),
             all ? formatted("frame %u", chart.log.frames().back().frame) : "now");
    draw.PushClipRect({plot.area.min.x - 2.0f, where.min.y},
                      {plot.area.end().x + 2.0f, plot.area.end().y + 2.0f}, true);
    drawMarks(draw, plot, chart.log, where.min.y);

    std::optional<std::size_t> hovered;
    if (mouse && plot.count > 0 && mouse->x >= plot.area.min.x) {
        const auto back =
            std::size_t(std::max(0.0f, (plot.area.end().x - mouse->x) / plot.step() + 0.5f));
        if (back < plot.count) {
            hovered = plot.first + plot.count - 1 - back;
            const float x = std::round(plot.x(*hovered));
            draw.AddRectFilled({x - 0.5f, plot.area.min.y}, {x + 0.5f, plot.area.end().y},
                               packed(color::kFaint));
        }
    }
    for (const bool strong : {false, true})
        for (const CurveLine& line : chart.lines)
            if ((line.probe == chart.activeProbe) == strong)
                drawLine(draw, plot, chart.log, line, strong);
    for (const CurveLine& line : chart.lines)
        if (line.probe == chart.activeProbe)
            drawReached(draw, plot, line);
    draw.PopClipRect();
    return hovered;
}

void drawLineSample(ImDrawList& draw, ImVec2 from, float length, std::size_t probe, ImU32 tint) {
    const ImVec2 points[] = {from, {from.x + length, from.y}};
    drawPath(draw, points, tint, 1.6f, probe);
}

} // namespace afterglow
