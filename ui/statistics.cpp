#include "ui/statistics.h"

#include "ui/buffer.h"
#include "ui/shift_outcomes.h"
#include "ui/words.h"

#include <algorithm>
#include <cstdio>

namespace tessera {

namespace {

constexpr const char* ray_help[] = {
    "From the camera to the first surface.",
    "On from a vertex of a base path.",
    "From a vertex of a base path to a point on a light: is anything in between?",
    "On from a vertex of an offset path.",
    "A new edge of an offset path, to a vertex of the base path or to a light: is anything in between?",
};
static_assert(std::size(ray_help) == ray_kind_count);

/// 0 of 0 is 0.
double ratio(std::uint64_t part, std::uint64_t whole) {
    return static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(whole, 1));
}

std::string decimal(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", number);
    return text;
}

FigureGroup paths(const Snapshot& snapshot) {
    const Counters& c = snapshot.counters;
    return {"Paths of " + std::string(paper_name(snapshot.settings.method)),
            {{"spp", "samples a pixel", std::to_string(snapshot.spp), {}, "Passes over the whole picture so far."},
             {"camera_paths",
              "camera paths",
              count_text(c.camera_paths),
              {},
              "Base paths traced in all passes, those of the columns and rows around tiles among them."},
             {"path_vertices",
              "mean vertices",
              decimal(ratio(c.path_vertices, c.camera_paths)),
              {},
              "Surface vertices a base path: its mean length."}}};
}

FigureGroup rays(const Counters& c) {
    FigureGroup group{"Rays", {{"rays", "all", count_text(c.all_rays()), {}, "Rays shot in all passes."}}};
    for (std::size_t i = 0; i < c.rays.size(); ++i) {
        const std::string_view kind = to_string(static_cast<RayKind>(i));
        if (c.rays[i] > 0)
            group.figures.push_back({"rays." + std::string(kind), in_words(kind), count_text(c.rays[i]),
                                     ratio(c.rays[i], c.all_rays()), ray_help[i]});
    }
    return group;
}

/// How often base paths were reused, as in [Bauszat 2017, Table 1].
FigureGroup reuse(const Counters& c) {
    const std::uint64_t all = c.set_paths();
    FigureGroup group{
        "Base paths",
        {{"reused", "reused", count_text(c.reused_paths), ratio(c.reused_paths, all),
          "Base paths that were shifted to the other pixels of their sampling set, of all in sampling sets: those "
          "reused per gradient. Table 1 of [Bauszat 2017] has 14.8 to 19 %. A path counts once for every set that "
          "it is in."},
         {"skipped", "skipped", count_text(c.skipped_paths), ratio(c.skipped_paths, all),
          "Base paths that carry light, and were ended by the roulette on reuse. Table 1 of [Bauszat 2017] has "
          "81.6 to 85.3 % and no third kind: to be compared with skipped and dark together."},
         {"dark", "dark", count_text(c.dark_paths), ratio(c.dark_paths, all),
          "Base paths without any light that could be reused."}}};
    if (c.skipped_light_paths > 0)
        group.figures.push_back(
            {"skipped_light",
             "skipped by weight",
             count_text(c.skipped_light_paths),
             {},
             "Light paths of reused base paths that were ended because their weight is small."});
    return group;
}

FigureGroup shifts(const Counters& c) {
    const std::uint64_t all = c.shift_attempts();
    FigureGroup group{"Shifts",
                      {{"shifts",
                        "a camera path",
                        decimal(ratio(all, c.camera_paths)),
                        {},
                        "Shifts of a base path to one other pixel, a camera path."}}};
    for (std::size_t i = 0; i < c.shifts.size(); ++i) {
        const auto outcome = static_cast<ShiftOutcome>(i);
        const std::string_view name = to_string(outcome);
        group.figures.push_back({"shifts." + std::string(name), in_words(name), count_text(c.shifts[i]),
                                 ratio(c.shifts[i], all), outcome_help(outcome)});
    }
    return group;
}

} // namespace

std::string count_text(std::uint64_t count) {
    if (count < 10000)
        return std::to_string(count);
    double number = static_cast<double>(count) / 1000;
    const char* units[] = {"k", "M", "G", "T"};
    std::size_t unit = 0;
    while (number >= 999.5 && unit + 1 < std::size(units)) {
        number /= 1000;
        ++unit;
    }
    char text[32];
    std::snprintf(text, sizeof text,
                  number < 9.995   ? "%.2f %s"
                  : number < 99.95 ? "%.1f %s"
                                   : "%.0f %s",
                  number, units[unit]);
    return text;
}

std::vector<FigureGroup> statistics(const Snapshot& snapshot) {
    const Counters& c = snapshot.counters;
    std::vector<FigureGroup> groups{paths(snapshot), rays(c)};
    if (c.set_paths() > 0)
        groups.push_back(reuse(c));
    if (c.shift_attempts() > 0)
        groups.push_back(shifts(c));
    return groups;
}

} // namespace tessera
