#include "render/film/film.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// Returns the sign s_k of a pass in reconstruction (41). Of the 2^k passes from pass 2^k on, the first half and
/// the second half are one net each (Pass::random). The difference of two nets shows the noise of the mean; halves
/// that split a net would overestimate it.
float sign_of(int pass) {
    const auto p = static_cast<unsigned>(pass);
    const bool is_second = p == 1 || (p & std::bit_floor(p) >> 1) != 0;
    return is_second ? -1.0f : 1.0f;
}

/// Replaces each entry of `into` by combine(entry, other's entry).
template <class Entry, class Combine>
void combine_entries(Image<Entry>& into, const Image<Entry>& other, Combine combine) {
    std::transform(into.begin(), into.end(), other.begin(), into.begin(), combine);
}

template <class Entry>
void add_entries(Image<Entry>& into, const Image<Entry>& other) {
    combine_entries(into, other, [](Entry a, const Entry& b) {
        a += b;
        return a;
    });
}

} // namespace

void Film::PixelSums::operator+=(const PixelSums& other) {
    primal += other.primal;
    very_direct += other.very_direct;
    coverage += other.coverage;
    half_primal += other.half_primal;
    paths += other.paths;
    if (other.brightest.size > brightest.size)
        brightest = other.brightest;
}

void Film::GradientSums::operator+=(const GradientSums& other) {
    dx += other.dx;
    dy += other.dy;
    half_dx += other.half_dx;
    half_dy += other.half_dy;
}

std::uint64_t Film::bytes(int width, int height, const FilmBuffers& buffers) {
    const std::size_t a_pixel =
        sizeof(PixelSums) + (buffers.gradients ? sizeof(GradientSums) : 0) +
        (buffers.albedo ? sizeof(AlbedoSums) + (buffers.means ? sizeof(glm::dvec3) : 0) : 0) +
        static_cast<std::size_t>(buffers.components) * (sizeof(Component) + sizeof(float)) +
        (buffers.reuse ? sizeof(ReuseCounts) : 0) + (buffers.luminance ? sizeof(float) : 0) +
        (buffers.lamp_edges ? 1 : 0);
    return PixelFeatures::bytes(width, height) +
           static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * a_pixel;
}

Film::Film(int width, int height, const FilmBuffers& buffers)
    : buffers_(buffers), pixels_(width, height), components_(width * buffers.components, height),
      projections_(width * buffers.components, height), features_(width, height, buffers.albedo) {
    if (buffers.gradients)
        gradients_ = Image<GradientSums>(width, height);
    if (buffers.albedo) {
        albedos_ = Image<AlbedoSums>(width, height);
        if (buffers.means)
            beside_ = Image<glm::dvec3>(width, height);
    }
    if (buffers.reuse)
        reuse_ = Image<ReuseCounts>(width, height);
    if (buffers.luminance)
        luminance_ = Image<float>(width, height);
    if (buffers.lamp_edges)
        lamp_edges_ = Image<std::uint8_t>(width, height);
}

bool Film::is_good(const PixelSample& sample) const {
    const auto all_finite = [](std::span<const Rgb> values) { return std::ranges::all_of(values, is_finite); };
    return is_finite(sample.primal) && is_finite(sample.dx) && is_finite(sample.dy) &&
           is_finite(sample.very_direct) && is_finite(sample.albedo) && is_finite(sample.beside) &&
           all_finite(sample.components) && all_finite(sample.components_dx) && all_finite(sample.components_dy);
}

void Film::add_components(int x, int y, const PixelSample& sample) {
    Component* components = components_.row(y) + x * buffers_.components;
    for (std::size_t l = 0; l < sample.components.size(); ++l)
        components[l].primal += sample.components[l];
    for (std::size_t l = 0; l < sample.components_dx.size(); ++l)
        components[l].dx += sample.components_dx[l];
    for (std::size_t l = 0; l < sample.components_dy.size(); ++l)
        components[l].dy += sample.components_dy[l];
}

void Film::keep_if_brightest(int x, int y, int pass, const PixelSample& sample) {
    Brightest found{sample.primal, x + 1 < width() ? sample.dx : Rgb(0), y + 1 < height() ? sample.dy : Rgb(0),
                    sample.albedo, sign_of(pass)};
    for (int c = 0; c < 3; ++c) // includes `beside`, so primal times albedo is the sample's radiance
        if (found.primal[c] != 0)
            found.albedo[c] += sample.beside[c] / found.primal[c];
    for (Rgb c : {found.primal, found.dx, found.dy})
        found.size = std::max(found.size, size_of(c));
    if (Brightest& kept = pixels_(x, y).brightest; found.size > kept.size)
        kept = found;
}

