// SPDX-License-Identifier: MIT
#include "app/report/report.h"

#include "app/base/output.h"
#include "app/measure/metric.h"
#include "app/report/contact_sheet.h"
#include "renderer/image/image_io.h"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

std::vector<int> columnsOf(int frames, std::optional<int> event) {
    std::set<int> chosen;
    if (event) {
        for (int after : {-1, 0, 1, 2, 4, 8, 16, 32})
            if (*event + after < frames)
                chosen.insert(*event + after);
    } else {
        constexpr int kColumns = 6;
        for (int i = 0; i < kColumns; ++i)
            chosen.insert((frames - 1) * i / (kColumns - 1));
    }
    return {chosen.begin(), chosen.end()};
}

/// The sheet of one run.
class RunSheet {
public:
    RunSheet(const Experiment& experiment, const RunOutline& outline, const MetricsTable& table,
             const Json& summary, const Json& timing, const std::filesystem::path& folder)
        : experiment_(experiment), outline_(outline), table_(table),
          summary_(summary.at("variants")), timing_(timing.at("variants")), folder_(folder) {
        if (!outline.events.empty())
            event_ = outline.events.front().change.first;
        frames_ = columnsOf(experiment.frames(), event_);
    }

    Image<glm::u8vec4> draw() const;

private:
    Image<glm::u8vec4> picture(const std::string& row, int frame) const;
    int referenceOf(int frame) const; ///< the frame that its reference is named by
    std::vector<std::pair<std::string, std::string>> notesOf(const std::string& variant) const;
    bool hasResponse() const;
    SheetCurve curveOf(std::size_t variant, const char* metric, FrameRange range) const;
    SheetPlot responsePlot() const;
    SheetPlot errorPlot() const;

    const Experiment& experiment_;
    const RunOutline& outline_;
    const MetricsTable& table_;
    const Json &summary_, &timing_; ///< by variant
    const std::filesystem::path& folder_;
    std::optional<int> event_; ///< frame of the first one
    std::vector<int> frames_;  ///< of the columns, rising
};

Image<glm::u8vec4> RunSheet::picture(const std::string& row, int frame) const {
    const auto file = folder_ / row / (frameStem("frame", frame) + ".png");
    return std::filesystem::exists(file) ? readPng(file) : Image<glm::u8vec4>();
}

int RunSheet::referenceOf(int frame) const {
    const auto holds = [&](const FrameRange& range) { return range.contains(frame); };
    const auto found = std::ranges::find_if(outline_.references, holds);
    return found == outline_.references.end() ? frame : found->first;
}

bool RunSheet::hasResponse() const {
    return std::ranges::any_of(summary_, [](const Json& variant) {
        return variant.contains("response_settled") && !variant.at("response_settled").is_null();
    });
}

SheetCurve RunSheet::curveOf(std::size_t variant, const char* metric, FrameRange range) const {
    SheetCurve curve;
    curve.name = experiment_.variants[variant].name;
    curve.color = sheetColor(variant);
    curve.firstFrame = range.first;
    const auto values = table_.curve(curve.name, metric, range.end);
    for (int frame = range.first; frame < range.end; ++frame)
        curve.values.push_back(
            values[std::size_t(frame)].value_or(std::numeric_limits<double>::quiet_NaN()));
    return curve;
}

SheetPlot RunSheet::responsePlot() const {
    SheetPlot plot;
    plot.title = "Response: 0 is the old light, 1 the new";
    plot.yLabel = "response";
    plot.yMax = 1.1;
    plot.levels = {{0.0, "0"}, {0.5, "50 %"}, {0.9, "90 %"}, {1.0, "100 %"}};
    const FrameRange range{std::max(0, *event_ - 4),
                           std::min(experiment_.frames(), *event_ + 41)}; // later: a flat line
    for (const RunEvent& event : outline_.events)
        if (range.contains(event.change.first))
            plot.events.push_back(event.change.first);
    for (std::size_t i = 0; i < experiment_.variants.size(); ++i) {
        SheetCurve curve = curveOf(i, "response", range);
        const Json& t90 = summary_.at(curve.name).at("t90");
        if (!t90.is_null() && range.contains(*event_ + t90.get<int>())) {
            curve.marked = *event_ + t90.get<int>();
            curve.mark = "t90 " + std::to_string(t90.get<int>());
        }
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

SheetPlot RunSheet::errorPlot() const {
    SheetPlot plot;
    plot.title = "Error: RMSE of linear color against the reference";
    plot.yLabel = "rmse";
    for (const RunEvent& event : outline_.events)
        plot.events.push_back(event.change.first);
    // The first frames have no history and would press all else to the ground.
    const FrameRange range{std::min(8, experiment_.frames() - 1), experiment_.frames()};
    double largest = 0.0;
    for (std::size_t i = 0; i < experiment_.variants.size(); ++i) {
        plot.curves.push_back(curveOf(i, "rmse", range));
        for (const double value : plot.curves.back().values)
            if (value > largest)
                largest = value;
    }
    plot.yMax = largest > 0.0 ? largest * 1.1 : 1.0;
    return plot;
}

std::vector<std::pair<std::string, std::string>>
RunSheet::notesOf(const std::string& variant) const {
    const Json &summary = summary_.at(variant), &timing = timing_.at(variant);
    std::vector<std::pair<std::string, std::string>> notes;
    for (const Metric& metric : metrics()) {
        const std::string value = shownValue(metric, summary, timing);
        const bool isReplaced = summary.value(metric.insteadOf, Json()).is_number();
        if ((metric.shown & kSheet) && !isReplaced && value != "-")
            notes.emplace_back(metric.label, value);
    }
    return notes;
}

Image<glm::u8vec4> RunSheet::draw() const {
    ContactSheet sheet;
    sheet.title = experiment_.name;
    sheet.subtitle = experiment_.description;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        const int after = event_ ? frames_[i] - *event_ : 0;
        if (event_ && frames_[i] == *event_)
            sheet.eventColumn = i;
        sheet.columns.push_back(event_ ? fmt::format("frame {}  ({:+})", frames_[i], after)
                                       : fmt::format("frame {}", frames_[i]));
    }
    for (std::size_t i = 0; i < experiment_.variants.size(); ++i) {
        SheetRow row{.name = experiment_.variants[i].name, .color = sheetColor(i)};
        row.notes = notesOf(row.name);
        for (const int frame : frames_)
            row.pictures.push_back(picture(row.name, frame));
        sheet.rows.push_back(std::move(row));
    }
    SheetRow reference{.name = "reference", .color = kReferenceColor};
    reference.notes = {{"samples", std::to_string(experiment_.referenceSamples)}};
    for (const int frame : frames_)
        reference.pictures.push_back(picture(reference.name, referenceOf(frame)));
    sheet.rows.push_back(std::move(reference));
    if (hasResponse())
        sheet.plots.push_back(responsePlot());
    sheet.plots.push_back(errorPlot());
    sheet.footer = fmt::format("afterglow {}  {}  {}x{}  {:g} Hz  seed {}  signal {}", version(),
                               experiment_.scene, experiment_.size.x, experiment_.size.y,
                               experiment_.rate, experiment_.seed, nameOf(experiment_.signal));
    return drawContactSheet(sheet);
}

} // namespace

Image<glm::u8vec4> drawRunSheet(const Experiment& experiment, const RunOutline& outline,
                                const MetricsTable& table, const Json& summary, const Json& timing,
                                const std::filesystem::path& folder) {
    return RunSheet(experiment, outline, table, summary, timing, folder).draw();
}

} // namespace afterglow
