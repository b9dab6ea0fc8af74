#pragma once

#include "recon/picture/reconstruct.h"
#include "render/run/picture_identity.h"
#include "render/run/reference_image.h"
#include "render/run/render.h"

#include <array>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

#include <glm/vec2.hpp>

namespace tessera {

/// Default seed of a reference's first half; the second half has the next seed.
inline constexpr std::uint64_t first_reference_seed = 1001;

/// Returns the settings of a reference's halves: G-PR with tiles of 8x8 pixels (not tuned) and without path
/// guiding, whose state is not in checkpoints.
RenderSettings reference_settings();

/// A shard of a reference: one of `count` parts of its passes.
struct PassShard {
    int number = 1; ///< from 1 to `count`
    int count = 1;

    bool is_all() const { return count == 1; }
    bool operator==(const PassShard&) const = default;
};

/// How a reference is made.
struct ReferenceRecipe {
    RenderSettings settings = reference_settings(); ///< of one half; the other has the next seed
    glm::ivec2 size{640, 360};
    int spp = 512; ///< samples per pixel of both halves together; odd numbers are rounded up
    /// Reconstruction of both halves. L2 is linear in the raw samples, and so unbiased.
    ReconstructionSettings reconstruction{.norm = Norm::l2};
    double checkpoint_seconds = 60; ///< wall time between checkpoints
    PassShard share;                ///< the shard to render (reference_share.h)
};

/// Returns the settings of the reconstruction: `none` for a method without gradients. The choice depends on
/// nothing that was rendered, so the default, l2, has no bias (recon/norm.h).
ReconstructionSettings reconstruction_of(const ReferenceRecipe& recipe);

/// Passes of a shard, in each of the two halves.
struct PassRange {
    int first, count;
};
/// Returns the passes of the recipe's shard. Throws std::invalid_argument for a shard number above the count, and
/// for more shards than passes.
PassRange passes_of(const ReferenceRecipe& recipe);

/// Makes the reference from two halves with all passes of the recipe. Frees their films.
ReferenceImage reference_of(std::array<Render, 2>& halves, const ReferenceRecipe& recipe,
                            const SceneSource& source, const SceneChecksums& scene);

/// Returns the path of a scene's reference: FOLDER/SCENE-WxH-dDEPTH.exr, with "-FILTER" at the end of the
/// name unless the filter is the box.
std::filesystem::path reference_file(const std::filesystem::path& folder, const std::string& scene_name,
                                     glm::ivec2 size, int depth, FilterKind filter);

/// Returns the path of a reference's checkpoint, beside its output.
std::filesystem::path reference_checkpoint(const std::filesystem::path& output);

/// Renders a reference: two halves, a pass of each in turn, with checkpoints. After an interruption, another
/// object for the same file continues from the checkpoint to the same bits.
class ReferenceRender {
public:
    /// Continues from the checkpoint if there is one. Throws std::runtime_error if it is of another subject or
    /// other settings, or cannot be read. Keeps a reference to `pool`.
    ReferenceRender(std::filesystem::path output, PictureSubject subject, const ReferenceRecipe& recipe,
                    ThreadPool& pool);

    /// Is called before each pass, and returns whether to continue.
    using Watch = std::function<bool(const ReferenceRender&)>;

    /// Renders until the reference is complete, and then returns true. If `watch` returns false, or after a stop
    /// request, which can end a pass early, writes a checkpoint and returns false.
    bool run(const Watch& watch, const std::stop_token& stop = {});

    int spp() const { return halves_[0].spp() + halves_[1].spp(); }           ///< of both halves
    int spp_wanted() const { return wanted_; }                                ///< of the recipe or its shard
    int spp_resumed() const { return spp_resumed_; }                          ///< from the checkpoint
    double seconds() const { return seconds_of_halves() - seconds_resumed_; } ///< wall time since the checkpoint
    double seconds_left() const;                                              ///< infinite before the first pass
    /// Returns the error of the mean of the halves so far; both need a sample. Costs two reconstructions.
    FloorFreeError error_so_far() const;
    /// The two halves with their passes so far.
    const std::array<Render, 2>& halves() const { return halves_; }

    /// Writes the complete reference, and then removes the checkpoint. Frees the films: no other call may follow.
    ReferenceImage finish();
    /// Writes the complete shard for merge_shards(), and then removes the checkpoint.
    void finish_shard();

private:
    bool is_complete() const { return spp() >= wanted_ && halves_[0].spp() == halves_[1].spp(); }
    double seconds_of_halves() const { return halves_[0].seconds() + halves_[1].seconds(); }
    Memory memory();
    void write();
    void resume();

    std::filesystem::path output_;
    PictureSubject subject_;
    ReferenceRecipe recipe_;
    ThreadPool& pool_;
    std::array<Render, 2> halves_;
    std::string identity_;
    int wanted_;
    int spp_resumed_ = 0;
    double seconds_resumed_ = 0;
};

} // namespace tessera