void Film::add(int x, int y, int pass, const PixelSample& sample, Counters& counters) {
    // The base path is valid even if other base paths made the sample invalid.
    if (!luminance_.empty())
        luminance_(x, y) = sample.luminance;
    if (!is_good(sample)) {
        counters.refuse({pass, y, x});
        return;
    }
    if (!reuse_.empty())
        reuse_(x, y) += sample.reuse;
    const float sign = sign_of(pass);
    PixelSums& sums = pixels_(x, y);
    sums.paths += static_cast<std::uint32_t>(sample.paths);
    sums.primal += sample.primal;
    keep_if_brightest(x, y, pass, sample);
    sums.half_primal += sign * sample.primal;
    sums.very_direct += sample.very_direct;
    sums.coverage += sample.coverage;
    if (!albedos_.empty()) {
        const glm::dvec3 a(sample.albedo), v = glm::dvec3(sample.primal) * a + glm::dvec3(sample.beside);
        albedos_(x, y).add(a, v, {glm::dvec3(sample.spread.variance), glm::dvec3(sample.spread.covariance)});
        if (!beside_.empty())
            beside_(x, y) += glm::dvec3(sample.beside);
    }
    if (gradients_.empty())
        return;
    add_components(x, y, sample);
    // The last column and row have no neighbour: their gradients stay 0.
    GradientSums& gradients = gradients_(x, y);
    if (x + 1 < width()) {
        gradients.dx += sample.dx;
        gradients.half_dx += sign * sample.dx;
    }
    if (y + 1 < height()) {
        gradients.dy += sample.dy;
        gradients.half_dy += sign * sample.dy;
    }
}

void Film::add(const Film& other) {
    add_entries(pixels_, other.pixels_);
    add_entries(gradients_, other.gradients_);
    add_entries(albedos_, other.albedos_);
    add_entries(beside_, other.beside_);
    add_entries(components_, other.components_);
    add_entries(reuse_, other.reuse_);
    balance_ += other.balance_;
    features_.take_more_of(other.features_);
    combine_entries(lamp_edges_, other.lamp_edges_,
                    [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
    projections_ = other.projections_; // equal, unless this film has no pass yet
    luminance_ = other.luminance_;
}

void Film::add_feature_sample(int x, int y, int pass, const FeatureSample& sample, Counters& counters) {
    if (!features_.add(x, y, sample))
        counters.refuse({pass, y, x});
}

void Film::finish(int pass) {
    balance_ += static_cast<int>(sign_of(pass));
}

void Film::find_lamp_edges(const RgbImage& lamps) {
    constexpr float noticeable = 0.01f; // of the squared length of the brighter radiance; not tuned
    if (lamp_edges_.empty())
        return;
    const auto mark = [&](int x, int y) {
        if (x >= 0 && y >= 0 && x < width() && y < height())
            lamp_edges_(x, y) = 1;
    };
    const auto compare = [&](int x, int y, int to_x, int to_y) {
        if (to_x < -1 || to_x > width() || to_y > height())
            return;
        const Rgb a = lamps(x + 1, y + 1), b = lamps(to_x + 1, to_y + 1), d = a - b;
        if (glm::dot(d, d) > noticeable * std::max(glm::dot(a, a), glm::dot(b, b))) {
            mark(x, y);
            mark(to_x, to_y);
        }
    };
    for (int y = -1; y <= height(); ++y)
        for (int x = -1; x <= width(); ++x) {
            compare(x, y, x + 1, y);
            for (int to_x = x - 1; to_x <= x + 1; ++to_x)
                compare(x, y, to_x, y + 1);
        }
}

Memory Film::memory() {
    Memory memory{memory_of(pixels_),     memory_of(gradients_),   memory_of(albedos_), memory_of(beside_),
                  memory_of(components_), memory_of(projections_), memory_of(reuse_),   memory_of(luminance_),
                  memory_of(lamp_edges_), memory_of(balance_)};
    append(memory, features_.memory());
    return memory;
}

} // namespace tessera
