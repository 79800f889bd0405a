// SPDX-License-Identifier: MIT
#include "app/report/sheet_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace afterglow {

using namespace sheet;

namespace {

constexpr glm::u8vec3 kGrid{37, 41, 50};
constexpr glm::u8vec3 kAxis{74, 81, 94};
constexpr glm::u8vec3 kLevel{112, 120, 134};

constexpr TextStyle kTitle{.size = 18, .weight = Weight::Medium, .color = kBright};
constexpr TextStyle kTick{.size = 14, .color = {150, 158, 171}};
constexpr TextStyle kLegend{.size = 16, .color = kText};
constexpr TextStyle kMark{.size = 16, .weight = Weight::Medium};

constexpr int kTitleHeight = 42, kAxisHeight = 44;
constexpr int kLevelWidth = 44; ///< to the right of the axes, for the levels' names

/// The smallest of 1, 2, 5, 10, 20, 50 ... times a power of ten that is not below `least`.
double roundStep(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least * (1.0 - 1e-9))
            return factor * power;
    }
    return 10.0 * power;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", std::abs(value) < 1e-12 ? 0.0 : value);
    return text;
}

/// From frames and values to pixels.
struct Axes {
    int firstFrame = 0, lastFrame = 1;
    double yMin = 0.0, yMax = 1.0;
    glm::vec2 upperLeft{0.0f}, lowerRight{0.0f};

    float x(double frame) const {
        const double t = (frame - firstFrame) / double(lastFrame - firstFrame);
        return float(upperLeft.x + t * (lowerRight.x - upperLeft.x));
    }
    float y(double value) const {
        const double t = (value - yMin) / (yMax - yMin);
        return float(lowerRight.y + std::clamp(t, 0.0, 1.0) * (upperLeft.y - lowerRight.y));
    }
    /// Thin straight lines are sharp in the middle of a pixel.
    float sharpX(double frame) const { return std::floor(x(frame)) + 0.5f; }
    float sharpY(double value) const { return std::floor(y(value)) + 0.5f; }
};

Axes axesOf(const SheetPlot& plot, glm::ivec2 corner, glm::ivec2 size) {
    Axes axes;
    bool any = false;
    for (const SheetCurve& curve : plot.curves) {
        if (curve.values.empty())
            continue;
        const int last = curve.firstFrame + int(curve.values.size()) - 1;
        axes.firstFrame = any ? std::min(axes.firstFrame, curve.firstFrame) : curve.firstFrame;
        axes.lastFrame = any ? std::max(axes.lastFrame, last) : last;
        any = true;
    }
    axes.lastFrame = std::max(axes.lastFrame, axes.firstFrame + 1);
    axes.yMin = plot.yMin;
    axes.yMax = plot.yMax > plot.yMin ? plot.yMax : plot.yMin + 1.0;
    axes.upperLeft = glm::vec2(corner.x, corner.y + kTitleHeight);
    axes.lowerRight = glm::vec2(corner.x + size.x - kLevelWidth, corner.y + size.y - kAxisHeight);
    return axes;
}

void drawGrid(Canvas& canvas, const SheetPlot& plot, const Axes& a) {
    const double xStep = std::max(1.0, roundStep((a.lastFrame - a.firstFrame) * 60.0 /
                                                 double(a.lowerRight.x - a.upperLeft.x)));
    for (double f = std::ceil(a.firstFrame / xStep) * xStep; f <= a.lastFrame; f += xStep) {
        const float x = a.sharpX(f);
        canvas.line({x, a.upperLeft.y}, {x, a.lowerRight.y}, 1.0f, kGrid);
        canvas.text({x, a.lowerRight.y + 19.0f}, number(f), kTick.aligned(0.5f));
    }
    const double yStep =
        roundStep((a.yMax - a.yMin) * 30.0 / double(a.lowerRight.y - a.upperLeft.y));
    for (double v = std::ceil(a.yMin / yStep) * yStep; v <= a.yMax + 1e-9 * yStep; v += yStep) {
        const float y = a.sharpY(v);
        canvas.line({a.upperLeft.x, y}, {a.lowerRight.x, y}, 1.0f, kGrid);
        canvas.text({a.upperLeft.x - 10.0f, y + 4.0f}, number(v), kTick.aligned(1.0f));
    }
    for (const auto& [value, name] : plot.levels) {
        const float y = a.sharpY(value);
        canvas.dashed({a.upperLeft.x, y}, {a.lowerRight.x, y}, 5.0f, 5.0f, 1.0f, kLevel, 0.7f);
        canvas.text({a.lowerRight.x + 8.0f, y + 4.0f}, name, kTick);
    }
    const glm::vec2 origin(std::floor(a.upperLeft.x) + 0.5f, std::floor(a.lowerRight.y) + 0.5f);
    canvas.line(origin, {a.lowerRight.x, origin.y}, 1.0f, kAxis);
    canvas.line(origin, {origin.x, a.upperLeft.y}, 1.0f, kAxis);
    canvas.text({a.lowerRight.x, a.lowerRight.y + 38.0f}, plot.xLabel, kTick.aligned(1.0f));
}

