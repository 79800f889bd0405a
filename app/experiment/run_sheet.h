#pragma once

#include "app/experiment/contact_sheet.h"
#include "app/experiment/runner.h"

#include <map>

namespace afterglow {

/// Gathers the pictures of a run that go on its contact sheet: few columns around the first event,
/// or spread over the run if there is none.
class RunSheet {
public:
    explicit RunSheet(const Experiment& experiment);

    const std::vector<int>& frames() const { return frames_; } ///< of the columns, rising

    /// Keeps the picture if its frame is a column.
    void addFrame(const std::string& variant, int frame, const Image<glm::u8vec4>& picture);
    void addReference(int frame, const Image<glm::u8vec4>& picture);

    Image<glm::u8vec4> draw(const ExperimentResult& result) const;

private:
    std::vector<Image<glm::u8vec4>> picturesOf(const std::string& row) const;
    SheetPlot responsePlot(const ExperimentResult& result) const;
    SheetPlot errorPlot(const ExperimentResult& result) const;

    const Experiment& experiment_;
    std::optional<int> event_; ///< frame of the first one
    std::vector<int> frames_;
    std::map<std::string, std::map<int, Image<glm::u8vec4>>> pictures_; ///< by row and frame
};

} // namespace afterglow
