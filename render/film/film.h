#pragma once

#include "recon/image.h"
#include "render/film/counters.h"
#include "render/film/pixel_looks.h"
#include "render/io/memory.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// e = v / a of radiance v; 0 where nothing is seen, and so both are black: v = a e holds whatever e is.
inline Rgb coefficient(Rgb radiance, Rgb albedo) {
    return is_black(radiance) ? Rgb(0) : radiance / albedo;
}

/// What one pass found at one pixel.
struct PixelSample {
    Rgb primal{0}; ///< radiance over `albedo`
    Rgb dx{0};     ///< of the same, to the pixel on the right
    Rgb dy{0};     ///< to the pixel below
    Rgb very_direct{0};
    Rgb albedo{1}; ///< above 0, or black where nothing is seen
    ReuseCounts reuse{};
    float luminance = -1; ///< PathReuse::arriving_luminance of its base path, which the plan learns from

    /// Of primal, dx and dy the parts by direction (basis.h), in memory that outlives the sample; none: without
    /// such a basis, or no neighbour.
    std::span<const Rgb> parts{}, parts_dx{}, parts_dy{};

    /// Radiance less primal times albedo: other than 0 where the sample is the mean of several paths or
    /// positions, whose light is not divided by one albedo.
    Rgb beside{0};
    int paths = 1; ///< base paths of its own that it is the mean of
    Rgb own{0};    ///< the radiance of these alone, without very direct light; where there are gradients
    /// Within a sample that is such a mean: the variance of the albedo, and its covariance with radiance.
    Rgb albedo_spread{0}, value_spread{0};
};

/// What a film keeps beside primal and very direct light.
struct FilmBuffers {
    bool gradients = false;  ///< and what pixels have of their own paths alone
    bool albedo = false;     ///< what radiance was divided by, and radiance itself
    bool reuse = false;      ///< how sharing went
    bool luminance = false;  ///< for the plan, of the last pass
    bool lamp_edges = false; ///< of the lamps that the camera sees
    int parts = 0;           ///< of primal and gradients
    bool means = false;      ///< samples may be means (PixelSample::beside); paths are counted
};

/// Sums of a render's samples, the only place that knows counts and borders. Sums are kept in double: means are
/// taken when they are asked for, and 10^5 passes neither drift nor overflow. Every pixel is written once a pass,
/// by one worker, so the sums do not depend on the number of threads.
class Film {
    struct Moments {
        glm::dvec3 sum;
        double squares; ///< of the lengths of colours

        void operator+=(Rgb value) {
            const glm::dvec3 v(value);
            sum += v;
            squares += glm::dot(v, v);
        }
        void operator+=(const Moments& other) {
            sum += other.sum;
            squares += other.squares;
        }
    };

public:
    Film(int width, int height, const FilmBuffers& buffers);

    /// The memory that a film takes.
    static std::uint64_t bytes(int width, int height, const FilmBuffers& buffers);

    int width() const { return primal_.width(); }
    int height() const { return primal_.height(); }

    /// Adds the sample of pass `pass` at one pixel. One that is not finite is refused and counted: nothing of it
    /// is kept but its base path's luminance.
    void add(int x, int y, int pass, const PixelSample& sample, Counters& counters);

    const PixelLooks& looks() const { return looks_; }
    /// Adds one more look at a pixel, in pass `pass`. One that is not finite is refused and counted.
    void add_look(int x, int y, int pass, const Look& look, Counters& counters);

    /// Takes looks that were taken before, where it has fewer of its own.
    void take_looks(const PixelLooks& looks) { looks_.take_more_of(looks); }

    /// To be called after each pass: it counts to one half or the other.
    void finish(int pass);
    /// Between passes: finds out where more looks are needed, for the means of so many passes.
    void ask_for_looks(int passes) { looks_.ask_for_more(passes); }

