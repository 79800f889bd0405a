#include "app/experiment/run_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

namespace afterglow {

namespace {

const std::string kReference = "reference";

std::string textOf(const char* format, auto... values) {
    char text[128];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string framesText(const std::optional<int>& frames) {
    return frames ? std::to_string(*frames) : "never";
}

SheetCurve curveOf(const VariantResult& variant, std::size_t index, int firstFrame) {
    SheetCurve curve;
    curve.name = variant.name;
    curve.color = sheetColor(index);
    curve.firstFrame = firstFrame;
    return curve;
}

std::vector<int> columns(int frames, std::optional<int> event) {
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

} // namespace

RunSheet::RunSheet(const Experiment& experiment) : experiment_(experiment) {
    const auto segments = experiment.timeline.segments();
    if (segments.size() > 1)
        event_ = segments[1].first;
    frames_ = columns(experiment.frames(), event_);
}

void RunSheet::addFrame(const std::string& variant, int frame, const Image<glm::u8vec4>& picture) {
    if (std::ranges::find(frames_, frame) != frames_.end())
        pictures_[variant][frame] = picture;
}

void RunSheet::addReference(int frame, const Image<glm::u8vec4>& picture) {
    addFrame(kReference, frame, picture);
}

std::vector<Image<glm::u8vec4>> RunSheet::picturesOf(const std::string& row) const {
    std::vector<Image<glm::u8vec4>> pictures;
    for (int frame : frames_)
        pictures.push_back(pictures_.at(row).at(frame));
    return pictures;
}

SheetPlot RunSheet::responsePlot(const ExperimentResult& result) const {
    SheetPlot plot;
    plot.title = "Response: 0 is the old light, 1 the new";
    plot.yLabel = "response";
    plot.yMax = 1.1;
    plot.levels = {{0.0, "0"}, {0.5, "50 %"}, {0.9, "90 %"}, {1.0, "100 %"}};
    plot.events = {*event_};
    const int first = std::max(0, *event_ - 4);
    const int end = std::min(experiment_.frames(), *event_ + 41); // what comes later is a flat line
    for (std::size_t i = 0; i < result.variants.size(); ++i) {
        const VariantResult& variant = result.variants[i];
        SheetCurve curve = curveOf(variant, i, first);
        for (int frame = first; frame < end; ++frame)
            curve.values.push_back(variant.response[std::size_t(frame)].value_or(
                std::numeric_limits<double>::quiet_NaN()));
        if (!variant.events.empty() && variant.events.front().response.t90) {
            const int t90 = *variant.events.front().response.t90;
            const int reached = variant.events.front().frame + t90;
            if (reached < end) {
                curve.marked = reached;
                curve.mark = std::to_string(t90);
            }
        }
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

SheetPlot RunSheet::errorPlot(const ExperimentResult& result) const {
    SheetPlot plot;
    plot.title = "Error: RMSE of linear luminance against the reference";
    plot.yLabel = "rmse";
    if (event_)
        plot.events = {*event_};
    // The first frames have no history and would press all else to the ground.
    const int first = std::min(8, experiment_.frames() - 1);
    double largest = 0.0;
    for (std::size_t i = 0; i < result.variants.size(); ++i) {
        const VariantResult& variant = result.variants[i];
        SheetCurve curve = curveOf(variant, i, first);
        curve.values.assign(variant.rmse.begin() + first, variant.rmse.end());
        largest = std::max(largest, *std::ranges::max_element(curve.values));
        plot.curves.push_back(std::move(curve));
    }
    plot.yMax = largest > 0.0 ? largest * 1.1 : 1.0;
    const double unit = std::pow(10.0, std::floor(std::log10(plot.yMax)));
    const double step = plot.yMax / unit < 2.0   ? unit / 2.0
                        : plot.yMax / unit < 5.0 ? unit
                                                 : 2.0 * unit;
    for (int i = 0; i * step <= plot.yMax; ++i)
        plot.levels.emplace_back(i * step, textOf("%.3g", i * step));
    return plot;
}

Image<glm::u8vec4> RunSheet::draw(const ExperimentResult& result) const {
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
    for (std::size_t i = 0; i < result.variants.size(); ++i) {
        const VariantResult& variant = result.variants[i];
        SheetRow row;
        row.name = variant.name;
        row.color = sheetColor(i);
        row.pictures = picturesOf(variant.name);
        if (!variant.events.empty()) {
            const ResponseSummary& response = variant.events.front().response;
            row.notes = {"t50 " + framesText(response.t50), "t90 " + framesText(response.t90),
                         "t99 " + framesText(response.t99),
                         textOf("ghost %.1f", response.ghostFrames)};
        }
        row.notes.push_back(textOf("rmse %.4f", variant.rmseSettled));
        row.notes.push_back(textOf("%.1f ms", variant.clock.medianMilliseconds()));
        sheet.rows.push_back(std::move(row));
    }
    SheetRow reference;
    reference.name = kReference;
    reference.color = kReferenceColor;
    reference.notes = {textOf("%d spp", experiment_.referenceSamples)};
    reference.pictures = picturesOf(kReference);
    sheet.rows.push_back(std::move(reference));
    if (event_)
        sheet.plots.push_back(responsePlot(result));
    sheet.plots.push_back(errorPlot(result));
    sheet.footer =
        textOf("afterglow %s", std::string(version()).c_str()) +
        textOf("  %s  %dx%d", experiment_.scene.c_str(), experiment_.size.x, experiment_.size.y) +
        textOf("  %g Hz  seed %u", experiment_.rate, experiment_.seed) +
        textOf("  signal %s", std::string(nameOf(experiment_.signal)).c_str());
    return drawContactSheet(sheet);
}

} // namespace afterglow
