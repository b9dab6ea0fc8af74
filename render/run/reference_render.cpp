#include "render/run/reference_render.h"

#include "render/io/json_text.h"
#include "render/run/checkpoint.h"
#include "render/run/fitting_reconstruction.h"
#include "render/run/picture_identity.h"
#include "render/run/reference_share.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;

/// The pictures of both halves, by the norm of a recipe that serves best.
struct Halves {
    std::array<RgbImage, 2> images;
    Norm norm = Norm::none;
};

/// By how much two pictures of the same differ: relMSE with an epsilon in units of their own brightness, so that
/// which of several pairs differ less does not depend on the unit of light.
double difference_of(const std::array<RgbImage, 2>& halves) {
    double brightness = 0;
    for (const RgbImage& half : halves)
        for (Rgb c : half)
            brightness += static_cast<double>(luminance(c)) / static_cast<double>(2 * half.size());
    const double epsilon = relative_mse_epsilon * brightness * brightness;
    double sum = 0;
    for (std::size_t i = 0; i < halves[0].size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const auto a = static_cast<double>(halves[0].data()[i][c]),
                       b = static_cast<double>(halves[1].data()[i][c]);
            if (const double scale = (a + b) * (a + b) / 4 + epsilon; scale > 0)
                sum += (a - b) * (a - b) / scale;
        }
    return sum;
}

/// What there is to choose from: without gradients all norms make the same picture.
std::vector<Norm> norms_of(const ReferenceRecipe& recipe) {
    return has_gradients(recipe.settings.method) ? recipe.norms : std::vector{Norm::none};
}

/// @param images_of  of half 0, then of half 1, to be reconstructed
template <class ImagesOf>
Halves best_halves(const ReferenceRecipe& recipe, ImagesOf&& images_of) {
    const std::vector<Norm> norms = norms_of(recipe);
    std::vector<Halves> candidates(norms.size());
    for (std::size_t i = 0; i < 2; ++i) {
        const GradientImages images = images_of(i);
        for (std::size_t n = 0; n < candidates.size(); ++n) {
            ReconstructionSettings settings = recipe.reconstruction;
            settings.norm = candidates[n].norm = norms[n];
            Reconstructor reconstructor;
            candidates[n].images[i] = reconstruct_if_it_fits(reconstructor, images, settings).image;
        }
    }
    if (candidates.size() == 1)
        return std::move(candidates.front());
    return std::move(*std::min_element(candidates.begin(), candidates.end(), [](const Halves& a, const Halves& b) {
        return difference_of(a.images) < difference_of(b.images);
    }));
}

Render half(const PictureSubject& subject, const ReferenceRecipe& recipe, unsigned i) {
    RenderSettings settings = recipe.settings;
    settings.seed += i;
    return Render(subject.scene, subject.camera, recipe.size, settings, passes_of(recipe).first);
}

} // namespace

RenderSettings reference_settings() {
    RenderSettings settings;
    settings.method = Method::gpr;
    settings.tile = 8;
    settings.seed = first_reference_seed;
    settings.path_guiding = Guiding::off; // what it learns is in no checkpoint
    return settings;
}

std::filesystem::path reference_file(const std::filesystem::path& folder, const std::string& scene_name,
                                     glm::ivec2 size, int depth) {
    return folder / fmt::format("{}-{}x{}-d{}.exr", scene_name, size.x, size.y, depth);
}

std::filesystem::path reference_checkpoint(const std::filesystem::path& output) {
    return output.string() + ".checkpoint";
}

PassRange passes_of(const ReferenceRecipe& recipe) {
    const auto [number, count] = recipe.share;
    const std::int64_t all = (std::int64_t{recipe.spp} + 1) / 2;
    if (number < 1 || number > count)
        throw std::invalid_argument(fmt::format("share {} of {}: there is none", number, count));
    if (count > all)
        throw std::invalid_argument(fmt::format(
            "{} shares of {} samples a pixel: at most {}, one a sample of each half", count, recipe.spp, all));
    const auto begin_of = [&](int share) { return static_cast<int>(all * (share - 1) / count); };
    return {begin_of(number), begin_of(number + 1) - begin_of(number)};
}

