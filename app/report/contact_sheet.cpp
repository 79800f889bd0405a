// SPDX-License-Identifier: MIT
#include "app/report/contact_sheet.h"

#include "app/report/canvas.h"
#include "app/report/sheet_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace afterglow {

using namespace sheet;

namespace {

constexpr glm::u8vec3 kBlank{24, 27, 33};

constexpr TextStyle kTitle{.size = 30, .weight = Weight::Medium, .color = kBright};
constexpr TextStyle kSubtitle{.size = 18, .color = kFaint};
constexpr TextStyle kCaption{.size = 16, .color = kText};
constexpr TextStyle kName{.size = 20, .weight = Weight::Medium, .color = kText};
constexpr TextStyle kNote{.size = 16, .color = kFaint};
constexpr TextStyle kValue{.size = 16, .weight = Weight::Medium, .color = kText, .align = 1.0f};
constexpr TextStyle kFooter{.size = 14, .color = kFaint};

constexpr int kMargin = 32;
constexpr int kGap = 6;       ///< between pictures
constexpr int kEventGap = 22; ///< before the column of the event
constexpr int kCaptionHeight = 26;
constexpr int kPlotHeight = 320;
constexpr int kPlotGap = 36; ///< above each plot
constexpr int kNoteStep = 22;
constexpr int kNoteGap = 16; ///< at least, between a note and its value
constexpr int kWidestPicture = 320, kNarrowestPicture = 120;
constexpr int kLeastContent = 560; ///< narrower plots have no room for their labels

/// Averages whole blocks; blocks at the right and lower edge may be smaller.
Image<glm::u8vec4> reduced(const Image<glm::u8vec4>& picture, int factor) {
    const glm::ivec2 size = (picture.size() + factor - 1) / factor;
    Image<glm::u8vec4> result(size);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 first = glm::ivec2(x, y) * factor;
            const glm::ivec2 end = glm::min(first + factor, picture.size());
            glm::ivec4 sum(0);
            for (int v = first.y; v < end.y; ++v) {
                for (int u = first.x; u < end.x; ++u)
                    sum += glm::ivec4(picture({u, v}));
            }
            const int count = (end.x - first.x) * (end.y - first.y);
            result({x, y}) = glm::u8vec4((sum + count / 2) / count);
        }
    }
    return result;
}

Image<glm::u8vec4> enlarged(const Image<glm::u8vec4>& picture, int factor) {
    Image<glm::u8vec4> result(picture.size() * factor);
    for (int y = 0; y < result.size().y; ++y) {
        for (int x = 0; x < result.size().x; ++x)
            result({x, y}) = picture({x / factor, y / factor});
    }
    return result;
}

Image<glm::u8vec4> shown(const Image<glm::u8vec4>& picture) {
    const int width = picture.size().x;
    if (width > kWidestPicture)
        return reduced(picture, (width + kWidestPicture - 1) / kWidestPicture);
    if (width < kNarrowestPicture)
        return enlarged(picture, (kNarrowestPicture + width - 1) / width);
    return picture;
}

int ceilWidth(std::string_view text, const TextStyle& style) {
    return int(std::ceil(style.width(text)));
}

/// The size of the sheet's pictures as given; (0, 0) if there is none.
glm::ivec2 pictureSize(const ContactSheet& sheet) {
    glm::ivec2 size(0);
    for (const SheetRow& row : sheet.rows) {
        if (row.pictures.size() > sheet.columns.size())
            throw std::logic_error("a row of a contact sheet has more pictures than columns");
        for (const auto& picture : row.pictures) {
            if (picture.pixels().empty())
                continue;
            if (size != glm::ivec2(0) && picture.size() != size)
                throw std::logic_error("the pictures of a contact sheet must have one size");
            size = picture.size();
        }
    }
    return size;
}

/// Where everything is, in pixels.
struct Layout {
    glm::ivec2 picture{0}; ///< as shown
    int left = 0;          ///< of the first picture, and of the plots' axes
    int content = 0;       ///< the width from there to the right margin
    int top = 0;           ///< of the first row
    int rowStep = 0;
    glm::ivec2 size{0};
    std::optional<std::size_t> eventColumn;

    int columnX(std::size_t column) const {
        const bool afterEvent = eventColumn && *eventColumn > 0 && column >= *eventColumn;
        return left + int(column) * (picture.x + kGap) + (afterEvent ? kEventGap - kGap : 0);
    }
};

