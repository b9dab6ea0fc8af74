#include "render/estimator/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr double largest_variance = std::numeric_limits<float>::max();

/// An image of sum / passes, where `sum_of` gives the sum of an entry.
template <class Entry, class SumOf>
RgbImage means_of(const Image<Entry>& entries, int passes, SumOf sum_of) {
    RgbImage image(entries.width(), entries.height());
    const double scale = passes > 0 ? 1.0 / passes : 0.0;
    std::transform(entries.begin(), entries.end(), image.begin(),
                   [&](const Entry& entry) { return Rgb(sum_of(entry) * scale); });
    return image;
}

/// Of a mean over n, from the sample variance (squares - |sum|^2 / n) / (n - 1).
template <class Moments>
float variance_of(const Moments& m, double n) {
    const double spread = m.squares - glm::dot(m.sum, m.sum) / n; // below 0 by rounding alone
    return static_cast<float>(std::clamp(spread / (n * (n - 1)), 0.0, largest_variance));
}

/// The means and their variances.
template <class Moments>
void measure(const Image<Moments>& moments, int passes, RgbImage& mean, Image<float>& variance) {
    mean = means_of(moments, passes, [](const Moments& m) { return m.sum; });
    variance = {};
    if (passes < 2)
        return;
    variance = Image<float>(moments.width(), moments.height());
    std::transform(moments.begin(), moments.end(), variance.begin(),
                   [passes](const Moments& m) { return variance_of(m, passes); });
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
        sizeof(Moments) * (buffers.gradients ? 3 : 1) + sizeof(Brightest) + sizeof(glm::dvec3) +
        (buffers.albedo ? sizeof(AlbedoPoints) + (buffers.means ? 5 : 4) * sizeof(glm::dvec3) : 0) +
        static_cast<std::size_t>(buffers.parts) * (sizeof(Part) + sizeof(float)) +
        (buffers.reuse ? sizeof(ReuseCounts) : 0) + (buffers.means ? sizeof(std::uint32_t) : 0) +
        (buffers.luminance ? sizeof(float) : 0) + (buffers.lamp_edges ? 1 : 0);
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * a_pixel;
}

