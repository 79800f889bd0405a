// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace afterglow {

/// A value that its bytes describe completely. It must have no padding between its members.
template <class T>
concept PlainValue =
    std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::ranges::range<T>;

/// FNV-1a of 128 bits (Fowler, Noll, Vo): a name for content. Content that differs by accident has
/// another name for all purposes; it is no defence against somebody who looks for a collision.
class Hash {
public:
    /// Adds bytes as they are: "ab" and then "c" is the same as "a" and then "bc".
    void add(std::span<const std::byte> bytes);
    void add(std::string_view bytes) { add(std::as_bytes(std::span(bytes))); }

    /// Adds the bytes of a value.
    template <PlainValue T>
    void add(const T& value) {
        add(std::as_bytes(std::span(&value, 1)));
    }

    /// Adds the number of values and then the values, so that one list does not run into the next.
    template <std::ranges::contiguous_range List>
    void addList(const List& list) {
        add(std::uint64_t(std::ranges::size(list)));
        add(std::as_bytes(std::span<const std::ranges::range_value_t<List>>(list)));
    }

    std::string hex() const; ///< 32 digits, small letters

private:
    // The offset basis of 128 bits.
    std::uint64_t high_ = 0x6c62272e07bb0142, low_ = 0x62b821756295c58d;
};

} // namespace afterglow
