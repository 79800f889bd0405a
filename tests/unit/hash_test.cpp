// SPDX-License-Identifier: MIT
#include "renderer/base/hash.h"

#include <doctest/doctest.h>

#include <set>
#include <vector>

using namespace afterglow;

namespace {

template <class... Values>
std::string hashOf(const Values&... values) {
    Hash hash;
    (hash.add(values), ...);
    return hash.hex();
}

} // namespace

TEST_CASE("the hash is FNV-1a of 128 bits") {
    // Landon Curt Noll's test vectors.
    CHECK(hashOf(std::string_view("")) == "6c62272e07bb014262b821756295c58d");
    CHECK(hashOf(std::string_view("a")) == "d228cb696f1a8caf78912b704e4a8964");
    CHECK(hashOf(std::string_view("foobar")) == "343e1662793c64bf6f0d3597ba446f18");
}

TEST_CASE("texts are bytes that follow each other, lists are apart") {
    CHECK(hashOf("ab", "c") == hashOf("a", std::string("bc")));
    const auto lists = [](const std::vector<int>& a, const std::vector<int>& b) {
        Hash hash;
        hash.addList(a);
        hash.addList(b);
        return hash.hex();
    };
    CHECK(lists({1, 2}, {3}) != lists({1}, {2, 3}));
    CHECK(lists({}, {1}) != lists({1}, {}));
}

TEST_CASE("every byte and its place count") {
    std::set<std::string> seen;
    for (std::size_t place = 0; place < 64; ++place)
        for (int value = 0; value < 256; ++value) {
            std::string text(64, '\0');
            text[place] = char(value);
            seen.insert(hashOf(text));
        }
    CHECK(seen.size() == 64 * 255 + 1); // all zero is one text
}
