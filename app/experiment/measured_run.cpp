#include "app/experiment/measured_run.h"

#include "app/cli/opened_scene.h"
#include "app/cli/terminal.h"
#include "recon/metrics/halo.h"
#include "recon/metrics/seen_error.h"
#include "render/run/checked_reconstruction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

namespace tessera {

MeasuredScene::MeasuredScene(SceneSource source, const std::vector<Setup>& setups,
                             const std::filesystem::path& folder, const ReferenceRecipe& recipe)
    : source_(std::move(source)), name_(scene_name(source_)) {
    check_scene_file(source_.file);
    for (const Setup& setup : setups) {
        const Key key = key_of(setup.settings);
        if (references_.count(key))
            continue;
        ReferenceRecipe of_setup = recipe;
        of_setup.size = setup.settings.size;
        of_setup.settings.max_depth = setup.settings.render.max_depth;
        of_setup.settings.filter = setup.settings.render.filter;
        references_.emplace(key, FolderReference(folder, name_, of_setup));
    }
}

void MeasuredScene::check_writable() const {
    for (const auto& [key, reference] : references_)
        reference.check_writable();
}

void MeasuredScene::check_seeds(std::uint64_t first, int count) const {
    for (const auto& [key, reference] : references_)
        for (std::uint64_t seed : reference.seeds())
            if (seed - first < static_cast<std::uint64_t>(count))
                throw BadInput(fmt::format("seed {} is also a seed of {}: errors against it would be too small",
                                           seed, reference.path().string()));
}

const ReferenceImage& MeasuredScene::reference(const PictureSettings& settings) const {
    return references_.at(key_of(settings)).image();
}

std::vector<const FolderReference*> MeasuredScene::references() const {
    std::vector<const FolderReference*> all;
    for (const auto& [key, reference] : references_)
        all.push_back(&reference);
    return all;
}

std::vector<FolderReference*> MeasuredScene::references() {
    std::vector<FolderReference*> all;
    for (auto& [key, reference] : references_)
        all.push_back(&reference);
    return all;
}

void check_names(const std::vector<MeasuredScene>& scenes) {
    std::map<std::string, std::filesystem::path> files;
    for (const MeasuredScene& scene : scenes)
        if (const auto [other, is_new] = files.emplace(scene.name(), scene.source().file); !is_new)
            throw BadInput(fmt::format("{} and {} are both named \"{}\"", other->second.string(),
                                       scene.source().file.string(), scene.name()));
}

namespace {

/// Returns the tile spectrum of the error; empty if the method has no tiles or the image is too small.
std::optional<TileSpectrum> tiles_of(const RgbImage& image, const RgbImage& reference, const RenderSettings& s) {
    const bool is_large = std::min(image.width(), image.height()) >= 4 * s.tile;
    if (!reuses_paths(s.method) || s.tile < 2 || !is_large)
        return {};
    return measure_tile_spectrum(image, reference, s.tile);
}

} // namespace

MeasuredRun::MeasuredRun(Render render, const Effort& effort, int halvings,
                         std::vector<ReconstructionSettings> reconstructions, bool measures_artefacts,
                         const ReferenceImage& reference, ThreadPool& pool)
    : render_(std::move(render)), effort_(effort), next_halvings_(halvings),
      reconstructions_(std::move(reconstructions)), measures_artefacts_(measures_artefacts), reference_(reference),
      pool_(pool), measurements_(reconstructions_.size()), images_(reconstructions_.size()) {}

double MeasuredRun::done() const {
    switch (effort_.unit) {
    case Effort::Unit::spp:
        return render_.spp() / effort_.amount;
    case Effort::Unit::cpu_seconds:
        return render_.cpu_seconds() / effort_.amount;
    case Effort::Unit::wall_seconds:
        return render_.seconds() / effort_.amount;
    }
    return 1;
}

void MeasuredRun::pass() {
    render_.pass(pool_);
    int reached = next_halvings_ + 1; // none reached
    while (reached > 0 && done() >= std::ldexp(1, 1 - reached))
        --reached;
    if (reached > next_halvings_)
        return;
    measure(reached);
    next_halvings_ = reached - 1;
}

void MeasuredRun::measure(int halvings) {
    const ParallelFor parallel_for = pool_.row_loops();
    const GradientImages buffers = render_.images();
    for (std::size_t i = 0; i < reconstructions_.size(); ++i) {
        const double cpu = process_cpu_seconds();
        Reconstructor reconstructor;
        Reconstruction r =
            reconstruct_checked(reconstructor, buffers, reconstructions_[i], parallel_for, pool_.size());
        const double reconstruction_cpu = process_cpu_seconds() - cpu;
        measurements_[i].push_back({halvings,
                                    render_.settings().seed,
                                    render_.spp(),
                                    render_.cpu_seconds() + reconstruction_cpu,
                                    render_.seconds() + r.seconds,
                                    reconstruction_cpu,
                                    measure_error(r.image, reference_.mean).relative_mse,
                                    measure_floor_free_error(r.image, reference_.halves[0], reference_.halves[1]),
                                    tiles_of(r.image, reference_.mean, render_.settings()),
                                    render_.counters(),
                                    {}});
        Measurement& m = measurements_[i].back();
        m.psnr = psnr(r.image, reference_.halves[0], reference_.halves[1]);
        m.flip = mean_flip(r.image, reference_.mean, parallel_for);
        if (measures_artefacts_) {
            Artefacts artefacts = measure_artefacts(r.image, reference_.halves[0], reference_.halves[1]);
            if (const auto halo = measure_halo(buffers, reconstructions_[i], parallel_for)) {
                artefacts.halo_energy = halo->energy;
                artefacts.halo_peak = halo->peak;
            }
            m.artefacts = std::move(artefacts);
        }
        images_[i] = std::move(r.image);
    }
}

} // namespace tessera
