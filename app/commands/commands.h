#pragma once

#include "app/cli/opened_scene.h"
#include "app/cli/picture_layers.h"
#include "app/experiment/experiment.h"
#include "app/experiment/references.h"
#include "recon/image.h"
#include "recon/picture/reconstruct.h"
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

// The commands of the program, one function each, with all that one can ask of them. Those with many options have
// the words of the command line, too, as a step between it and these.

/// What run_view returns where there is neither a display nor a way to draw without one: the caller may render the
/// same comparison headless.
inline constexpr int view_needs_display = -1;
/// What run_view returns where a signal ended a script or a screenshot: what a shell says of Ctrl-C.
inline constexpr int view_cut_short = 130;

/// Samples a pixel of pictures for which neither samples nor time are given.
inline constexpr int usual_spp = 16;

/// `tessera view`.
struct ViewOptions {
    SceneOrigin scene; ///< loaded in the background
    SceneOpener open;  ///< for scenes dropped on the window
    std::vector<PaneSettings> panes = default_panes(2);
    bool panes_as_remembered = true; ///< as many as the last time; otherwise, or if that is not known, `panes`
    std::optional<int> max_depth;    ///< otherwise the scene decides
    SizeChoice render_size;
    int threads = 0;                       ///< of the renderer; 0: one a hardware thread
    std::optional<glm::ivec2> window_size; ///< otherwise that of the last window, or 1440x810
    int spp = 0; ///< samples a pixel at which the panes rest; 0: none (a screenshot: usual_spp)
    std::optional<SampleChoice> sample; ///< to begin with in the path inspector, of the last pane
    std::filesystem::path reference;    ///< EXR file to measure errors against; empty: none
    std::filesystem::path jobs;         ///< folder of a bench, sweep or stability suite to follow; empty: none
    bool shows_gallery = true;          ///< at first, where no scene was given
    std::filesystem::path screenshot;   ///< if not empty: save a picture of the window at `spp` samples, and end
    std::filesystem::path script;       ///< if not empty: steps to be played
    bool log_actions = false;           ///< a line on stdout for every change of state, and where controls lie
};

/// The scene within the program and those that are found (built_in_stability_scenes), with small pictures, what is
/// known to fail there, and the verdicts of the stability suite as they were measured last (RESULTS.md). Where
/// they cannot be found, the first alone, and the problem.
/// @param results  a table as the suite writes it (stability.csv); empty: what was measured last
GalleryContents gallery(const std::function<std::vector<std::filesystem::path>()>& find_scenes,
                        std::string_view results = {});

/// Opens the viewer and returns when the user quits: an exit code (0; 2: the scene or the picture failed, a
/// message is on stderr), or one of those above. Where the display is lost, the process ends: display_lost.
int run_view(const ViewOptions& options);

enum class ClockChoice { wall, cpu };

/// What `tessera render` is asked for.
struct RenderOptions {
    SceneSource scene;
    RenderSettings settings;
    std::optional<int> max_depth; ///< empty: the scene's own
    std::optional<int> spp;       ///< passes; empty: by time, or usual_spp
    std::optional<double> time;   ///< seconds of rendering, without loading
    ClockChoice clock = ClockChoice::wall;
    std::optional<glm::ivec2> size; ///< empty: the scene's own
    ReconstructionLayers layers;    ///< without norms: guided where there are gradients
    int threads = 0;                ///< 0: one a hardware thread
    std::filesystem::path output;
    std::filesystem::path stats; ///< empty: none
};

/// Renders a picture. Returns an ExitCode. Throws BadInput, LoadError or another std::exception before anything
/// has been written.
int run_render(const RenderOptions& options);

/// What `tessera reference` is asked for.
struct ReferenceOptions {
    SceneSource scene;
    ReferenceRecipe recipe;
    std::optional<int> max_depth;   ///< empty: the scene's own
    std::optional<glm::ivec2> size; ///< empty: the scene's own
    bool is_share = false;          ///< the recipe's share is to be written, be it one of one
    int threads = 0;                ///< 0: one a hardware thread
    std::filesystem::path output;
};

/// Renders a reference or a share of one, from a checkpoint if there is one, and prints its error. Returns an
/// ExitCode: failure if Ctrl-C came before it was complete. Throws BadInput, LoadError or another std::exception.
int run_reference(const ReferenceOptions& options);

/// The words of `tessera reference`, before they are given a meaning.
struct ReferenceWords {
    std::string scene, camera, share;
    glm::ivec2 size{0}; ///< 0: not given
    std::vector<std::string> definitions;
    bool strict = false;
    ReferenceOptions options; ///< all that is not above
};

/// Adds the command; `words` take what is given to it, and must live as long as `app`.
void add_reference(CLI::App& app, ReferenceWords& words);

/// What the words mean. Throws BadInput that names the option.
ReferenceOptions parse_reference(const CLI::App& command, const ReferenceWords& words);

/// What `tessera merge` is asked for.
struct MergeOptions {
    std::vector<std::filesystem::path> shares; ///< in any order
    std::filesystem::path output;
};

/// Adds the command; `options` take what is given to it, and must live as long as `app`.
void add_merge(CLI::App& app, MergeOptions& options);

/// Adds the shares of a reference up, and prints its error. Returns an ExitCode. Throws BadInput, and as
/// merge_shares does.
int run_merge(const MergeOptions& options);

