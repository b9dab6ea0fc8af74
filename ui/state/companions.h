#pragma once

#include "recon/image.h"
#include "recon/metrics/error_map.h"
#include "recon/picture/reconstruct.h"
#include "render/film/counters.h"
#include "render/scene/scene_checksums.h"
#include "render/settings/settings.h"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

struct FirstHits;

/// The image that errors are measured against.
struct Reference {
    std::string name; ///< of its file
    RgbImage image;
    float mean = 0; ///< mean luminance
    /// Two independent renders whose mean is `image`. Errors against both are free of the reference's own error
    /// (recon/metrics/metrics.h). Empty: there are none, and the reference's noise is unknown.
    std::array<RgbImage, 2> halves{};
    std::size_t not_finite = 0;            ///< number of pixels without finite values, which errors leave out
    std::optional<SceneChecksums> scene{}; ///< checksums of its scene; empty: its file has none
};

/// Inputs of some buffers in addition to a pane's snapshot; null: missing.
struct Companions {
    std::shared_ptr<const Reference> reference;
    std::shared_ptr<const FirstHits> first_hits;
    bool first_hits_are_earlier =
        false; ///< first_hits are of a previous camera or size, until new ones are traced
    /// Index of the basis component that is shown of coefficients and gradients (GradientImages::parts); null:
    /// the whole.
    std::shared_ptr<const int> component{};
};

inline bool same_size(const RgbImage& a, const RgbImage& b) {
    return a.width() == b.width() && a.height() == b.height();
}

/// Histogram of an image's luminances on a logarithmic scale.
struct Histogram {
    static constexpr int first_stop = -12, last_stop = 8, bins_a_stop = 6; // log2 of radiance
    static constexpr int bin_count = (last_stop - first_stop) * bins_a_stop;

    std::array<std::size_t, bin_count> bins{}; ///< the first and last also count values beyond the ends
    std::size_t black = 0, negative = 0, not_finite = 0;

    /// Returns the lower end of a bin, a luminance.
    static float low_end(int bin);
};

Histogram histogram_of(const RgbImage& image);

/// Error of a picture relative to a reference.
struct PictureError {
    double relative_mse = 0;
    double standard_error = 0;  ///< of relative_mse; NaN for a reference without halves
    std::size_t not_finite = 0; ///< number of pixels left out, because the picture or the reference is not finite
};

/// Measures the error of a picture. Uses both halves of a reference that has them, where the reference's own
/// error cancels (measure_floor_free_error); otherwise the result includes the reference's error. Empty: the
/// sizes differ, or no pixel is finite.
std::optional<PictureError> error_to(const Reference& reference, const RgbImage& picture);

/// Returns the caveat that a chart of errors against this reference must show; empty: none.
std::string reference_caveat(const Reference& reference);

/// Makes a reference from the layers of a file. Drops `halves` unless both have the image's size.
std::shared_ptr<const Reference> make_reference(std::string name, RgbImage image, std::array<RgbImage, 2> halves,
                                                std::optional<SceneChecksums> scene = {});

/// Error of a pane's picture at some pass: measured against the reference, or estimated from the samples.
struct ErrorPoint {
    int spp = 0;                                                      ///< samples per pixel
    double seconds = 0;                                               ///< wall time of the pane's passes
    double error = 0;                                                 ///< relMSE
    double standard_error = std::numeric_limits<double>::quiet_NaN(); ///< of error; NaN: unknown
    std::size_t not_finite = 0; ///< number of pixels left out, because picture or reference are not finite
};

/// Outcomes of a pane's shifts at some pass.
struct ShiftPoint {
    int spp = 0;
    double seconds = 0;
    std::array<double, shift_outcome_count> shares{}; ///< fraction of all shifts so far by outcome, [0, 1]
    Method method = Method::gpr;
};

/// Points of one render in the order of its passes. Keeps the newest, and older ones only as dense as a
/// logarithmic chart shows them.
template <class Point>
class PassHistory {
public:
    void add(const Point& point) {
        const std::size_t n = points_.size();
        const bool replaces = n > 0 && point.spp <= points_.back().spp; // a repeated reconstruction
        const bool is_dense = n > 1 && points_[n - 1].spp < least_step * points_[n - 2].spp;
        if (replaces || is_dense)
            points_.back() = point;
        else
            points_.push_back(point);
    }
    void clear() { points_.clear(); }
    const std::vector<Point>& points() const { return points_; }

private:
    static constexpr double least_step = 1.04; // ratio of spp between points: about 60 points per decade
    std::vector<Point> points_;
};

/// Errors of a pane's pictures by one method and reconstruction: a line of the chart.
struct ErrorCurve {
    Method method = Method::gpr;
    ReconstructionSettings reconstruction; ///< after applied()
    PassHistory<ErrorPoint> history;

    const std::vector<ErrorPoint>& points() const { return history.points(); }
};

} // namespace tessera
