#include "app/report/page.h"

#include "app/base/embedded.h"

#include <stdexcept>

namespace afterglow {

namespace {

std::string htmlText(std::string_view text) {
    std::string escaped;
    for (char c : text) {
        switch (c) {
        case '&': escaped += "&amp;"; break;
        case '<': escaped += "&lt;"; break;
        case '>': escaped += "&gt;"; break;
        case '"': escaped += "&quot;"; break;
        default: escaped += c;
        }
    }
    return escaped;
}

/// JSON that cannot end the element it stands in, or open a comment there: "<" occurs in strings
/// alone, where an escape says the same.
std::string scriptJson(const nlohmann::ordered_json& data) {
    const std::string json =
        data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::string escaped;
    escaped.reserve(json.size());
    for (char c : json) {
        if (c == '<')
            escaped += "\\u003c";
        else
            escaped += c;
    }
    return escaped;
}

/// The files of assets/report with this ending, one after the other.
std::string assets(std::string_view ending) {
    std::string bytes;
    for (const EmbeddedFile& file : embeddedReport())
        if (file.name.ends_with(ending))
            bytes += file.bytes;
    return bytes;
}

} // namespace

std::string reportPage(std::string_view title, const nlohmann::ordered_json& data,
                       const PictureStore& pictures) {
    const auto part = [&](std::string_view name) -> std::string {
        if (name == "title")
            return htmlText(title);
        if (name == "style")
            return assets(".css");
        if (name == "script")
            return assets(".js");
        if (name == "data")
            return scriptJson(data);
        if (name == "pictures")
            return pictures.html();
        throw std::logic_error("report.html: no part is named " + std::string(name));
    };

    std::string page;
    const std::string html = assets(".html");
    std::string_view rest = html;
    for (auto open = rest.find("{{"); open != rest.npos; open = rest.find("{{")) {
        const auto close = rest.find("}}", open);
        if (close == rest.npos)
            throw std::logic_error("report.html: {{ without }}");
        page += rest.substr(0, open);
        page += part(rest.substr(open + 2, close - open - 2));
        rest.remove_prefix(close + 2);
    }
    page += rest;
    return page;
}

} // namespace afterglow
