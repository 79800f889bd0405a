#include "app/workbench/pass_timings.h"
#include "app/workbench/view_state.h"
#include "program.h"
#include "renderer/base/error.h"
#include "renderer/scene/procedural.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

ViewState cornellState() {
    return startState(makeProceduralScene("cornell"), Settings{});
}

void press(ViewState& state, KeyStroke stroke) {
    const auto command = commandFor(stroke);
    REQUIRE(command);
    perform(state, *command);
}
void press(ViewState& state, char key) {
    press(state, {keyOf(key)});
}

} // namespace

TEST_CASE("cycling through the filters comes back to the first, in both directions") {
    ViewState state = cornellState();
    const Filter first = state.settings.filter;
    for (const char* direction : {"forward", "backward"}) {
        CAPTURE(direction);
        std::set<Filter> seen;
        for (std::size_t i = 0; i < allFilters().size(); ++i) {
            seen.insert(state.settings.filter);
            press(state, {.key = keyOf('F'), .shift = direction[0] == 'b'});
        }
        CHECK(seen.size() == allFilters().size());
        CHECK(state.settings.filter == first);
    }
    CHECK_FALSE(state.resetWanted); // another filter is no reason to forget
}

TEST_CASE("number keys switch lights by slot, L the key light, and an empty slot does nothing") {
    ViewState state = cornellState();
    REQUIRE(state.lightNames == std::vector<std::string>{"key", "fill"});
    press(state, '2');
    CHECK(state.lights[0].on);
    CHECK_FALSE(state.lights[1].on);
    press(state, '2');
    CHECK(state.lights[1].on);
    press(state, 'L');
    CHECK_FALSE(state.lights[0].on);
    const auto before = state.lights;
    press(state, '9');
    CHECK(state.lights == before);

    std::swap(state.lightNames[0], state.lightNames[1]);
    press(state, 'L');
    CHECK_FALSE(state.lights[1].on);
}

TEST_CASE("the frame number rises by one with each rendered frame and with nothing else") {
    ViewState state = cornellState();
    for (std::uint32_t i = 0; i < 5; ++i) {
        CHECK(state.frame == i);
        REQUIRE(wantsFrame(state));
        passTime(state, 0.5);
        frameRendered(state, 0.5);
    }
    togglePause(state);
    CHECK_FALSE(wantsFrame(state));
    CHECK(state.frame == 5);
}

TEST_CASE("the first frame is rendered even if it was paused before") {
    ViewState state = cornellState();
    press(state, 'P');
    CHECK(wantsFrame(state));
    frameRendered(state, 0.1);
    CHECK_FALSE(wantsFrame(state));
}

TEST_CASE("two steps are two frames, and then it is paused") {
    ViewState state = cornellState();
    press(state, 'N');
    press(state, 'N');
    for (int i = 0; i < 2; ++i) {
        REQUIRE(wantsFrame(state));
        frameRendered(state, 0.1);
    }
    CHECK_FALSE(wantsFrame(state));
    CHECK(state.paused);
    press(state, {Key::Space});
    CHECK(wantsFrame(state));
}

TEST_CASE(
    "scene time goes on by a sixtieth of a second a frame, or like the clock, or not at all") {
    ViewState state = cornellState();
    for (int i = 0; i < 60; ++i)
        frameRendered(state, 0.25);
    CHECK(state.seconds == doctest::Approx(1.0));
    state.timeStep = TimeStep::WallClock;
    frameRendered(state, 0.05);
    CHECK(state.seconds == doctest::Approx(1.05));
    frameRendered(state, 30.0); // a stall
    CHECK(state.seconds == doctest::Approx(1.15));
    press(state, 'M');
    frameRendered(state, 0.05);
    CHECK(state.seconds == doctest::Approx(1.15));
}

