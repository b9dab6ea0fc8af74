#include "render/io/text.h"
#include "render/load/properties.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace tessera {

namespace {

Rgb srgb_to_linear(Rgb c) {
    return {tessera::srgb_to_linear(c.r), tessera::srgb_to_linear(c.g), tessera::srgb_to_linear(c.b)};
}

/// Reads "#rrggbb" as bytes over 255, as Mitsuba 0.6 does. Mitsuba 3 has no such colours.
Rgb hexadecimal(const XmlElement& element, const std::string& text) {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
    if (text.size() != 7 || error != std::errc() || end != text.data() + text.size())
        element.fail("'" + text + "' is not a colour such as '#a0b0c0'", "value");
    return Rgb(value >> 16, value >> 8 & 0xff, value & 0xff) / 255.0f;
}

/// Reads a colour given as one number, as three, or as "#rrggbb".
Rgb triple(const XmlElement& element) {
    if (element.tag() == "float" || element.tag() == "integer")
        return Rgb(element.number("value"));
    const std::string text = element.required("value");
    if (text.starts_with('#'))
        return hexadecimal(element, text);
    const std::vector<float> values = element.numbers("value");
    if (values.size() == 1)
        return Rgb(values[0]);
    if (values.size() != 3)
        element.fail("'" + text + "' must be one number or three", "value");
    return {values[0], values[1], values[2]};
}

Rgb color_of_samples(const XmlElement& element, const std::vector<glm::vec2>& samples, SpectrumKind what) {
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (!(samples[i].x > samples[i - 1].x))
            element.fail("the wavelengths of a spectrum must increase", "value");
    const Rgb color = rgb_of_spectrum(samples, what);
    if (!(color.r + color.g + color.b <= std::numeric_limits<float>::max()))
        element.fail("the spectrum's numbers are too large", "value");
    return color;
}

/// Reads a spectrum such as "400:0.2, 500:0.3" (nm:value).
Rgb color_of_list(const XmlElement& element, std::string text, SpectrumKind what) {
    std::replace(text.begin(), text.end(), ':', ' ');
    const auto values = parse_numbers(text);
    if (!values || values->empty() || values->size() % 2 != 0)
        element.fail("'" + element.attribute("value") + "' is not a list of wavelengths and values", "value");
    std::vector<glm::vec2> samples;
    for (std::size_t i = 0; i < values->size(); i += 2)
        samples.emplace_back((*values)[i], (*values)[i + 1]);
    return color_of_samples(element, samples, what);
}

Rgb color_of_black_body(const XmlElement& element, float kelvin, float scale) {
    if (!(kelvin > 0))
        element.fail("the temperature of a black body must be above 0");
    const Rgb color = scale * rgb_of_black_body(static_cast<double>(kelvin));
    if (!std::isfinite(color.r + color.g + color.b))
        element.fail("the black body is too bright");
    return color;
}

/// Reads <blackbody temperature="5000K" scale="0.1"/> of Mitsuba 0.6.
Rgb black_body(const XmlElement& element) {
    std::string text = element.required("temperature");
    if (text.ends_with('K') || text.ends_with('k'))
        text.pop_back();
    const auto kelvin = parse_number(text);
    if (!kelvin)
        element.fail("'" + element.attribute("temperature") + "' is not a temperature", "temperature");
    return color_of_black_body(element, static_cast<float>(*kelvin),
                               element.has("scale") ? element.number("scale") : 1);
}

/// Reads `values` at `wavelengths`, or evenly from `wavelength_min` to `wavelength_max` (Mitsuba 3; nm).
Rgb color_of_arrays(Properties& p, SpectrumKind what) {
    const auto values = parse_numbers(p.text("values", ""));
    auto wavelengths = parse_numbers(p.text("wavelengths", ""));
    if (p.type() == "regular" && values && wavelengths) {
        const float first = p.number("wavelength_min", p.number("lambda_min", 360));
        const float last = p.number("wavelength_max", p.number("lambda_max", 830));
        for (std::size_t i = 0; i < values->size(); ++i)
            wavelengths->push_back(first + (last - first) * static_cast<float>(i) /
                                               static_cast<float>(std::max<std::size_t>(values->size(), 2) - 1));
    }
    if (!values || !wavelengths || values->empty() || values->size() != wavelengths->size())
        p.element().fail("'" + p.type() + "' needs as many 'wavelengths' as 'values', lists of numbers");
    std::vector<glm::vec2> samples;
    for (std::size_t i = 0; i < values->size(); ++i)
        samples.emplace_back((*wavelengths)[i], (*values)[i]);
    return color_of_samples(p.element(), samples, what);
}

/// Reads a plugin <spectrum type="..."> of Mitsuba 3.
Rgb spectrum_plugin(const XmlElement& element, Rgb fallback, std::vector<LoadNote>& notes, SpectrumKind what) {
    Properties p(element, notes);
    Rgb color = fallback;
    if (p.has("filename")) { // expand_spectrum_file() could not read it
        p.ignore_all();
    } else if (p.type() == "uniform") {
        color = Rgb(p.number("value", 1));
    } else if (p.type() == "rgb" || p.type() == "srgb" || p.type() == "d65") {
        color = p.color("color", Rgb(1)) * p.number("scale", 1); // D65 is the white of sRGB
    } else if (p.type() == "blackbody") {
        color = color_of_black_body(element, p.number("temperature", 5000), p.number("scale", 1));
        p.note("the spectrum is replaced by its linear sRGB colour");
    } else if (p.type() == "irregular" || p.type() == "regular") {
        color = color_of_arrays(p, what);
        p.note("the spectrum is replaced by its linear sRGB colour");
    } else {
        p.note("the spectrum '" + p.type() + "' is not known; a default is used instead");
        p.ignore_all();
    }
    p.report_unused();
    return color;
}

} // namespace

bool is_color(const XmlElement& element) {
    static constexpr std::string_view tags[] = {"rgb",       "srgb",  "spectrum", "color",
                                                "blackbody", "float", "integer"};
    return std::find(std::begin(tags), std::end(tags), element.tag()) != std::end(tags);
}

Rgb read_color(const XmlElement& element, Rgb fallback, std::vector<LoadNote>& notes, SpectrumKind what) {
    if (!is_color(element))
        element.fail("'" + element.attribute("name") + "' must be a colour, not <" + std::string(element.tag()) +
                     ">");
    if (element.tag() == "spectrum" && element.has("type"))
        return spectrum_plugin(element, fallback, notes, what);
    if (element.tag() == "spectrum" && !element.has("value") && element.has("filename"))
        return fallback; // expand_spectrum_file() could not read it
    if (element.tag() == "blackbody") {
        notes.push_back({element.position(), "the spectrum is replaced by its linear sRGB colour"});
        return black_body(element);
    }
    const std::string text = element.required("value");
    if (element.tag() == "spectrum" && text.find(':') != std::string::npos) {
        notes.push_back({element.position(), "the spectrum is replaced by its linear sRGB colour"});
        return color_of_list(element, text, what);
    }
    const Rgb value = triple(element);
    // One number is a constant spectrum. Mitsuba 0.6 treats it as grey even for emission.
    if (element.tag() == "spectrum" && what == SpectrumKind::emission && !is_mitsuba_0(element))
        return value * rgb_of_spectrum({{360, 1}, {830, 1}}, what);
    return element.tag() == "srgb" ? srgb_to_linear(value) : value;
}

} // namespace tessera
