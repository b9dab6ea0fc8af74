#include "render/run/reference_render.h"

#include "render/io/json_text.h"
#include "render/run/checked_reconstruction.h"
#include "render/run/checkpoint.h"
#include "render/run/picture_identity.h"
#include "render/run/reference_share.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "render/settings/settings_table.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;

/// Reconstructs both halves.
/// @param images_of  returns the images of half 0, then of half 1
template <class ImagesOf>
std::array<RgbImage, 2> reconstructed_halves(const ReferenceRecipe& recipe, ImagesOf&& images_of) {
    const ReconstructionSettings settings = reconstruction_of(recipe);
    std::array<RgbImage, 2> halves;
    for (std::size_t i = 0; i < 2; ++i) {
        const GradientImages images = images_of(i);
        Reconstructor reconstructor; // a cold start keeps the halves independent
        halves[i] = reconstruct_checked(reconstructor, images, settings).image;
    }
    return halves;
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
    settings.path_guiding = Guiding::off;
    return settings;
}

ReconstructionSettings reconstruction_of(const ReferenceRecipe& recipe) {
    return applied(recipe.reconstruction, has_gradients(recipe.settings.method));
}

std::filesystem::path reference_file(const std::filesystem::path& folder, const std::string& scene_name,
                                     glm::ivec2 size, int depth, FilterKind filter) {
    const std::string end = filter == FilterKind::box ? "" : fmt::format("-{}", to_string(filter));
    return folder / fmt::format("{}-{}x{}-d{}{}.exr", scene_name, size.x, size.y, depth, end);
}

std::filesystem::path reference_checkpoint(const std::filesystem::path& output) {
    return output.string() + ".checkpoint";
}

PassRange passes_of(const ReferenceRecipe& recipe) {
    const auto [number, count] = recipe.share;
    const std::int64_t all = (std::int64_t{recipe.spp} + 1) / 2;
    if (number < 1 || number > count)
        throw std::invalid_argument(fmt::format("there is no share {} of {}", number, count));
    if (count > all)
        throw std::invalid_argument(fmt::format("{} shares are too many for {} samples per pixel: the limit is {}",
                                                count, recipe.spp, all));
    const auto begin_of = [&](int share) { return static_cast<int>(all * (share - 1) / count); };
    return {begin_of(number), begin_of(number + 1) - begin_of(number)};
}

ReferenceRender::ReferenceRender(std::filesystem::path output, PictureSubject subject,
                                 const ReferenceRecipe& recipe, ThreadPool& pool)
    : output_(std::move(output)), subject_(std::move(subject)), recipe_(recipe), pool_(pool),
      halves_{half(subject_, recipe, 0), half(subject_, recipe, 1)}, identity_(shard_identity(subject_, recipe)),
      wanted_(recipe.share.is_all() ? recipe.spp : 2 * passes_of(recipe).count) {
    if (recipe.settings.path_guiding != Guiding::off)
        throw std::invalid_argument(
            "references need path guiding off, because their checkpoints do not store what it learns");
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
    const auto halves = reconstructed_halves(recipe_, [&](std::size_t i) { return halves_[i].images(); });
    return measure_reference_error(halves[0], halves[1]);
}

ReferenceImage reference_of(std::array<Render, 2>& halves, const ReferenceRecipe& recipe,
                            const SceneSource& source, const SceneChecksums& scene) {
    ReferenceImage reference;
    UnreliablePixels known(recipe.size);
    reference.halves = reconstructed_halves(recipe, [&](std::size_t i) {
        GradientImages images = halves[i].take_images();
        known.look_at(images);
        return images;
    });
    for (std::size_t i = 0; i < 2; ++i)
        reference.seeds[i] = halves[i].settings().seed;
    reference.mean = mean_of(reference.halves[0], reference.halves[1]);
    reference.doubt = doubt_of(reference.halves, known.unknown());
    const ReconstructionSettings reconstruction = reconstruction_of(recipe);
    auto settings =
        settings_json(source, recipe.settings, recipe.size, halves[0].spp() + halves[1].spp(), reconstruction);
    settings["recon"] = to_string(reconstruction.norm);
    reference.settings = to_text(settings);
    reference.camera = camera_json(halves[0].camera());
    reference.scene = scene;
    return reference;
}

ReferenceImage ReferenceRender::finish() {
    ReferenceImage reference = reference_of(halves_, recipe_, subject_.source,
                                            checksums_of(subject_.scene->description(), subject_.camera));
    write_reference(output_, reference);
    std::filesystem::remove(reference_checkpoint(output_)); // only after the reference is written
    return reference;
}

void ReferenceRender::finish_shard() {
    write_checkpoint(output_, shard_header(subject_, recipe_), memory());
    std::filesystem::remove(reference_checkpoint(output_)); // only after the shard is written
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
            fmt::format("{} is of {}; delete that file to start the reference again", file.string(), what));
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
