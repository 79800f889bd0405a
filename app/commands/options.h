// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace CLI {
class App;
}

namespace afterglow {

// The options of the program, over CLI11, which is slow to compile: only options.cpp and
// command_line.cpp include it. An option is added once, with its name, its variable, its kind and
// its help; everything about it is there.

/// The type of an option's value: its placeholder in the help, and its parser. The parser throws
/// UsageError with what was expected and what was found; the option's name is put in front of that.
template <class T>
struct Kind {
    std::string word;
    std::function<T(const std::string&)> read;
};

constexpr int kMostFrames = 100'000;                    ///< of a run
constexpr int kMostSamples = 1 << 20;                   ///< per pixel of a reference
using Assignment = std::pair<std::string, std::string>; ///< a key and its value

Kind<std::string> anyText(std::string word = "NAME");
Kind<int> wholeNumber(int min, int max, std::string word = "N");
Kind<std::uint32_t> seedNumber();
Kind<double> number(double min, double max, std::string word);
Kind<glm::ivec2> imageSize();  ///< 1280x720
Kind<Assignment> assignment(); ///< KEY=VALUE
Kind<std::string> oneOf(std::string kind,
                        std::vector<std::string> names); ///< or the nearest is told

/// Returns the parts of "a,b" at each comma. UsageError if one is empty.
std::vector<std::string> partsOf(const std::string& text);

template <class T>
Kind<std::vector<T>> listOf(Kind<T> item, std::string word = "A,B,...") {
    return {std::move(word), [read = std::move(item.read)](const std::string& text) {
                std::vector<T> values;
                for (const std::string& part : partsOf(text))
                    values.push_back(read(part));
                return values;
            }};
}

/// Returns a default as the help shows it; empty if there is none, which is 0 of numbers.
std::string defaultText(const std::string& value);
std::string defaultText(glm::ivec2 value);
template <class T>
std::string defaultText(const T& value) {
    if constexpr (std::is_integral_v<T>)
        return value == 0 ? "" : defaultText(std::to_string(value));
    return {};
}

/// The options of one command. Variables must stay where they are until read() is done.
class Options {
public:
    explicit Options(CLI::App& app);
    ~Options();
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;

    /// Adds "--name,-n", or "WORD" without dashes for a place of its own. The help ends with the
    /// default that the variable has now.
    template <class V, class T>
    void add(const std::string& names, V& value, Kind<T> kind, const std::string& help) {
        addText(names, kind.word, help + defaultText(value), Count::Once, reader(value, kind));
    }
    /// Adds an option that must be given.
    template <class T>
    void require(const std::string& names, T& value, Kind<T> kind, const std::string& help) {
        addText(names, kind.word, help, Count::Required, reader(value, kind));
    }
    /// Adds an option that may be given again for more values, and for places of any number,
    /// of which there must be one.
    template <class T>
    void addEach(const std::string& names, std::vector<T>& values, Kind<T> kind,
                 const std::string& help) {
        addText(names, kind.word, help, Count::Any,
                [&values, read = std::move(kind.read)](const std::string& text) {
                    values.push_back(read(text));
                });
    }
    /// Adds a place that may have any number of values; without one they stay as they are.
    template <class T>
    void addPlaces(const std::string& name, std::vector<T>& values, Kind<T> kind,
                   const std::string& help) {
        addText(name, kind.word, help, Count::Optional, listReader(values, kind));
    }
    /// Adds an option of two values: "--compare BEFORE AFTER".
    template <class T>
    void addPair(const std::string& name, std::vector<T>& values, Kind<T> kind,
                 const std::string& help) {
        addText(name, kind.word, help, Count::Two, listReader(values, kind));
    }
    void addFlag(const std::string& name, bool& value, const std::string& help);

    void exclude(const std::string& name, std::initializer_list<const char*> others);
    void need(const std::string& name, const std::string& other);
    /// Adds a check of several options together. It is called once all have been read, and throws
    /// UsageError.
    void check(std::function<void()> check);
    void setFooter(const std::string& text); ///< of the help; exit codes are put behind it

    /// Gives the variables the values that were found.
    void read() const;

private:
    enum class Count { Once, Required, Any, Optional, Two };
    using Take = std::function<void(const std::string&)>;

    template <class V, class T>
    static Take reader(V& value, Kind<T>& kind) {
        return
            [&value, read = std::move(kind.read)](const std::string& text) { value = read(text); };
    }
    /// Its values take the place of those that are there.
    template <class T>
    static Take listReader(std::vector<T>& values, Kind<T>& kind) {
        return [&values, read = std::move(kind.read),
                isFirst = true](const std::string& text) mutable {
            if (std::exchange(isFirst, false))
                values.clear();
            values.push_back(read(text));
        };
    }
    void addText(const std::string& names, const std::string& word, const std::string& help,
                 Count count, Take take);

    struct Entry;
    CLI::App& app_;
    std::vector<Entry> entries_;
    std::vector<std::function<void()>> checks_;
};

} // namespace afterglow
