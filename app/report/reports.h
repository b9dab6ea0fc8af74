// What experiments write: pictures, charts, files of results, pages, and the report of the stability suite; and
// what is seen of them while they are at work.
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

/// A result with what a page calls it.
struct NamedResult {
    std::string name;
    const Result* result; ///< must outlive this
};

/// The pictures that the first seed came to, those that are there and of the reference's size, with that run's
/// figures.
std::vector<PagePicture> pictures_of(const Experiment& experiment, const std::vector<NamedResult>& results,
                                     const RgbImage& reference);

/// A picture with its name, in plain ASCII.
struct LabelledPicture {
    std::string label;
    RgbImage image;
};

/// The pictures row by row, each below its label; what of a label is wider than its picture runs into the next.
/// All must be of one size; there must be one.
RgbImage picture_sheet(const std::vector<LabelledPicture>& pictures, int columns);

/// The part of the image in the rectangle, which must lie in it.
RgbImage crop(const RgbImage& image, PixelRect rect);

/// Up to `count` squares of the image that do not overlap, where the pictures err most, all of them together: of
/// the squares of that edge the one with the largest sum of relative squared errors, in which no pixel counts for
/// more than 1, then the next. All images are of one size; the edge is cut to that.
std::vector<PixelRect> choose_crops(const RgbImage& reference, const std::vector<const RgbImage*>& pictures,
                                    int edge, int count);

/// HTML: the reference of a scene with the crops marked, and these crops of the reference and of every picture of
/// the first seed. Empty where there is no picture, or none of the reference's size.
std::string crops_section(const Experiment& experiment, const SceneCurves& scene);

/// The exposure, for write_png, that brings nine tenths of the pixels to below 0.8.
float usual_exposure(const RgbImage& image);

// Charts, and what their lines are called.

/// The line of a chart that a result is on: "gpr", "gpr l1, roulette absolute". It says what tells the result from
/// others with the same value of the first variation.
std::string line_label(const ExperimentOptions& options, const Result& result);

/// What a chart calls the curve: "gpr l2, tile 4".
std::string curve_label(const ExperimentOptions& options, const Curve& curve);

/// A Result::title as a part of a file's name.
std::string file_name(const std::string& title);

/// What a result's time or number of samples was to be.
Effort effort_of(const ExperimentOptions& options, const Result& result);

/// Error against CPU seconds and against samples, a line for each curve, with the spread over the seeds as bars
/// (the uncertainty for one seed) and the slope in the key. Errors that are not certain are left out.
Chart bench_chart(const ExperimentOptions& options, const SceneCurves& scene);

/// What people see of errors, PSNR and FLIP, against CPU seconds, a line for each curve: means over the seeds.
Chart seen_chart(const ExperimentOptions& options, const SceneCurves& scene);

/// Samples a CPU second against the triangles of the scenes, a line for each method, of its best curve. Worth
/// drawing for two scenes and more.
Chart triangle_chart(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes);

/// Error, efficiency and speed of one scene's results against the first variation (or the method, if nothing is
/// varied): a line for every method and value of the second.
Chart sweep_chart(const ExperimentOptions& options, const std::vector<Result>& results);
/// One for each title of the results, which must come title by title.
std::vector<Chart> sweep_charts(const ExperimentOptions& options, const std::vector<Result>& results);

// Files of results, and the page of `tessera bench`.

/// The results as CSV, a line for each: scene, method, reconstruction, what is varied, the share of time or
/// samples, all columns of result.h, and the kinds of machines; an empty cell where there is no value.
std::string to_csv(const ExperimentOptions& options, const std::vector<Result>& results);
/// A cell of such a file: in quotes where the text would else be more than one.
std::string csv_cell(const std::string& text);

/// The results as JSON, with the machine, all settings and every single run.
std::string to_json(const ExperimentOptions& options, const std::vector<Result>& results);

/// CSV with a line for each pair of curves of a scene of which the first is not of G-PR and the second is.
std::string speed_up_csv(const ExperimentOptions& options, const std::vector<SceneCurves>& scenes);

/// One HTML page that needs no other file: speed-up at equal error, then for every scene its charts, its figures
/// and crops of the pictures at equal time, and at the end settings and machine. Pictures and references that
/// cannot be read are left out.
std::string bench_page(const Experiment& experiment, const std::vector<SceneCurves>& scenes);

/// Describes a scene's complete references in plain text: file, method, reconstruction and own error. Explains a
/// reference by a method that `results`, those of the scene, judge. Empty: no reference is complete.
std::string reference_words(const Experiment& experiment, const std::string& scene,
                            const std::vector<Result>& results);

/// Writes sweep.csv, sweep.json, sweep.md, and a chart of each scene, sweep-SCENE.svg, to the sweep's folder.
void write_sweep(const Experiment& experiment, const std::vector<Result>& results);

// The stability suite.

/// What the suite says of one setup on one scene.
struct OverviewCell {
    std::string scene, setup; ///< their names
    Verdict::Kind verdict = Verdict::Kind::ok;
    double factor = 0; ///< as in Findings
};

/// What leads to a scene's section, to stand before its heading: headings have anchors of their own, but without
/// the dots of a name.
std::string anchor(const std::string& scene);

/// A line a scene, a column a setup, each in the order in which they come: the ratio of errors, or what is wrong.
/// Empty where there is no such cell. Scenes link to their anchors.
ReportTable overview(const std::vector<OverviewCell>& cells);

/// A scene of the suite and what is rendered of it.
struct StabilityCase {
    StabilityScene scene;
    std::unique_ptr<ExperimentOptions> options; ///< the experiment's
    std::unique_ptr<Experiment> experiment;

    const std::string& name() const { return experiment->scenes().front().name(); }
};

/// Writes stability.html, which needs no other file, stability.md and stability.csv on the scenes that have two
/// runs and more of each setup, to the folder of the suite's options.
void write_stability(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases);

/// Writes SCENE.png: the reference, and the pictures of the first seed with the names of their setups.
void write_sheet(const ExperimentOptions& suite, const StabilityCase& of);

// What others see of it.

/// What reads the folder that `tessera bench`, `sweep` or `stability` works in, on whichever machine: its list of
/// jobs, which of them are claimed by whom or done, and charts of what is done, as the reports have them. Claims
/// nothing and changes nothing. Throws std::runtime_error that says what of the folder is missing.
FolderReader folder_reader(const std::filesystem::path& folder);

} // namespace tessera
