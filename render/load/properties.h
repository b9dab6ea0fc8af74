// Parameters of plugins, and their conversion: colours, spectra, transforms, indices of refraction.
#pragma once

#include "recon/image.h"
#include "render/load/xml_document.h"

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Kind of quantity that a spectrum describes. A reflectance is converted under D65, the white of sRGB, so a
/// constant one is grey. An emission is converted without an illuminant, as in Mitsuba 3, so a constant one
/// (equal energy) is slightly reddish.
enum class SpectrumKind { reflectance, emission };

/// A plugin's element, such as <bsdf type="...">, with its parameters. It records which parameters are read;
/// report_unused() notes the others, so that everything in a file that is not understood is reported.
///
/// Names are in Mitsuba 3's spelling; "intIOR" of 0.6 is read as "int_ior". Readers return the fallback if the
/// parameter is missing, and throw LoadError if it has another type or an invalid value.
class Properties {
public:
    Properties(const XmlElement& plugin, std::vector<LoadNote>& notes);

    const XmlElement& element() const { return element_; }
    const std::string& type() const { return type_; }
    /// Returns the id, or the type if there is no id.
    std::string name() const;

    bool has(std::string_view parameter) const;
    std::optional<XmlElement> take(std::string_view parameter);
    float number(std::string_view parameter, float fallback);
    int integer(std::string_view parameter, int fallback);
    bool boolean(std::string_view parameter, bool fallback);
    std::string text(std::string_view parameter, const std::string& fallback);
    Rgb color(std::string_view parameter, Rgb fallback);
    SpectrumKind spectrum_of() const;                ///< emission for emitters, reflectance for all other plugins
    glm::mat4 transform(std::string_view parameter); ///< an invalid one has error notes; see read_transform()
    /// Returns the rotation in a transform. Translation and scaling are dropped, shear is dropped with a note. A
    /// singular transform has no effect, with an error note.
    glm::mat3 rotation(std::string_view parameter);
    glm::vec3 point(std::string_view parameter, glm::vec3 fallback);

    /// Takes the children that were not taken yet and fulfil `predicate`.
    std::vector<XmlElement> take_all(const std::function<bool(const XmlElement&)>& predicate);

    /// Takes parameters that have no effect in Tessera.
    void ignore(std::initializer_list<std::string_view> parameters);
    void ignore_all();

    void note(const std::string& text) const { note(element_, text); }
    void note(const XmlElement& where, const std::string& text) const;

    /// Notes each parameter that was not taken.
    void report_unused() const;

    std::vector<LoadNote>& notes() const { return *notes_; }

private:
    struct Parameter {
        XmlElement element;
        std::string name; // in Mitsuba 3's spelling; empty for an unnamed plugin or reference
        bool used = false;
    };

    XmlElement element_;
    std::string type_;
    std::vector<LoadNote>* notes_;
    std::vector<Parameter> parameters_;
};

/// Converts "intIOR" to "int_ior".
std::string snake_case(std::string_view name);

/// Returns whether the element is a colour: <rgb>, <srgb>, <spectrum>, <blackbody>, <color> or a number.
bool is_color(const XmlElement& element);

/// Returns a colour in linear sRGB. A spectrum given by wavelengths or by a plugin of Mitsuba 3 is converted,
/// with a note. A spectrum whose file could not be read becomes the fallback. Throws LoadError for anything else.
Rgb read_color(const XmlElement& element, Rgb fallback, std::vector<LoadNote>& notes,
               SpectrumKind what = SpectrumKind::reflectance);

/// Returns the product of a <transform>'s steps (matrix, lookat, translate, rotate, scale). The first step acts
/// on a point first. An <animation> has the transform of its first key. Invalid steps are left out, with error
/// notes.
glm::mat4 read_transform(const XmlElement& transform, std::vector<LoadNote>& notes);

/// Returns the rotation (or rotation and mirroring) in a transform, by Gram-Schmidt; empty: the transform is
/// singular.
std::optional<glm::mat3> rotation_of(const glm::mat4& transform);

/// Returns the product of a <transform>'s steps for texture coordinates (u, v, 1). A matrix may have 9 numbers
/// instead of 16. Invalid steps are left out, with error notes.
glm::mat3 read_uv_transform(const XmlElement& transform, std::vector<LoadNote>& notes);

/// Reads a <point> or <vector>: value="x y z", or attributes x, y and z, which default to 0. Throws LoadError.
glm::vec3 read_point(const XmlElement& point);

/// Returns the linear sRGB colour of a spectrum, given as (nm, value) at increasing wavelengths, linear in
/// between and 0 outside. Negative channels (out of gamut) become 0. A single sample means a constant spectrum.
Rgb rgb_of_spectrum(const std::vector<glm::vec2>& samples, SpectrumKind what);

/// Returns the linear sRGB colour of a black body's radiance, in W / (m^2 sr nm) averaged with the CIE matching
/// functions, as in Mitsuba; kelvin > 0. Negative channels become 0.
Rgb rgb_of_black_body(double kelvin);

/// Returns the index of refraction of a dielectric by its usual name, such as "bk7" or "water", in any case;
/// empty: unknown name.
std::optional<float> refraction_index(std::string_view name);

/// A conductor's complex index of refraction against vacuum, for red, green and blue.
struct ComplexIndex {
    Rgb eta;
    Rgb k;
};

/// Returns a conductor's index by the name that Mitsuba uses, such as "Au"; "none" is a perfect mirror. Empty:
/// unknown name.
std::optional<ComplexIndex> metal_index(std::string_view name);

} // namespace tessera
