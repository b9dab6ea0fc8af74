#include "render/load/colors.h"

#include "render/load/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tessera {

namespace {

float srgb_to_linear(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

Rgb srgb_to_linear(Rgb c) {
    return {srgb_to_linear(c.r), srgb_to_linear(c.g), srgb_to_linear(c.b)};
}

/// "#rrggbb", the bytes over 255.
Rgb hexadecimal(const XmlElement& element, const std::string& text) {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
    if (text.size() != 7 || error != std::errc() || end != text.data() + text.size())
        element.fail("'" + text + "' is not a colour such as '#a0b0c0'", "value");
    return Rgb(value >> 16, value >> 8 & 0xff, value & 0xff) / 255.0f;
}

/// One number or three, or "#rrggbb".
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

/// "400:0.2, 500:0.3": the mean over the range of wavelengths, by trapezoids.
float mean_of_samples(const XmlElement& element, std::string text) {
    std::replace(text.begin(), text.end(), ':', ' ');
    const auto values = parse_numbers(text);
    if (!values || values->empty() || values->size() % 2 != 0)
        element.fail("'" + element.attribute("value") + "' is not a list of wavelengths and values", "value");
    float area = 0;
    float range = 0;
    for (std::size_t i = 2; i < values->size(); i += 2) {
        const float step = (*values)[i] - (*values)[i - 2];
        if (step <= 0)
            element.fail("the wavelengths of a spectrum must increase", "value");
        area += step * 0.5f * ((*values)[i + 1] + (*values)[i - 1]);
        range += step;
    }
    return range > 0 ? area / range : (*values)[1];
}

} // namespace

bool is_color(const XmlElement& element) {
    static constexpr std::string_view tags[] = {"rgb", "srgb", "spectrum", "color", "float", "integer"};
    return std::find(std::begin(tags), std::end(tags), element.tag()) != std::end(tags);
}

Rgb read_color(const XmlElement& element, Rgb fallback, std::vector<LoadNote>& notes) {
    if (!is_color(element))
        element.fail("'" + element.attribute("name") + "' must be a colour, not <" + std::string(element.tag()) +
                     ">");
    if (element.tag() == "spectrum" && !element.has("value") && element.has("filename")) {
        notes.push_back({element.position(), "spectra in files are not read; a default is used instead"});
        return fallback;
    }
    const std::string text = element.required("value");
    if (element.tag() == "spectrum" && text.find(':') != std::string::npos) {
        notes.push_back({element.position(), "the spectrum is replaced by the grey of its mean"});
        return Rgb(mean_of_samples(element, text));
    }
    const Rgb value = triple(element);
    return element.tag() == "srgb" ? srgb_to_linear(value) : value;
}

} // namespace tessera
