#include "ui/state/buffer.h"

#include "recon/guided/demodulation.h"
#include "recon/guided/fireflies.h"
#include "render/run/first_hits.h"
#include "ui/gl/tone.h"
#include "ui/state/companions.h"
#include "ui/state/inspected.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tessera {

namespace {

ErrorKind error_kind(Buffer buffer) {
    return static_cast<ErrorKind>(static_cast<int>(buffer) - static_cast<int>(Buffer::error_relative_squared));
}

const RgbImage& primal_with_very_direct(const GradientImages& images, RgbImage& scratch) {
    if (images.very_direct.size() != images.radiance().size())
        return images.radiance();
    scratch = images.radiance();
    for (std::size_t i = 0; i < scratch.size(); ++i)
        scratch.data()[i] += images.very_direct.data()[i];
    return scratch;
}

/// Returns `value` > 0, rounded up to one of the steps times a power of ten.
float rounded_up(float value) {
    const float power = std::pow(10.0f, std::floor(std::log10(value)));
    for (float step : {1.0f, 1.2f, 1.5f, 2.0f, 2.5f, 3.0f, 4.0f, 5.0f, 6.0f, 8.0f}) {
        if (step * power >= value)
            return step * power;
    }
    return 10 * power;
}

/// Whether there is a reconstruction of this size. A preview's can remain when the first full pass arrives.
bool has_reconstruction(const Snapshot& snapshot) {
    if (!snapshot.images || !snapshot.reconstruction)
        return false;
    const RgbImage& image = snapshot.reconstruction->image;
    const RgbImage& primal = snapshot.images->primal;
    return !image.empty() && image.width() == primal.width() && image.height() == primal.height();
}

} // namespace

std::shared_ptr<const void> picture_source(const Snapshot& snapshot, Buffer buffer) {
    switch (family(buffer)) {
    case BufferFamily::reuse:
        return snapshot.reuse;
    case BufferFamily::first_hit:
    case BufferFamily::reference:
        return nullptr;
    case BufferFamily::gradient:
    case BufferFamily::variance:
        return snapshot.images;
    case BufferFamily::basis:
        return snapshot.images && !snapshot.images->demodulation.empty() ? snapshot.images : nullptr;
    case BufferFamily::picture:
    case BufferFamily::error:
        break;
    }
    const bool is_final = buffer == Buffer::reconstruction || family(buffer) == BufferFamily::error;
    if (is_final && has_reconstruction(snapshot))
        return snapshot.reconstruction;
    return snapshot.images;
}

bool has_components(Buffer buffer) {
    return family(buffer) == BufferFamily::gradient || buffer == Buffer::coefficient ||
           buffer == Buffer::projection || buffer == Buffer::dx_variance || buffer == Buffer::dy_variance;
}

bool is_footprint(Buffer buffer) {
    return buffer == Buffer::footprint_1 || buffer == Buffer::footprint_2;
}

std::shared_ptr<const void> companion_source(const Companions& companions, Buffer buffer) {
    if (has_components(buffer))
        return companions.component;
    if (family(buffer) == BufferFamily::error || family(buffer) == BufferFamily::reference)
        return companions.reference;
    if (family(buffer) == BufferFamily::first_hit)
        return companions.first_hits;
    return nullptr;
}

