// What pages of reports are made of: HTML that needs no other file, with pictures that are held against each
// other, and tables that are written as Markdown, too.
#pragma once

#include "recon/image.h"

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// The whole page: heading, `body` (HTML), and what its comparisons need.
std::string html_page(std::string_view title, const std::string& body);

/// HTML: says that the experiment was interrupted; empty where it was not.
std::string not_complete();

/// <img> of the image as PNG, times 2^exposure, in the page itself. `attributes` are as HTML has them.
std::string inline_image(const RgbImage& image, float exposure, std::string_view attributes);

/// A picture of a page, with what it is called and what is known of it.
struct PagePicture {
    std::string name;    ///< plain text
    std::string figures; ///< HTML
    RgbImage image;
};

/// HTML: the reference and the pictures as a whole, one against another (assets/compare.js), times 2^exposure, and
/// all of them small. They must be of one size; there must be one.
std::string comparison(const RgbImage& reference, const std::vector<PagePicture>& pictures, float exposure);

/// A table of a report. All text is plain.
struct ReportTable {
    struct Column {
        std::string name;
        bool is_number = false;   ///< stands on the right
        std::string meaning = {}; ///< empty: the name says it
    };
    struct Cell {
        std::string text;
        std::string strong = {}; ///< before the text
        std::string look = {}; ///< a class of the page's style: "ok", "worse", "fails", "undecided"; empty: as any
        std::string link = {}; ///< an anchor's name: leads there
    };
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; ///< a cell for each column; an empty one where there is nothing to say
};

std::string to_markdown(const ReportTable& table);
std::string to_html(const ReportTable& table);

} // namespace tessera
