// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace afterglow {

/// A table of text with columns as wide as what is in them: the first one is aligned to the left,
/// the others to the right.
class TextTable {
public:
    explicit TextTable(std::vector<std::string> head);
    void add(std::vector<std::string> row); ///< of as many cells as the head
    bool empty() const { return rows_.size() == 1; }
    std::string text() const; ///< each line is indented by two

private:
    std::vector<std::vector<std::string>> rows_;
};

/// "12.3", "0.0123": a number with three digits that matter.
std::string digits(double value);
/// "12.3 MB", of 10^6 bytes.
std::string bytesText(double bytes);

} // namespace afterglow
