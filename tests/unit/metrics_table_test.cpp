// SPDX-License-Identifier: MIT
#include "app/measure/metrics_table.h"
#include "renderer/base/error.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

std::string refusal(std::string_view text) {
    try {
        MetricsTable::parse(text, "metrics.csv");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

TEST_CASE("a table that is read says what the one that was written said, to the last digit") {
    MetricsTable table;
    table.add("svgf", 3, "rmse", 1.0 / 3.0);
    table.add("svgf", 0, "rmse", 1e-30);
    table.add("fixed", 1, "relmse", std::numeric_limits<double>::infinity());
    table.add("fixed", 1, "psnr", std::nan(""));
    const std::string text = table.csv({"fixed", "svgf"});
    CHECK(text == "variant,frame,metric,value\nfixed,1,relmse,inf\nfixed,1,psnr,nan\n"
                  "svgf,0,rmse,1e-30\nsvgf,3,rmse,0.333333333\n");
    const MetricsTable back = MetricsTable::parse(text, "metrics.csv");
    CHECK(back.csv({"fixed", "svgf"}) == text);
    const auto curve = back.curve("svgf", "rmse", 5);
    REQUIRE(curve.size() == 5);
    CHECK(*curve[0] == 1e-30);
    CHECK_FALSE(curve[1]);
    CHECK(*curve[3] == *table.curve("svgf", "rmse", 5)[3]);
    CHECK(std::isinf(*back.curve("fixed", "relmse", 2)[1]));
    CHECK(back.curve("svgf", "rmse", 2).size() == 2);
}

TEST_CASE("tables of other frames come together in the order of variants and frames") {
    MetricsTable late, early;
    late.add("a", 4, "rmse", 4.0);
    early.add("a", 1, "rmse", 1.0);
    early.add("a", 1, "flip", 2.0);
    late.append(early);
    CHECK(late.csv({"a"}) == "variant,frame,metric,value\na,1,rmse,1\na,1,flip,2\na,4,rmse,4\n");
}

TEST_CASE("what is no row of a table is refused by its line") {
    const std::string head = "variant,frame,metric,value\n";
    CHECK(refusal("variant,frame\n") ==
          "metrics.csv:1: not a row of \"variant,frame,metric,value\"");
    for (const char* row : {"a,1,rmse", "a,1,rmse,", "a,x,rmse,1", "a,-1,rmse,1", ",1,rmse,1",
                            "a,1,,1", "a,1,rmse,1,2", "a,1,rmse,1x", "a,1.5,rmse,1"}) {
        CAPTURE(row);
        CHECK(refusal(head + "a,0,rmse,1\n" + row + "\n") ==
              "metrics.csv:3: not a row of \"variant,frame,metric,value\"");
    }
    CHECK(refusal(head) == "accepted");
}
