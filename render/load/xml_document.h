#pragma once

#include "render/load/messages.h"

#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace tessera {

class XmlElement;

/// A scene file as a tree that knows where in the text each element stands.
class XmlDocument {
public:
    /// `name` stands in messages. Throws LoadError at the place of a syntax error.
    XmlDocument(std::string text, std::string name);
    XmlDocument(const XmlDocument&) = delete;
    XmlDocument& operator=(const XmlDocument&) = delete;

    const std::string& name() const { return name_; }
    XmlElement root() const;
    pugi::xml_document& tree() { return tree_; }

    /// All elements in order of the file, the root first.
    std::vector<XmlElement> elements() const;

    /// The place of an element's "<", or of the value of one of its attributes.
    FilePosition position(pugi::xml_node node, const char* attribute = nullptr) const;
    std::string source_line(int line) const;

private:
    FilePosition position(std::size_t offset) const;

    std::string text_; // as it was in the file; the tree's values may have been replaced since
    std::string name_;
    std::vector<std::size_t> line_starts_;
    pugi::xml_document tree_;
};

/// An element with the document it stands in: a handle, cheap to copy, valid as long as the document.
class XmlElement {
public:
    XmlElement(const XmlDocument& document, pugi::xml_node node) : document_(&document), node_(node) {}

    std::string_view tag() const { return node_.name(); }
    bool has(const char* attribute) const { return !node_.attribute(attribute).empty(); }
    /// Empty when there is no such attribute.
    std::string attribute(const char* name) const { return node_.attribute(name).value(); }
    /// Throws LoadError when there is no such attribute.
    std::string required(const char* name) const;
    std::vector<XmlElement> children() const;

    /// Of the element, or of an attribute's value.
    FilePosition position(const char* attribute = nullptr) const { return document_->position(node_, attribute); }
    LoadError error(const std::string& text, const char* attribute = nullptr) const;
    [[noreturn]] void fail(const std::string& text, const char* attribute = nullptr) const {
        throw error(text, attribute);
    }

    /// The attribute's value as a finite number or several; throws LoadError.
    float number(const char* name) const;
    std::vector<float> numbers(const char* name) const;

    /// The same for all handles of an element.
    const void* key() const { return node_.internal_object(); }

private:
    const XmlDocument* document_;
    pugi::xml_node node_;
};

} // namespace tessera
