#pragma once

#include "recon/image.h"
#include "render/film/albedo_moments.h"
#include "render/film/counters.h"
#include "render/film/pixel_features.h"
#include "render/io/memory.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// Returns e = v / a, theory (27), of radiance v and albedo a, or 0 for a black radiance. A pixel that sees
/// nothing has v = a = 0, so v = a e holds for any e.
inline Rgb coefficient(Rgb radiance, Rgb albedo) {
    return is_black(radiance) ? Rgb(0) : radiance / albedo;
}

/// One pixel's sample of one pass.
struct PixelSample {
    Rgb primal{0};      ///< radiance divided by `albedo`
    Rgb dx{0};          ///< difference of the primals to the pixel on the right
    Rgb dy{0};          ///< difference to the pixel below
    Rgb very_direct{0}; ///< directly visible emission
    Rgb albedo{1};      ///< positive, or black if the pixel sees nothing
    ReuseCounts reuse{};
    float luminance = -1; ///< PathReuse::arriving_luminance() of its base path

    /// Basis components of primal, dx and dy (basis.h). The memory belongs to the caller. Empty without such a
    /// basis or without a neighbour.
    std::span<const Rgb> components{}, components_dx{}, components_dy{};

    /// Radiance minus primal times albedo. It is 0 unless the sample is a mean of several paths or positions,
    /// which have different albedos.
    Rgb beside{0};
    int paths = 1;              ///< number of base paths in that mean
    AlbedoSpread<Rgb> spread{}; ///< of albedo and radiance within that mean; 0 for one path
    float coverage = 1;         ///< alpha: 1, or 0 if the pixel sees nothing; times filter weight

    /// Sets albedo, spread and `beside` of a sample that is a mean and has its primal.
    void set_albedo(const AlbedoMoments<Rgb>& mean) {
        albedo = mean.albedo;
        spread = mean.spread();
        beside = mean.value - primal * albedo;
    }
};

/// Optional contents of a film, besides primal and directly visible emission.
struct FilmBuffers {
    bool gradients = false;
    bool albedo = false;     ///< moments of the albedos by which radiance was divided, and of radiance
    bool reuse = false;      ///< outcomes of shifts
    bool luminance = false;  ///< arriving luminance of the last pass, from which LearnedReuse learns
    bool lamp_edges = false; ///< edges of directly visible emitters
    int components = 0;      ///< basis components of primal and gradients
    bool means = false;      ///< samples may be means (PixelSample::beside)
};

/// Sums of a render's samples. Only the film handles numbers of passes and the image's borders. Sums are doubles,
/// so 10^5 passes neither drift nor overflow. One worker writes each pixel once a pass, so the sums do not depend
/// on the number of threads.
class Film {
    struct Moments {
        glm::dvec3 sum{0};
        double squares = 0; ///< sum of squared lengths of colours

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

    /// Returns the memory that a film takes.
    static std::uint64_t bytes(int width, int height, const FilmBuffers& buffers);

    int width() const { return pixels_.width(); }
    int height() const { return pixels_.height(); }

    /// Adds the sample of pass `pass` at one pixel. Rejects and counts an invalid sample; the film only keeps the
    /// luminance of its base path.
    void add(int x, int y, int pass, const PixelSample& sample, Counters& counters);

    const PixelFeatures& features() const { return features_; }
    /// Adds one feature sample of a pixel in pass `pass`. Rejects and counts an invalid sample.
    void add_feature_sample(int x, int y, int pass, const FeatureSample& sample, Counters& counters);

    /// Replaces the feature samples of each pixel for which `features` has more.
    void take_features(const PixelFeatures& features) { features_.take_more_of(features); }

    /// Assigns the pass to one of the two halves. To be called after each pass.
    void finish(int pass);
    /// Finds, between passes, where the means of so many passes need more feature samples.
    void request_features(int passes) { features_.request_more(passes); }

    /// Adds the sums of another film of the same render, with the same size and buffers and other passes. The bits
    /// depend on the order in which films are added. All films draw the same feature samples: the film that has
    /// more of a pixel keeps them. Path luminances are those of `other`.
    void add(const Film& other);

    /// Returns the projections s^l of a pixel, theory (30): FilmBuffers::parts numbers. set_projection() must set
    /// them before the pixel's first sample.
    const float* projection(int x, int y) const { return projections_.row(y) + x * buffers_.components; }
    void set_projection(int x, int y, const float* numbers) {
        std::copy_n(numbers, buffers_.components, projections_.row(y) + x * buffers_.components);
    }