ReferenceRender::ReferenceRender(std::filesystem::path output, PictureSubject subject,
                                 const ReferenceRecipe& recipe, ThreadPool& pool)
    : output_(std::move(output)), subject_(std::move(subject)), recipe_(recipe),
      pool_(pool), halves_{half(subject_, recipe, 0), half(subject_, recipe, 1)},
      identity_(share_identity(subject_, recipe)),
      wanted_(recipe.share.is_all() ? recipe.spp : 2 * passes_of(recipe).count) {
    if (recipe.settings.path_guiding != Guiding::off)
        throw std::invalid_argument("path guiding is not off: references are made without it, as what they would have "
                                    "learnt is not in their checkpoints");
    if (std::filesystem::exists(reference_checkpoint(output_)))
        resume();
}

bool ReferenceRender::run(const Watch& watch, const std::stop_token& stop) {
    auto last = Clock::now();
    while (!is_complete()) {
        Render& behind = halves_[halves_[1].spp() < halves_[0].spp()];
        if (!watch(*this) || !behind.pass(pool_, stop)) {
            write();
            return false;
        }
        if (std::chrono::duration<double>(Clock::now() - last).count() >= recipe_.checkpoint_seconds) {
            write();
            last = Clock::now();
        }
    }
    return true;
}

double ReferenceRender::seconds_left() const {
    const int done = spp() - spp_resumed_;
    return done == 0 ? std::numeric_limits<double>::infinity() : seconds() / done * (wanted_ - spp());
}

FloorFreeError ReferenceRender::error_so_far() const {
    const Halves best = best_halves(recipe_, [&](std::size_t i) { return halves_[i].images(); });
    return measure_reference_error(best.images[0], best.images[1]);
}

ReferenceImage reference_of(std::array<Render, 2>& halves, const ReferenceRecipe& recipe,
                            const SceneSource& source, const SceneChecksums& scene) {
    ReferenceImage reference;
    KnownPixels known(recipe.size);
    Halves best = best_halves(recipe, [&](std::size_t i) {
        GradientImages images = halves[i].take_images();
        known.look_at(images);
        return images;
    });
    for (std::size_t i = 0; i < 2; ++i) {
        reference.halves[i] = std::move(best.images[i]);
        reference.seeds[i] = halves[i].settings().seed;
    }
    reference.mean = mean_of(reference.halves[0], reference.halves[1]);
    reference.doubt = doubt_of(reference.halves, known.unknown());
    ReconstructionSettings reconstruction = recipe.reconstruction;
    reconstruction.norm = best.norm;
    auto settings =
        settings_json(source, recipe.settings, recipe.size, halves[0].spp() + halves[1].spp(), reconstruction);
    settings["recon"] = to_string(best.norm);
    reference.settings = to_text(settings);
    reference.camera = camera_json(halves[0].camera());
    reference.scene = scene;
    return reference;
}

ReferenceImage ReferenceRender::finish() {
    ReferenceImage reference = reference_of(halves_, recipe_, subject_.source,
                                            checksums_of(subject_.scene->description(), subject_.camera));
    write_reference(output_, reference);
    std::filesystem::remove(reference_checkpoint(output_)); // not before the picture is there
    return reference;
}

void ReferenceRender::finish_share() {
    write_checkpoint(output_, share_header(subject_, recipe_), memory());
    std::filesystem::remove(reference_checkpoint(output_)); // not before the share is there
}

Memory ReferenceRender::memory() {
    Memory memory = halves_[0].memory();
    append(memory, halves_[1].memory());
    return memory;
}

void ReferenceRender::write() {
    write_checkpoint(reference_checkpoint(output_), identity_, memory());
}

void ReferenceRender::resume() {
    const std::filesystem::path file = reference_checkpoint(output_);
    const Checkpoint checkpoint = read_checkpoint(file);
    const auto refuse = [&](const std::string& what) {
        throw std::runtime_error(
            fmt::format("{} is of {}; without that file the reference is begun anew", file.string(), what));
    };
    if (const std::string difference = identity_difference(checkpoint.identity, identity_); !difference.empty())
        refuse(difference);
    if (!fits(checkpoint, memory()))
        refuse("another version of the program");
    restore(checkpoint, memory());
    if (spp() > wanted_ + 1)
        throw std::runtime_error(
            fmt::format("{} has {} spp already, and {} are asked for", file.string(), spp(), wanted_));
    spp_resumed_ = spp();
    seconds_resumed_ = seconds_of_halves();
}

} // namespace tessera
