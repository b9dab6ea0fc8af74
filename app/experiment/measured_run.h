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

/// How much a render is given.
struct Effort {
    enum class Unit { spp, cpu_seconds, wall_seconds };

    double amount = 64;
    Unit unit = Unit::spp;

    bool operator==(const Effort&) const = default;
};

/// The effort with its unit: "64 spp", "60 CPU s", "60 s".
std::string to_string(const Effort& effort);

/// One picture and its errors. Times are of rendering and of this picture's reconstruction.
struct Measurement {
    int halvings = 0; ///< taken after 1 / 2^halvings of the time or samples that a render is given
    std::uint64_t seed = 0;
    int spp = 0;
    double cpu_seconds = 0, wall_seconds = 0;
    double reconstruction_cpu_seconds = 0; ///< part of cpu_seconds
    double relative_mse = 0;               ///< to the mean of the reference's halves
    FloorFreeError floor_free;
    std::optional<TileSpectrum> tiles; ///< of methods that share light within tiles of two pixels and more
    Counters counters;
    std::optional<Artefacts> artefacts; ///< where they are measured
    std::string machine = {};           ///< the kind of machine that it was rendered on
    // As seen on a screen (recon/metrics/seen_error.h); not numbers in journals from before.
    double psnr = std::numeric_limits<double>::quiet_NaN(); ///< decibels, to the reference's halves
    double flip = std::numeric_limits<double>::quiet_NaN(); ///< in the mean, to the mean of the halves
};

/// The measurement as JSON; numbers that are not finite become null.
nlohmann::ordered_json to_json(const Measurement& measurement);
/// What to_json wrote. Throws nlohmann::json::exception where something is missing.
Measurement measurement_from_json(const nlohmann::json& json);

/// A scene to measure on, and the references it needs.
class MeasuredScene {
public:
    /// One reference for each size and depth of the setups, in `folder`; those that are missing are made by the
    /// recipe, but for its size and depth. Throws BadInput for a file that is not there, and as FolderReference
    /// does.
    MeasuredScene(SceneSource source, const std::vector<Setup>& setups, const std::filesystem::path& folder,
                  const ReferenceRecipe& recipe);

    /// The scene_name of its source.
    const std::string& name() const { return name_; }
    const SceneSource& source() const { return source_; }

    /// Throws std::runtime_error where a missing reference cannot be written.
    void check_writable() const;
    /// Throws BadInput where one of the `count` seeds from `first` on is a reference's.
    void check_seeds(std::uint64_t first, int count) const;
    /// The reference for pictures of these settings.
    FolderReference& reference_for(const PictureSettings& settings) { return references_.at(key_of(settings)); }
    const FolderReference& reference_for(const PictureSettings& settings) const {
        return references_.at(key_of(settings));
    }
    /// Its image, once it is complete.
    const ReferenceImage& reference(const PictureSettings& settings) const;
    /// The references in the order of size and depth.
    std::vector<const FolderReference*> references() const;
    std::vector<FolderReference*> references();

private:
    using Key = std::array<int, 3>; // width, height, depth
    static Key key_of(const PictureSettings& s) { return {s.size.x, s.size.y, s.render.max_depth}; }

    SceneSource source_;
    std::string name_;
    std::map<Key, FolderReference> references_;
};

/// Throws BadInput where two scenes have one name.
void check_names(const std::vector<MeasuredScene>& scenes);

/// A render that is measured on its way, with one or several reconstructions: measuring costs it no time.
class MeasuredRun {
public:
    /// Is measured after effort / 2^i for i from `halvings` down to 0: at the first pass that is not before. Where
    /// one pass is past several of these, only the last counts. Artefacts are measured on demand. Keeps
    /// references to the reference and the pool.
    MeasuredRun(Render render, const Effort& effort, int halvings,
                std::vector<ReconstructionSettings> reconstructions, bool measures_artefacts,
                const ReferenceImage& reference, ThreadPool& pool);

    double done() const; ///< share of the effort; 1 and more: it is at its end
    bool is_done() const { return done() >= 1; }
    /// Makes one more pass, and measures when it is time to.
    void pass();

    /// The measurements of each reconstruction, in the order of time.
    const std::vector<std::vector<Measurement>>& measurements() const { return measurements_; }
    /// The last picture measured, of each reconstruction.
    const std::vector<RgbImage>& images() const { return images_; }
    const Render& render() const { return render_; }

private:
    void measure(int halvings);

    Render render_;
    Effort effort_;
    int next_halvings_; ///< of the measurement to come
    std::vector<ReconstructionSettings> reconstructions_;
    bool measures_artefacts_;
    const ReferenceImage& reference_;
    ThreadPool& pool_;
    std::vector<std::vector<Measurement>> measurements_;
    std::vector<RgbImage> images_;
};

} // namespace tessera
