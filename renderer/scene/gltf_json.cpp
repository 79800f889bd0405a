// SPDX-License-Identifier: MIT
#include "renderer/scene/gltf_json.h"

#include "renderer/scene/gltf_container.h"

#include <sstream>

#include <nlohmann/json.hpp>

namespace afterglow {

namespace {

std::string plain(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

std::string shown(const nlohmann::json& value) {
    if (value.is_number()) {
        return plain(value.get<double>());
    }
    if (value.is_string()) {
        std::string quoted(1, '"');
        quoted += forMessage(value.get_ref<const std::string&>());
        return quoted += '"';
    }
    return value.type_name();
}

} // namespace

bool GltfView::has(const char* key) const {
    return value_->contains(key);
}

GltfView GltfView::at(const char* key) const {
    const auto found = value_->find(key);
    if (found == value_->end()) {
        fault(std::string("has no \"") + key + "\"");
    }
    return {*found, where_.empty() ? key : where_ + "." + key};
}

std::optional<GltfView> GltfView::object(const char* key) const {
    if (!has(key)) {
        return std::nullopt;
    }
    GltfView member = at(key);
    if (!member.value_->is_object()) {
        member.fault("must be an object, found " + shown(*member.value_));
    }
    return member;
}

std::vector<GltfView> GltfView::array(const char* key) const {
    std::vector<GltfView> elements;
    if (!has(key)) {
        return elements;
    }
    const GltfView member = at(key);
    if (!member.value_->is_array()) {
        member.fault("must be an array, found " + shown(*member.value_));
    }
    elements.reserve(member.value_->size());
    for (std::size_t i = 0; i < member.value_->size(); ++i) {
        elements.emplace_back((*member.value_)[i], member.where_ + "[" + std::to_string(i) + "]");
    }
    return elements;
}

std::vector<GltfView> GltfView::objects(const char* key) const {
    std::vector<GltfView> elements = array(key);
    for (const GltfView& element : elements) {
        if (!element.value_->is_object()) {
            element.fault("must be an object, found " + shown(*element.value_));
        }
    }
    return elements;
}

std::string GltfView::text() const {
    if (!value_->is_string()) {
        fault("must be text, found " + shown(*value_));
    }
    return value_->get<std::string>();
}

std::string GltfView::text(const char* key, const std::string& otherwise) const {
    return has(key) ? at(key).text() : otherwise;
}

bool GltfView::flag(const char* key, bool otherwise) const {
    if (!has(key)) {
        return otherwise;
    }
    const GltfView member = at(key);
    if (!member.value_->is_boolean()) {
        member.fault("must be true or false, found " + shown(*member.value_));
    }
    return member.value_->get<bool>();
}

double GltfView::number(double low, double high) const {
    if (!value_->is_number()) {
        fault("must be a number, found " + shown(*value_));
    }
    const double value = value_->get<double>();
    if (!(value >= low && value <= high)) {
        fault("is " + plain(value) + ", which is not in [" + plain(low) + ", " + plain(high) + "]");
    }
    return value;
}

double GltfView::number(const char* key, double otherwise, double low, double high) const {
    return has(key) ? at(key).number(low, high) : otherwise;
}

std::uint64_t GltfView::whole(std::uint64_t low, std::uint64_t high) const {
    // Some exporters write 12.0 for 12. Up to 2^53 a double holds every whole number.
    const double value = value_->is_number() ? value_->get<double>() : -1.0;
    if (value != std::floor(value) || value < double(low) || value > double(high)) {
        fault("must be a whole number" +
              (high == kLargest
                   ? " >= " + std::to_string(low)
                   : " in [" + std::to_string(low) + ", " + std::to_string(high) + "]") +
              ", found " + shown(*value_));
    }
    return std::uint64_t(value);
}

std::uint64_t GltfView::whole(const char* key, std::uint64_t otherwise, std::uint64_t low,
                              std::uint64_t high) const {
    return has(key) ? at(key).whole(low, high) : otherwise;
}

std::uint32_t GltfView::index(std::size_t count, const char* things) const {
    const std::uint64_t value = whole();
    if (value >= count) {
        fault("is " + std::to_string(value) + ", but there are " + std::to_string(count) + " " +
              things);
    }
    return std::uint32_t(value);
}

std::optional<std::uint32_t> GltfView::index(const char* key, std::size_t count,
                                             const char* things) const {
    if (!has(key)) {
        return std::nullopt;
    }
    return at(key).index(count, things);
}

std::optional<std::vector<double>> GltfView::numbers(const char* key, std::size_t count, double low,
                                                     double high) const {
    if (!has(key)) {
        return std::nullopt;
    }
    const std::vector<GltfView> elements = array(key);
    if (elements.size() != count) {
        at(key).fault("must be " + std::to_string(count) + " numbers, found " +
                      std::to_string(elements.size()));
    }
    std::vector<double> values;
    for (const GltfView& element : elements) {
        values.push_back(element.number(low, high));
    }
    return values;
}

} // namespace afterglow