Film::Film(int width, int height, const FilmBuffers& buffers)
    : primal_(width, height), brightest_(width, height), parts_a_pixel_(buffers.parts),
      parts_(width * buffers.parts, height), projections_(width * buffers.parts, height),
      very_direct_(width, height) {
    if (buffers.gradients) {
        dx_ = Image<Moments>(width, height);
        dy_ = Image<Moments>(width, height);
    }
    if (buffers.albedo) {
        albedo_ = Image<AlbedoPoints>(width, height);
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
           all_finite(sample.parts) && all_finite(sample.parts_dx) && all_finite(sample.parts_dy);
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

void Film::remember_if_brightest(int x, int y, const PixelSample& sample) {
    Brightest found{sample.primal, x + 1 < width() ? sample.dx : Rgb(0), y + 1 < height() ? sample.dy : Rgb(0),
                    sample.albedo};
    for (int c = 0; c < 3; ++c) // so that primal times albedo is its radiance, of a mean of paths, too
        if (found.primal[c] > 0)
            found.albedo[c] += sample.beside[c] / found.primal[c];
    for (Rgb c : {found.primal, found.dx, found.dy})
        found.size = std::max(found.size, luminance(glm::abs(c)));
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
    remember_if_brightest(x, y, sample);
    very_direct_(x, y) += sample.very_direct;
    if (keeps_albedo()) {
        const glm::dvec3 a(sample.albedo), v = glm::dvec3(sample.primal) * a + glm::dvec3(sample.beside);
        value_(x, y) += v;
        if (!beside_.empty())
            beside_(x, y) += glm::dvec3(sample.beside);
        sampled_albedo_(x, y) += a;
        albedo_squares_(x, y) += a * a;
        albedo_values_(x, y) += a * v;
    }
    if (dx_.empty())
        return;
    add_parts(x, y, sample);
    // The last column and row have no neighbour: their gradients stay 0.
    if (x + 1 < width())
        dx_(x, y) += sample.dx;
    if (y + 1 < height())
        dy_(x, y) += sample.dy;
}

void Film::add(const Film& other) {
    for (Image<Moments> Film::*sums : {&Film::primal_, &Film::dx_, &Film::dy_})
        add_entries(this->*sums, other.*sums);
    for (Image<glm::dvec3> Film::*sums : {&Film::value_, &Film::sampled_albedo_, &Film::albedo_squares_,
                                          &Film::albedo_values_, &Film::beside_, &Film::very_direct_})
        add_entries(this->*sums, other.*sums);
    add_entries(parts_, other.parts_);
    add_entries(paths_, other.paths_);
    add_entries(reuse_, other.reuse_);
    join(brightest_, other.brightest_,
         [](const Brightest& a, const Brightest& b) { return b.size > a.size ? b : a; });
    join(albedo_, other.albedo_,
         [](const AlbedoPoints& a, const AlbedoPoints& b) { return b.count > a.count ? b : a; });
    join(lamp_edges_, other.lamp_edges_,
         [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
    projections_ = other.projections_; // the same ones, where this film has had a pass
    luminance_ = other.luminance_;
}

void Film::add_albedo(int x, int y, int pass, Rgb albedo, Counters& counters) {
    const bool is_good = is_finite(albedo);
    if (!is_good)
        counters.refuse({pass, y, x});
    albedo_(x, y).add(is_good ? albedo : Rgb(0));
}

void Film::find_lamp_edges(const RgbImage& lamps) {
    constexpr float noticeable = 0.01f; // of a squared radiance
    if (lamp_edges_.empty())
        return;
    const auto compare = [&](int x, int y, int to_x, int to_y) {
        if (to_x < 0 || to_x >= width() || to_y >= height())
            return;
        const Rgb a = lamps(x, y), b = lamps(to_x, to_y), d = a - b;
        if (glm::dot(d, d) > noticeable * std::max(glm::dot(a, a), glm::dot(b, b)))
            lamp_edges_(x, y) = lamp_edges_(to_x, to_y) = 1;
    };
    for (int y = 0; y < height(); ++y)
        for (int x = 0; x < width(); ++x) {
            compare(x, y, x + 1, y);
            for (int to_x = x - 1; to_x <= x + 1; ++to_x)
                compare(x, y, to_x, y + 1);
        }
}

double Film::AlbedoPoints::variance() const {
    const double n = count;
    return count > 1 ? std::max(moments.squares - glm::dot(moments.sum, moments.sum) / n, 0.0) / (n - 1) : 0;
}

double Film::AlbedoPoints::mean_square() const {
    return count > 0 ? glm::dot(moments.sum, moments.sum) / (static_cast<double>(count) * count) : 0;
}

void Film::AlbedoPoints::operator+=(const AlbedoPoints& other) {
    moments.sum += other.moments.sum;
    moments.squares += other.moments.squares;
    count += other.count;
}

void Film::ask_for_albedo(int passes) {
    // The albedo's relative variance is to be well below that of the light, of which a sample has about 0.1 to 1
    // before the pixels around help. Tried on stability's texture: 0.002 is as good, 0.015 costs a fifth more
    // time.
    constexpr double enough_of_one = 0.004;
    constexpr double most = 16;
    const double enough = enough_of_one / passes;
    for (int y = 0; y < albedo_.height(); ++y)
        for (int x = 0; x < albedo_.width(); ++x) {
            // A few points of one pixel may well be alike by chance: the pixels around tell, too.
            AlbedoPoints around;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height() - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width() - 1); ++i)
                    around += albedo_(i, j);
            AlbedoPoints& here = albedo_(x, y);
            const double spread = around.variance() / std::max(around.mean_square(), 1e-30);
            here.more = static_cast<int>(std::clamp(std::pow(spread / enough, 2 / 3.0) - here.count, 0.0, most));
        }
}

/// How albedo, value and coefficient of entry i changed from sample to sample. With S for sums over products of
/// differences to the means, the coefficient that follows the albedo explains S_ea^2 / S_aa of S_ee; a v / a is v.
void Film::measure_samples(std::size_t i, int passes, Demodulation& result) const {
    const double n = passes;
    const glm::dvec3 a = sampled_albedo_.data()[i] / n, v = value_.data()[i] / n, e = primal_.data()[i].sum / n;
    const glm::dvec3 beside = beside_.empty() ? glm::dvec3(0) : beside_.data()[i] / n;
    const glm::dvec3 variance = glm::max(albedo_squares_.data()[i] / n - a * a, 0.0); // below 0 by rounding alone
    const glm::dvec3 with_value = albedo_values_.data()[i] / n - a * v, with_light = v - beside - a * e;
    const double all = primal_.data()[i].squares - n * glm::dot(e, e);
    double explained = 0;
    for (int c = 0; c < 3; ++c)
        explained += variance[c] > 0 ? n * with_light[c] * with_light[c] / variance[c] : 0;
    result.sampled_variance.data()[i] = Rgb(variance);
    result.value_covariance.data()[i] = Rgb(with_value);
    result.unexplained_variance.data()[i] =
        static_cast<float>(std::clamp((all - explained) / (n * std::max(n - 2, 1.0)), 0.0, largest_variance));
}

Demodulation Film::demodulation(int passes) const {
    if (!keeps_albedo())
        return {};
    const auto sum = [](const glm::dvec3& s) { return s; };
    const RgbImage black(albedo_.width(), albedo_.height());
    const Image<float> none(albedo_.width(), albedo_.height());
    Demodulation result{means_of(value_, passes, sum),
                        black,
                        means_of(sampled_albedo_, passes, sum),
                        none,
                        none,
                        black,
                        black,
                        none};
    const double samples = std::pow(passes, 1.5);
    for (std::size_t i = 0; i < albedo_.size(); ++i) {
        const AlbedoPoints& points = albedo_.data()[i];
        result.albedo.data()[i] = Rgb(points.moments.sum / static_cast<double>(std::max(points.count, 1)));
        result.albedo_variance.data()[i] = static_cast<float>(points.variance());
        result.sampled_share.data()[i] = static_cast<float>(samples / (samples + std::pow(points.count, 1.5)));
        if (passes > 1)
            measure_samples(i, passes, result);
    }
    return result;
}

std::vector<CoefficientPart> Film::part_means(int passes) const {
    const RgbImage black(width(), height());
    const Image<float> none = passes > 1 ? Image<float>(width(), height()) : Image<float>();
    std::vector<CoefficientPart> result;
    const double scale = passes > 0 ? 1.0 / passes : 0.0;
    for (int l = 0; l < parts_a_pixel_; ++l) {
        CoefficientPart& part =
            result.emplace_back(Image<float>(width(), height()), black, black, black, none, none, none);
        for (int y = 0; y < height(); ++y)
            for (int x = 0; x < width(); ++x) {
                const Part& sums = parts_(x * parts_a_pixel_ + l, y);
                part.projection(x, y) = projection(x, y)[l];
                part.primal(x, y) = Rgb(sums.primal.sum * scale);
                part.dx(x, y) = Rgb(sums.dx.sum * scale);
                part.dy(x, y) = Rgb(sums.dy.sum * scale);
                if (passes < 2)
                    continue;
                part.primal_variance(x, y) = variance_of(sums.primal, passes);
                part.dx_variance(x, y) = variance_of(sums.dx, passes);
                part.dy_variance(x, y) = variance_of(sums.dy, passes);
            }
    }
    return result;
}

BrightestSamples Film::brightest_samples(int passes) const {
    const auto image_of = [this](Rgb Brightest::*part) {
        RgbImage image(width(), height());
        std::transform(brightest_.begin(), brightest_.end(), image.begin(),
                       [part](const Brightest& b) { return b.*part; });
        return image;
    };
    const bool has_gradients = !dx_.empty();
    return {image_of(&Brightest::primal), has_gradients ? image_of(&Brightest::dx) : RgbImage(),
            has_gradients ? image_of(&Brightest::dy) : RgbImage(),
            keeps_albedo() ? image_of(&Brightest::albedo) : RgbImage(), passes};
}

GradientImages Film::means(int passes) const {
    GradientImages images;
    measure(primal_, passes, images.primal, images.primal_variance);
    measure(dx_, passes, images.dx, images.dx_variance);
    measure(dy_, passes, images.dy, images.dy_variance);
    images.parts = part_means(passes);
    images.demodulation = demodulation(passes);
    images.very_direct = means_of(very_direct_, passes, [](const glm::dvec3& sum) { return sum; });
    images.brightest = brightest_samples(passes);
    return images;
}

GradientImages Film::take_means(int passes) {
    reuse_ = {};
    paths_ = {};
    luminance_ = {};
    GradientImages images;
    images.parts = part_means(passes);
    parts_ = {};
    images.brightest = brightest_samples(passes);
    brightest_ = {};
    const auto take = [passes](Image<Moments>& moments, RgbImage& mean, Image<float>& variance) {
        measure(moments, passes, mean, variance);
        moments = {};
    };
    take(dx_, images.dx, images.dx_variance);
    take(dy_, images.dy, images.dy_variance);
    images.demodulation = demodulation(passes);
    albedo_ = {};
    value_ = sampled_albedo_ = albedo_squares_ = albedo_values_ = beside_ = {};
    take(primal_, images.primal, images.primal_variance);
    images.very_direct = means_of(very_direct_, passes, [](const glm::dvec3& sum) { return sum; });
    return images;
}

ReuseMaps Film::reuse_maps(int passes) const {
    ReuseMaps maps{reuse_, passes};
    maps.paths = Image<float>(paths_.width(), paths_.height());
    std::ranges::transform(paths_, maps.paths.begin(), [](std::uint32_t n) { return static_cast<float>(n); });
    return maps;
}

Image<float> Film::noise(int passes) const {
    constexpr double floor = 0.03; // of the mean
    double sum = 0;
    for (const Moments& m : primal_)
        sum += static_cast<double>(luminance(Rgb(m.sum / double(passes))));
    const double least = floor * sum / static_cast<double>(primal_.size());
    Image<float> noise(width(), height());
    std::transform(primal_.begin(), primal_.end(), noise.begin(), [&](const Moments& m) {
        const double bright = static_cast<double>(std::max(luminance(Rgb(m.sum / double(passes))), 0.0f)) + least;
        return bright > 0 ? static_cast<float>(std::sqrt(static_cast<double>(variance_of(m, passes))) / bright)
                          : 0;
    });
    return noise;
}

Memory Film::memory() {
    return {memory_of(primal_),         memory_of(very_direct_),   memory_of(dx_),     memory_of(dy_),
            memory_of(brightest_),      memory_of(albedo_),        memory_of(value_),  memory_of(sampled_albedo_),
            memory_of(albedo_squares_), memory_of(albedo_values_), memory_of(beside_), memory_of(paths_),
            memory_of(parts_),          memory_of(projections_),   memory_of(reuse_),  memory_of(luminance_),
            memory_of(lamp_edges_)};
}

} // namespace tessera
