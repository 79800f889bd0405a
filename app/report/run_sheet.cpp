#include "app/report/run_sheet.h"

#include "app/base/output.h"
#include "renderer/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

std::string textOf(const char* format, auto... values) {
    char text[128];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// "12", "never", or nothing where there was no response.
std::string framesText(const Json& summary, const char* key) {
    return summary.at(key).is_null() ? "never" : std::to_string(summary.at(key).get<int>());
}

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
    RunSheet(const Experiment& experiment, const RunPlan& plan, const MetricsTable& table,
             const Json& summary, const Json& timing, const std::filesystem::path& folder)
        : experiment_(experiment), plan_(plan), table_(table), summary_(summary.at("variants")),
          timing_(timing.at("variants")), folder_(folder) {
        if (!plan.events.empty())
            event_ = plan.events.front().change.first;
        frames_ = columnsOf(experiment.frames(), event_);
    }

    Image<glm::u8vec4> draw() const;

private:
    Image<glm::u8vec4> picture(const std::string& row, int frame) const;
    std::vector<std::pair<std::string, std::string>> notesOf(const std::string& variant) const;
    bool hasResponse() const;
    SheetCurve curveOf(std::size_t variant, const char* metric, FrameRange range) const;
    SheetPlot responsePlot() const;
    SheetPlot errorPlot() const;

    const Experiment& experiment_;
    const RunPlan& plan_;
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
    for (const RunEvent& event : plan_.events)
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
    for (const RunEvent& event : plan_.events)
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
    const Json& summary = summary_.at(variant);
    std::vector<std::pair<std::string, std::string>> notes;
    const auto note = [&](const char* label, const char* format, const char* key) {
        if (summary.contains(key) && !summary.at(key).is_null())
            notes.emplace_back(label, textOf(format, summary.at(key).get<double>()));
    };
    if (summary.contains("response_settled") && !summary.at("response_settled").is_null()) {
        notes = {{"t50", framesText(summary, "t50")},
                 {"t90", framesText(summary, "t90")},
                 {"t99", framesText(summary, "t99")}};
        note("ghost", "%.1f", "ghost_frames");
    } else {
        note("ghost", "%.3f", "ghost_energy");
    }
    note("RMSE", "%.4f", "rmse_settled");
    const Json& spent = timing_.at(variant).at("ms_per_frame");
    notes.emplace_back("ms", spent.is_null() ? "-" : textOf("%.1f", spent.get<double>()));
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
        sheet.columns.push_back(textOf("frame %d", frames_[i]) +
                                (event_ ? textOf("  (%+d)", after) : ""));
    }
    for (std::size_t i = 0; i < experiment_.variants.size(); ++i) {
        SheetRow row{.name = experiment_.variants[i].name, .color = sheetColor(i)};
        row.notes = notesOf(row.name);
        for (const int frame : frames_)
            row.pictures.push_back(picture(row.name, frame));
        sheet.rows.push_back(std::move(row));
    }
    SheetRow reference{.name = "reference", .color = kReferenceColor};
    reference.notes = {{"samples", textOf("%d", experiment_.referenceSamples)}};
    for (const int frame : frames_)
        reference.pictures.push_back(
            picture(reference.name, plan_.moments[momentAt(plan_.moments, frame)].first));
    sheet.rows.push_back(std::move(reference));
    if (hasResponse())
        sheet.plots.push_back(responsePlot());
    sheet.plots.push_back(errorPlot());
    sheet.footer =
        textOf("afterglow %s", std::string(version()).c_str()) +
        textOf("  %s  %dx%d", experiment_.scene.c_str(), experiment_.size.x, experiment_.size.y) +
        textOf("  %g Hz  seed %u", experiment_.rate, experiment_.seed) +
        textOf("  signal %s", std::string(nameOf(experiment_.signal)).c_str());
    return drawContactSheet(sheet);
}

} // namespace

Image<glm::u8vec4> drawRunSheet(const Experiment& experiment, const RunPlan& plan,
                                const MetricsTable& table, const Json& summary, const Json& timing,
                                const std::filesystem::path& folder) {
    return RunSheet(experiment, plan, table, summary, timing, folder).draw();
}

} // namespace afterglow