    /// Marks the pixels on both sides of every edge of `lamps`, an image of directly visible emission with one
    /// more pixel on all four sides. Does nothing without FilmBuffers::lamp_edges. Not during a pass.
    void find_lamp_edges(const RgbImage& lamps);
    bool has_lamp_edge(int x, int y) const { return !lamp_edges_.empty() && lamp_edges_(x, y) != 0; }

    /// Returns means over `passes` complete passes, and their variances if there are at least two passes.
    GradientImages means(int passes) const;
    /// Returns means() at the end of a render. Frees each group of sums before it uses the next one, so all sums
    /// and all means never exist together. The film cannot be used afterwards.
    GradientImages take_means(int passes);
    /// Returns alpha: the covered fraction of each pixel over `passes` complete passes.
    Image<float> coverage(int passes) const;
    /// Returns the outcomes of shifts over `passes` complete passes; empty without reuse.
    ReuseMaps reuse_maps(int passes) const;
    /// Returns PixelSample::luminance of the last pass; empty without FilmBuffers::luminance.
    const Image<float>& path_luminance() const { return luminance_; }
    /// Returns all memory that passes change.
    Memory memory();

private:
    /// Sums of one basis component.
    struct Component {
        Moments primal, dx, dy;

        void operator+=(const Component& other) {
            primal += other.primal;
            dx += other.dx;
            dy += other.dy;
        }
    };

    /// The sample with the largest contribution to a pixel.
    struct Brightest {
        Rgb primal{0}, dx{0}, dy{0};
        Rgb albedo{0};  ///< radiance over primal
        float sign = 1; ///< of its pass in the half differences
        float size = 0; ///< largest |luminance| of primal, dx and dy
    };

    // The half sums are the sums of s_k x_k in reconstruction (41). Floats suffice: their rounding stays far below
    // the noise that half differences measure.

    struct PixelSums {
        Moments primal;
        glm::dvec3 very_direct{0};
        double coverage = 0;
        Rgb half_primal{0};
        std::uint32_t paths = 0; ///< base paths
        Brightest brightest;

        void operator+=(const PixelSums& other);
    };
    struct GradientSums {
        Moments dx, dy;
        Rgb half_dx{0}, half_dy{0};

        void operator+=(const GradientSums& other);
    };
    using AlbedoSums = AlbedoMoments<glm::dvec3>;

    /// Computes half differences, reconstruction (41), from sums. The weights s_k - S / n sum to 0 for every n.
    /// `scale` makes their squares sum to n, as those of the mean do.
    struct HalfWeights {
        double balance = 0; ///< S / n
        double scale = 1;   ///< (1 - S^2 / n^2)^(-1/2)
        int passes = 0;

        /// Returns a half difference.
        /// @param sum  of s_k x_k
        Rgb difference(Rgb sum, const Moments& moments) const {
            return Rgb((glm::dvec3(sum) - balance * moments.sum) * (scale / passes));
        }
        /// Returns the weight of one sample.
        float of_sample(float sign) const {
            return static_cast<float>(scale) * (sign - static_cast<float>(balance));
        }
    };

    bool is_good(const PixelSample& sample) const;
    void add_components(int x, int y, const PixelSample& sample);
    void keep_if_brightest(int x, int y, int pass, const PixelSample& sample);
    HalfWeights half_weights(int passes) const;
    std::vector<BasisComponent> component_means(int passes) const;
    Demodulation demodulation(int passes) const;
    void measure_samples(std::size_t i, int passes, Demodulation& result) const;
    void measure_gradients(int passes, GradientImages& images) const;
    void measure_pixels(int passes, GradientImages& images) const;

    FilmBuffers buffers_;
    Image<PixelSums> pixels_;
    Image<GradientSums> gradients_; ///< empty without gradients; so are those below without their buffers
    Image<AlbedoSums> albedos_;     ///< values are radiance
    Image<glm::dvec3> beside_;      ///< PixelSample::beside
    Image<Component> components_;   ///< FilmBuffers::parts adjacent entries per pixel
    Image<float> projections_;      ///< FilmBuffers::parts adjacent entries per pixel
    Image<ReuseCounts> reuse_;
    Image<float> luminance_;
    Image<std::uint8_t> lamp_edges_;
    PixelFeatures features_;
    int balance_ = 0; ///< passes of the first half minus passes of the second
};

} // namespace tessera
