// The parameters of a plugin, and what their values mean: colours, transforms, spectra and indices of refraction.
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

/// What a spectrum is one of. That of a surface is seen in the light of D65, the white of sRGB: one that is the
/// same at all wavelengths is grey. That of a light is its own colour, as in Mitsuba 3: equal energy at all
/// wavelengths is a little reddish.
enum class SpectrumOf { reflectance, emission };

/// A plugin's element, such as <bsdf type="...">, with its parameters. Remembers which were asked for: the others
/// end as notes, so that nothing in a file is passed over in silence.
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
    SpectrumOf spectrum_of() const; ///< what spectra among the parameters are: those of an emitter are of light
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

/// Whether the element is a colour: <rgb>, <srgb>, <spectrum>, <blackbody>, <color> or a <float>.
bool is_color(const XmlElement& element);

/// A colour's linear value. A spectrum given by wavelengths or as a plugin of Mitsuba 3 becomes its linear sRGB
/// colour, one in a file the fallback, with a note. Throws LoadError for anything else.
Rgb read_color(const XmlElement& element, Rgb fallback, std::vector<LoadNote>& notes,
               SpectrumOf what = SpectrumOf::reflectance);

/// The product of a <transform>'s steps (matrix, lookat, translate, rotate, scale); the first step is applied to a
/// point first. Throws LoadError.
glm::mat4 read_transform(const XmlElement& transform);

/// The rotation (and mirroring) nearest to a transform, by Gram and Schmidt; empty: the transform is flat.
std::optional<glm::mat3> rotation_of(const glm::mat4& transform);

/// The product of a <transform>'s steps for texture coordinates (u, v, 1); a matrix may have 9 numbers instead of
/// 16. Throws LoadError.
glm::mat3 read_uv_transform(const XmlElement& transform);

/// A <point> or <vector>: value="x y z", or attributes x, y and z, 0 where one is left out. Throws LoadError.
glm::vec3 read_point(const XmlElement& point);

/// Linear sRGB of a spectrum given at increasing wavelengths (nm, value), linear between them and 0 beyond.
/// Colours outside of the gamut are cut at 0. A single sample stands for a constant.
Rgb rgb_of_spectrum(const std::vector<glm::vec2>& samples, SpectrumOf what);

/// Linear sRGB of the radiance of a black body, W / (m^2 sr nm) weighted by the CIE's matching functions, as
/// Mitsuba has it; kelvin > 0. White is D65.
Rgb rgb_of_black_body(double kelvin);

/// The index of refraction of a transparent material by its usual name, such as "bk7" or "water", in any case;
/// empty: the name is not known.
std::optional<float> refraction_index(std::string_view name);

/// A metal's complex index of refraction against vacuum, for red, green and blue.
struct ComplexIndex {
    Rgb eta;
    Rgb k;
};

/// The index of a metal by its chemical symbol, such as "Au", as in Mitsuba; "none" is a mirror that reflects all.
/// Empty: the name is not known.
std::optional<ComplexIndex> metal_index(std::string_view name);

} // namespace tessera