Layout layoutOf(const ContactSheet& sheet) {
    Layout l;
    l.eventColumn = sheet.eventColumn;
    if (const glm::ivec2 size = pictureSize(sheet); size != glm::ivec2(0))
        l.picture = shown(Image<glm::u8vec4>(size)).size();

    int gutter = 90;
    std::size_t mostNotes = 0;
    for (const SheetRow& row : sheet.rows) {
        gutter = std::max(gutter, ceilWidth(row.name, kName) + 40);
        for (const auto& [note, value] : row.notes)
            gutter =
                std::max(gutter, ceilWidth(note, kNote) + kNoteGap + ceilWidth(value, kValue) + 40);
        mostNotes = std::max(mostNotes, row.notes.size());
    }
    l.left = kMargin + gutter;
    const int columns = int(sheet.columns.size());
    const int pictures =
        columns == 0 ? 0 : l.columnX(std::size_t(columns - 1)) + l.picture.x - l.left;
    const int texts =
        std::max({ceilWidth(sheet.title, kTitle), ceilWidth(sheet.subtitle, kSubtitle),
                  ceilWidth(sheet.footer, kFooter)}) -
        gutter;
    l.content = std::max({pictures, texts, kLeastContent});

    l.top = kMargin + 24 + (sheet.subtitle.empty() ? 0 : 30) + 20 + kCaptionHeight;
    l.rowStep = std::max(l.picture.y, 36 + kNoteStep * int(mostNotes)) + kGap;
    int bottom = l.top + l.rowStep * int(sheet.rows.size());
    bottom += (kPlotGap + kPlotHeight) * int(sheet.plots.size());
    bottom += sheet.footer.empty() ? 0 : 34;
    l.size = {l.left + l.content + kMargin, bottom + kMargin - kGap};
    return l;
}

void drawHeading(Canvas& canvas, const ContactSheet& sheet, const Layout& l) {
    canvas.text({kMargin, kMargin + 22}, sheet.title, kTitle);
    canvas.text({kMargin, kMargin + 52}, sheet.subtitle, kSubtitle);
    for (std::size_t i = 0; i < sheet.columns.size(); ++i) {
        canvas.text({l.columnX(i), l.top - 10}, sheet.columns[i],
                    l.eventColumn == i ? kCaption.colored(kEventColor) : kCaption);
    }
}

void drawRow(Canvas& canvas, const SheetRow& row, const ContactSheet& sheet, const Layout& l,
             int y) {
    const int height = l.rowStep - kGap;
    canvas.fill({kMargin, y}, {3, height}, row.color);
    canvas.text({kMargin + 16, y + 18}, row.name, kName.colored(row.color));
    int baseline = y + 46;
    for (const auto& [note, value] : row.notes) {
        canvas.text({kMargin + 16, baseline}, note, kNote);
        canvas.text({l.left - 24, baseline}, value, kValue);
        baseline += kNoteStep;
    }
    for (std::size_t i = 0; i < sheet.columns.size(); ++i) {
        const glm::ivec2 corner(l.columnX(i), y);
        if (i < row.pictures.size() && !row.pictures[i].pixels().empty())
            canvas.place(corner, shown(row.pictures[i]));
        else
            canvas.fill(corner, l.picture, kBlank);
    }
}

} // namespace

glm::u8vec3 sheetColor(std::size_t variant) {
    // Orange, sky blue, bluish green, yellow and reddish purple of Okabe and Ito's set ("Color
    // universal design", 2008), made lighter for a dark ground.
    constexpr std::array<glm::u8vec3, 5> colors = {
        {{245, 166, 60}, {104, 184, 246}, {61, 211, 154}, {240, 228, 96}, {226, 148, 196}}};
    return colors[variant % colors.size()];
}

Image<glm::u8vec4> drawContactSheet(const ContactSheet& sheet) {
    const Layout l = layoutOf(sheet);
    Canvas canvas(l.size, kGround);
    drawHeading(canvas, sheet, l);
    int y = l.top;
    for (const SheetRow& row : sheet.rows) {
        drawRow(canvas, row, sheet, l, y);
        y += l.rowStep;
    }
    if (l.eventColumn && *l.eventColumn > 0 && *l.eventColumn < sheet.columns.size()) {
        const float x = float(l.columnX(*l.eventColumn)) - kEventGap / 2.0f;
        canvas.line({x, l.top - kCaptionHeight + 8}, {x, y - kGap - 1}, 1.5f, kEventColor, 0.8f);
    }
    y -= kGap;
    for (const SheetPlot& plot : sheet.plots) {
        drawPlot(canvas, plot, {l.left, y + kPlotGap}, {l.content, kPlotHeight});
        y += kPlotGap + kPlotHeight;
    }
    if (!sheet.footer.empty())
        canvas.text({kMargin, y + 34}, sheet.footer, kFooter);
    return canvas.image();
}

} // namespace afterglow