TEST_CASE("every key of the overview that is pressed once means something, and no stroke means two "
          "things") {
    CHECK(keyHelp().size() > 20);
    CHECK(commandFor({Key::F12}) == Command{Action::SavePicture});
    CHECK(commandFor({.key = keyOf('S'), .control = true}) == Command{Action::SavePicture});
    CHECK_FALSE(commandFor({keyOf('S')})); // flies
    CHECK_FALSE(commandFor({.key = keyOf('F'), .control = true}));
    CHECK_FALSE(commandFor({Key::Unknown}));
    for (int slot = 0; slot < 9; ++slot)
        CHECK(commandFor({keyOf(char('1' + slot))}) == Command{Action::ToggleLight, slot});
    ViewState state = cornellState();
    press(state, {.key = keyOf('Q'), .control = true});
    CHECK(state.quit);
}

TEST_CASE(
    "going through the images shows all that the filter makes and no other, then the picture") {
    for (const Filter filter : allFilters()) {
        CAPTURE(nameOf(filter));
        ViewState state = cornellState();
        state.settings.filter = filter;
        std::size_t made = 0;
        for (const AovInfo& aov : aovs())
            made += isMadeBy(aov, filter, state.settings.denoiser);
        for (std::size_t i = 0; i < made; ++i) {
            cycleImage(state, 1);
            REQUIRE(state.image);
            CHECK(shownImage(state) == state.image);
        }
        cycleImage(state, 1);
        CHECK_FALSE(state.image);
        cycleImage(state, -1);
        CHECK(state.image);
    }
}

TEST_CASE(
    "an image that the filter does not make falls back to the picture and comes back with it") {
    ViewState state = cornellState();
    while (!state.image || state.displays[*state.image].name != "lambda")
        cycleImage(state, 1);
    chooseFilter(state, Filter::None);
    CHECK_FALSE(shownImage(state));
    chooseFilter(state, Filter::Asvgf);
    CHECK(shownImage(state));
}

TEST_CASE("every field can be set, keeps to its range, and goes back to its default") {
    Settings settings;
    for (const Field& field : fields()) {
        CAPTURE(field.key);
        CHECK(isDefault(settings, field));
        setFieldValue(settings, field, field.max + 1e6);
        CHECK(fieldValue(settings, field) == doctest::Approx(field.max));
        setFieldValue(settings, field, field.min - 1e6);
        CHECK(fieldValue(settings, field) == doctest::Approx(field.min));
        CHECK_FALSE((isDefault(settings, field) && field.min != fieldValue(Settings{}, field)));
        resetField(settings, field);
        CHECK(isDefault(settings, field));
    }
    ViewState state = cornellState();
    for (int i = 0; i < 100; ++i)
        press(state, ']');
    CHECK(double(state.settings.display.exposure) == doctest::Approx(8.0));
}

TEST_CASE("flying goes along the camera's axes, by speed times time, and diagonals are no faster") {
    const Camera start = lookAt({0, 1, 5}, {0, 1, 0});
    Camera camera = start;
    fly(camera, {.move = {0, 0, 1}}, 2.0f, 0.5);
    CHECK(glm::distance(camera.position, glm::vec3(0, 1, 4)) < 1e-5f);
    fly(camera, {.move = {1, 0, 0}, .fast = true}, 2.0f, 0.5);
    CHECK(glm::distance(camera.position, glm::vec3(kFastFactor, 1, 4)) < 1e-5f);
    camera = start;
    fly(camera, {.move = {1, 0, 1}}, 2.0f, 0.5);
    CHECK(glm::distance(camera.position, start.position) == doctest::Approx(1.0));
    fly(camera, {}, 2.0f, 0.5);
    CHECK(camera.orientation == start.orientation);
}

TEST_CASE("looking turns right and up, keeps the horizon level and never passes the zenith") {
    Camera camera = lookAt({0, 1, 5}, {0, 1, 0});
    fly(camera, {.look = {0.3f, 0.0f}}, 1.0f, 0.0);
    CHECK(camera.forward().x == doctest::Approx(std::sin(0.3f)));
    fly(camera, {.look = {0.0f, 0.2f}}, 1.0f, 0.0);
    CHECK(camera.forward().y == doctest::Approx(std::sin(0.2f)));
    for (int i = 0; i < 50; ++i) {
        fly(camera, {.look = {0.1f, 0.5f}}, 1.0f, 0.0);
        const glm::vec3 right = camera.orientation * glm::vec3(1, 0, 0);
        const glm::vec3 up = camera.orientation * glm::vec3(0, 1, 0);
        REQUIRE(std::abs(right.y) < 1e-4f);
        REQUIRE(up.y > 0.0f);
    }
    CHECK(camera.forward().y > 0.999f);
    CHECK(glm::length(camera.orientation) == doctest::Approx(1.0));
}

