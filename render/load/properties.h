#pragma once

#include "recon/image.h"
#include "render/load/xml_document.h"

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// A plugin's element (<bsdf type="...">, <shape type="...">, ...) with its parameters. Remembers which were asked
/// for: the others end as notes, so that nothing in a file is passed over in silence.
///
/// Parameters are asked for in the spelling of Mitsuba 3; "intIOR" of 0.6 answers to "int_ior". All readers return
/// the fallback when the parameter is absent and throw LoadError when it has another type or a bad value.
class Properties {
public:
    Properties(const XmlElement& plugin, std::vector<LoadNote>& notes);

    const XmlElement& element() const { return element_; }
    const std::string& type() const { return type_; }
    /// The id, or the type where there is none.
    std::string name() const;

    bool has(std::string_view parameter) const;
    std::optional<XmlElement> take(std::string_view parameter);
    float number(std::string_view parameter, float fallback);
    int integer(std::string_view parameter, int fallback);
    bool boolean(std::string_view parameter, bool fallback);
    std::string text(std::string_view parameter, const std::string& fallback);
    Rgb color(std::string_view parameter, Rgb fallback);
    glm::mat4 transform(std::string_view parameter);
    /// The rotation in a transform; says so where there is more to it. Throws LoadError for a flat one.
    glm::mat3 rotation(std::string_view parameter);
    glm::vec3 point(std::string_view parameter, glm::vec3 fallback);

    /// The children not asked for so far that answer `wanted`.
    std::vector<XmlElement> take_all(const std::function<bool(const XmlElement&)>& wanted);

    /// Parameters that make no difference to this program.
    void ignore(std::initializer_list<std::string_view> parameters);
    void ignore_all();

    void note(const std::string& text) const { note(element_, text); }
    void note(const XmlElement& where, const std::string& text) const;

    /// A note for each parameter that nobody asked for.
    void report_unused() const;

    std::vector<LoadNote>& notes() const { return *notes_; }

private:
    struct Parameter {
        XmlElement element;
        std::string name; // in Mitsuba 3's spelling; empty for a nested plugin or reference
        bool used = false;
    };

    XmlElement element_;
    std::string type_;
    std::vector<LoadNote>* notes_;
    std::vector<Parameter> parameters_;
};

/// "intIOR" -> "int_ior".
std::string snake_case(std::string_view name);

} // namespace tessera
