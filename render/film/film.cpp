#include "render/film/film.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// How a pass counts in Film::Difference: of one half or the other. Of 2^k passes from pass 2^k on, the first half
/// and the second are a net each (Pass::random), and as independent of each other as nets are: how far they differ
/// tells the noise. (By halves that tear what lies evenly together it is told half as large again as it is.)
float sign_of(int pass) {
    const auto p = static_cast<unsigned>(pass);
    const bool is_second = p == 1 || (p & std::bit_floor(p) >> 1) != 0;
    return is_second ? -1.0f : 1.0f;
}

/// What two entries at the same place become, in the first image.
template <class Entry, class Join>
void join(Image<Entry>& into, const Image<Entry>& other, Join joined) {
    std::transform(into.begin(), into.end(), other.begin(), into.begin(), joined);
}

template <class Entry>
void add_entries(Image<Entry>& into, const Image<Entry>& other) {
    join(into, other, [](Entry a, const Entry& b) {
        a += b;
        return a;
    });
}

} // namespace

std::uint64_t Film::bytes(int width, int height, const FilmBuffers& buffers) {
    const std::size_t a_pixel =
        sizeof(Moments) * (buffers.gradients ? 3 : 1) + (buffers.gradients ? sizeof(glm::dvec3) : 0) +
        sizeof(Brightest) + sizeof(Difference) + sizeof(glm::dvec3) +
        (buffers.albedo ? (buffers.means ? 5 : 4) * sizeof(glm::dvec3) : 0) +
        static_cast<std::size_t>(buffers.parts) * (sizeof(Part) + sizeof(float)) +
        (buffers.reuse ? sizeof(ReuseCounts) : 0) + (buffers.means ? sizeof(std::uint32_t) : 0) +
        (buffers.luminance ? sizeof(float) : 0) + (buffers.lamp_edges ? 1 : 0);
    return PixelLooks::bytes(width, height) +
           static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * a_pixel;
}

Film::Film(int width, int height, const FilmBuffers& buffers)
    : primal_(width, height), brightest_(width, height), differences_(width, height),
      looks_(width, height, buffers.albedo), parts_a_pixel_(buffers.parts), parts_(width * buffers.parts, height),
      projections_(width * buffers.parts, height), very_direct_(width, height) {
    if (buffers.gradients) {
        dx_ = Image<Moments>(width, height);
        dy_ = Image<Moments>(width, height);
        own_ = Image<glm::dvec3>(width, height);
    }
    if (buffers.albedo) {
        value_ = sampled_albedo_ = albedo_squares_ = albedo_values_ = Image<glm::dvec3>(width, height);
        if (buffers.means)
            beside_ = Image<glm::dvec3>(width, height);
    }
    if (buffers.means)
        paths_ = Image<std::uint32_t>(width, height);
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
           is_finite(sample.own) && all_finite(sample.parts) && all_finite(sample.parts_dx) &&
           all_finite(sample.parts_dy);
}

void Film::add_parts(int x, int y, const PixelSample& sample) {
    Part* parts = parts_.row(y) + x * parts_a_pixel_;
    for (std::size_t l = 0; l < sample.parts.size(); ++l)
        parts[l].primal += sample.parts[l];
    for (std::size_t l = 0; l < sample.parts_dx.size(); ++l)
        parts[l].dx += sample.parts_dx[l];
    for (std::size_t l = 0; l < sample.parts_dy.size(); ++l)
        parts[l].dy += sample.parts_dy[l];
}

void Film::remember_if_brightest(int x, int y, int pass, const PixelSample& sample) {
    Brightest found{sample.primal, x + 1 < width() ? sample.dx : Rgb(0), y + 1 < height() ? sample.dy : Rgb(0),
                    sample.albedo, sign_of(pass)};
    for (int c = 0; c < 3; ++c) // so that primal times albedo is its radiance, of a mean of paths, too
        if (found.primal[c] > 0)
            found.albedo[c] += sample.beside[c] / found.primal[c];
    for (Rgb c : {found.primal, found.dx, found.dy})
        found.size = std::max(found.size, size_of(c));
    if (Brightest& kept = brightest_(x, y); found.size > kept.size)
        kept = found;
}

