// Parts of report pages: self-contained HTML, comparisons of pictures, and tables for HTML and Markdown.
#pragma once

#include "recon/image.h"

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// Returns a page with a heading, `body` (HTML), and the style and script that comparisons need.
std::string html_page(std::string_view title, const std::string& body);

/// Returns HTML that states that the experiment was interrupted; empty if it was not.
std::string interruption_note();

/// Returns an <img> with the image times 2^exposure as embedded PNG. `attributes` are HTML attributes.
std::string inline_image(const RgbImage& image, float exposure, std::string_view attributes);

/// A picture of a page, with its label and figures.
struct PagePicture {
    std::string name;    ///< plain text
    std::string figures; ///< HTML
    RgbImage image;
};

/// Returns HTML that compares the reference and the pictures with each other (assets/compare.js), times
/// 2^exposure, with thumbnails. All must have one size, and there must be at least one picture.
std::string comparison(const RgbImage& reference, const std::vector<PagePicture>& pictures, float exposure);

/// A table of a report, in plain text.
struct ReportTable {
    struct Column {
        std::string name;
        bool is_number = false;   ///< aligned right
        std::string meaning = {}; ///< explanation; empty: the name suffices
    };
    struct Cell {
        std::string text;
        std::string strong = {}; ///< bold text before `text`
        std::string look = {};   ///< class of the page's style: "ok", "worse", "fails", "undecided"; empty: none
        std::string link = {};   ///< name of the anchor to link to
    };
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; ///< a cell for each column; may be empty
};

std::string to_markdown(const ReportTable& table);
std::string to_html(const ReportTable& table);

} // namespace tessera