void drawEvents(Canvas& canvas, const SheetPlot& plot, const Axes& a) {
    for (const int frame : plot.events) {
        const float x = a.sharpX(frame);
        canvas.line({x, a.upperLeft.y}, {x, a.lowerRight.y}, 1.0f, kEventColor, 0.8f);
        canvas.text({x, a.upperLeft.y - 6.0f}, "event", kTick.aligned(0.5f).colored(kEventColor));
    }
}

void drawCurve(Canvas& canvas, const SheetCurve& curve, const Axes& a) {
    std::vector<Polyline> lines(1);
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
        if (std::isfinite(curve.values[i]))
            lines.back().emplace_back(a.x(curve.firstFrame + double(i)), a.y(curve.values[i]));
        else if (!lines.back().empty())
            lines.emplace_back();
    }
    canvas.stroke(lines, 1.8f, curve.color);
}

/// The marked points of all curves, and what is written beside them: below the curve, to the right,
/// and further down where one would stand on another.
void drawMarks(Canvas& canvas, const SheetPlot& plot, const Axes& a) {
    struct Box {
        glm::vec2 min, max;
    };
    std::vector<Box> taken;
    for (const SheetCurve& curve : plot.curves) {
        const auto index = std::size_t(curve.marked.value_or(0) - curve.firstFrame);
        if (!curve.marked || index >= curve.values.size() || !std::isfinite(curve.values[index]))
            continue;
        const glm::vec2 at(a.x(*curve.marked), a.y(curve.values[index]));
        canvas.dot(at, 5.5f, kGround);
        canvas.dot(at, 4.0f, curve.color);

        const TextStyle style = kMark.colored(curve.color);
        const float width = style.width(curve.mark);
        Box box{{at.x + 10.0f, at.y + 6.0f}, {at.x + 10.0f + width, at.y + 20.0f}};
        const auto overlaps = [&](const Box& b) {
            return box.min.x < b.max.x + 6.0f && b.min.x < box.max.x + 6.0f &&
                   box.min.y < b.max.y + 4.0f && b.min.y < box.max.y + 4.0f;
        };
        while (std::any_of(taken.begin(), taken.end(), overlaps)) {
            box.min.y += 4.0f;
            box.max.y += 4.0f;
        }
        taken.push_back(box);
        const glm::vec2 baseline(box.min.x, box.max.y - 3.0f);
        // Keeps lines that run behind the text away from it.
        const TextStyle halo = style.colored(kGround);
        for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x)
                canvas.text(baseline + glm::vec2(x, y), curve.mark, halo);
        canvas.text(baseline, curve.mark, style);
    }
}

void drawLegend(Canvas& canvas, const SheetPlot& plot, glm::vec2 rightEnd) {
    for (auto curve = plot.curves.rbegin(); curve != plot.curves.rend(); ++curve) {
        const TextStyle style = kLegend.aligned(1.0f);
        canvas.text(rightEnd, curve->name, style);
        rightEnd.x -= std::ceil(style.width(curve->name)) + 10.0f;
        const float y = std::floor(rightEnd.y - 5.0f) + 0.5f;
        canvas.line({rightEnd.x - 20.0f, y}, {rightEnd.x, y}, 2.5f, curve->color);
        rightEnd.x -= 44.0f;
    }
}

} // namespace

void drawPlot(Canvas& canvas, const SheetPlot& plot, glm::ivec2 corner, glm::ivec2 size) {
    const Axes axes = axesOf(plot, corner, size);
    const glm::vec2 title = glm::vec2(corner) + glm::vec2(0.0f, 14.0f);
    canvas.text(title, plot.title, kTitle);
    canvas.text(title + glm::vec2(kTitle.width(plot.title) + 18.0f, 0.0f), plot.yLabel, kTick);
    drawLegend(canvas, plot, {axes.lowerRight.x, corner.y + 14.0f});
    drawGrid(canvas, plot, axes);
    drawEvents(canvas, plot, axes);
    for (const SheetCurve& curve : plot.curves)
        drawCurve(canvas, curve, axes);
    drawMarks(canvas, plot, axes);
}

} // namespace afterglow