TEST_CASE("home is the scene's camera, wherever one flew") {
    ViewState state = cornellState();
    const Camera home = state.camera;
    fly(state.camera, {.move = {1, 1, 1}, .look = {1, 1}}, 3.0f, 1.0);
    REQUIRE(state.camera.position != home.position);
    press(state, {Key::Home});
    CHECK(state.camera.position == home.position);
    CHECK(state.camera.orientation == home.orientation);
}

TEST_CASE("an unknown camera is named together with the known ones") {
    const Scene scene = makeProceduralScene("cornell");
    CHECK_THROWS_AS(startState(scene, Settings{}, "nowhere"), UsageError);
    CHECK_NOTHROW(startState(scene, Settings{}, scene.cameras.front().name));
}

TEST_CASE("a fitted picture lies in the middle, inside, with its proportions to half a pixel") {
    for (const glm::ivec2 area : {glm::ivec2(1600, 900), {101, 77}, {1, 1}, {1, 900}, {333, 2}})
        for (const glm::ivec2 image :
             {glm::ivec2(640, 360), {61, 37}, {1, 1}, {1, 1000}, {16384, 1}}) {
            CAPTURE(area.x);
            CAPTURE(area.y);
            CAPTURE(image.x);
            CAPTURE(image.y);
            const Rect fitted = fitAspect({{7, 3}, area}, image);
            const glm::ivec2 before = fitted.min - glm::ivec2(7, 3);
            const glm::ivec2 after = area - before - fitted.size;
            CHECK(glm::all(glm::greaterThanEqual(before, glm::ivec2(0))));
            CHECK(glm::all(glm::lessThanEqual(glm::abs(after - before), glm::ivec2(1))));
            CHECK((before.x == 0 || before.y == 0));
            CHECK(glm::all(glm::greaterThan(fitted.size, glm::ivec2(0))));
            const double scale = std::min(double(area.x) / image.x, double(area.y) / image.y);
            CHECK(std::abs(fitted.size.x - std::max(scale * image.x, 1.0)) <= 0.5);
            CHECK(std::abs(fitted.size.y - std::max(scale * image.y, 1.0)) <= 0.5);
        }
    CHECK(fitAspect({{0, 0}, {0, 0}}, {4, 3}).empty());
    CHECK(fitAspect({{0, 0}, {8, 8}}, {0, 3}).empty());
}

TEST_CASE("the panel and the view fill the window without overlap, down to no window at all") {
    for (const glm::ivec2 window : {glm::ivec2(1600, 900), {558, 20}, {557, 20}, {1, 1}, {0, 0}})
        for (const bool shown : {true, false}) {
            const Layout layout = layoutOf(window, 372, shown);
            CHECK(layout.panel.size.x + layout.view.size.x == window.x);
            CHECK(layout.view.min.x == layout.panel.size.x);
            CHECK(layout.view.size.y == window.y);
            CHECK(layout.panel.empty() == (!shown || window.x < 558));
        }
}

TEST_CASE(
    "the render size follows the window or not, and is zero only when the window is minimized") {
    Resolution resolution{.followWindow = true, .scale = 0.5f};
    CHECK(renderSize(resolution, {101, 33}) == glm::ivec2(51, 17));
    CHECK(renderSize(resolution, {1, 1}) == glm::ivec2(1, 1));
    CHECK(renderSize(resolution, {0, 20}) == glm::ivec2(0));
    resolution.followWindow = false;
    CHECK(renderSize(resolution, {101, 33}) == resolution.fixed);
    CHECK(renderSize(resolution, {0, 0}) == glm::ivec2(0));
    CHECK(startResolution(false, {4000, 2000}).followWindow);
    CHECK_FALSE(startResolution(true, {1228, 900}).followWindow);
    CHECK(startResolution(true, {240, 160}).followWindow);
}

