#include "render/load/bsdf_readers.h"
#include "render/load/plugins.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

namespace tessera {

// Disney's principled BSDF [Burley 2012, 2015].

namespace {

/// Reads the parameters that both plugins have.
template <class M>
void read_common(LoadContext& context, Properties& p, M& m) {
    m.base_color = reflectance_parameter(context, p, "base_color", Rgb(0.5f));
    m.roughness = grey_parameter(context, p, "roughness", 0.5f);
    m.anisotropic = grey_parameter(context, p, "anisotropic", 0);
    m.spec_trans = grey_parameter(context, p, "spec_trans", 0);
    m.spec_tint = grey_parameter(context, p, "spec_tint", 0);
    m.sheen = grey_parameter(context, p, "sheen", 0);
    m.sheen_tint = grey_parameter(context, p, "sheen_tint", 0);
    m.flatness = grey_parameter(context, p, "flatness", 0);
    p.ignore({"main_specular_sampling_rate", "specular_reflectance_sampling_rate", "clearcoat_sampling_rate",
              "specular_transmittance_sampling_rate", "diffuse_reflectance_sampling_rate",
              "diffuse_transmittance_sampling_rate"});
}

/// Reads the index of refraction, given directly or by "specular" (0.5 means 1.5).
float principled_index(Properties& p, bool transmits) {
    if (p.has("eta") && p.has("specular"))
        p.take("specular")->fail("'principled' takes 'eta' or 'specular', not both");
    if (p.has("eta")) {
        const float eta = p.number("eta", 1.5f);
        if (!(eta > 0))
            p.take("eta")->fail("an index of refraction must be above 0", "value");
        return transmits && eta == 1 ? 1.001f : eta; // an index of 1 would not refract
    }
    const float specular = p.number("specular", 0.5f);
    if (!(specular >= 0 && specular < 12.5f))
        p.take("specular")->fail("'specular' must be at least 0 and below 12.5", "value");
    // The reflectance at normal incidence, ((eta - 1) / (eta + 1))^2, is 0.08 specular [Burley 2012, 5.5].
    return 2 / (1 - std::sqrt(0.08f * (transmits && specular == 0 ? 1e-3f : specular))) - 1;
}

} // namespace

Material read_principled(LoadContext& context, Properties& p) {
    PrincipledMaterial m;
    read_common(context, p, m);
    m.metallic = grey_parameter(context, p, "metallic", 0);
    m.clearcoat = grey_parameter(context, p, "clearcoat", 0);
    m.clearcoat_gloss = grey_parameter(context, p, "clearcoat_gloss", 0);
    m.eta = principled_index(p, !m.spec_trans.is_black());
    return {{}, m};
}

Material read_thin_principled(LoadContext& context, Properties& p) {
    ThinPrincipledMaterial m;
    read_common(context, p, m);
    m.eta = texture_parameter(context, p, "eta", Rgb(1.5f));
    if (const Rgb* eta = std::get_if<Rgb>(&m.eta.kind); eta && !(eta->r > 0))
        p.take("eta")->fail("an index of refraction must be above 0", "value");
    m.diff_trans = texture_parameter(context, p, "diff_trans", Rgb(0));
    if (const Rgb* constant = std::get_if<Rgb>(&m.diff_trans.kind);
        constant && !(constant->r >= 0 && constant->r <= 2))
        p.take("diff_trans")->fail("'diff_trans' must be from 0 to 2", "value");
    return {{}, m};
}

} // namespace tessera
