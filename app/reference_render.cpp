#include "app/reference_render.h"

#include "app/exit_codes.h"
#include "app/interrupt.h"
#include "app/picture_identity.h"
#include "app/progress.h"
#include "app/stats.h"
#include "render/session/checkpoint.h"
#include "render/session/render.h"

#include <chrono>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;

/// The two halves, and the file from which they go on.
class ReferenceRender {
public:
    ReferenceRender(const std::filesystem::path& output, const SceneSource& source,
                    const std::shared_ptr<const Scene>& scene, const ReferenceRecipe& recipe, ThreadPool& pool)
        : file_(output.string() + ".checkpoint"), recipe_(recipe),
          pool_(pool), halves_{half(scene, recipe, 0), half(scene, recipe, 1)},
          identity_(picture_identity(source, scene, recipe.settings, recipe.size, pool)) {
        if (std::filesystem::exists(file_))
            resume();
    }

    /// False: Ctrl-C ended it.
    bool run() {
        Progress progress("reference");
        const double seconds_before = seconds();
        const int spp_before = spp();
        auto last = Clock::now();
        while (spp() < recipe_.spp && !interrupted()) {
            for (Render& half : halves_)
                half.pass(pool_);
            if (std::chrono::duration<double>(Clock::now() - last).count() >= recipe_.checkpoint_seconds) {
                write();
                last = Clock::now();
            }
            progress.update(static_cast<double>(spp() - spp_before) / (recipe_.spp - spp_before),
                            seconds() - seconds_before, fmt::format("{} of {} spp", spp(), recipe_.spp));
        }
        if (spp() < recipe_.spp)
            write();
        return spp() >= recipe_.spp;
    }

    ReferenceImage take(const SceneSource& source) {
        for (const Render& half : halves_)
            if (const std::string warning = refused_text(half.counters(), half.settings().seed); !warning.empty())
                fmt::print(stderr, "warning: {}\n", warning);
        ReferenceImage reference;
        const nlohmann::json settings =
            settings_json(source, recipe_.settings, recipe_.size, spp(), recipe_.reconstruction.alpha);
        reference.settings = settings.dump();
        for (std::size_t i = 0; i < 2; ++i) {
            reference.halves[i] = reconstruct(halves_[i].take_images(), recipe_.reconstruction).image;
            reference.seeds[i] = halves_[i].settings().seed;
        }
        reference.mean = mean_of(reference.halves[0], reference.halves[1]);
        return reference;
    }

    void remove_checkpoint() const { std::filesystem::remove(file_); }

private:
    static Render half(const std::shared_ptr<const Scene>& scene, const ReferenceRecipe& recipe, unsigned i) {
        RenderSettings settings = recipe.settings;
        settings.seed += i;
        return Render(scene, scene->camera(), recipe.size, settings);
    }

    int spp() const { return halves_[0].spp() + halves_[1].spp(); }
    double seconds() const { return halves_[0].seconds() + halves_[1].seconds(); }

    Memory memory() {
        Memory memory = halves_[0].memory();
        append(memory, halves_[1].memory());
        return memory;
    }

    void write() { write_checkpoint(file_, identity_, memory()); }

    void resume() {
        const Checkpoint checkpoint = read_checkpoint(file_);
        if (const std::string difference = identity_difference(checkpoint.identity, identity_);
            !difference.empty())
            throw BadInput(fmt::format("{} is of {}; without that file the reference is begun anew",
                                       file_.string(), difference));
        restore(checkpoint, memory());
        if (spp() > recipe_.spp + 1)
            throw BadInput(
                fmt::format("{} has {} spp already, and {} are asked for", file_.string(), spp(), recipe_.spp));
        fmt::print(stderr, "{}: going on from {} spp\n", file_.string(), spp());
    }

    std::filesystem::path file_;
    const ReferenceRecipe& recipe_;
    ThreadPool& pool_;
    std::array<Render, 2> halves_;
    std::string identity_;
};

} // namespace

RenderSettings reference_settings() {
    RenderSettings settings;
    settings.method = Method::gpr;
    settings.tile = 8;
    settings.seed = first_reference_seed;
    return settings;
}

std::optional<ReferenceImage> render_reference(const std::filesystem::path& output, const SceneSource& source,
                                               const std::shared_ptr<const Scene>& scene,
                                               const ReferenceRecipe& recipe, ThreadPool& pool) {
    ReferenceRender render(output, source, scene, recipe, pool);
    if (!render.run())
        return {};
    ReferenceImage reference = render.take(source);
    write_reference(output, reference);
    render.remove_checkpoint(); // not before the picture is there
    return reference;
}

} // namespace tessera
