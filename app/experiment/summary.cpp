#include "app/experiment/runner.h"

#include <cstdio>

namespace afterglow {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

void add(Json& json, const EventResult* event) {
    const auto responseOf = [&](auto member) {
        return event ? orNull(event->response.*member) : Json(nullptr);
    };
    json["t50"] = responseOf(&ResponseSummary::t50);
    json["t90"] = responseOf(&ResponseSummary::t90);
    json["t99"] = responseOf(&ResponseSummary::t99);
    json["ghost_frames"] = event ? Json(event->response.ghostFrames) : Json(nullptr);
    json["overshoot"] = event ? Json(event->response.overshoot) : Json(nullptr);
    json["noise_after_event"] = event ? Json(event->noiseAfter) : Json(nullptr);
    json["noise_settle_frames"] = event ? orNull(event->noiseSettles) : Json(nullptr);
}

std::string cell(const std::optional<int>& frames) {
    return frames ? std::to_string(*frames) : "never";
}

std::string cell(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

} // namespace

Json summaryOf(const Experiment& experiment, const ExperimentResult& result) {
    Json variants = Json::object();
    for (const VariantResult& variant : result.variants) {
        Json json;
        add(json, variant.events.empty() ? nullptr : &variant.events.front());
        json["rmse_settled"] = variant.rmseSettled;
        json["flicker"] = variant.flicker;
        json["ms_per_frame"] = variant.clock.medianMilliseconds();
        json["rays_per_frame"] = variant.clock.meanRays();
        if (variant.events.size() > 1)
            for (const EventResult& event : variant.events) {
                Json one{{"frame", event.frame}};
                add(one, &event);
                json["events"].push_back(one);
            }
        variants[variant.name] = json;
    }
    return {{"experiment", experiment.name}, {"variants", variants}};
}

std::string tableOf(const ExperimentResult& result) {
    std::vector<std::vector<std::string>> rows{{"variant", "t50", "t90", "t99", "ghost frames",
                                                "overshoot", "noise after", "rmse settled",
                                                "flicker", "ms/frame", "rays/frame"}};
    for (const VariantResult& variant : result.variants) {
        std::vector<std::string> row{variant.name};
        if (variant.events.empty()) {
            row.insert(row.end(), 6, "-");
        } else {
            const EventResult& event = variant.events.front();
            for (const auto& frames : {event.response.t50, event.response.t90, event.response.t99})
                row.push_back(cell(frames));
            row.push_back(cell("%.2f", event.response.ghostFrames));
            row.push_back(cell("%+.3f", event.response.overshoot));
            row.push_back(cell("%.5f", event.noiseAfter));
        }
        row.push_back(cell("%.5f", variant.rmseSettled));
        row.push_back(cell("%.5f", variant.flicker));
        row.push_back(cell("%.2f", variant.clock.medianMilliseconds()));
        row.push_back(cell("%.0f", variant.clock.meanRays()));
        rows.push_back(row);
    }
    std::string table;
    for (const auto& row : rows) {
        for (std::size_t column = 0; column < row.size(); ++column) {
            std::size_t width = 0;
            for (const auto& other : rows)
                width = std::max(width, other[column].size());
            const std::string padding(width - row[column].size(), ' ');
            table += column == 0 ? row[column] + padding : "  " + padding + row[column];
        }
        table += '\n';
    }
    return table;
}

} // namespace afterglow
