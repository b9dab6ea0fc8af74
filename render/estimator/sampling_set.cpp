#include "render/estimator/sampling_set.h"

namespace tessera {

void SamplingSet::assign(PixelRect rect) {
    clear();
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            add(x, y);
}

void SamplingSet::expand(const Film& film) {
    components.resize(static_cast<std::size_t>(size() * arriving.components()));
    for (int i = 0; arriving.is_kept() && i < size(); ++i) {
        const glm::ivec2 p = pixels[i];
        Rgb* const first = components.data() + i * arriving.components();
        arriving.expand(i, tessera::coefficient(radiance[i], albedo[i]), film.projection(p.x, p.y), first);
        for (int l = 0; l < arriving.components(); ++l)
            first[l] *= weight(i);
    }
}

void SamplingSet::count(std::span<const ShiftOutcome> outcomes, int k) {
    for (std::size_t m = 0; m < outcomes.size(); ++m)
        if (m != static_cast<std::size_t>(k))
            ++reuse[m].shifts[static_cast<std::size_t>(outcomes[m])];
}

void SamplingSet::count(const ReuseDecision& decision, int k) {
    ReuseCounts& of_path = reuse[k];
    if (!decision.is_dark())
        ++(decision.survives() ? of_path.reused : of_path.skipped);
}

void SetMeans::begin(PixelRect area, int components) {
    area_ = area;
    component_count_ = static_cast<std::size_t>(components);
    const auto pixels = static_cast<std::size_t>(area.width()) * static_cast<std::size_t>(area.height());
    pixels_.assign(pixels, {});
    for (std::vector<Rgb>* sums : {&components_, &components_dx_, &components_dy_})
        sums->assign(pixels * component_count_, Rgb(0));
}

void SetMeans::add(const SamplingSet& set, PixelRect all) {
    for (int i = 0; i < set.size(); ++i) {
        const glm::ivec2 p = set.pixels[i];
        if (!area_.contains(p))
            continue;
        const std::size_t at = index(p.x, p.y);
        Pixel& pixel = pixels_[at];
        pixel.reuse += set.reuse[i];
        add(set, {}, i, pixel.primal, components_at(components_, at));
        if (set.positions > 1)
            see(set, i, pixel);
        if (p.x + 1 < all.x1)
            add(set, i, i + 1, pixel.dx, components_at(components_dx_, at));
        if (p.y + 1 < all.y1)
            add(set, i, i + all.width(), pixel.dy, components_at(components_dy_, at));
    }
}

/// Updates running means, which cannot overflow as sums can. The sets of the first position set the weights; the
/// sets of other positions add with the same weights.
void SetMeans::add(const SamplingSet& set, std::optional<int> from, int to, Mean& mean,
                   std::span<Rgb> components) {
    const auto pixels = static_cast<float>(set.size());
    if (set.position == 0)
        mean.pixels += pixels;
    const float share = pixels / mean.pixels, kept = set.position == 0 ? 1 - share : 1;
    const auto move = [=](Rgb& value, Rgb here, Rgb there) { value = value * kept + (there - here) * share; };
    move(mean.value, from ? set.coefficient(*from) : Rgb(0), set.coefficient(to));
    for (std::size_t l = 0; l < components.size(); ++l)
        move(components[l], from ? set.components_of(*from)[l] : Rgb(0), set.components_of(to)[l]);
}

/// To be called after add() of the primal.
void SetMeans::see(const SamplingSet& set, int i, Pixel& pixel) {
    const auto entry = static_cast<std::size_t>(i);
    const float share = static_cast<float>(set.size()) / pixel.primal.pixels,
                kept = set.position == 0 ? 1 - share : 1, seen_share = share / static_cast<float>(set.positions);
    Seen& seen = pixel.seen;
    seen.moments *= kept;
    seen.moments.add(set.albedo[entry], set.radiance[entry], seen_share, share * set.weight(i));
    seen.very_direct = seen.very_direct * kept + set.paths[entry]->very_direct * seen_share;
    // Means over positions that all saw the same would differ from it by rounding.
    pixel.is_mixed = pixel.is_mixed || set.paths[entry] != set.base[entry];
}

void SetMeans::take_primal(int x, int y, PixelSample& sample) const {
    const std::size_t at = index(x, y);
    const Pixel& pixel = pixels_[at];
    sample.primal = pixel.primal.value;
    sample.components = components_at(components_, at);
    if (!pixel.is_mixed)
        return;
    sample.very_direct = pixel.seen.very_direct;
    sample.set_albedo(pixel.seen.moments);
}

void SetMeans::take_gradients(int x, int y, PixelSample& sample) const {
    const std::size_t at = index(x, y);
    const Pixel& pixel = pixels_[at];
    sample.dx = pixel.dx.value;
    sample.dy = pixel.dy.value;
    sample.components_dx = components_at(components_dx_, at);
    sample.components_dy = components_at(components_dy_, at);
}

} // namespace tessera
