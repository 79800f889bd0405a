// SPDX-License-Identifier: MIT
#pragma once

// Only the glTF importer's own files include this.

#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace afterglow {

/// The fault of a document, without the name of its file.
class GltfFault : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A value in a document that knows where it is. Everything it is asked for is checked: GltfFault,
/// "nodes[3].mesh is 7, but there are 2 meshes".
class GltfView {
public:
    GltfView(const nlohmann::json& value, std::string where)
        : value_(&value), where_(std::move(where)) {}

    const std::string& where() const { return where_; }
    const nlohmann::json& json() const { return *value_; }
    [[noreturn]] void fault(const std::string& cause) const {
        throw GltfFault(where_ + " " + cause);
    }

    bool has(const char* key) const;
    /// Returns a member that must be there.
    GltfView at(const char* key) const;
    /// Returns a member that must be an object, if it is there.
    std::optional<GltfView> object(const char* key) const;
    /// Returns the elements of a member that is an array; none if it is not there.
    std::vector<GltfView> array(const char* key) const;
    /// Does the same for elements that must be objects.
    std::vector<GltfView> objects(const char* key) const;

    std::string text() const;
    std::string text(const char* key, const std::string& otherwise) const;
    bool flag(const char* key, bool otherwise) const;
    double number(double low, double high) const;
    double number(const char* key, double otherwise, double low, double high) const;
    std::uint64_t whole(std::uint64_t low = 0, std::uint64_t high = kLargest) const;
    std::uint64_t whole(const char* key, std::uint64_t otherwise, std::uint64_t low = 0,
                        std::uint64_t high = kLargest) const;
    /// Returns an index into something of which there are `count`, called `things`.
    std::uint32_t index(std::size_t count, const char* things) const;
    std::optional<std::uint32_t> index(const char* key, std::size_t count,
                                       const char* things) const;
    /// Returns exactly `count` finite numbers in [low, high], if the member is there.
    std::optional<std::vector<double>> numbers(const char* key, std::size_t count,
                                               double low = -kLargestFloat,
                                               double high = kLargestFloat) const;

    static constexpr std::uint64_t kLargest = std::uint64_t(1) << 40; ///< safe to add and to double
    static constexpr double kLargestFloat = 3.4e38;

private:
    const nlohmann::json* value_;
    std::string where_;
};

} // namespace afterglow
