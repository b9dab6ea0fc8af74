// footprint_bench [CHART.svg [SAMPLES [SCENE.xml...]]]: compares the footprints of base paths.
//
// For each vertex, prints the area of the scalar form, theory (25) and (26), and that of the parallelogram of two
// vectors. Both are relative to the area of the Minkowski sum of all differential vectors. Also prints the cost of
// computing them, and writes a chart of the scalar form. SAMPLES is the number of samples per pixel (16). The
// default scenes are three of ../shared/scenes, if they exist, and assets/stability/glossy.xml.
#include "render/inspect/path_differentials.h"
#include "render/load/mitsuba_xml.h"
#include "render/paths/base_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr glm::ivec2 size(320, 180);
constexpr int max_vertices = 4, paths_per_turn = 200, turns = 100;

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// The 10 % quantile, the median and the 90 % quantile.
using Quantiles = std::array<double, 3>;

Quantiles quantiles(std::vector<double> numbers) {
    std::sort(numbers.begin(), numbers.end());
    const auto at = [&](double fraction) {
        return numbers[static_cast<std::size_t>(fraction * static_cast<double>(numbers.size() - 1))];
    };
    return {at(0.1), at(0.5), at(0.9)};
}

struct Areas {
    std::vector<double> scalar, reduced; ///< areas, relative to that of the Minkowski sum
};

struct Measured {
    std::string name;
    std::array<Areas, max_vertices> areas;
    std::vector<double> scalar_cost, full_cost; ///< of each turn: extra time relative to the paths alone
};

/// Measures the footprints of base paths of a scene, and their cost.
class Measurement {
public:
    Measurement(const Scene& scene, double samples)
        : scene_(scene), rule_{static_cast<float>(samples)}, projection_(scene.camera(), size) {}

    Measured take(std::string name) {
        Measured m{std::move(name), {}, {}, {}};
        for (std::uint32_t turn = 0; turn < turns; ++turn) {
            double alone = 0, scalar = 0, full = 0;
            // The order rotates, so cold caches affect all variants equally.
            for (const std::uint32_t variant : {turn % 3, (turn + 1) % 3, (turn + 2) % 3})
                (variant == 0 ? alone : variant == 1 ? scalar : full) = min_seconds_of(turn, variant);
            m.scalar_cost.push_back(scalar / alone - 1);
            m.full_cost.push_back(full / alone - 1);
        }
        for (std::uint32_t i = 0; i < 20000; ++i) {
            trace(i, &hits_);
            compare(i, m);
        }
        return m;
    }

private:
    glm::vec2 pixel(std::uint32_t i) const {
        return Random(1, i, 0).draw_2d(0, Draw::direction) * glm::vec2(size);
    }

    void trace(std::uint32_t i, std::vector<Hit>* hits) {
        hits_.clear();
        const Tracer tracer{scene_, counters_, {6, 0}, {}, nullptr, hits};
        ray_ = projection_.ray(pixel(i));
        trace_base_path(tracer, ray_, projection_.pixel_width(), Random(1, i, 0), path_);
    }

    /// Computes the scalar footprints of the last traced path.
    void find_scalar() { scalar_footprints(path_, projection_.pixel_width(), ray_.origin, log_samples_, widths_); }
    /// Calls visit(vertex, derivatives) for each vertex of the last traced path.
    template <class Visit>
    void find_full(std::uint32_t i, Visit&& visit) {
        differentiate(scene_, projection_, pixel(i), glm::vec2(0), path_, hits_, differentiation_, visit);
    }

    /// Returns the least of 15 timings, as other work on the machine can only slow them down.
    double min_seconds_of(std::uint32_t turn, std::uint32_t variant) {
        double seconds = seconds_of(turn, variant);
        for (int again = 0; again < 14; ++again)
            seconds = std::min(seconds, seconds_of(turn, variant));
        return seconds;
    }

    /// Returns the CPU seconds of one turn.
    /// @param variant  0: paths alone, 1: with scalar footprints, 2: with full differentials and their footprints
    double seconds_of(std::uint32_t turn, std::uint32_t variant) {
        const double begin = cpu_seconds();
        for (std::uint32_t i = turn * paths_per_turn; i < (turn + 1) * paths_per_turn; ++i) {
            trace(i, variant == 2 ? &hits_ : nullptr);
            if (variant == 1)
                find_scalar();
            if (variant == 2)
                find_full(i, [&](int, const PathDerivatives& d) { sink_ += footprint(d, rule_).a.x; });
        }
        return cpu_seconds() - begin;
    }

    void compare(std::uint32_t i, Measured& m) {
        find_scalar();
        find_full(i, [&](int v, const PathDerivatives& d) {
            if (v >= max_vertices)
                return;
            const NumberVectors vectors = differential_vectors(d, rule_);
            const float sum_area = area_of_sum(vectors, d.count, d.normal),
                        width = widths_[static_cast<std::size_t>(v)];
            if (!(sum_area > 0))
                return;
            Areas& a = m.areas[static_cast<std::size_t>(v)];
            a.scalar.push_back(double(width * width / sum_area));
            a.reduced.push_back(double(reduce(vectors, d.count, d.normal).area() / sum_area));
        });
    }

