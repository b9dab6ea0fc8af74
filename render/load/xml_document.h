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

/// A scene file as a tree that knows where in the text each element stands, with the files that it includes.
class XmlDocument {
public:
    /// `name` stands in messages; `folder` is where the file lies, nothing for a text in memory. Throws LoadError
    /// at the place of a syntax error. Entities other than XML's own are not expanded, however a DOCTYPE declares
    /// them.
    XmlDocument(std::string text, std::string name, std::optional<std::filesystem::path> folder = {});
    XmlDocument(const XmlDocument&) = delete;
    XmlDocument& operator=(const XmlDocument&) = delete;

    const std::string& name() const { return name_; }
    const std::optional<std::filesystem::path>& folder() const { return folder_; }
    /// Whether the bytes were no UTF-8 and were taken for Latin-1.
    bool was_latin1() const { return was_latin1_; }
    XmlElement root() const;
    /// Of Mitsuba, as the file says that includes this one, if any does, or as this one says; empty: it does not.
    const std::string& version() const { return version_; }
    pugi::xml_document& tree() { return tree_; }

    /// All elements in order of the file, the root first, those of included files in the place of the <include>.
    std::vector<XmlElement> elements() const;

    /// Gives an <include> element of this document what it stands for.
    XmlDocument& include(pugi::xml_node node, std::unique_ptr<XmlDocument> document);
    /// What an element stands for; null for all but <include>.
    const XmlDocument* included(pugi::xml_node node) const;
    /// This document and all that it includes, in order.
    std::vector<const XmlDocument*> documents() const;

    /// The place of an element's "<", or of the value of one of its attributes.
    FilePosition position(pugi::xml_node node, const char* attribute = nullptr) const;
    std::string source_line(int line) const;

private:
    FilePosition position(std::size_t offset) const;
    void take_text(std::string bytes);

    std::string text_; // as it was in the file; the tree's values may have been replaced since
    std::string name_;
    std::optional<std::filesystem::path> folder_;
    std::string version_;
    bool was_latin1_ = false;
    std::vector<std::size_t> line_starts_;
    pugi::xml_document tree_;
    std::map<const void*, std::unique_ptr<XmlDocument>> included_; // by the node's internal object
    std::vector<const XmlDocument*> include_order_;
};

/// An element with the document it stands in: a handle, cheap to copy, valid as long as the document.
class XmlElement {
public:
    XmlElement(const XmlDocument& document, pugi::xml_node node) : document_(&document), node_(node) {}

    const XmlDocument& document() const { return *document_; }
    std::string_view tag() const { return node_.name(); }
    bool has(const char* attribute) const { return !node_.attribute(attribute).empty(); }
    /// The value of an attribute; empty when there is none of that name.
    std::string attribute(const char* name) const { return node_.attribute(name).value(); }
    /// The value of an attribute. Throws LoadError when there is none of that name.
    std::string required(const char* name) const;
    /// The elements in this one, in order of the file; in the place of an <include> what it stands for: the
    /// elements in its <scene>, or its root.
    std::vector<XmlElement> children() const;

    /// The place of the element, or of an attribute's value.
    FilePosition position(const char* attribute = nullptr) const { return document_->position(node_, attribute); }
    LoadError error(const std::string& text, const char* attribute = nullptr) const;
    [[noreturn]] void fail(const std::string& text, const char* attribute = nullptr) const {
        throw error(text, attribute);
    }

    /// The attribute's value as a finite number or several; throws LoadError.
    float number(const char* name) const;
    std::vector<float> numbers(const char* name) const;

    /// A key of the element, which is equal for all handles of it.
    const void* key() const { return node_.internal_object(); }

private:
    const XmlDocument* document_;
    pugi::xml_node node_;
};

/// Whether the element is of a scene of Mitsuba 0.x.
inline bool is_of_version_0(const XmlElement& element) {
    return element.document().version().starts_with("0.");
}

} // namespace tessera
