// Output of experiments: pictures, charts, result files, pages and the stability report; and the reader of a
// folder in which experiments run.
#pragma once

#include "app/experiment/experiment.h"
#include "app/experiment/speed_up.h"
#include "app/experiment/stability.h"
#include "app/report/page.h"
#include "recon/image.h"
#include "ui/charts/chart.h"
#include "ui/jobs/followed_folder.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

// Pictures.

/// A result with its label on a page.
struct NamedResult {
    std::string name;
    const Result* result; ///< must outlive this
};

/// Returns the first seed's pictures of the results, with that run's figures. Omits pictures that do not exist or
/// are not of the reference's size.
std::vector<PagePicture> pictures_of(const Experiment& experiment, const std::vector<NamedResult>& results,
                                     const RgbImage& reference);

/// A picture with its label, in plain ASCII.
struct LabelledPicture {
    std::string label;
    RgbImage image;
};

/// Arranges the pictures row by row, each below its label; a label wider than its picture continues over the next
/// one. All pictures must have one size, and there must be at least one.
RgbImage picture_sheet(const std::vector<LabelledPicture>& pictures, int columns);

/// Returns the part of the image in the rectangle, which must lie within the image.
RgbImage crop(const RgbImage& image, PixelRect rect);

/// Returns up to `count` disjoint squares of the given edge with the largest errors of all pictures together. The
/// error of a square is the sum of relative squared errors, where each pixel contributes at most 1. All images
/// must have one size; the edge is limited to it.
std::vector<PixelRect> choose_crops(const RgbImage& reference, const std::vector<const RgbImage*>& pictures,
                                    int edge, int count);

/// Returns HTML: the reference of a scene with marked crops, and these crops of the reference and of every
/// picture of the first seed. Empty if there is no picture, or none of the reference's size.
std::string crops_section(const Experiment& experiment, const SceneCurves& scene);

/// Returns the exposure for write_png, in stops, that maps the 90th percentile of the luminance to 0.8.
float auto_exposure(const RgbImage& image);

// Charts, and the labels of their lines.

/// Returns the label of the line that a result belongs to in a sweep's chart: "gpr", "gpr l1, roulette absolute".
/// The value of the first variation is on the x axis and not in the label.
std::string line_label(const ExperimentOptions& options, const Result& result);

/// Returns the label of a curve: "gpr l2, tile 4".
std::string curve_label(const ExperimentOptions& options, const Curve& curve);

/// Converts a Result::title to a part of a file name.
std::string file_name(const std::string& title);

/// Returns the effort at which a result was measured.
Effort effort_of(const ExperimentOptions& options, const Result& result);

/// Returns plots of error against CPU seconds and against samples per pixel, with a line for each curve. Bars are
/// the deviation over seeds, or the uncertainty for one seed; the key has the slopes. Omits errors that are not
/// significant.
Chart bench_chart(const ExperimentOptions& options, const SceneCurves& scene);

/// Returns plots of PSNR and FLIP against CPU seconds, with a line for each curve: means over seeds.
Chart seen_chart(const ExperimentOptions& options, const SceneCurves& scene);

/// Returns a plot of samples per CPU second against the triangles of the scenes, with a line for each method,
/// from its best curve. Useful for two or more scenes.
Chart triangle_chart(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes);

/// Returns plots of error, efficiency and speed of one scene's results against the first variation (or the
/// method, if nothing is varied), with a line for each method and value of the second variation.
Chart sweep_chart(const ExperimentOptions& options, const std::vector<Result>& results);
/// Returns a chart for each title. The results must be ordered by title.
std::vector<Chart> sweep_charts(const ExperimentOptions& options, const std::vector<Result>& results);

// Files of results, and the page of `tessera bench`.

/// Returns the results as CSV with a line for each: scene, method, reconstruction, variations, effort, the
/// columns of result.h, and the kinds of machines. A cell without a value is empty.
std::string to_csv(const ExperimentOptions& options, const std::vector<Result>& results);
/// Returns a CSV cell, in quotes if the text needs them.
std::string csv_cell(const std::string& text);

/// Returns the results as JSON, with the machine, all settings and every run.
std::string to_json(const ExperimentOptions& options, const std::vector<Result>& results);

/// Returns CSV with a line for each pair of curves of a scene, the slower not of G-PR and the faster of G-PR.
std::string speed_up_csv(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes);

/// Returns a self-contained HTML page: speed-up at equal error; for every scene its charts, figures and crops of
/// the pictures at equal time; settings and machine. Omits pictures and references that cannot be read.
std::string bench_page(const Experiment& experiment, const std::vector<SceneCurves>& scenes);

/// Describes a scene's complete references in plain text: file, method, reconstruction and own error. For a
/// reference by a method among `results`, the results of the scene, explains the consequences. Empty: no
/// reference is complete.
std::string describe_references(const Experiment& experiment, const std::string& scene,
                                const std::vector<Result>& results);

/// Writes sweep.csv, sweep.json, sweep.md and a chart of each scene, sweep-SCENE.svg, to the sweep's folder.
void write_sweep(const Experiment& experiment, const std::vector<Result>& results);

// The stability suite.

/// Verdict of the suite on one setup and one scene.
struct OverviewCell {
    std::string scene, setup; ///< names
    Verdict::Kind verdict = Verdict::Kind::ok;
    double factor = 0; ///< Findings::factor
};

/// Returns the HTML anchor of a scene, to precede its heading: the automatic anchors of headings lose the dots of
/// names.
std::string anchor(const std::string& scene);

/// Returns a table with a row for each scene and a column for each setup, in order of their first cells. A cell
/// has the verdict and the ratio of errors; it is empty if there is no such result. Scenes link to their anchors.
ReportTable overview(const std::vector<OverviewCell>& cells);

/// A scene of the suite with its experiment.
struct StabilityCase {
    StabilityScene scene;
    std::unique_ptr<ExperimentOptions> options; ///< of the experiment
    std::unique_ptr<Experiment> experiment;

    const std::string& name() const { return experiment->scenes().front().name(); }
};

/// Writes stability.html (self-contained), stability.md and stability.csv to the folder of the suite. They have
/// the scenes with at least two runs of PT, and their setups with at least two runs.
void write_stability(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases);

/// Writes SCENE.png: the reference, and the first seed's pictures labelled with their setups.
void write_sheet(const ExperimentOptions& suite, const StabilityCase& of);

// The folder of a running experiment.

/// Returns the reader of a folder in which `tessera bench`, `sweep` or `stability` runs on any machine: its jobs
/// with their states and owners, and charts of the results as in the reports. The reader claims and changes
/// nothing. It throws std::runtime_error that states what is missing in the folder.
FolderReader folder_reader(const std::filesystem::path& folder);

} // namespace tessera
