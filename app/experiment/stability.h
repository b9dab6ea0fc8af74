// The stability suite: its scenes, and how it judges a setup on one of them by path tracing.
#pragma once

#include "app/cli/opened_scene.h"
#include "app/experiment/result.h"

#include <optional>
#include <string>
#include <vector>

#include <glm/ext/vector_int2.hpp>

namespace tessera {

/// Something measured, and what it is held against.
struct Deviation {
    double value = 0;  ///< measured minus expected
    double error = 0;  ///< its standard error
    double sigmas = 0; ///< how far from what is tolerated, as a normal variable would be; 0: within it
};

/// What the runs of a setup say of it, with the same scene's PT for comparison.
struct Findings {
    std::size_t bad_pixels = 0; ///< not finite, in all runs together
    std::size_t refused = 0;    ///< samples that were not finite, and left out
    Deviation energy;           ///< mean luminance over the reference's, minus 1 (of a black one: itself)
    Deviation squared_bias;     ///< mean of (bias / reference)^2 over pieces of the image: what no number of seeds
                                ///< averages out
    double spike = 0;           ///< 99.99th percentile of the pixels' relative errors, all runs together
    double worst = 0;           ///< the largest of them
    glm::ivec2 worst_pixel{0};
    double worst_share = 0; ///< of the squared error, what the worst pixels (worst_count) have
    double tone_mapped = 0; ///< mean of Artefacts::tone_mapped
    double tenfold = 0;     ///< mean of Artefacts::tenfold
    double halo_energy = 0; ///< means of Artefacts::halo_energy and halo_peak over the runs that have a spike;
    double halo_peak = 0;   ///< not numbers: none has
    double tile_edges = 0;  ///< mean of TileSpectrum::edges; not a number where there are none
    double tile_edges_error = 0;
    double error = 0;       ///< relMSE, of pictures in units of the reference's mean
    double error_error = 0; ///< its standard error, references' noise included
    double cost = 0;        ///< of a sample: CPU seconds, over those of PT
    Counters counters;      ///< of all runs together
    /// Error times CPU seconds over that of PT: the ratio of errors at equal time. Its interval of 95 %; none of
    /// them a number where either error is not certain.
    double factor = 0, low = 0, high = 0;
};

struct Verdict {
    enum class Kind { ok, worse, fails, undecided };
    Kind kind = Kind::ok;
    std::string cause; ///< empty for ok; of what is worse, what of it is cost, and where shifts fail
};

/// Finds it. Both results must have runs with artefacts.
Findings find(const Result& result, const Result& path_tracing, const ReferenceNoise& reference);

/// `path_tracing`: what was found of PT on the same scene. Where that looks biased to references that are made by
/// PT, rare light is missing in one of them, and nobody's bias can be told. `level`: the probability of calling
/// a mean wrong that is not.
Verdict judge(const Findings& findings, const Findings& path_tracing, double level);

/// "ok", "worse than PT", "fails", "undecided".
std::string to_string(Verdict::Kind kind);

/// What a scene needs to fail, if not what the suite gives to all.
struct StabilityNeeds {
    std::optional<int> spp;
    std::optional<int> seeds;
    std::optional<glm::ivec2> size; ///< pixels
};

/// A scene of the suite.
struct StabilityScene {
    SceneSource source;
    int depth = 0;     ///< that it asks for
    std::string fails; ///< which method is known to fail there, and why; empty: the file does not say
    StabilityNeeds needs;
};

/// The scenes of these files: one of each file, or one for each value where it has <!-- vary: NAME = VALUE, VALUE
/// -->, with any number of values. What is known to fail is in <!-- fails: REASON -->, what it needs for that in
/// <!-- needs: NEEDS -->: "100000 spp, 3 seeds, 16x16 pixels", any of these. Throws BadInput that names a file
/// that is not there, where a variable has no values, or where a need is none of these; and as load_mitsuba_xml
/// does: all are read once.
std::vector<StabilityScene> stability_scenes(const std::vector<std::filesystem::path>& files);

/// What a scene's file says of who fails there; empty: nothing, or it cannot be read.
std::string known_failure(const std::filesystem::path& file);

/// The scenes that come with the program, in the order of their names: those of assets/stability of the folder at
/// hand, of the program's, or of one that either lies in. Where there are none, those within the program, which
/// are written to $XDG_CACHE_HOME/tessera/stability (else ~/.cache). Throws std::exception where that cannot be
/// done.
std::vector<std::filesystem::path> built_in_stability_scenes();

/// Writes the scenes within the program, and what they are made of, to a folder.
void unpack_stability_scenes(const std::filesystem::path& folder);

} // namespace tessera
