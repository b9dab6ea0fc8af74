#include "ui/panels/panels.h"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tessera {
namespace {

Snapshot snapshot_of_counts() {
    Snapshot snapshot;
    snapshot.spp = 12;
    Counters& c = snapshot.counters;
    c.camera_paths = 2000;
    c.path_vertices = 5000;
    c.rays = {20000, 0, 10000, 0, 40000, 10000};
    c.dark_paths = 10;
    c.skipped_paths = 830;
    c.reused_paths = 160;
    c.shifts = {600, 300, 0, 50, 0, 50};
    return snapshot;
}

const Statistic& figure(const std::vector<StatisticGroup>& groups, const std::string& id) {
    for (const StatisticGroup& group : groups) {
        for (const Statistic& f : group.statistics) {
            if (f.id == id)
                return f;
        }
    }
    throw std::runtime_error("no figure " + id);
}

bool has_figure(const Snapshot& snapshot, const std::string& id) {
    const std::vector<StatisticGroup> groups = statistics(snapshot);
    return std::any_of(groups.begin(), groups.end(), [&](const StatisticGroup& group) {
        return std::any_of(group.statistics.begin(), group.statistics.end(),
                           [&](const Statistic& f) { return f.id == id; });
    });
}

TEST(Statistics, EachCounterHasAFigure) {
    const std::vector<StatisticGroup> groups = statistics(snapshot_of_counts());
    EXPECT_EQ(figure(groups, "spp").value, "12");
    EXPECT_EQ(figure(groups, "camera_paths").value, "2000");
    EXPECT_EQ(figure(groups, "path_vertices").value, "2.50");
    EXPECT_EQ(figure(groups, "rays").value, "80.0 k");
    EXPECT_EQ(figure(groups, "rays.shift_bounce").value, "40.0 k");
    EXPECT_EQ(figure(groups, "rays.shift_bounce").label, "shift bounce");
    EXPECT_DOUBLE_EQ(*figure(groups, "rays.camera").share, 0.25);
    EXPECT_DOUBLE_EQ(*figure(groups, "reused").share, 0.16);
    EXPECT_DOUBLE_EQ(*figure(groups, "skipped").share, 0.83);
    EXPECT_DOUBLE_EQ(*figure(groups, "dark").share, 0.01);
    EXPECT_EQ(figure(groups, "shifts").value, "0.50");
    EXPECT_DOUBLE_EQ(*figure(groups, "shifts.ok").share, 0.6);
    EXPECT_DOUBLE_EQ(*figure(groups, "shifts.occluded").share, 0.3);
    EXPECT_DOUBLE_EQ(*figure(groups, "shifts.kind_mismatch").share, 0);
    for (const StatisticGroup& group : groups) {
        for (const Statistic& f : group.statistics)
            EXPECT_GT(f.help.size(), 20u) << f.id;
    }
}

TEST(Statistics, EventsThatDidNotOccurAreOmitted) {
    Snapshot snapshot = snapshot_of_counts();
    EXPECT_FALSE(has_figure(snapshot, "rays.light"));
    snapshot.counters.dark_paths = snapshot.counters.skipped_paths = snapshot.counters.reused_paths = 0;
    snapshot.counters.shifts = {};
    EXPECT_FALSE(has_figure(snapshot, "reused"));
    EXPECT_FALSE(has_figure(snapshot, "shifts.ok"));
    EXPECT_EQ(figure(statistics(Snapshot{}), "path_vertices").value, "0.00"); // without any path
}

TEST(Statistics, CountsHaveThreeDigits) {
    EXPECT_EQ(count_text(0), "0");
    EXPECT_EQ(count_text(9999), "9999");
    EXPECT_EQ(count_text(12345), "12.3 k");
    EXPECT_EQ(count_text(999400), "999 k");
    EXPECT_EQ(count_text(999600), "1.00 M");
    EXPECT_EQ(count_text(4560000), "4.56 M");
    EXPECT_EQ(count_text(9996000), "10.0 M");
    EXPECT_EQ(count_text(7890000000), "7.89 G");
    EXPECT_EQ(count_text(5000000000000000), "5000 T");
}

} // namespace
} // namespace tessera
