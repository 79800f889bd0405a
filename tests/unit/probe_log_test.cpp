// SPDX-License-Identifier: MIT
#include "app/measure/probe_csv.h"
#include "app/measure/probe_log.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

ProbeFrame frameOf(std::uint32_t number, double lit = 1.0) {
    ProbeFrame frame;
    frame.frame = number;
    frame.panes[0] = {"SVGF", "filter=svgf"};
    frame.probes[0] = probeAt({3, 5}, {61, 37});
    frame.samples[0][0] = ProbeSample{.pixels = 1, .lit = lit, .rawLit = 2.0 * lit};
    return frame;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char character : text) {
        if (character == '\n')
            lines.emplace_back();
        else
            lines.back() += character;
    }
    REQUIRE(lines.back().empty()); // the last line ends too
    lines.pop_back();
    return lines;
}

const ProbeRun kRun{"cornell", 7, {61, 37}};

/// The lines that begin with "# ", or the others.
std::vector<std::string> linesOf(const ProbeLog& log, bool facts) {
    std::vector<std::string> lines = linesOf(toCsv(log, kRun));
    std::erase_if(lines, [&](const std::string& line) { return line.starts_with("# ") != facts; });
    return lines;
}

std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields(1);
    bool inQuotes = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && inQuotes && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[i++];
        else if (line[i] == '"')
            inQuotes = !inQuotes;
        else if (line[i] == ',' && !inQuotes)
            fields.emplace_back();
        else
            fields.back() += line[i];
    }
    return fields;
}

} // namespace

TEST_CASE("a probe at a pixel is that pixel, and one between two holds both in any order") {
    const glm::ivec2 image{61, 37};
    CHECK(probeAt({60, 0}, image) == Probe{{60, 0}, {1, 1}});
    const Probe box{{3, 5}, {8, 2}};
    CHECK(probeBetween({3, 5}, {10, 6}, image) == box);
    CHECK(probeBetween({10, 6}, {3, 5}, image) == box);
    CHECK(probeBetween({3, 6}, {10, 5}, image) == box);
}

TEST_CASE("a probe around a pixel has nine by nine pixels, moved into the picture, or all of it") {
    const glm::ivec2 image{61, 37};
    CHECK(probeAround({30, 20}, image) == Probe{{26, 16}, {9, 9}});
    CHECK(probeAround({0, 36}, image) == Probe{{0, 28}, {9, 9}});
    CHECK(probeAround({60, -5}, image) == Probe{{52, 0}, {9, 9}});
    CHECK(probeAround({3, 1}, {61, 4}) == Probe{{0, 0}, {9, 4}});
}

TEST_CASE("a probe never leaves its picture and is never empty") {
    const glm::ivec2 image{61, 37};
    CHECK(probeBetween({-9, -1}, {100, 37}, image) == Probe{{0, 0}, {61, 37}});
    CHECK(probeBetween({70, 40}, {90, 50}, image) == Probe{{60, 36}, {1, 1}});
    CHECK_THROWS_AS(probeAt({0, 0}, {0, 37}), std::logic_error);
    for (const glm::ivec2 to : {glm::ivec2(1, 1), glm::ivec2(7, 3), glm::ivec2(640, 360)}) {
        for (int x = 0; x < image.x; ++x) {
            for (const int size : {1, 2, 5}) {
                const Probe probe =
                    rescaled(probeBetween({x, 36}, {x + size - 1, 36}, image), image, to);
                CAPTURE(x);
                CHECK(probe.min.x >= 0);
                CHECK(probe.min.y >= 0);
                CHECK(probe.size.x >= 1);
                CHECK(probe.size.y >= 1);
                CHECK(probe.min.x + probe.size.x <= to.x);
                CHECK(probe.min.y + probe.size.y <= to.y);
            }
        }
    }
}

