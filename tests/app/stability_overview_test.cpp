#include "app/report/reports.h"

#include <limits>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(StabilityOverview, EveryCellIsInTheColumnOfItsPoint) {
    using Kind = Verdict::Kind;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(overview({{"glossy-0.001", "pt", Kind::ok, 1},
                        {"glossy-0.001", "pr", Kind::worse, 2.5},
                        {"glossy-0.001", "gpr-l2", Kind::fails, unknown},
                        {"sds", "pt", Kind::ok, 1}, // Ctrl-C came before its second run of pr
                        {"sds", "gpr-l2", Kind::ok, 0.125}}),
              "| scene | pt | pr | gpr-l2 |\n"
              "| --- | --- | --- | --- |\n"
              "| [glossy-0.001](#glossy-0.001) | ok 1 | **worse 2.5** | **fails** |\n"
              "| [sds](#sds) | ok 1 | | ok 0.125 |\n");
    EXPECT_EQ(anchor("glossy-0.001"), "<a id=\"glossy-0.001\"></a>");
}

} // namespace

} // namespace tessera::test