TEST_CASE("plus and minus go through the resolutions of one kind and stop at both ends") {
    for (const bool follows : {true, false}) {
        ViewState state = cornellState();
        state.resolution = {.followWindow = follows, .scale = 0.6f, .fixed = {700, 400}};
        std::size_t steps = 0;
        for (int i = 0; i < 20; ++i)
            press(state, '-');
        for (Resolution before;; ++steps) {
            before = state.resolution;
            press(state, '=');
            if (state.resolution == before)
                break;
            CHECK(renderSize(state.resolution, {800, 600}).x > renderSize(before, {800, 600}).x);
        }
        CHECK(state.resolution.followWindow == follows);
        CHECK(steps + 1 ==
              std::size_t(std::ranges::count_if(resolutions(), [&](const auto& choice) {
                  return choice.resolution.followWindow == follows;
              })));
    }
}

TEST_CASE(
    "timings forget the first frame, in which shaders are compiled, and passes that are gone") {
    PassTimings timings;
    const PassTimings::Row slow[] = {{"trace", 900.0}, {"filter", 500.0}};
    const PassTimings::Row usual[] = {{"trace", 10.0}, {"tone map", 1.0}};
    CHECK(timings.frame() == 0.0);
    timings.addPasses(slow);
    timings.addFrame(1400.0);
    for (int i = 0; i < 5; ++i) {
        timings.addPasses(usual);
        timings.addFrame(11.0);
    }
    REQUIRE(timings.passes().size() == 2);
    CHECK(timings.passes()[0].name == "trace");
    CHECK(timings.passes()[0].milliseconds == doctest::Approx(10.0));
    CHECK(timings.passes()[1].name == "tone map");
    CHECK(timings.passTotal() == doctest::Approx(11.0));
    CHECK(timings.frame() == doctest::Approx(11.0));
    for (std::size_t i = 0; i < 2 * PassTimings::kFrames; ++i)
        timings.addFrame(double(i));
    CHECK(timings.frames().size() == PassTimings::kFrames);
    CHECK(timings.frames().back() == float(2 * PassTimings::kFrames - 1));
}

TEST_CASE("a fitted range leaves out the outermost hundredth, and what is no number") {
    Image<glm::vec4> values({1000, 1});
    for (int i = 0; i < 1000; ++i)
        values({i, 0}) = glm::vec4(float(i) / 1000.0f, 0, 0, 0);
    values({0, 0}).x = std::numeric_limits<float>::quiet_NaN();
    values({999, 0}).x = std::numeric_limits<float>::infinity();
    values({998, 0}).x = 1e9f;
    const ImageDisplay fitted = fittedTo(values, {"depth", gpu::kMapScalar, 0.0f, 1.0f, "m"});
    CHECK(fitted.low == doctest::Approx(0.01).epsilon(0.2));
    CHECK(fitted.high == doctest::Approx(0.99).epsilon(0.01));
    const ImageDisplay both = fittedTo(values, {"gradient", gpu::kMapSigned, -9.0f, 9.0f, ""});
    CHECK(both.low == -both.high);
    const Image<glm::vec4> nothing({3, 3}, glm::vec4(std::numeric_limits<float>::quiet_NaN()));
    const ImageDisplay before{"depth", gpu::kMapScalar, 0.25f, 0.5f, "m"};
    CHECK(fittedTo(nothing, before) == before);
}

TEST_CASE("a picture never takes the name of a file that is there") {
    const TemporaryFolder folder;
    CHECK(freePicturePath(folder.path()).filename() == "afterglow-0001.png");
    std::ofstream(folder.path() / "afterglow-0001.png") << "mine";
    std::ofstream(folder.path() / "afterglow-0003.png") << "mine too";
    CHECK(freePicturePath(folder.path()).filename() == "afterglow-0002.png");
}
