// Reads a material and its notes from a <bsdf> alone.
#pragma once

#include "render/load/mitsuba_xml.h"

#include <string>
#include <variant>

namespace tessera::test {

inline LoadedScene parse(const std::string& body, const std::string& version = "3.0.0") {
    return parse_mitsuba_xml(
        "<scene version=\"" + version + "\">\n" + body + "<sensor type='perspective'/></scene>", "test.xml");
}

struct Read {
    Material material;
    std::string notes; // one per line
};

/// Reads a scene with one <bsdf> and returns its material.
inline Read read(const std::string& bsdf, const std::string& version = "3.0.0") {
    const LoadedScene loaded = parse(bsdf, version);
    Read result{loaded.description.materials.at(0), {}};
    for (const LoadNote& note : loaded.notes)
        result.notes += note.text + "\n";
    return result;
}

/// Returns a <bsdf> of this type that contains `inside`.
inline std::string around(const std::string& type, const std::string& inside) {
    return "<bsdf type='" + type + "'>" + inside + "</bsdf>";
}

template <class Kind>
const Kind& part(const Material& mixture, std::size_t i) {
    return std::get<Kind>(std::get<MixtureMaterial>(mixture.kind).parts.at(i)->kind);
}

inline const std::string diffuse = "<bsdf type='diffuse'/>", glass = "<bsdf type='dielectric'/>",
                         check = "<texture type='checkerboard' name='map'/>",
                         two_sided = around("twosided", diffuse);

} // namespace tessera::test
