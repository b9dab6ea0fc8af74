#include "render/load/xml_document.h"

#include "render/io/text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace tessera {

namespace {

constexpr const char* white_space = " \t\r\n";

/// Returns the offset of an attribute's value, given the offset of the element's name; npos if not found.
/// pugixml keeps offsets of elements only, and a message should point at the value.
std::size_t value_offset(const std::string& text, std::size_t element, std::string_view wanted) {
    std::size_t at = text.find_first_of(" \t\r\n/>", element);
    while (at != std::string::npos) {
        const std::size_t begin = text.find_first_not_of(white_space, at);
        const std::size_t equals = text.find_first_of("=>", begin);
        if (equals == std::string::npos || text[equals] == '>')
            break;
        const std::size_t open = text.find_first_of("\"'", equals);
        const std::size_t close = open == std::string::npos ? open : text.find(text[open], open + 1);
        if (close == std::string::npos)
            break;
        const std::size_t name_end = std::min(text.find_first_of(" \t\r\n=", begin), equals);
        if (std::string_view(text).substr(begin, name_end - begin) == wanted)
            return open + 1;
        at = close + 1;
    }
    return std::string::npos;
}

} // namespace

XmlDocument::XmlDocument(std::string text, std::string name, std::optional<std::filesystem::path> folder)
    : name_(std::move(name)), folder_(std::move(folder)) {
    take_text(std::move(text));
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n')
            line_starts_.push_back(i + 1);
    const auto result = tree_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (result) {
        version_ = root().attribute("version");
        return;
    }
    // For an unexpected end, pugixml's offset is one past the last character. The last line is shown then.
    const std::size_t last = text_.empty() ? 0 : text_.find_last_not_of(white_space);
    const std::size_t offset =
        std::min<std::size_t>(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)),
                              last == std::string::npos ? 0 : last);
    const FilePosition where = position(offset);
    throw LoadError(where, std::string("the XML is broken: ") + result.description(), source_line(where.line));
}

void XmlDocument::take_text(std::string bytes) {
    try {
        Utf8Text utf8 = to_utf8(std::move(bytes));
        text_ = std::move(utf8.text);
        was_latin1_ = utf8.was_latin1;
    } catch (const std::runtime_error& e) {
        throw LoadError({name_, 0, 0}, e.what());
    }
}

XmlElement XmlDocument::root() const {
    return XmlElement(*this, tree_.document_element());
}

std::vector<XmlElement> XmlDocument::elements() const {
    struct Walker : pugi::xml_tree_walker {
        explicit Walker(const XmlDocument& d) : document(d) {}
        bool for_each(pugi::xml_node& node) override {
            if (const XmlDocument* inner = document.included(node)) {
                const std::vector<XmlElement> elements = inner->elements();
                found.insert(found.end(), elements.begin(), elements.end());
            } else if (node.type() == pugi::node_element) {
                found.emplace_back(document, node);
            }
            return true;
        }
        const XmlDocument& document;
        std::vector<XmlElement> found;
    };
    Walker walker(*this);
    pugi::xml_node top = tree_; // traverse() is not const, but changes nothing
    top.traverse(walker);
    return walker.found;
}

XmlDocument& XmlDocument::include(pugi::xml_node node, std::unique_ptr<XmlDocument> document) {
    std::unique_ptr<XmlDocument>& place = included_[node.internal_object()];
    place = std::move(document);
    place->version_ = version_;
    include_order_.push_back(place.get());
    return *place;
}

const XmlDocument* XmlDocument::included(pugi::xml_node node) const {
    const auto found = included_.find(node.internal_object());
    return found == included_.end() ? nullptr : found->second.get();
}

std::vector<const XmlDocument*> XmlDocument::documents() const {
    std::vector<const XmlDocument*> result{this};
    for (const XmlDocument* inner : include_order_)
        for (const XmlDocument* document : inner->documents())
            result.push_back(document);
    return result;
}

FilePosition XmlDocument::position(pugi::xml_node node, const char* attribute) const {
    if (node.offset_debug() < 0)
        return {name_, 0, 0};
    const auto element = static_cast<std::size_t>(node.offset_debug());
    const std::size_t value = attribute ? value_offset(text_, element, attribute) : std::string::npos;
    return position(value != std::string::npos ? value : element - std::min<std::size_t>(element, 1));
}

FilePosition XmlDocument::position(std::size_t offset) const {
    const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    const std::size_t line = static_cast<std::size_t>(after - line_starts_.begin()); // from 1
    return {name_, static_cast<int>(line), static_cast<int>(offset - line_starts_[line - 1]) + 1};
}

std::string XmlDocument::source_line(int line) const {
    if (line < 1 || static_cast<std::size_t>(line) > line_starts_.size())
        return {};
    const std::size_t begin = line_starts_[static_cast<std::size_t>(line) - 1];
    const std::size_t end = std::min(text_.find('\n', begin), text_.size());
    return text_.substr(begin, end - begin);
}

std::string XmlElement::required(const char* name) const {
    if (!has(name))
        fail("<" + std::string(tag()) + "> needs the attribute '" + name + "'");
    return attribute(name);
}

std::vector<XmlElement> XmlElement::children() const {
    std::vector<XmlElement> result;
    for (pugi::xml_node child : node_.children()) {
        const XmlDocument* const included = document_->included(child);
        if (included && included->root().tag() == "scene") {
            const std::vector<XmlElement> inner = included->root().children();
            result.insert(result.end(), inner.begin(), inner.end());
        } else if (included) {
            result.push_back(included->root());
        } else if (child.type() == pugi::node_element) {
            result.emplace_back(*document_, child);
        }
    }
    return result;
}

LoadError XmlElement::error(const std::string& text, const char* attribute) const {
    const FilePosition where = position(attribute);
    return LoadError(where, text, document_->source_line(where.line));
}

float XmlElement::number(const char* name) const {
    const std::string text = required(name);
    const auto value = parse_number(text);
    if (!value || !std::isfinite(static_cast<float>(*value)))
        fail("'" + text + "' is not a number", name);
    return static_cast<float>(*value);
}

std::vector<float> XmlElement::numbers(const char* name) const {
    const std::string text = required(name);
    const auto values = parse_numbers(text);
    if (!values)
        fail("'" + text + "' is not a list of numbers", name);
    return *values;
}

} // namespace tessera