    const Scene& scene_;
    DeltaRule rule_;
    float log_samples_ = std::log2(rule_.samples);
    Projection projection_;
    Counters counters_;
    Ray ray_;
    BasePath path_;
    std::vector<Hit> hits_;
    Differentiation differentiation_;
    std::vector<float> widths_;
    float sink_ = 0;
};

void print(const Measured& m) {
    fmt::print("{}\n", m.name);
    for (int v = 0; v < max_vertices; ++v) {
        const Areas& a = m.areas[static_cast<std::size_t>(v)];
        if (a.scalar.empty())
            continue;
        const Quantiles q = quantiles(a.scalar);
        fmt::print(
            "  x{}: {} paths, scalar / full: 10 % {:.2f}, median {:.2f}, 90 % {:.2f}; parallelogram / full: "
            "median {:.2f}\n",
            v + 1, a.scalar.size(), q[0], q[1], q[2], quantiles(a.reduced)[1]);
    }
    const Quantiles scalar = quantiles(m.scalar_cost), full = quantiles(m.full_cost);
    fmt::print(
        "  cost relative to the paths, median of {} turns (10 %, 90 %): scalar {:.1f} % ({:.1f}, {:.1f}), full "
        "{:.1f} % ({:.1f}, {:.1f})\n",
        turns, 100 * scalar[1], 100 * scalar[0], 100 * scalar[2], 100 * full[1], 100 * full[0], 100 * full[2]);
}

/// Writes a chart of the scalar form's relative areas: for each scene and vertex, a bar from the 10 % to the 90 %
/// quantile, with the median.
void write_chart(const std::string& file, const std::vector<Measured>& all) {
    constexpr double top = 20, bottom = 280, left = 60, step = 24, gap = 28, decades = 2; // 0.03 to 3
    const auto y = [&](double ratio) {
        return bottom - (bottom - top) * (std::clamp(std::log10(ratio), -1.5, 0.5) + 1.5) / decades;
    };
    const double width = left + double(all.size()) * (max_vertices * step + gap) + 20;
    std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"330\" "
                                  "font-family=\"sans-serif\" font-size=\"12\">\n"
                                  "<rect width=\"{0}\" height=\"330\" fill=\"white\"/>\n",
                                  width);
    for (const double ratio : {0.03, 0.1, 0.3, 1.0, 3.0})
        svg +=
            fmt::format("<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\"/>\n"
                        "<text x=\"{4}\" y=\"{5:.1f}\" text-anchor=\"end\">{6}</text>\n",
                        left, width - 10, y(ratio), ratio == 1 ? "#444" : "#ddd", left - 6, y(ratio) + 4, ratio);
    double x = left + gap / 2;
    for (const Measured& m : all) {
        for (int v = 0; v < max_vertices; ++v, x += step) {
            const Areas& a = m.areas[static_cast<std::size_t>(v)];
            if (a.scalar.empty())
                continue;
            const Quantiles q = quantiles(a.scalar);
            svg +=
                fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"{:.1f}\" fill=\"#9cc3e6\"/>\n"
                            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"3\" fill=\"#1f4e79\"/>\n"
                            "<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">x{}</text>\n",
                            x, y(q[2]), y(q[0]) - y(q[2]), x, y(q[1]) - 1.5, x + 7, bottom + 16, v + 1);
        }
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                           x - step * max_vertices / 2 - 5, bottom + 36, m.name);
        x += gap;
    }
    std::ofstream(file) << svg << "</svg>\n";
}

} // namespace

} // namespace tessera

int main(int count, char** arguments) {
    const std::string chart = count > 1 ? arguments[1] : "footprint-areas.svg";
    const double samples = count > 2 ? std::stod(arguments[2]) : 16;
    std::vector<std::filesystem::path> files(arguments + std::min(count, 3), arguments + count);
    const std::filesystem::path source = TESSERA_SOURCE_DIR;
    if (files.empty())
        for (const char* name : {"cornell-box", "kitchen", "bathroom"})
            files.push_back(source / "../shared/scenes" / name / "scene.xml");
    std::erase_if(files, [](const auto& file) { return !std::filesystem::exists(file); });
    if (files.empty())
        files.push_back(source / "assets/cornell-box.xml");
    if (count <= 3)
        files.push_back(source / "assets/stability/glossy.xml");
    std::vector<tessera::Measured> all;
    for (const std::filesystem::path& file : files) {
        const tessera::Scene scene(tessera::load_mitsuba_xml(file).description);
        const bool is_named = file.stem() == "scene";
        all.push_back(tessera::Measurement(scene, samples)
                          .take((is_named ? file.parent_path().filename() : file.stem()).string()));
        tessera::print(all.back());
    }
    tessera::write_chart(chart, all);
}
