#include "tests/support/z_scores.h"

#include "recon/picture/reconstruct.h"
#include "render/run/render.h"
#include "render/scene/scene.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {

namespace {

struct Moments {
    Image<glm::dvec3> sum, squares;

    void add(const RgbImage& image) {
        if (sum.empty()) {
            sum = Image<glm::dvec3>(image.width(), image.height());
            squares = sum;
        }
        for (std::size_t i = 0; i < image.size(); ++i) {
            const glm::dvec3 v = image.data()[i];
            sum.data()[i] += v;
            squares.data()[i] += v * v;
        }
    }

    Measured result(int runs) const {
        Measured m{RgbImage(sum.width(), sum.height()), RgbImage(sum.width(), sum.height())};
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const glm::dvec3 mean = sum.data()[i] / double(runs);
            const glm::dvec3 variance =
                glm::max(squares.data()[i] / double(runs) - mean * mean, 0.0) / (runs - 1.0);
            m.mean.data()[i] = Rgb(mean);
            m.standard_error.data()[i] = Rgb(glm::sqrt(variance));
        }
        return m;
    }
};

/// Returns the |z| that a standard normal variable exceeds with this probability.
double normal_limit(double probability) {
    double low = 0, high = 40;
    while (high - low > 1e-6) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) > probability ? low : high) = middle;
    }
    return high;
}

double sharing_fraction(const ReuseMaps& maps) {
    const auto reusing = std::ranges::count_if(maps.reuse_set_size, [](float size) { return size > 1; });
    return maps.reuse_set_size.empty()
               ? 0
               : static_cast<double>(reusing) / static_cast<double>(maps.reuse_set_size.size());
}

} // namespace

MethodMeasured measure(std::shared_ptr<const Scene> scene, glm::ivec2 size, const RenderSettings& settings,
                       int runs, int passes, std::span<const Norm> norms) {
    ThreadPool pool(2);
    Moments primal, very_direct, dx, dy, coefficient;
    std::map<Norm, Moments> pictures;
    MethodMeasured measured;
    Reconstructor reconstructor;
    for (int run = 0; run < runs; ++run) {
        RenderSettings s = settings;
        s.seed = settings.seed + static_cast<std::uint64_t>(run);
        Render render(scene, scene->camera(), size, s);
        for (int pass = 0; pass < passes; ++pass)
            render.pass(pool);
        const GradientImages images = render.images();
        primal.add(images.radiance());
        very_direct.add(images.very_direct);
        if (images.has_gradients()) {
            if (!images.demodulation.empty())
                coefficient.add(images.primal);
            dx.add(images.dx);
            dy.add(images.dy);
        }
        for (const Norm norm : norms)
            if (applied(norm, images.has_gradients()) == norm &&
                guarantee_of(norm).convergence == Convergence::unbiased)
                pictures[norm].add(reconstructor.reconstruct(images, {.norm = norm}).image);
        if (run + 1 == runs)
            measured.sharing = sharing_fraction(render.reuse_maps());
    }
    measured.primal = primal.result(runs);
    measured.very_direct = very_direct.result(runs);
    measured.dx = dx.result(runs);
    measured.dy = dy.result(runs);
    measured.coefficient = coefficient.result(runs);
    for (const auto& [norm, moments] : pictures)
        measured.pictures[norm] = moments.result(runs);
    return measured;
}

ZResult z_test(const Measured& a, const Measured& b) {
    ZResult r;
    double squares = 0;
    double sum = 0;
    // The rounding errors of solvers are proportional to the whole picture's brightness, also in black pixels.
    double brightness = 0;
    for (const Rgb& value : b.mean)
        for (int c = 0; c < 3; ++c)
            brightness += std::abs(double(value[c])) / (3.0 * double(b.mean.size()));
    for (std::size_t i = 0; i < a.mean.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double difference = double(a.mean.data()[i][c]) - b.mean.data()[i][c];
            const double error = std::hypot(a.standard_error.data()[i][c], b.standard_error.data()[i][c]);
            const double scale = std::abs(a.mean.data()[i][c]) + std::abs(b.mean.data()[i][c]);
            const double rounding = 1e-6 * (scale + brightness) + 1e-12;
            const double z = difference / std::max(error, rounding);
            r.largest = std::max(r.largest, std::abs(z));
            squares += z * z;
            sum += z;
            ++r.count;
        }
    r.mean_square = squares / r.count;
    r.shift = sum / r.count;
    r.limit = normal_limit(1e-4 / r.count);
    return r;
}

bool ZResult::passes() const {
    // Channels and neighbours share paths, so the effective number of tests counts as a tenth (not tuned).
    const double effective = count / 10.0;
    return largest < 1.15 * limit && mean_square < 1 + 6 * std::sqrt(2 / effective) &&
           std::abs(shift) < 5 / std::sqrt(effective);
}

std::string ZResult::to_string() const {
    return fmt::format("largest |z| {:.2f} (limit {:.2f}), mean z^2 {:.2f}, mean z {:+.2f}, {} values", largest,
                       limit, mean_square, shift, count);
}

namespace {

Measured difference(const Measured& m, int sx, int sy) {
    Measured d{RgbImage(m.mean.width(), m.mean.height()), RgbImage(m.mean.width(), m.mean.height())};
    for (int y = 0; y + sy < m.mean.height(); ++y)
        for (int x = 0; x + sx < m.mean.width(); ++x) {
            const Rgb e0 = m.standard_error(x, y), e1 = m.standard_error(x + sx, y + sy);
            d.mean(x, y) = m.mean(x + sx, y + sy) - m.mean(x, y);
            d.standard_error(x, y) = glm::sqrt(e0 * e0 + e1 * e1);
        }
    return d;
}

} // namespace

Measured sum(const Measured& a, const Measured& b) {
    Measured s = a;
    for (std::size_t i = 0; i < s.mean.size(); ++i) {
        s.mean.data()[i] += b.mean.data()[i];
        const Rgb e0 = a.standard_error.data()[i], e1 = b.standard_error.data()[i];
        s.standard_error.data()[i] = glm::sqrt(e0 * e0 + e1 * e1);
    }
    return s;
}
Measured difference_x(const Measured& image) {
    return difference(image, 1, 0);
}
Measured difference_y(const Measured& image) {
    return difference(image, 0, 1);
}

} // namespace tessera::test
