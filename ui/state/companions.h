#pragma once

#include "recon/image.h"
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
    float mean = 0; ///< of its luminance
    /// Two renders that are independent of each other, whose mean is the image: errors against both are free of
    /// the reference's own (recon/metrics/metrics.h). Empty: it has none, and how noisy it is is not known.
    std::array<RgbImage, 2> halves{};
    std::size_t not_finite = 0;            ///< pixels that errors cannot be measured at
    std::optional<SceneChecksums> scene{}; ///< what it shows; empty: its file does not say
};

/// What some buffers are made of beside a pane's snapshot; null: there is none.
struct Companions {
    std::shared_ptr<const Reference> reference;
    std::shared_ptr<const FirstHits> first_hits; ///< of the camera and size that the panes show or showed before
    bool first_hits_are_earlier = false; ///< they are of what was shown before: newer ones are on their way
    /// Which part of coefficients and their gradients is shown in place of these (GradientImages::parts); null:
    /// none.
    std::shared_ptr<const int> part{};
};

/// How far each pixel of an image I is from a reference r; the mean of the three channels' figures.
enum class ErrorKind {
    relative_squared, ///< (I - r)^2 / (r^2 + relative_mse_epsilon): its mean over the pixels is relMSE
    squared,          ///< (I - r)^2
    absolute,         ///< |I - r|
    relative,         ///< |I - r| / (|r| + mape_epsilon)
};

float pixel_error(ErrorKind kind, const Rgb& value, const Rgb& reference);

inline bool same_size(const RgbImage& a, const RgbImage& b) {
    return a.width() == b.width() && a.height() == b.height();
}

/// The errors of all pixels; both images have one size.
RgbImage error_map(ErrorKind kind, const RgbImage& image, const RgbImage& reference);

/// How the luminances of an image are spread, on a logarithmic scale.
struct Histogram {
    static constexpr int first_stop = -12, last_stop = 8, bins_a_stop = 6; // log2 of radiance
    static constexpr int bin_count = (last_stop - first_stop) * bins_a_stop;

    std::array<std::size_t, bin_count> bins{}; ///< what is beyond the ends is in the first and the last
    std::size_t black = 0, negative = 0, not_finite = 0;

    /// The luminance with which a bin begins.
    static float low_end(int bin);
};

Histogram histogram_of(const RgbImage& image);

/// How far a picture is from a reference.
struct PictureError {
    double relative_mse = 0;
    double standard_error = 0;  ///< of it; not a number where the reference has no halves
    std::size_t not_finite = 0; ///< pixels left out, in either
};

/// Measures against both halves of a reference that has them, where its own error cancels
/// (measure_floor_free_error); otherwise against its image, from which no picture can be less far than that is
/// from the truth. Empty: they differ in size, or nothing is finite.
std::optional<PictureError> error_to(const Reference& reference, const RgbImage& picture);

/// What a chart of errors to it must tell beside its points; empty: nothing.
std::string caveat_of(const Reference& reference);

/// A reference from the layers of a file. `halves` that are not both of the image's size are dropped.
std::shared_ptr<const Reference> make_reference(std::string name, RgbImage image, std::array<RgbImage, 2> halves,
                                                std::optional<SceneChecksums> scene = {});

/// How far a picture was from the reference, or by an estimate samples from the truth, after so much work.
struct ErrorPoint {
    int spp = 0;                                                      ///< samples a pixel
    double seconds = 0;                                               ///< wall time of the pane's passes
    double error = 0;                                                 ///< relMSE
    double standard_error = std::numeric_limits<double>::quiet_NaN(); ///< of it; not a number: not known
    std::size_t not_finite = 0; ///< pixels left out of it, as they or the reference's are not finite
};

/// How the shifts had ended after so much work.
struct ShiftPoint {
    int spp = 0;
    double seconds = 0;
    std::array<double, shift_outcome_count> shares{}; ///< of all shifts so far, [0, 1]
    Method method = Method::gpr;                      ///< that made them
};

/// The points of one render in the order of its passes: the newest always, older ones as far apart as a
/// logarithmic chart can show.
template <class Point>
class PassHistory {
public:
    void add(const Point& point) {
        const std::size_t n = points_.size();
        const bool replaces = n > 0 && point.spp <= points_.back().spp; // as does a reconstruction made anew
        const bool is_dense = n > 1 && points_[n - 1].spp < least_step * points_[n - 2].spp;
        if (replaces || is_dense)
            points_.back() = point;
        else
            points_.push_back(point);
    }
    void clear() { points_.clear(); }
    const std::vector<Point>& points() const { return points_; }

private:
    static constexpr double least_step = 1.04; // in samples: some 60 points a decade
    std::vector<Point> points_;
};

/// The errors of a pane's pictures that were made in one way: a line of the chart.
struct ErrorCurve {
    Method method = Method::gpr;
    ReconstructionSettings reconstruction; ///< its norm is applied()
    PassHistory<ErrorPoint> history;

    const std::vector<ErrorPoint>& points() const { return history.points(); }
};

} // namespace tessera
