#pragma once

#include "app/cli/opened_scene.h"
#include "app/cli/picture_layers.h"
#include "app/compare/error_maps.h"
#include "app/experiment/experiment.h"
#include "app/experiment/references.h"
#include "recon/image.h"
#include "recon/picture/reconstruct.h"
#include "render/scene/sensor.h"
#include "render/settings/settings.h"
#include "ui/jobs/scene_load.h"
#include "ui/state/document.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace CLI {
class App;
} // namespace CLI

namespace tessera {

struct SavedPicture;

// The commands of the program: one function each, with a struct of options. For commands with many options,
// a struct of command-line arguments is parsed into these options.

/// Returned by run_view if there is neither a display nor a way to render off screen. The caller may then make a
/// contact sheet.
inline constexpr int view_needs_display = -1;
/// Returned by run_view if a signal ended a script or a screenshot: the shell's exit code for Ctrl-C.
inline constexpr int view_interrupted = 130;

/// Default samples per pixel, if neither samples nor time are given.
inline constexpr int default_spp = 16;

/// Options of `tessera view`.
struct ViewOptions {
    SceneOrigin scene; ///< loaded in the background
    SceneOpener open;  ///< opens scenes that are dropped on the window
    std::vector<PaneSettings> panes = default_panes(2);
    bool uses_stored_pane_count = true; ///< use the number of panes of the last session; if unknown, `panes`
    std::optional<int> max_depth;       ///< empty: the scene's own
    SizeChoice render_size;
    int threads = 0;                       ///< of the renderer; 0: one per hardware thread
    std::optional<glm::ivec2> window_size; ///< empty: that of the last window, or 1440x810
    int spp = 0; ///< samples per pixel at which the panes stop; 0: no limit (for a screenshot: default_spp)
    std::optional<SampleChoice> sample; ///< opened in the path inspector of the last pane
    std::filesystem::path reference;    ///< EXR file for error measurement; empty: none
    std::filesystem::path jobs;       ///< output folder of a bench, sweep or stability run to follow; empty: none
    bool shows_gallery = true;        ///< at start, if no scene is given
    std::filesystem::path screenshot; ///< PNG of the window at `spp` samples, then the viewer ends; empty: none
    std::filesystem::path script;     ///< script file to play; "-": standard input; empty: none
    bool log_actions = false;         ///< prints every change of state and the positions of controls to stdout
};

/// Returns the gallery: the embedded scene and the scenes that `find_scenes` finds (built_in_stability_scenes),
/// each with a small picture, its known failure, and the verdicts of a stability run. If `find_scenes` throws,
/// only the embedded scene and the error message.
/// @param results  contents of a stability.csv; empty: the table embedded in the program (tests/results)
GalleryContents gallery(const std::function<std::vector<std::filesystem::path>()>& find_scenes,
                        std::string_view results = {});

/// Opens the viewer and returns when the user quits. Returns 0, 2 after an error that is reported on stderr, or
/// one of the values above. A lost display ends the process (display_lost).
int run_view(const ViewOptions& options);

enum class ClockChoice { wall, cpu };

/// Options of `tessera render`.
struct RenderOptions {
    RenderSettings settings;
    std::optional<int> max_depth; ///< empty: the scene's own
    std::optional<int> spp;       ///< passes; empty: limited by time, or default_spp
    std::optional<double> time;   ///< seconds of rendering, without loading
    ClockChoice clock = ClockChoice::wall;
    std::optional<glm::ivec2> size;    ///< of the film; empty: the scene's own
    std::optional<PixelFormat> format; ///< empty: the scene's own
    ReconstructionLayers
        layers;      ///< no norms: guided for methods with gradients, weighted for basis components, else none
    int threads = 0; ///< 0: one per hardware thread
    std::filesystem::path cameras; ///< camera path: one picture of each scene for each camera; empty: none
    std::filesystem::path output;
    std::filesystem::path stats; ///< empty: none
};

/// Renders a picture of each scene and camera. Returns an ExitCode. For one picture, throws BadInput, LoadError or
/// another std::exception before anything is written. Several pictures have numbered names (picture_names.h); an
/// error of a scene or picture is printed, and the next ones are rendered.
/// @param scenes  not empty
int run_render(const RenderOptions& options, const std::vector<SceneSource>& scenes);

/// Options of `tessera reference`.
struct ReferenceOptions {
    SceneSource scene;
    ReferenceRecipe recipe;
    std::optional<int> max_depth;   ///< empty: the scene's own
    std::optional<glm::ivec2> size; ///< of the film; empty: the scene's own
    bool is_shard = false;          ///< write a shard file, even if it is the only shard
    int threads = 0;                ///< 0: one per hardware thread
    std::filesystem::path output;
};

/// Renders a reference or a shard of one, from a checkpoint if there is one, and prints its error. Returns an
/// ExitCode: failure if Ctrl-C interrupted it. Throws BadInput, LoadError or another std::exception.
int run_reference(const ReferenceOptions& options);

/// Command-line arguments of `tessera reference`.
struct ReferenceArguments {
    std::string scene, camera, sensor, crop, share;
    glm::ivec2 size{0}; ///< 0: not given
    std::vector<std::string> definitions;
    bool strict = false;
    ReferenceOptions options; ///< all other options
};

/// Adds the subcommand to `app`, which stores its arguments in `words`; `words` must outlive `app`.
void add_reference(CLI::App& app, ReferenceArguments& words);

/// Parses the arguments. Throws BadInput that names the option.
ReferenceOptions parse_reference(const CLI::App& command, const ReferenceArguments& words);

/// Options of `tessera merge`.
struct MergeOptions {
    std::vector<std::filesystem::path> shares; ///< files of all shards, in any order
    std::filesystem::path output;
};

/// Adds the subcommand to `app`, which stores its arguments in `options`; `options` must outlive `app`.
void add_merge(CLI::App& app, MergeOptions& options);

/// Merges the shards of a reference, and prints its error. Returns an ExitCode. Throws BadInput, and as
/// merge_shards does.
int run_merge(const MergeOptions& options);

/// Options of `tessera reconstruct`.
struct ReconstructOptions {
    std::vector<std::filesystem::path> inputs; ///< as for read_gradients
    ReconstructionLayers layers{{Norm::guided}};
    bool repair = false; ///< pixels that are not finite become 0
    int threads = 0;     ///< 0: one per hardware thread
    std::filesystem::path output;
    std::filesystem::path stats; ///< empty: none
};

/// Reconstructs a picture from saved buffers. Returns an ExitCode. Throws BadInput or another std::exception
/// before anything is written.
int run_reconstruct(const ReconstructOptions& options);

/// Command-line arguments of `tessera reconstruct`.
struct ReconstructArguments {
    std::vector<std::string> inputs;
    std::string primal, dx, dy, direct; ///< the inputs by name, instead of `inputs`
    std::string norms = "guided";
    ReconstructOptions options; ///< all other options
};

/// Adds the subcommand to `app`, which stores its arguments in `words`; `words` must outlive `app`.
void add_reconstruct(CLI::App& app, ReconstructArguments& words);

/// Parses the arguments. Throws BadInput that names the option.
ReconstructOptions parse_reconstruct(const ReconstructArguments& words);

enum class ComparisonFormat { text, json, csv };

/// Options of `tessera compare`.
struct CompareOptions {
    std::vector<std::filesystem::path> images; ///< at least one
    std::filesystem::path reference;
    std::filesystem::path reference2; ///< independent of the first; empty: none
    std::string layer; ///< of the images, as choose_layer() in render/io/exr_layers.h; empty: the picture
    std::string reference_layer; ///< of the references; empty: the picture, or both halves
    std::vector<MapFile> maps;   ///< written for each image
    ComparisonFormat format = ComparisonFormat::text;
    int tile = 0; ///< tile edge for the tile spectrum, pixels; 0: none
};

/// Command-line arguments of `tessera compare`.
struct CompareArguments {
    CompareOptions options;
    std::vector<std::string> files, maps;
    bool json = false, csv = false;
};

/// Adds the subcommand to `app`, which stores its arguments in `words`; `words` must outlive `app`.
void add_compare(CLI::App& app, CompareArguments& words);

/// Parses the arguments. Throws BadInput that names the option.
CompareOptions parse_compare(const CompareArguments& words);

/// `tessera compare`: prints the errors of each image against the reference, or against the mean of both
/// references. With two references, or one that has two halves, also prints errors without their noise. Images of
/// any format are compared in the pixels that their display windows have in common. Returns 0, or 2 with messages
/// on stderr for files that cannot be read or compared; the others are printed.
int run_compare(const CompareOptions& options);

/// `tessera info`: prints the contents of a scene, the time and memory to load it, its features that affect
/// rendering, and notes on ignored or replaced parts with their positions. Returns an ExitCode.
int run_info(const SceneSource& source);

struct ContactSheetOptions {
    SceneSource scene;
    std::filesystem::path output = "contact-sheet.png";
    glm::ivec2 size{
        0}; ///< of each picture; 0: the scene's own, scaled down to at most about 640x360 pixels in area
    double seconds = 5; ///< wall time of rendering for each method
    int threads = 0;
};

/// Writes a comparison of path tracing and gradient-domain path reusing as a PNG, for machines without a display:
/// both pictures, the latter's primal and its gradients. Returns an ExitCode.
int run_contact_sheet(const ContactSheetOptions& options);

/// Writes the EXR file of `tessera render --buffers` for a picture of the viewer. The header also has the camera,
/// the norm, times and counts. Further layers hold first-hit albedo, normal and depth, and errors against the
/// reference if its size matches. The snapshot's own reconstruction is used if it belongs to the newest pass and
/// to these settings; otherwise a new one is computed. Throws std::exception that names the file.
void write_saved_picture(const std::filesystem::path& file, const SavedPicture& picture);

/// `tessera bench`: renders every scene with every method and reconstruction, measures errors at doubling times,
/// and writes bench.html (self-contained), bench.csv, bench-speedup.csv, bench.json and charts of each scene.
/// Updates them while jobs finish. Returns an ExitCode. Throws as run_sweep does.
int run_bench(const ExperimentOptions& options);

/// `tessera sweep`: renders every scene with every setup of the experiment, measures errors, and writes
/// sweep.csv, sweep.json, sweep.md and a chart of each scene. Updates them while jobs finish. Returns an
/// ExitCode. Throws BadInput or another std::exception before rendering, except for scene files that cannot be
/// loaded: these are found when their jobs start.
int run_sweep(const ExperimentOptions& options);

/// `tessera stability`: renders small scenes, each known to make some method fail, with all methods and
/// reconstructions, and compares them with path tracing (app/experiment/stability.h). Writes stability.html,
/// stability.md, stability.csv and a sheet of pictures for each scene, and updates them while jobs finish. The
/// jobs and pictures of a scene are in OUTPUT/scenes/SCENE. Empty `options.scenes`: the scenes that come with the
/// program. Path lengths are the scenes' own. Returns an ExitCode. Throws BadInput or another std::exception
/// before rendering.
int run_stability(ExperimentOptions options);

/// Input of a reconstruction, read from files.
struct GradientInput {
    GradientImages images;                         ///< all finite
    std::map<std::string, std::string> attributes; ///< attributes of the EXR header that begin with "tessera:"
    std::size_t repaired = 0;                      ///< invalid values that were replaced
};

/// Reads the input of a reconstruction. One file must be an EXR with layers, as reconstruct_layers() writes them
/// (app/cli/picture_layers.h). Three or four files, EXR (plain RGB) or PFM, are primal, dx, dy and optionally the
/// directly visible emission. A file of another program needs the layers primal_without_direct (or primal, if
/// there is no layer direct), dx and dy. The last column of dx and the last row of dy are ignored and may be
/// missing. Throws BadInput or another std::exception that names the file, for sizes that do not match and for
/// pixels that are not finite; `repair` sets these to 0 instead.
GradientInput read_gradients(const std::vector<std::filesystem::path>& files, bool repair);

/// Describes the first pixel in row-major order that is not finite: "pixel (3, 4) is (nan, 0, 1)". Empty: there
/// is none.
std::string text_of_bad_pixel(const RgbImage& image);

/// Parses the command line and runs its command. Returns an ExitCode. Throws std::exception whose what() is fit
/// for the user.
int run_command_line(int argc, char** argv);

} // namespace tessera
