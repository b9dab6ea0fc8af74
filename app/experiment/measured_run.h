#pragma once

#include "app/experiment/measurement.h"
#include "app/experiment/references.h"
#include "app/experiment/setup.h"
#include "recon/reconstruct.h"
#include "render/run/reference_image.h"
#include "render/run/render.h"

#include <map>
#include <memory>
#include <vector>

namespace tessera {

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
    /// Renders what references are missing. False: Ctrl-C ended it.
    bool make_references(const std::shared_ptr<const Scene>& scene, ThreadPool& pool);

    const ReferenceImage& reference(const PictureSettings& settings) const;
    /// The references in the order of size and depth.
    std::vector<const FolderReference*> references() const;

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
