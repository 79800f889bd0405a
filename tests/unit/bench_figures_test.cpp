// SPDX-License-Identifier: MIT
#include "app/bench/compare_figures.h"
#include "app/bench/startup.h"
#include "app/bench/text_table.h"
#include "renderer/base/error.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

nlohmann::ordered_json fileOf(const Figures& figures) {
    return {{"schema", kBenchSchema},
            {"machine", {{"cpu", "a processor"}}},
            {"gl", {{"renderer", "a renderer"}}},
            {"tracing_threads", 2},
            {"figures", describe(figures)}};
}

std::string refusal(const std::string& text) {
    try {
        readBenchFile(text, "bench.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

Figures oneFigure(std::string_view unit, Better better, double median) {
    Figures figures;
    figures.add("hall", "figure", unit, better, exactly(median));
    return figures;
}

FigureComparison compareOne(std::string_view unit, Better better, double before, double after) {
    return compareFigures(oneFigure(unit, better, before), oneFigure(unit, better, after), 10.0);
}

} // namespace

TEST_CASE("median and quartiles are those of the definition, in any order of the values") {
    CHECK(spreadOf({}) == Spread{});
    CHECK(spreadOf({7.0}) == Spread{.median = 7.0, .lower = 7.0, .upper = 7.0, .n = 1});
    CHECK(spreadOf({4.0, 1.0, 3.0, 2.0}) ==
          Spread{.median = 2.5, .lower = 1.75, .upper = 3.25, .n = 4});
    std::vector<double> values{5.0, 9.0, 1.0, 3.0, 7.0};
    std::ranges::sort(values);
    do
        CHECK(spreadOf(values) == Spread{.median = 5.0, .lower = 3.0, .upper = 7.0, .n = 5});
    while (std::ranges::next_permutation(values).found);
}

TEST_CASE("one outlier moves neither the median nor the quartiles of nine values") {
    const Spread calm = spreadOf({1, 2, 3, 4, 5, 6, 7, 8, 9});
    const Spread disturbed = spreadOf({1, 2, 3, 4, 5, 6, 7, 8, 9000});
    CHECK(calm == disturbed);
}

TEST_CASE("a rate turns quartiles over, and none of nothing") {
    const Spread rate = rateOf(12.0, Spread{.median = 3.0, .lower = 2.0, .upper = 4.0, .n = 5});
    CHECK(rate == Spread{.median = 4.0, .lower = 3.0, .upper = 6.0, .n = 5});
    CHECK(rateOf(12.0, {}).median == 0.0);
}

TEST_CASE("figures that are read are those that were written, to the last bit") {
    Figures figures;
    figures.add("hall/61x37/svgf", "passes.a-trous 0.ms", "ms", Better::Less,
                {.median = 1.0 / 3.0, .lower = 0.1, .upper = 1e300, .n = 13});
    figures.add("", "copy.gb_per_s", "GB/s", Better::None, exactly(0.0));
    figures.add("hall", "rate", "Mrays/s", Better::More, spreadOf({1.0, 2.0}));
    const BenchFile file = readBenchFile(fileOf(figures).dump(), "bench.json");
    CHECK(file.machine == "a processor, a renderer, 2 threads");
    REQUIRE(file.figures.all().size() == 3);
    for (const Figure& figure : figures.all()) {
        CAPTURE(figure.key);
        const Figure* const read = file.figures.find(figure.key);
        REQUIRE(read);
        CHECK((*read == figure));
    }
    CHECK_THROWS_AS(figures.add("hall", "rate", "ms", Better::Less, {}), std::logic_error);
}

TEST_CASE("a file that is none of figures is refused with its name and the cause") {
    const auto spoilt = [](auto spoil) {
        nlohmann::ordered_json json = fileOf(oneFigure("ms", Better::Less, 1.0));
        spoil(json);
        return refusal(json.dump());
    };
    CHECK(spoilt([](auto&) {}) == "accepted");
    CHECK(refusal("{").starts_with("bench.json:1")); // the line
    CHECK(refusal("[]").starts_with("bench.json: "));
    CHECK(spoilt([](auto& json) { json.erase("schema"); }).find("schema") != std::string::npos);
    CHECK(spoilt([](auto& json) {
              json["schema"] = kBenchSchema + 1;
          }).find("this program reads") != std::string::npos);
    CHECK(spoilt([](auto& json) { json["figures"]["hall/figure"].erase("n"); }).find("n") !=
          std::string::npos);
    for (const char* key : {"median", "unit", "better", "n"}) {
        CAPTURE(key);
        const std::string message =
            spoilt([&](auto& json) { json["figures"]["hall/figure"][key] = nullptr; });
        CHECK(message.find(std::string("hall/figure")) != std::string::npos);
        CHECK(message.find(key) != std::string::npos);
    }
    CHECK(spoilt([](auto& json) {
              json["figures"]["hall/figure"]["better"] = "large";
          }).find("large") != std::string::npos);
}

TEST_CASE("what is worse follows from the direction, and the bound belongs to what is good") {
    const auto isWorse = [](std::string_view unit, Better better, double before, double after) {
        return compareOne(unit, better, before, after).rows.at(0).worse;
    };
    CHECK_FALSE(isWorse("ms", Better::Less, 10.0, 11.0));
    CHECK(isWorse("ms", Better::Less, 10.0, 11.01));
    CHECK_FALSE(isWorse("ms", Better::Less, 10.0, 1.0));
    CHECK_FALSE(isWorse("Mrays/s", Better::More, 11.0, 10.0));
    CHECK(isWorse("Mrays/s", Better::More, 11.01, 10.0));
    CHECK_FALSE(isWorse("Mrays/s", Better::More, 1.0, 10.0));
    CHECK_FALSE(isWorse("ms", Better::None, 1.0, 10.0));
    CHECK(isWorse("ms", Better::Less, 0.0, 0.1));
    CHECK_FALSE(isWorse("ms", Better::Less, 0.0, 0.0));
}

TEST_CASE("memory that has grown is marked, and is no time") {
    const FigureComparison memory = compareOne("bytes", Better::Less, 1.0, 2.0);
    CHECK(memory.rows.at(0).worse);
    CHECK(memory.slower().empty());
    CHECK(compareOne("ms", Better::Less, 1.0, 2.0).slower().size() == 1);
    CHECK(compareOne("Mrays/s", Better::More, 2.0, 1.0).slower().size() == 1);
}

TEST_CASE("a comparison is by key, names what one file lacks, and tells the worst first") {
    Figures before, after;
    before.add("", "a", "ms", Better::Less, exactly(1.0));
    before.add("", "gone", "ms", Better::Less, exactly(1.0));
    before.add("", "b", "ms", Better::Less, exactly(1.0));
    after.add("", "new", "ms", Better::Less, exactly(1.0));
    after.add("", "b", "ms", Better::Less, exactly(4.0));
    after.add("", "a", "ms", Better::Less, exactly(2.0));
    const FigureComparison comparison = compareFigures(before, after, 10.0);
    CHECK(comparison.onlyBefore == std::vector<std::string>{"gone"});
    CHECK(comparison.onlyAfter == std::vector<std::string>{"new"});
    REQUIRE(comparison.slower().size() == 2);
    CHECK(comparison.slower()[0].key == "b");
    CHECK(comparison.slower()[0].ratio == 4.0);
    const std::string table = tableOf(comparison);
    CHECK(table.find("4.000  worse") != std::string::npos);
    CHECK(table.find("only before: gone") != std::string::npos);
}

TEST_CASE("columns of a table are aligned, and no line ends in a blank") {
    TextTable table({"name", "ms", ""});
    table.add({"a long name", "1.5", ""});
    table.add({"b", "12345", "worse"});
    CHECK(table.text() == "  name            ms\n"
                          "  a long name    1.5\n"
                          "  b            12345  worse\n");
    CHECK_THROWS_AS(table.add({"too", "few"}), std::logic_error);
    CHECK(digits(0.0) == "0");
    CHECK(digits(0.01234) == "0.0123");
    CHECK(digits(1.234) == "1.23");
    CHECK(digits(12.34) == "12.3");
    CHECK(digits(1234.4) == "1234");
    CHECK(bytesText(1.5e6) == "1.50 MB");
}

TEST_CASE("the times of a start are read from the line that was written, behind any other") {
    StartupTimes times;
    int nanoseconds = 1'000'000'007;
    for (auto* point : {&times.command, &times.scene, &times.context, &times.programs,
                        &times.upload, &times.first, &times.second})
        *point += std::chrono::nanoseconds(nanoseconds++);
    times.bvhMilliseconds = 12.5;
    const StartupTimes read = startupTimesIn("something else\n" + lineOf(times) + "\n");
    CHECK((read.command == times.command));
    CHECK((read.context == times.context));
    CHECK((read.second == times.second));
    CHECK(read.bvhMilliseconds == 12.5);
    CHECK_THROWS_AS(startupTimesIn("nothing"), Error);
    CHECK_THROWS_AS(startupTimesIn("startup: {}"), Error);
    CHECK_THROWS_AS(startupTimesIn("startup: not JSON"), Error);
}
