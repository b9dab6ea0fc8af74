// The stability suite: its scenes, and the verdict on a setup in comparison with path tracing on the same scene.
#pragma once

#include "app/cli/opened_scene.h"
#include "app/experiment/result.h"

#include <optional>
#include <string>
#include <vector>

#include <glm/ext/vector_int2.hpp>

namespace tessera {

/// Difference between a measured and an expected value, with its significance.
struct Deviation {
    double value = 0;  ///< measured minus expected
    double error = 0;  ///< standard error of `value`
    double sigmas = 0; ///< standard deviations of a normal variable beyond the tolerance; 0: within
};

/// Statistics of all runs of one setup on one scene. Costs and factors are relative to PT on the same scene.
struct Findings {
    std::size_t bad_pixels = 0; ///< pixels that are not finite, summed over the runs
    std::size_t refused = 0;    ///< invalid samples, left out of the pictures; summed over the runs
    Deviation energy;           ///< mean luminance / the reference's - 1; for a black reference: mean luminance
    Deviation squared_bias;     ///< mean of (bias / reference)^2 over square pieces of the image
    double spike = 0;           ///< 99.99th percentile of the pixels' relative errors over all runs
    double worst = 0;           ///< largest relative error of a pixel in any run
    glm::ivec2 worst_pixel{0};
    double worst_fraction = 0; ///< fraction of the total squared error that is in the worst_count() worst pixels
    double tone_mapped = 0;    ///< mean of Artefacts::tone_mapped
    double tenfold = 0;        ///< mean of Artefacts::tenfold
    double halo_energy = 0;    ///< mean of Artefacts::halo_energy over the runs with a firefly; NaN: none has one
    double halo_peak = 0;      ///< mean of Artefacts::halo_peak over the same runs; NaN: none
    double tile_edges = 0;     ///< mean of TileSpectrum::edges; NaN for methods without tiles
    double tile_edges_error = 0;
    double error = 0;       ///< mean relMSE, of pictures in units of the reference's mean luminance
    double error_error = 0; ///< standard error of `error`, including the noise of the references
    double cost = 0;        ///< CPU seconds of a sample over those of a PT sample
    Counters counters;      ///< sums over the runs
    /// Error times CPU seconds, over the same product of PT, which is the ratio of errors at equal time; and its
    /// 95 % confidence interval. All three are NaN if either error is below twice the references' noise.
    double factor = 0, low = 0, high = 0;
};

struct Verdict {
    enum class Kind { ok, worse, fails, undecided };
    Kind kind = Kind::ok;
    std::string cause; ///< empty for ok; for worse: error per sample, cost per sample and shift success
};

/// Computes the findings. All runs of both results must have artefacts.
Findings find(const Result& result, const Result& path_tracing, const ReferenceNoise& reference);

/// Judges a setup. The verdict is undecided if the setup is biased and PT also appears biased against its own
/// path-traced reference, since one of them then lacks rare light paths.
/// @param path_tracing  findings of PT on the same scene
/// @param level  probability of calling an unbiased mean biased
Verdict judge(const Findings& findings, const Findings& path_tracing, double level);

/// Returns "ok", "worse than PT", "fails" or "undecided".
std::string to_string(Verdict::Kind kind);

/// Settings that a scene needs for its failure to show, in place of the suite's own.
struct StabilityNeeds {
    std::optional<int> spp;
    std::optional<int> seeds;
    std::optional<glm::ivec2> size; ///< pixels
};

/// A scene of the suite, with one value of its variable if it has one.
struct StabilityScene {
    SceneSource source;
    int depth = 0;     ///< path length in edges, from the scene file
    std::string fails; ///< the method that is known to fail there, and why; empty: the file does not say
    StabilityNeeds needs;
};

/// Loads the scenes of these files. A file gives one scene, or one for each value of the comment
/// <!-- vary: NAME = VALUE, VALUE -->. <!-- fails: REASON --> states the known failure. <!-- needs: NEEDS -->
/// states any of the needs, such as "100000 spp, 3 seeds, 16x16 pixels". Throws BadInput that names the file if
/// it does not exist, if a variable has no values, or if a need is malformed; and as load_mitsuba_xml does.
std::vector<StabilityScene> stability_scenes(const std::vector<std::filesystem::path>& files);

/// Returns the known failure that a scene file states; empty: it states none, or cannot be read.
std::string known_failure(const std::filesystem::path& file);

/// Returns the scene files of the suite in order of their names, from the first folder assets/stability found in
/// the current folder, the program's folder, or a parent of either. If there is none, unpacks the embedded scenes
/// to $XDG_CACHE_HOME/tessera/stability (default ~/.cache/tessera/stability). Throws std::exception if that
/// fails.
std::vector<std::filesystem::path> built_in_stability_scenes();

/// Writes the embedded scenes, and the files that they refer to, to a folder.
void unpack_stability_scenes(const std::filesystem::path& folder);

} // namespace tessera