namespace {

const RgbImage no_picture;

/// Returns the reconstruction, or the primal until there is one.
const RgbImage& final_picture(const Snapshot& snapshot, RgbImage& scratch) {
    return has_reconstruction(snapshot) ? snapshot.reconstruction->image
                                        : primal_with_very_direct(*snapshot.images, scratch);
}

/// Returns the selected basis component; null: none is selected, or the snapshot does not have it.
const BasisComponent* component_of(const Snapshot& snapshot, const Companions& companions) {
    const std::vector<BasisComponent>& components = snapshot.images->components;
    const int l = companions.component ? *companions.component : -1;
    return l >= 0 && l < static_cast<int>(components.size()) ? &components[l] : nullptr;
}

/// Returns coefficients, gradients or their variances.
/// @param measured  GradientImages (the whole) or BasisComponent
template <class Measured>
const RgbImage& measured_picture(const Measured& measured, Buffer buffer, RgbImage& scratch) {
    switch (buffer) {
    case Buffer::dx:
        return measured.dx;
    case Buffer::dy:
        return measured.dy;
    case Buffer::dx_variance:
        return scratch = grey(measured.dx_variance);
    case Buffer::dy_variance:
        return scratch = grey(measured.dy_variance);
    default:
        return measured.primal;
    }
}

const RgbImage& projection_picture(const Snapshot& snapshot, RgbImage& scratch, const Companions& companions) {
    if (snapshot.images->components.empty())
        return no_picture;
    const BasisComponent* component = component_of(snapshot, companions);
    return scratch = grey((component ? *component : snapshot.images->components.front()).projection);
}

const RgbImage& error_picture(const Snapshot& snapshot, Buffer buffer, RgbImage& scratch,
                              const Companions& companions) {
    if (!companions.reference || !same_size(snapshot.images->primal, companions.reference->image))
        return no_picture;
    return scratch = error_map(error_kind(buffer), final_picture(snapshot, scratch), companions.reference->image);
}

const RgbImage& first_hit_picture(Buffer buffer, RgbImage& scratch, const Companions& companions) {
    if (!companions.first_hits)
        return no_picture;
    if (buffer == Buffer::depth)
        return scratch = grey(companions.first_hits->depth);
    if (buffer == Buffer::footprint_1)
        return scratch = grey(companions.first_hits->footprint_1);
    if (buffer == Buffer::footprint_2)
        return scratch = grey(companions.first_hits->footprint_2);
    return buffer == Buffer::albedo ? companions.first_hits->albedo : companions.first_hits->normal;
}

} // namespace

const RgbImage& picture(const Snapshot& snapshot, Buffer buffer, RgbImage& scratch, const Companions& companions) {
    if (family(buffer) == BufferFamily::first_hit)
        return first_hit_picture(buffer, scratch, companions);
    if (family(buffer) == BufferFamily::reference)
        return companions.reference ? companions.reference->image : no_picture;
    if (!picture_source(snapshot, buffer) || !snapshot.images)
        return no_picture;
    if (family(buffer) == BufferFamily::error)
        return error_picture(snapshot, buffer, scratch, companions);
    switch (buffer) {
    case Buffer::reused:
        return scratch = grey(snapshot.reuse->reused());
    case Buffer::outcomes:
        return scratch = grey(snapshot.reuse->failed());
    case Buffer::survival:
        return scratch = grey(snapshot.reuse->survival());
    case Buffer::reuse_set_size:
        return scratch = grey(snapshot.reuse->reuse_set_size);
    case Buffer::gain:
        return scratch = grey(snapshot.reuse->gain);
    case Buffer::samples:
        return scratch = grey(snapshot.reuse->paths);
    case Buffer::dx:
    case Buffer::dy:
    case Buffer::dx_variance:
    case Buffer::dy_variance:
    case Buffer::coefficient:
        if (const BasisComponent* component = component_of(snapshot, companions))
            return measured_picture(*component, buffer, scratch);
        return measured_picture(*snapshot.images, buffer, scratch);
    case Buffer::projection:
        return projection_picture(snapshot, scratch, companions);
    case Buffer::very_direct:
        return snapshot.images->very_direct;
    case Buffer::primal_variance:
        return scratch = grey(snapshot.images->primal_variance);
    case Buffer::mean_albedo:
        return snapshot.images->demodulation.albedo;
    case Buffer::sampled_albedo:
        return snapshot.images->demodulation.sampled_albedo;
    case Buffer::covariance:
        return scratch = sample_covariance(*snapshot.images);
    case Buffer::redistributed:
        return scratch = clamped_radiance(*snapshot.images);
    case Buffer::reconstruction:
        return final_picture(snapshot, scratch);
    default:
        return primal_with_very_direct(*snapshot.images, scratch);
    }
}

RgbImage own_colours(const Snapshot& snapshot, Buffer buffer) {
    return buffer == Buffer::outcomes && snapshot.reuse ? outcome_colours(*snapshot.reuse) : RgbImage();
}

