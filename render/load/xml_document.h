#pragma once

#include "render/io/text.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace tessera {

class XmlElement;

/// XML tree of a scene file that keeps the text position of each element, and owns the documents it includes.
class XmlDocument {
public:
    /// Parses the text. `name` is used in messages; `folder` holds the file, and is empty for a text in memory.
    /// Throws LoadError at a syntax error. Expands no entities but XML's own, whatever a DOCTYPE declares.
    XmlDocument(std::string text, std::string name, std::optional<std::filesystem::path> folder = {});
    XmlDocument(const XmlDocument&) = delete;
    XmlDocument& operator=(const XmlDocument&) = delete;

    const std::string& name() const { return name_; }
    const std::optional<std::filesystem::path>& folder() const { return folder_; }
    /// Whether the bytes were not valid UTF-8 and were converted from Latin-1.
    bool was_latin1() const { return was_latin1_; }
    XmlElement root() const;
    /// Mitsuba version stated by the outermost including document; empty: none stated.
    const std::string& version() const { return version_; }
    pugi::xml_document& tree() { return tree_; }

    /// Returns all elements in document order, root first. The elements of an included file replace its
    /// <include>.
    std::vector<XmlElement> elements() const;

    /// Attaches the document that an <include> element of this document names.
    XmlDocument& include(pugi::xml_node node, std::unique_ptr<XmlDocument> document);
    /// Returns the document attached to an <include>; null for all other elements.
    const XmlDocument* included(pugi::xml_node node) const;
    /// Returns this document and, recursively, all included ones, in document order.
    std::vector<const XmlDocument*> documents() const;

    /// Returns the position of an element's "<", or of the value of one of its attributes.
    FilePosition position(pugi::xml_node node, const char* attribute = nullptr) const;
    std::string source_line(int line) const;

private:
    FilePosition position(std::size_t offset) const;
    void take_text(std::string bytes);

    std::string text_; // UTF-8; unlike the tree, it keeps the $names of variables
    std::string name_;
    std::optional<std::filesystem::path> folder_;
    std::string version_;
    bool was_latin1_ = false;
    std::vector<std::size_t> line_starts_;
    pugi::xml_document tree_;
    std::map<const void*, std::unique_ptr<XmlDocument>> included_; // by XmlElement::key()
    std::vector<const XmlDocument*> include_order_;
};

/// Handle to an element and its document. Cheap to copy; valid as long as the document.
class XmlElement {
public:
    XmlElement(const XmlDocument& document, pugi::xml_node node) : document_(&document), node_(node) {}

    const XmlDocument& document() const { return *document_; }
    std::string_view tag() const { return node_.name(); }
    bool has(const char* attribute) const { return !node_.attribute(attribute).empty(); }
    /// Returns an attribute's value; empty if the attribute is missing.
    std::string attribute(const char* name) const { return node_.attribute(name).value(); }
    /// Returns an attribute's value. Throws LoadError if the attribute is missing.
    std::string required(const char* name) const;
    /// Returns the child elements in order. An <include> is replaced by the children of the included <scene>,
    /// or by the included root if that is not a <scene>.
    std::vector<XmlElement> children() const;

    /// Returns the position of the element, or of an attribute's value.
    FilePosition position(const char* attribute = nullptr) const { return document_->position(node_, attribute); }
    LoadError error(const std::string& text, const char* attribute = nullptr) const;
    [[noreturn]] void fail(const std::string& text, const char* attribute = nullptr) const {
        throw error(text, attribute);
    }

    /// Return the attribute's value as one finite number, or as several. Throw LoadError.
    float number(const char* name) const;
    std::vector<float> numbers(const char* name) const;

    /// Returns a map key that is equal for all handles of the same element.
    const void* key() const { return node_.internal_object(); }

private:
    const XmlDocument* document_;
    pugi::xml_node node_;
};

/// Returns whether the scene states a Mitsuba version 0.x.
inline bool is_mitsuba_0(const XmlElement& element) {
    return element.document().version().starts_with("0.");
}

} // namespace tessera
