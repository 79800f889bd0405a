// SPDX-License-Identifier: MIT
#include "app/workbench/frame_images.h"

#include <limits>
#include <set>

#include <doctest/doctest.h>

using namespace afterglow;

TEST_CASE("a fitted range leaves out the outermost hundredth, and what is no number") {
    Image<glm::vec4> values({1000, 1});
    for (int i = 0; i < 1000; ++i)
        values({i, 0}) = glm::vec4(float(i) / 1000.0f, 0, 0, 0);
    values({0, 0}).x = std::numeric_limits<float>::quiet_NaN();
    values({999, 0}).x = std::numeric_limits<float>::infinity();
    values({998, 0}).x = 1e9f;
    const ImageDisplay fitted = fittedTo(values, linear(0.0f, 1.0f, "m"));
    CHECK(fitted.low == doctest::Approx(0.01).epsilon(0.2));
    CHECK(fitted.high == doctest::Approx(0.99).epsilon(0.01));
    const ImageDisplay both = fittedTo(values, aroundZero(9.0f));
    CHECK(both.low == -both.high);
    const Image<glm::vec4> nothing({3, 3}, glm::vec4(std::numeric_limits<float>::quiet_NaN()));
    const ImageDisplay before = linear(0.25f, 0.5f, "m");
    CHECK(fittedTo(nothing, before) == before);
}

TEST_CASE("every image to look at is a row with all that lists, menus and legends are made from") {
    std::set<std::string_view> names;
    std::set<ImageGroup> ended;
    for (std::size_t i = 0; i < images().size(); ++i) {
        const AovInfo& image = images()[i];
        CAPTURE(image.name);
        CHECK(names.insert(image.name).second);
        CHECK_FALSE(image.meaning.empty());
        CHECK(image.channels.size() >= 1);
        CHECK(image.channels.size() <= 4);
        CHECK(image.display.low < image.display.high);
        CHECK((image.display.map != gpu::kMapLogarithm || image.display.low > 0.0f));
        CHECK((image.display.map != gpu::kMapSigned || image.display.low == -image.display.high));
        CHECK((image.group == ImageGroup::Truth) == isTruth(i));
        // A menu has each heading once.
        if (i > 0 && image.group != images()[i - 1].group)
            CHECK(ended.insert(images()[i - 1].group).second);
        CHECK_FALSE(ended.contains(image.group));
        CHECK_FALSE(titleOf(image.group).empty());
    }
    CHECK(&aovByName("color") == &aovs().front());
    // Ranges in extents of the scene grow with it, and no other.
    const auto small = imageDisplays(1.0f), large = imageDisplays(10.0f);
    for (std::size_t i = 0; i < images().size(); ++i) {
        const float factor = images()[i].display.perExtent ? 10.0f : 1.0f;
        CHECK(large[i].high == doctest::Approx(factor * small[i].high));
    }
}