/// What `tessera reconstruct` is asked for.
struct ReconstructOptions {
    std::vector<std::filesystem::path> inputs; ///< as read_gradients takes them
    ReconstructionLayers layers{{Norm::guided}};
    bool repair = false; ///< pixels that are not finite count as 0
    int threads = 0;     ///< 0: one a hardware thread
    std::filesystem::path output;
    std::filesystem::path stats; ///< empty: none
};

/// Reconstructs from saved buffers. Returns an ExitCode. Throws BadInput or another std::exception before anything
/// has been written.
int run_reconstruct(const ReconstructOptions& options);

/// The words of `tessera reconstruct`, before they are given a meaning.
struct ReconstructWords {
    std::vector<std::string> inputs;
    std::string primal, dx, dy, direct; ///< the inputs by their names instead
    std::string norms = "guided";
    ReconstructOptions options; ///< all that is not above
};

/// Adds the command; `words` take what is given to it, and must live as long as `app`.
void add_reconstruct(CLI::App& app, ReconstructWords& words);

/// What the words mean. Throws BadInput that names the option.
ReconstructOptions parse_reconstruct(const ReconstructWords& words);

struct CompareOptions {
    std::filesystem::path image;
    std::filesystem::path reference;
    std::filesystem::path reference2; ///< independent of the first; empty: there is none
    std::string layer;                ///< of `image`, such as "primal"; empty: its plain R, G, B
    bool json = false;
    int tile = 0; ///< edge of tiles whose grid is looked for in the error; 0: it is not
};

/// `tessera compare`: prints how far the image is from the reference, or from the mean of both. With two,
/// or one that `tessera reference` made and that has two halves, also the error that has no floor. Of other
/// references the plain R, G, B are taken, or `layer` where there are none. Returns the exit code: 0, or 2 with
/// one message on stderr for files that cannot be read or do not fit.
int run_compare(const CompareOptions& options);

/// `tessera info`: prints what was loaded, what it takes in time and memory, what the renderer must reckon with,
/// and what was ignored or replaced, with its place in the file. Returns an ExitCode.
int run_info(const SceneSource& source);

struct ContactSheetOptions {
    SceneSource scene;
    std::filesystem::path output = "contact-sheet.png";
    glm::ivec2 size{0}; ///< of each picture; 0: the scene's own, at most about 640x360 pixels in all
    double seconds = 5; ///< wall seconds of rendering for each method
    int threads = 0;
};

/// The viewer's comparison for machines without a display: path tracing and gradient-domain path reusing side by
/// side, with the latter's primal and gradients, labelled, as one PNG. Returns an ExitCode.
int run_contact_sheet(const ContactSheetOptions& options);

/// Writes the same EXR file as `tessera render --buffers`, with the camera, the norm, the times and what was
/// counted in its header, and layers for what else the viewer shows: albedo, normal and depth, and errors to a
/// reference of the picture's size. The reconstruction is the snapshot's own if that is of its newest pass and
/// made with these settings; otherwise it is made now. Throws std::exception that names the file.
void write_saved_picture(const std::filesystem::path& file, const SavedPicture& picture);

/// `tessera bench`: renders every scene with every method and reconstruction in turn, takes errors at doubling
/// times, and writes bench.html (which needs no other file), bench.csv, bench-speedup.csv, bench.json and a chart
/// a scene, anew after each round. Returns an ExitCode. Throws as run_sweep does.
int run_bench(const ExperimentOptions& options);

/// `tessera sweep`: renders every scene with every setup of the experiment, compares with references, and writes
/// sweep.csv, .json, .md and a chart a scene, anew after each round. Returns an ExitCode. Throws BadInput or
/// another std::exception before anything was rendered, but for scene files that cannot be loaded: these are met
/// in turn.
int run_sweep(const ExperimentOptions& options);

/// `tessera stability`: renders small scenes, each made so that some method is known to fail, with all methods and
/// reconstructions, and judges them by path tracing (app/experiment/stability.h). Writes stability.md,
/// stability.csv and a sheet of pictures a scene, anew after each round; each scene's journal and pictures are in
/// a folder of its own, OUTPUT/scenes/SCENE. No `options.scenes`: those that come with the program. Depths are the
/// scenes' own. Returns an ExitCode. Throws BadInput or another std::exception before anything was rendered.
int run_stability(ExperimentOptions options);

/// The input of a reconstruction, read from files.
struct GradientInput {
    GradientImages images;                         ///< all finite
    std::map<std::string, std::string> attributes; ///< those of the EXR header that Tessera wrote
    std::size_t repaired = 0;                      ///< invalid values that became 0 or got no weight
};

/// Reads one EXR file with layers, as reconstruct_layers() writes the buffers (app/cli/picture_layers.h), or three
/// or four files, EXR (plain RGB) or PFM: primal, dx, dy and perhaps the directly visible emission. A file of
/// another program needs the layers primal_without_direct (or primal, if there is no layer direct), dx and dy. The
/// last column of dx and the last row of dy are ignored and may be missing. Throws BadInput or another
/// std::exception that names the file: for sizes that do not fit, and for pixels that are not finite unless
/// `repair` makes them 0.
GradientInput read_gradients(const std::vector<std::filesystem::path>& files, bool repair);

/// The first pixel, row by row from the top left, that is not finite, as text: "pixel (3, 4) is (nan, 0, 1)".
/// Empty: there is none.
std::string text_of_bad_pixel(const RgbImage& image);

/// Reads the command line and runs the command it names. Returns an ExitCode; throws std::exception whose what()
/// is fit for the user.
int run_command_line(int argc, char** argv);

} // namespace tessera
