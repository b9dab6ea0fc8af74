#pragma once

#include "app/experiment/artefacts.h"
#include "app/experiment/references.h"
#include "app/experiment/setup.h"
#include "recon/metrics/metrics.h"
#include "recon/picture/reconstruct.h"
#include "render/film/counters.h"
#include "render/run/reference_image.h"
#include "render/run/render.h"

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// Time or number of samples of a render.
struct Effort {
    enum class Unit { spp, cpu_seconds, wall_seconds };

    double amount = 64;
    Unit unit = Unit::spp;

    bool operator==(const Effort&) const = default;
};

/// Formats the effort: "64 spp", "60 CPU s", "60 s".
std::string to_string(const Effort& effort);

/// Errors of one picture. Times include rendering and this picture's reconstruction.
struct Measurement {
    int halvings = 0; ///< measured at 1 / 2^halvings of the render's effort
    std::uint64_t seed = 0;
    int spp = 0;
    double cpu_seconds = 0, wall_seconds = 0;
    double reconstruction_cpu_seconds = 0; ///< contained in cpu_seconds
    double relative_mse = 0;               ///< relMSE against the mean of the reference's halves
    FloorFreeError floor_free;
    std::optional<TileSpectrum> tiles; ///< of methods that reuse paths within tiles; empty: too few tiles
    Counters counters;
    std::optional<Artefacts> artefacts; ///< empty: not measured
    std::string machine = {};           ///< kind of the machine that rendered it
    // Errors of the displayed picture (recon/metrics/seen_error.h); NaN in journals that lack them.
    double psnr = std::numeric_limits<double>::quiet_NaN(); ///< dB, against the reference's halves
    double flip = std::numeric_limits<double>::quiet_NaN(); ///< mean over pixels, against the mean of the halves
};

/// Converts a measurement to JSON; numbers that are not finite become null.
nlohmann::ordered_json to_json(const Measurement& measurement);
/// Parses the output of to_json. Throws nlohmann::json::exception if a required key is missing.
Measurement measurement_from_json(const nlohmann::json& json);

/// A scene of an experiment with its references.
class MeasuredScene {
public:
    /// Creates one reference for each size, depth and filter of the setups, in `folder`. Missing references use
    /// the recipe with these. Throws BadInput if the scene file does not exist, and as FolderReference does.
    MeasuredScene(SceneSource source, const std::vector<Setup>& setups, const std::filesystem::path& folder,
                  const ReferenceRecipe& recipe);

    /// Returns the scene_name of the source.
    const std::string& name() const { return name_; }
    const SceneSource& source() const { return source_; }

    /// Throws std::runtime_error if a missing reference cannot be written.
    void check_writable() const;
    /// Throws BadInput if one of the `count` seeds from `first` on is also a seed of a reference.
    void check_seeds(std::uint64_t first, int count) const;
    /// Returns the reference for pictures of these settings.
    FolderReference& reference_for(const PictureSettings& settings) { return references_.at(key_of(settings)); }
    const FolderReference& reference_for(const PictureSettings& settings) const {
        return references_.at(key_of(settings));
    }
    /// Returns the image of that reference, which must be complete.
    const ReferenceImage& reference(const PictureSettings& settings) const;
    /// Returns the references in order of size, depth and filter.
    std::vector<const FolderReference*> references() const;
    std::vector<FolderReference*> references();

private:
    using Key = std::array<int, 4>; // width, height, depth, filter
    static Key key_of(const PictureSettings& s) {
        return {s.size.x, s.size.y, s.render.max_depth, static_cast<int>(s.render.filter)};
    }

    SceneSource source_;
    std::string name_;
    std::map<Key, FolderReference> references_;
};

/// Throws BadInput if two scenes have the same name.
void check_names(const std::vector<MeasuredScene>& scenes);

/// A render whose errors are measured while it progresses, with one or several reconstructions. The time of the
/// measurements does not count as render time.
class MeasuredRun {
public:
    /// Errors are measured at the first pass at or after effort / 2^i, for i from `halvings` down to 0. If one
    /// pass crosses several of these points, only the last is recorded. Keeps references to `reference` and
    /// `pool`.
    MeasuredRun(Render render, const Effort& effort, int halvings,
                std::vector<ReconstructionSettings> reconstructions, bool measures_artefacts,
                const ReferenceImage& reference, ThreadPool& pool);

    double done() const; ///< completed fraction of the effort; may exceed 1
    bool is_done() const { return done() >= 1; }
    /// Renders one pass, and measures errors if it reaches the next point.
    void pass();

    /// Returns the measurements of each reconstruction, in order of time.
    const std::vector<std::vector<Measurement>>& measurements() const { return measurements_; }
    /// Returns the last measured picture of each reconstruction.
    const std::vector<RgbImage>& images() const { return images_; }
    const Render& render() const { return render_; }

private:
    void measure(int halvings);

    Render render_;
    Effort effort_;
    int next_halvings_; ///< halvings of the next measurement
    std::vector<ReconstructionSettings> reconstructions_;
    bool measures_artefacts_;
    const ReferenceImage& reference_;
    ThreadPool& pool_;
    std::vector<std::vector<Measurement>> measurements_;
    std::vector<RgbImage> images_;
};

} // namespace tessera