void Film::add(int x, int y, int pass, const PixelSample& sample, Counters& counters) {
    if (!luminance_.empty()) // it is its base path's alone, and finite, whatever the others brought
        luminance_(x, y) = sample.luminance;
    if (!is_good(sample)) {
        counters.refuse({pass, y, x});
        return;
    }
    if (!reuse_.empty())
        reuse_(x, y) += sample.reuse;
    if (!paths_.empty())
        paths_(x, y) += static_cast<std::uint32_t>(sample.paths);
    primal_(x, y) += sample.primal;
    remember_if_brightest(x, y, pass, sample);
    const float sign = sign_of(pass);
    differences_(x, y).primal += sign * sample.primal;
    very_direct_(x, y) += sample.very_direct;
    if (!value_.empty()) {
        const glm::dvec3 a(sample.albedo), v = glm::dvec3(sample.primal) * a + glm::dvec3(sample.beside);
        value_(x, y) += v;
        if (!beside_.empty())
            beside_(x, y) += glm::dvec3(sample.beside);
        sampled_albedo_(x, y) += a;
        albedo_squares_(x, y) += a * a + glm::dvec3(sample.albedo_spread);
        albedo_values_(x, y) += a * v + glm::dvec3(sample.value_spread);
    }
    if (dx_.empty())
        return;
    own_(x, y) += glm::dvec3(sample.own);
    add_parts(x, y, sample);
    // The last column and row have no neighbour: their gradients stay 0.
    if (x + 1 < width()) {
        dx_(x, y) += sample.dx;
        differences_(x, y).dx += sign * sample.dx;
    }
    if (y + 1 < height()) {
        dy_(x, y) += sample.dy;
        differences_(x, y).dy += sign * sample.dy;
    }
}

void Film::add(const Film& other) {
    for (Image<Moments> Film::*sums : {&Film::primal_, &Film::dx_, &Film::dy_})
        add_entries(this->*sums, other.*sums);
    for (Image<glm::dvec3> Film::*sums : {&Film::value_, &Film::sampled_albedo_, &Film::albedo_squares_,
                                          &Film::albedo_values_, &Film::beside_, &Film::own_, &Film::very_direct_})
        add_entries(this->*sums, other.*sums);
    add_entries(parts_, other.parts_);
    add_entries(paths_, other.paths_);
    add_entries(differences_, other.differences_);
    balance_ += other.balance_;
    add_entries(reuse_, other.reuse_);
    join(brightest_, other.brightest_,
         [](const Brightest& a, const Brightest& b) { return b.size > a.size ? b : a; });
    looks_.take_more_of(other.looks_);
    join(lamp_edges_, other.lamp_edges_,
         [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
    projections_ = other.projections_; // the same ones, where this film has had a pass
    luminance_ = other.luminance_;
}

void Film::add_look(int x, int y, int pass, const Look& look, Counters& counters) {
    if (!looks_.add(x, y, look))
        counters.refuse({pass, y, x});
}

void Film::finish(int pass) {
    balance_ += static_cast<int>(sign_of(pass));
}

void Film::find_lamp_edges(const RgbImage& lamps) {
    constexpr float noticeable = 0.01f; // of a squared radiance
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
    Memory memory{memory_of(primal_),
                  memory_of(very_direct_),
                  memory_of(dx_),
                  memory_of(dy_),
                  memory_of(brightest_),
                  memory_of(value_),
                  memory_of(sampled_albedo_),
                  memory_of(albedo_squares_),
                  memory_of(albedo_values_),
                  memory_of(beside_),
                  memory_of(own_),
                  memory_of(paths_),
                  memory_of(parts_),
                  memory_of(projections_),
                  memory_of(reuse_),
                  memory_of(luminance_),
                  memory_of(lamp_edges_),
                  memory_of(differences_),
                  memory_of(balance_)};
    append(memory, looks_.memory());
    return memory;
}

} // namespace tessera