TEST_CASE("a probe covers the same part of a picture of another size") {
    const glm::ivec2 image{64, 36};
    const Probe box{{16, 9}, {32, 18}};
    CHECK(rescaled(box, image, {128, 72}) == Probe{{32, 18}, {64, 36}});
    CHECK(rescaled(box, image, {16, 4}) == Probe{{4, 1}, {8, 2}});
    CHECK(rescaled(Probe{{0, 0}, image}, image, {61, 37}) == Probe{{0, 0}, {61, 37}});
    // A pixel that becomes less than one stays the one that holds its center.
    CHECK(rescaled(probeAt({3, 20}, image), image, {16, 9}) == Probe{{0, 5}, {1, 1}});
    // To a multiple and back nothing is lost.
    for (int x = 0; x < image.x; ++x) {
        const Probe pixel = probeAt({x, x / 2}, image);
        CHECK(rescaled(rescaled(pixel, image, {192, 108}), {192, 108}, image) == pixel);
    }
}

TEST_CASE("the log keeps the last 600 frames") {
    ProbeLog log;
    for (std::uint32_t i = 0; i < 1000; ++i)
        log.add(frameOf(i, i));
    REQUIRE(log.frames().size() == 600);
    CHECK(log.frames().front().frame == 400);
    CHECK(log.frames().back().frame == 999);
    const std::vector<float> series = seriesOf(log, 0, 0, ProbeQuantity::Lit);
    REQUIRE(series.size() == 600);
    CHECK(series.front() == 400.0f);
    CHECK(series.back() == 999.0f);
    log.clear();
    CHECK(log.frames().empty());
    CHECK(seriesOf(log, 0, 0, ProbeQuantity::Lit).empty());
}

TEST_CASE(
    "each quantity's series is its own member of the samples, with gaps where there is none") {
    ProbeLog log;
    ProbeFrame frame = frameOf(0);
    frame.samples[0][0] = ProbeSample{.pixels = 4,
                                      .lit = 1.0,
                                      .rawLit = 2.0,
                                      .rawVariance = 3.0,
                                      .variance = 4.0,
                                      .lambda = 0.5,
                                      .alpha = 0.25,
                                      .history = 7.0};
    log.add(frame);
    frame.frame = 1;
    frame.samples[0][0]->pixels = 0; // no surface
    log.add(frame);
    frame.frame = 2;
    frame.samples[0][0].reset(); // the pane did not run
    log.add(frame);
    frame.frame = 3;
    frame.samples[0][0] = ProbeSample{.pixels = 4, .lit = std::numeric_limits<double>::infinity()};
    log.add(frame);

    const auto first = [&](ProbeQuantity quantity) {
        return seriesOf(log, 0, 0, quantity).front();
    };
    CHECK(first(ProbeQuantity::Lit) == 1.0f);
    CHECK(first(ProbeQuantity::RawLit) == 2.0f);
    CHECK(first(ProbeQuantity::RawVariance) == 3.0f);
    CHECK(first(ProbeQuantity::Variance) == 4.0f);
    CHECK(first(ProbeQuantity::Lambda) == 0.5f);
    CHECK(first(ProbeQuantity::Alpha) == 0.25f);
    CHECK(first(ProbeQuantity::History) == 7.0f);
    const std::vector<float> lit = seriesOf(log, 0, 0, ProbeQuantity::Lit);
    CHECK(std::isnan(lit[1]));
    CHECK(std::isnan(lit[2]));
    CHECK(std::isnan(lit[3]));
    CHECK(seriesOf(log, 0, 0, ProbeQuantity::Alpha)[3] ==
          0.0f); // a number, for all that lit is not
    CHECK(log.measured(0, 0, 0) != nullptr);
    for (const std::size_t i : {1, 2, 3})
        CHECK(log.measured(i, 0, 0) == nullptr);
    for (const float value : seriesOf(log, 1, 0, ProbeQuantity::Lit))
        CHECK(std::isnan(value));
}

TEST_CASE("the table of quantities stands in the order of their enumeration") {
    for (std::size_t i = 0; i < quantities().size(); ++i) {
        CHECK(std::size_t(quantities()[i].quantity) == i);
        CHECK_FALSE(quantities()[i].name.empty());
    }
    CHECK(quantities().size() == std::size_t(ProbeQuantity::Variance) + 1);
    CHECK(infoOf(ProbeQuantity::Lambda).range == glm::vec2(0.0f, 1.0f));
    CHECK(infoOf(ProbeQuantity::Variance).logarithmic);
}

