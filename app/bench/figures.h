// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/spread.h"

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace afterglow {

/// The version of the shape of a file of figures: a change that readers must know raises it.
inline constexpr int kBenchSchema = 1;

/// The direction in which a figure is better. Facts and other programs' figures have none.
enum class Better { Less, More, None };

/// One number of a benchmark.
struct Figure {
    std::string key;  ///< "hall/640x360/svgf/passes.temporal.ms": unique in a file
    std::string unit; ///< "ms", "Mrays/s", "bytes", ...
    Better better = Better::None;
    Spread value;

    /// Returns whether it says how long something takes: a time, or a rate of it.
    bool isTime() const { return unit == "ms" || unit == "Mrays/s"; }
    bool operator==(const Figure&) const = default;
};

/// The figures of a benchmark, in the order in which they were measured.
class Figures {
public:
    /// `subject` is what was measured ("hall/640x360"), or empty. A key that is there already is
    /// std::logic_error.
    void add(std::string_view subject, std::string_view name, std::string_view unit, Better better,
             const Spread& value);
    const std::vector<Figure>& all() const { return figures_; }
    const Figure* find(std::string_view key) const; ///< null: it is not there

private:
    std::vector<Figure> figures_;
};

/// Returns an object with a member for each figure, by its key.
nlohmann::ordered_json describe(const Figures& figures);

/// A file that `afterglow bench --json` has written.
struct BenchFile {
    Figures figures;
    std::string machine; ///< processor, what drew, threads: "AMD EPYC 7B13, llvmpipe, 2 threads"
};

/// Reads the text of such a file. InputError, with the file and the cause, for any other file or
/// another schema.
BenchFile readBenchFile(std::string_view text, std::string_view source);

} // namespace afterglow
