#include "app/report/reports.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(StabilityOverview, EveryCellIsInTheColumnOfItsMethod) {
    using Kind = Verdict::Kind;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const ReportTable table = overview({{"glossy-0.001", "pt", Kind::ok, 1},
                                        {"glossy-0.001", "pr", Kind::worse, 2.5},
                                        {"glossy-0.001", "gpr-l2", Kind::fails, unknown},
                                        {"sds", "pt", Kind::ok, 1}, // interrupted before the run of pr
                                        {"sds", "gpr-l2", Kind::ok, 0.125}});
    EXPECT_EQ(to_markdown(table), "| scene | pt | pr | gpr-l2 |\n"
                                  "| --- | --- | --- | --- |\n"
                                  "| [glossy-0.001](#glossy-0.001) | ok 1 | **worse 2.5** | **fails** |\n"
                                  "| [sds](#sds) | ok 1 | | ok 0.125 |\n");
    const std::string html = to_html(table);
    for (const char* part :
         {"<td class=\"words \"><a href=\"#glossy-0.001\">glossy-0.001</a></td><td class=\"words ok\">ok 1</td>"
          "<td class=\"words worse\"><b>worse 2.5</b></td><td class=\"words fails\"><b>fails</b></td></tr>",
          "<td class=\"words ok\">ok 1</td><td class=\"words \"></td><td class=\"words ok\">ok 0.125</td>"})
        EXPECT_NE(html.find(part), std::string::npos) << html;
    EXPECT_EQ(anchor("glossy-0.001"), "<a id=\"glossy-0.001\"></a>");
}

} // namespace

} // namespace tessera::test
