// SPDX-License-Identifier: MIT
#include "app/workbench/keymap.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace afterglow;

namespace {

/// As the overview calls them.
const std::map<std::string, Key> kNamedKeys{
    {"Space", Key::Space},         {"Esc", Key::Escape}, {"Tab", Key::Tab},
    {"Backspace", Key::Backspace}, {"Home", Key::Home},  {"\xe2\x86\x90", Key::Left},
    {"\xe2\x86\x92", Key::Right},  {"+", keyOf('=')}};

/// What is held or done with the mouse; no stroke means it.
const std::set<std::string_view> kHeld{"W A S D",    "Q, E",  "Shift",
                                       "Right drag", "Wheel", "Click, drag"};
constexpr std::string_view kFlyingKeys = "WASDQE";

Key keyNamed(const std::string& name, bool page) {
    if (page)
        return name == "up" ? Key::PageUp : Key::PageDown;
    if (const auto known = kNamedKeys.find(name); known != kNamedKeys.end())
        return known->second;
    if (name.size() > 1 && name[0] == 'F')
        return Key(int(Key::F1) + std::stoi(name.substr(1)) - 1);
    REQUIRE(name.size() == 1);
    return keyOf(name[0]);
}

std::vector<std::string> itemsOf(std::string_view keys) {
    std::vector<std::string> items{""};
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (keys.substr(i, 2) == ", ") {
            items.emplace_back();
            ++i;
        } else {
            items.back() += keys[i];
        }
    }
    return items;
}

/// The strokes that a row of the overview names: "Ctrl C, Ctrl E", "Ctrl Shift C, V", "1 - 9".
std::vector<KeyStroke> strokesIn(std::string_view keys) {
    std::vector<KeyStroke> strokes;
    bool control = false, shift = false, page = false; // what holds until others are named
    for (const std::string& item : itemsOf(keys)) {
        std::istringstream words(item);
        std::vector<std::string> names;
        std::set<std::string> held;
        for (std::string word; words >> word;)
            if (word == "Ctrl" || word == "Shift" || word == "Page")
                held.insert(word);
            else
                names.push_back(word);
        if (!held.empty()) {
            control = held.contains("Ctrl");
            shift = held.contains("Shift");
            page = held.contains("Page");
        }
        if (names == std::vector<std::string>{"1", "-", "9"})
            names = {"1", "2", "3", "4", "5", "6", "7", "8", "9"};
        for (const std::string& name : names)
            strokes.push_back({keyNamed(name, page), control, shift});
    }
    return strokes;
}

std::vector<KeyStroke> allStrokes() {
    std::vector<KeyStroke> all;
    for (int key = 0; key <= int(Key::F12); ++key)
        for (const bool control : {false, true})
            for (const bool shift : {false, true})
                all.push_back({Key(key), control, shift});
    return all;
}

std::vector<KeyRow> allRows() {
    std::vector<KeyRow> all;
    for (const KeyGroup& group : keyGroups())
        all.insert(all.end(), group.rows.begin(), group.rows.end());
    return all;
}

std::string textOf(KeyStroke stroke) {
    return std::string(stroke.control ? "Ctrl " : "") + (stroke.shift ? "Shift " : "") +
           std::to_string(int(stroke.key));
}

} // namespace

TEST_CASE("the overview names every stroke that means something, and none for two things") {
    std::map<std::string, std::string> named; // stroke to row
    for (const KeyRow& row : allRows()) {
        if (kHeld.contains(row.keys))
            continue;
        CAPTURE(row.keys);
        const auto strokes = strokesIn(row.keys);
        CHECK_FALSE(strokes.empty());
        for (const KeyStroke& stroke : strokes) {
            CAPTURE(textOf(stroke));
            CHECK(actionOf(stroke));
            const auto [other, isNew] = named.try_emplace(textOf(stroke), row.meaning);
            CHECK_MESSAGE(isNew, "it also means: ", other->second);
        }
    }
    for (const KeyStroke& stroke : allStrokes()) {
        const bool isPlus = stroke == KeyStroke{.key = keyOf('='), .shift = true};
        CAPTURE(textOf(stroke));
        CHECK((actionOf(stroke) != nullptr) == (named.contains(textOf(stroke)) || isPlus));
    }
    CHECK(actionOf({.key = keyOf('='), .shift = true}) == actionOf({keyOf('=')}));
}

TEST_CASE("there is a stroke for every action, and the nine digits speak of nine slots") {
    for (const KeyRow& row : allRows()) {
        CAPTURE(row.keys);
        CHECK(row.actions.empty() == kHeld.contains(row.keys));
        CHECK((row.actions.size() == 9) == row.keys.ends_with("1 - 9"));
        for (const Action& action : row.actions) {
            CHECK_FALSE(action.strokes.empty());
            for (const KeyStroke& stroke : action.strokes)
                CHECK(actionOf(stroke)->label == action.label);
        }
    }
}

TEST_CASE("a button says its keys as the overview does, before what it does") {
    CHECK(tipOf(*actionOf(shift('O'))) == "Shift O. Loops the last take again.");
    CHECK(tipOf(*actionOf({Key::F12})).starts_with("F12 or Ctrl S. "));
    CHECK(tipOf(*actionOf(plain('R'))) == "R or Home");
    CHECK(tipOf(*actionOf(plain('.'))).starts_with("Full stop. "));
    CHECK(tipOf(*actionOf({Key::Backspace})).starts_with("Backspace. "));
}

TEST_CASE("keys that fly mean nothing else, fast or slow") {
    for (const char key : kFlyingKeys)
        for (const bool shift : {false, true}) {
            CAPTURE(key);
            CHECK_FALSE(actionOf({.key = keyOf(key), .shift = shift}));
        }
}

TEST_CASE("a stroke with Control never means what it means without") {
    for (const KeyStroke& stroke : allStrokes()) {
        if (!stroke.control || !actionOf(stroke))
            continue;
        CAPTURE(textOf(stroke));
        for (const bool shift : {false, true})
            CHECK(actionOf(stroke) != actionOf({.key = stroke.key, .shift = shift}));
    }
}
