#include "app/report/page.h"

#include "app/cli/terminal.h"
#include "embedded/compare_script.h"
#include "render/io/plain_images.h"
#include "ui/charts/chart.h"

#include <cstddef>

#include <fmt/core.h>

namespace tessera {

namespace {

/// Encodes bytes in base 64 [RFC 4648, 4].
std::string base64(const std::vector<char>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            group = group << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

constexpr const char* style = R"(
body { font: 15px/1.45 Inter, "DejaVu Sans", Helvetica, Arial, sans-serif; color: #222; max-width: 1120px;
       margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.25em; margin-top: 2.2em; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; margin: 1em 0; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2em 0.7em; border-bottom: 1px solid #e4e4e4; text-align: right;
         white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } th { font-weight: 600; }
.note { color: #666; max-width: 52em; } svg { max-width: 100%; height: auto; }
.crops { display: flex; flex-wrap: wrap; gap: 10px; } figure { margin: 0; }
figcaption { font-size: 12px; color: #444; } .crops img { image-rendering: pixelated; display: block; }
.compare figure { display: inline-block; width: 104px; margin: 6px 4px 0 0; vertical-align: top; cursor: pointer; }
.compare figure img { width: 100%; height: auto; display: block; } .compare figure.on { outline: 2px solid #008c74; }
.compare canvas { max-width: 100%; display: block; background: #000; cursor: crosshair; }
.compare output { font: 12px monospace; color: #444; white-space: pre; display: block; overflow: hidden; }
.compare button { margin-right: 2px; } .compare button.on { background: #008c74; color: #fff; }
th.words, td.words { text-align: left; } td.long { white-space: normal; min-width: 22em; }
td.ok { background: #e2f3ea; } td.worse { background: #ffe6c2; } td.fails { background: #ffcfc9; }
td.undecided { background: #e8e8f4; } .wide { overflow-x: auto; font-size: 13px; }
code { background: #f4f4f4; padding: 0 0.2em; }
)";

} // namespace

std::string html_page(std::string_view title, const std::string& body) {
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                       "<title>Tessera: {0}</title><style>{1}</style></head><body>\n"
                       "<h1>{0}</h1>\n{2}<script>\n{3}</script></body></html>\n",
                       escaped(title), style, body, compare_script);
}

std::string interruption_note() {
    return interrupted() ? "<p><b>Not complete: the experiment was interrupted.</b> Run the same command again to "
                           "continue.</p>\n"
                         : "";
}

std::string inline_image(const RgbImage& image, float exposure, std::string_view attributes) {
    return fmt::format(R"(<img width="{}" height="{}" {} src="data:image/png;base64,{}">)", image.width(),
                       image.height(), attributes, base64(encode_png(image, exposure)));
}

namespace {

/// Returns a thumbnail of the strip below the canvas. The canvas takes its pixels from these images.
std::string small_picture(const RgbImage& image, float exposure, const std::string& name,
                          const std::string& figures) {
    return fmt::format("<figure>{}<figcaption><b>{}</b><br>{}</figcaption></figure>\n",
                       inline_image(image, exposure, fmt::format("alt=\"{}\"", escaped(name))), escaped(name),
                       figures);
}

std::string list_option(std::size_t index, const std::string& name, bool is_chosen) {
    return fmt::format("<option value=\"{}\"{}>{}</option>", index, is_chosen ? " selected" : "", escaped(name));
}

} // namespace

std::string comparison(const RgbImage& reference, const std::vector<PagePicture>& pictures, float exposure) {
    std::string small = small_picture(reference, exposure, "reference", ""),
                first = list_option(0, "reference", false), second = list_option(0, "reference", true);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const auto& [name, figures, image] = pictures[i];
        small += small_picture(image, exposure, name, figures);
        first += list_option(i + 1, name, i + 1 == pictures.size());
        second += list_option(i + 1, name, false);
    }
    return fmt::format(
        "<div class=\"compare\" data-exposure=\"{}\">\n"
        "<p><select>{}</select> against <select>{}</select> <button value=\"first\">first</button>"
        "<button value=\"second\">second</button><button value=\"wipe\" class=\"on\">wipe</button>"
        "<button value=\"flicker\">flicker</button><button value=\"difference\">difference</button>"
        " <label>times 2^<input type=\"range\" min=\"0\" max=\"8\" value=\"2\"></label></p>\n"
        "<canvas></canvas><output>Wheel: zoom. Values are radiances, with the 8-bit precision of the "
        "page. Point at a small picture to show it; click to compare it.</output>\n"
        "<div class=\"pictures\">{}</div></div>\n",
        exposure, first, second, small);
}

std::string to_markdown(const ReportTable& table) {
    std::string text = "|", rule = "|";
    for (const ReportTable::Column& column : table.columns) {
        text += fmt::format(" {} |", column.name);
        rule += column.is_number ? " ---: |" : " --- |";
    }
    text += "\n" + rule + "\n";
    for (const std::vector<ReportTable::Cell>& row : table.rows) {
        text += "|";
        for (const ReportTable::Cell& cell : row) {
            const std::string words = (cell.strong.empty() ? "" : fmt::format("**{}**", cell.strong)) + cell.text;
            if (words.empty())
                text += " |";
            else
                text += cell.link.empty() ? fmt::format(" {} |", words)
                                          : fmt::format(" [{}](#{}) |", words, cell.link);
        }
        text += "\n";
    }
    return text;
}

namespace {

std::string html_cell(const ReportTable::Column& column, const ReportTable::Cell& cell) {
    std::string words = escaped(cell.text);
    if (!cell.strong.empty())
        words = fmt::format("<b>{}</b>{}", escaped(cell.strong), words);
    if (!cell.link.empty())
        words = fmt::format("<a href=\"#{}\">{}</a>", escaped(cell.link), words);
    const bool is_long = cell.text.size() > 30; // wraps lines
    return fmt::format("<td class=\"{}{}{}\">{}</td>", column.is_number ? "" : "words ", is_long ? "long " : "",
                       cell.look, words);
}

} // namespace

std::string to_html(const ReportTable& table) {
    std::string html = "<div class=\"wide\"><table><tr>";
    for (const ReportTable::Column& column : table.columns)
        html += fmt::format("<th class=\"{}\" title=\"{}\">{}</th>", column.is_number ? "" : "words",
                            escaped(column.meaning), escaped(column.name));
    for (const std::vector<ReportTable::Cell>& row : table.rows) {
        html += "</tr>\n<tr>";
        for (std::size_t i = 0; i < row.size(); ++i)
            html += html_cell(table.columns[i], row[i]);
    }
    return html + "</tr></table></div>\n";
}

} // namespace tessera