std::string missing_text(const Snapshot* snapshot, Method method, Buffer buffer, const Companions& companions) {
    const std::string name(paper_name(method));
    const bool of_gradients = family(buffer) == BufferFamily::gradient ||
                              (family(buffer) == BufferFamily::variance && buffer != Buffer::primal_variance);
    if (buffer == Buffer::redistributed && snapshot && is_expanded(snapshot->settings))
        return "A basis with several components has no firefly suppression";
    if (of_gradients && !has_gradients(method))
        return name + " measures no gradients";
    if (family(buffer) == BufferFamily::variance && snapshot && snapshot->spp < 2)
        return "Variances need two passes";
    if (buffer == Buffer::samples && snapshot && !measures_reuse_gain(snapshot->settings))
        return "All pixels have one sample per pass";
    if (family(buffer) == BufferFamily::reuse && method == Method::pt && buffer != Buffer::samples)
        return name + " reuses no paths";
    if (buffer == Buffer::reuse_set_size && !reuses_paths(method))
        return name + " has no tiles";
    if (buffer == Buffer::gain && snapshot && !measures_reuse_gain(snapshot->settings))
        return "The gain is measured only for G-PR with adaptive tiles";
    if (family(buffer) == BufferFamily::basis && method == Method::pt)
        return name + " does not demodulate the albedo";
    if (family(buffer) == BufferFamily::basis && snapshot && snapshot->settings.basis == Basis::none)
        return "With basis \"none\" the albedo is not demodulated";
    if (buffer == Buffer::projection && !has_gradients(method))
        return name + " measures no gradients, and so has no basis components";
    if (buffer == Buffer::projection && snapshot && !is_expanded(snapshot->settings))
        return "The basis has one component: choose harmonics or boxes";
    if (family(buffer) != BufferFamily::error && family(buffer) != BufferFamily::reference)
        return "";
    if (!companions.reference)
        return "No reference: drop an EXR file on the window";
    if (family(buffer) == BufferFamily::reference || !snapshot || !snapshot->images || snapshot->coarse() ||
        same_size(snapshot->images->primal, companions.reference->image))
        return "";
    const RgbImage& r = companions.reference->image;
    return "The reference has " + std::to_string(r.width()) + " x " + std::to_string(r.height()) + " pixels";
}

float top_value(Buffer buffer, const RgbImage& image) {
    if (buffer == Buffer::outcomes || buffer == Buffer::survival)
        return 1;
    float top = 0;
    for (const Rgb& pixel : image)
        top = std::max(top, pixel.r);
    return top > 0 ? rounded_up(top) : 1;
}

namespace {

/// Returns five decades that end at ten times the mean. The maximum would be an outlier's.
ValueRange variance_range(const RgbImage& image) {
    double sum = 0;
    for (const Rgb& pixel : image)
        sum += std::isfinite(pixel.r) ? static_cast<double>(pixel.r) : 0;
    const auto mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(image.size(), 1)));
    const float top = mean > 0 ? rounded_up(mean * 10) : 1;
    return {top * 1e-5f, top, true};
}

} // namespace

ValueRange automatic_range(Buffer buffer, const RgbImage& image, const Companions& companions) {
    if (family(buffer) == BufferFamily::variance)
        return variance_range(image);
    if (buffer == Buffer::gain)
        return {0.1f, 10, true}; // 1, where reuse neither gains nor costs, is in the middle
    if (family(buffer) != BufferFamily::error)
        return {0, top_value(buffer, image), false};
    const float mean = companions.reference && companions.reference->mean > 0 ? companions.reference->mean : 1;
    switch (error_kind(buffer)) {
    case ErrorKind::squared:
        return {rounded_up(mean * mean) * 1e-5f, rounded_up(mean * mean), true};
    case ErrorKind::absolute:
        return {rounded_up(mean) * 1e-3f, rounded_up(mean), true};
    case ErrorKind::relative:
        return {1e-3f, 1, true};
    case ErrorKind::relative_squared:
        break;
    }
    return {1e-4f, 1, true};
}

std::string legend_text(Buffer buffer, const ValueRange& range) {
    const BufferInfo& about = info(buffer);
    const double scale = static_cast<double>(about.unit_scale);
    char text[96];
    std::snprintf(text, sizeof text, "%s: %.4g .. %.4g%s%s%s", about.id, static_cast<double>(range.low) * scale,
                  static_cast<double>(range.high) * scale, *about.unit ? " " : "", about.unit,
                  range.logarithmic ? "  log scale" : "");
    return text;
}

} // namespace tessera