TEST_CASE("a probe that moves starts again, and the others go on") {
    ProbeLog log;
    ProbeFrame frame = frameOf(0);
    frame.probes[1] = probeAt({9, 9}, {61, 37});
    frame.samples[1][0] = ProbeSample{.pixels = 1, .lit = 5.0};
    log.add(frame);
    frame.frame = 1;
    frame.probes[1] = probeAt({10, 9}, {61, 37});
    frame.samples[1][0]->lit = 6.0;
    log.add(frame);
    CHECK(seriesOf(log, 0, 0, ProbeQuantity::Lit) == std::vector<float>{1.0f, 1.0f});
    CHECK(std::isnan(seriesOf(log, 1, 0, ProbeQuantity::Lit)[0]));
    CHECK(seriesOf(log, 1, 0, ProbeQuantity::Lit)[1] == 6.0f);

    log.restart(0);
    CHECK(std::isnan(seriesOf(log, 0, 0, ProbeQuantity::Lit)[1]));
    CHECK(seriesOf(log, 1, 0, ProbeQuantity::Lit)[1] == 6.0f);
}

TEST_CASE("other settings of a pane leave a mark that concerns this pane alone") {
    ProbeLog log;
    ProbeFrame frame = frameOf(0);
    const auto newest = [&](const ProbePane& pane) {
        ++frame.frame;
        frame.panes[1] = pane;
        log.add(frame);
        return log.frames().back().marks;
    };
    log.add(frame);
    CHECK(newest({"A-SVGF", "filter=asvgf"}).empty()); // a new pane is no change
    for (const auto& [pane, text] :
         {std::pair<ProbePane, std::string>({"A-SVGF alpha 0.1", "filter=asvgf alpha=0.1"},
                                            "pane B: A-SVGF alpha 0.1"),
          {ProbePane{"Fixed alpha", "filter=fixed"}, "pane B: Fixed alpha"},
          {ProbePane{"Fixed alpha", "filter=fixed signal=ao"}, "pane B: new settings"}}) {
        const auto marks = newest(pane);
        REQUIRE(marks.size() == 1);
        CHECK(marks[0].text == text);
        CHECK(marks[0].pane == std::size_t(1));
        CHECK_FALSE(marks[0].step);
        CHECK(newest(pane).empty());
    }
    CHECK(newest({"Another name", "filter=fixed signal=ao"}).empty());   // names make no numbers
    CHECK_FALSE(std::isnan(seriesOf(log, 0, 0, ProbeQuantity::Lit)[0])); // the series goes on
}

TEST_CASE("a sample without its probe or its pane is refused") {
    ProbeLog log;
    ProbeFrame frame = frameOf(0);
    frame.panes[0] = {};
    CHECK_THROWS_AS(log.add(frame), std::logic_error);
    frame = frameOf(0);
    frame.probes[0].reset();
    CHECK_THROWS_AS(log.add(frame), std::logic_error);
    CHECK(log.frames().empty());
}

TEST_CASE("the CSV has a row for each sample, whose numbers read back exactly") {
    ProbeLog log;
    ProbeFrame frame = frameOf(7, 0.1 + 0.2);
    frame.panes[0] = {"svgf, \"wide\"", "filter=svgf"};
    frame.panes[2] = {"asvgf", "filter=asvgf"};
    frame.probes[3] = probeBetween({1, 2}, {4, 9}, {61, 37});
    frame.samples[3][2] = ProbeSample{}; // no surface
    frame.marks = {{"key off", true, {}}, {"fill, on", true, {}}};
    log.add(frame);

    const std::vector<std::string> lines = linesOf(log, false);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0] == "frame,event,probe,x,y,width,height,pane,name,pixels,lit,raw_lit,"
                      "raw_variance,variance,lambda,alpha,history,response");
    CHECK(lines[1].starts_with("7,\"key off; fill, on\",A,3,5,1,1,A,\"svgf, \"\"wide\"\"\",1,"));
    CHECK(lines[2] == "7,\"key off; fill, on\",D,1,2,4,8,C,asvgf,0,,,,,,,,");
    const std::vector<std::string> fields = fieldsOf(lines[1]);
    REQUIRE(fields.size() == fieldsOf(lines[0]).size());
    CHECK(fields[8] == "svgf, \"wide\"");
    double lit = 0.0;
    std::from_chars(fields[10].data(), fields[10].data() + fields[10].size(), lit);
    CHECK(lit == 0.1 + 0.2);
    CHECK(fields[10] == "0.30000000000000004");
    CHECK(fields[17].empty());
}