    /// Adds what another film of the same size and buffers has summed, of other passes of the same render. The
    /// bits depend on the order in which films are added. Of albedos, whose points are the same ones in each,
    /// those of the film that has more of a pixel are kept; likewise of luminances the other's.
    void add(const Film& other);

    /// s^l of a pixel, FilmBuffers::parts numbers (basis.h): to be set before its first sample, and never again.
    const float* projection(int x, int y) const { return projections_.row(y) + x * parts_a_pixel_; }
    void set_projection(int x, int y, const float* numbers) {
        std::copy_n(numbers, parts_a_pixel_, projections_.row(y) + x * parts_a_pixel_);
    }

    /// Remembers more edges of lamps, if it keeps them: both sides of every step between pixels side by side of
    /// `lamps`, very direct light with a pixel more than the film on all four sides: an edge may lie in the
    /// outermost pixels. Not during a pass.
    void find_lamp_edges(const RgbImage& lamps);
    bool has_lamp_edge(int x, int y) const { return !lamp_edges_.empty() && lamp_edges_(x, y) != 0; }

    /// Means over `passes` complete passes; of two or more passes, their variances, too.
    GradientImages means(int passes) const;
    /// means() at the end of a render: gives each sum's memory up before the next is looked at, so that sums and
    /// means are never all there together. The film is then good for nothing more.
    GradientImages take_means(int passes);
    /// How sharing went over `passes` complete passes; empty where pixels share nothing.
    ReuseMaps reuse_maps(int passes) const;
    /// PixelSample::luminance of the last pass; empty where it is not kept.
    const Image<float>& path_luminance() const { return luminance_; }
    /// All that it has summed.
    Memory memory();

private:
    struct Part {
        Moments primal, dx, dy;

        void operator+=(const Part& other) {
            primal += other.primal;
            dx += other.dx;
            dy += other.dy;
        }
    };

    /// Sums over one half of the passes less those over the other. (They do not grow with the passes: floats will
    /// do.)
    struct Difference {
        Rgb primal{0}, dx{0}, dy{0};

        void operator+=(const Difference& other) {
            primal += other.primal;
            dx += other.dx;
            dy += other.dy;
        }
    };

    /// The sample that brought most to a pixel: primal, gradients, and its radiance over the primal.
    struct Brightest {
        Rgb primal{0}, dx{0}, dy{0}, albedo{0};
        float sign = 1; ///< of its pass in Difference
        float size = 0; ///< the largest luminance of its primal and gradients, whatever their signs
    };

    bool is_good(const PixelSample& sample) const;
    void add_parts(int x, int y, const PixelSample& sample);
    void remember_if_brightest(int x, int y, int pass, const PixelSample& sample);
    BrightestSamples brightest_samples(int passes) const;
    HalfDifferences half_differences(int passes) const;
    double share_of_balance(int passes) const { return passes > 0 ? static_cast<double>(balance_) / passes : 0; }
    double scale_of_halves(int passes) const;
    std::vector<CoefficientPart> part_means(int passes) const;
    Demodulation demodulation(int passes) const;
    void measure_samples(std::size_t i, int passes, Demodulation& result) const;

    Image<Moments> primal_, dx_, dy_;
    Image<Brightest> brightest_;
    Image<Difference> differences_;
    int balance_ = 0; // passes of the one half less those of the other
    PixelLooks looks_;
    Image<glm::dvec3> value_, sampled_albedo_, albedo_squares_, albedo_values_; // v, a, a^2 and a v per channel
    Image<std::uint32_t> paths_; // of their own that pixels have taken
    Image<glm::dvec3> beside_;   // what of v is not e a
    Image<glm::dvec3> own_;      // PixelSample::own
    int parts_a_pixel_;
    Image<Part> parts_;        // those of a pixel side by side
    Image<float> projections_; // likewise
    Image<glm::dvec3> very_direct_;
    Image<ReuseCounts> reuse_;
    Image<float> luminance_;
    Image<std::uint8_t> lamp_edges_;
};

} // namespace tessera