TEST_CASE("the CSV's response is that of the frame's own event, and empty where none is claimed") {
    // Two panes, of which the second shows the noise as it is; the light goes off in frame 20.
    ProbeLog log;
    double filtered = 1.0;
    for (std::uint32_t i = 0; i < 100; ++i) {
        const double light = i < 20 ? 1.0 : i < 60 ? 0.0 : 1.0;
        filtered += 0.5 * (light - filtered);
        ProbeFrame frame = frameOf(i);
        frame.panes[1] = {"none", "filter=none"};
        frame.probes[0] = probeBetween({0, 0}, {9, 9}, {61, 37});
        frame.samples[0][0] = ProbeSample{.pixels = 100, .lit = filtered, .rawLit = light};
        frame.samples[0][1] = ProbeSample{.pixels = 100, .lit = light, .rawLit = light};
        if (i == 20 || i == 60)
            frame.marks = {{i == 20 ? "key off" : "key on", true, {}}};
        log.add(frame);
    }
    const std::vector<std::string> lines = linesOf(log, false);
    REQUIRE(lines.size() == 201);
    for (int i = 0; i < 100; ++i) {
        const std::vector<std::string> slow = fieldsOf(lines[std::size_t(1 + 2 * i)]);
        const std::vector<std::string> quick = fieldsOf(lines[std::size_t(2 + 2 * i)]);
        CAPTURE(i);
        CHECK(slow[0] == std::to_string(i));
        CHECK(slow[1] == (i == 20 ? "key off" : i == 60 ? "key on" : ""));
        CHECK(quick[7] == "B");
        if (i < 20) {
            CHECK(slow[17].empty());
            CHECK(quick[17].empty());
        } else {
            CHECK(quick[17] == "1");
            const int since = i < 60 ? i - 20 : i - 60;
            // What is left of the first step when the second comes, 2^-40, is nothing to see here.
            CHECK(std::stod(slow[17]) ==
                  doctest::Approx(1.0 - std::pow(0.5, since + 1)).epsilon(1e-3));
        }
    }
    CHECK(linesOf(ProbeLog(), false).size() == 1);
}

TEST_CASE("the CSV begins with the run, the settings of each pane, what happened and the results") {
    ProbeLog log;
    double fast = 1.0, slow = 1.0;
    for (std::uint32_t i = 0; i < 55; ++i) {
        const double light = i < 20 ? 1.0 : 0.0;
        fast += 0.5 * (light - fast);
        slow += 0.001 * (light - slow);
        ProbeFrame frame = frameOf(i);
        frame.panes[0] = {"Fixed alpha 0.5", "filter=fixed alpha=0.5"};
        frame.panes[1] = {"Fixed alpha 0.001", "filter=fixed alpha=0.001"};
        if (i >= 47)
            frame.panes[1] = {"SVGF", "filter=svgf"};
        frame.probes[0] = probeBetween({0, 0}, {9, 9}, {61, 37});
        frame.samples[0][0] = ProbeSample{.pixels = 100, .lit = fast, .rawLit = light};
        frame.samples[0][1] = ProbeSample{.pixels = 100, .lit = slow, .rawLit = light};
        if (i == 20)
            frame.marks = {{"key off", true, {}}};
        log.add(frame);
    }
    const std::vector<std::string> expected{
        "# scene: cornell",
        "# seed: 7",
        "# size: 61x37",
        "# pane A from frame 0: Fixed alpha 0.5: filter=fixed alpha=0.5",
        "# pane B from frame 0: Fixed alpha 0.001: filter=fixed alpha=0.001",
        "# pane B from frame 47: SVGF: filter=svgf",
        "# event: frame 20, key off",
        "# event: frame 47, pane B: SVGF",
        "# result: probe A, pane A, Fixed alpha 0.5, frame 20, key off: t50 1, t90 3, "
        "1.0 ghost frames so far (live, 34)",
        "# result: probe A, pane B, Fixed alpha 0.001, frame 20, key off: t50 > 26, t90 > 26, "
        "> 26.6 ghost frames (cut short)"};
    const std::vector<std::string> facts = linesOf(log, true);
    REQUIRE(facts.size() == expected.size());
    for (std::size_t i = 0; i < facts.size(); ++i)
        CHECK(facts[i] == expected[i]);
}
