// The table of guarantees, from which help, tooltips and docs/reconstruction.md take their claims.
#include "recon/norm.h"

#include <array>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(Guarantee, OfEveryNormIsASentence) {
    for (const Norm norm : all_norms) {
        const std::string_view reason = guarantee_of(norm).reason;
        ASSERT_FALSE(reason.empty()) << to_string(norm);
        EXPECT_TRUE(reason.front() >= 'A' && reason.front() <= 'Z') << reason;
        EXPECT_EQ(reason.find('.'), reason.size() - 1) << reason;
    }
}

/// tests/recon/raw_samples_test.cpp shows that these norms alone are linear functions of the samples.
TEST(Guarantee, IsUnbiasedForLinearNormsAlone) {
    for (const Norm norm : all_norms) {
        const bool is_linear = norm == Norm::none || norm == Norm::l2 || norm == Norm::uniform;
        EXPECT_EQ(guarantee_of(norm).convergence == Convergence::unbiased, is_linear) << to_string(norm);
    }
}

TEST(Guarantee, OfADenoiserIsNotUnbiased) {
    for (const Norm norm : all_norms)
        if (denoises(norm)) {
            EXPECT_NE(guarantee_of(norm).convergence, Convergence::unbiased) << to_string(norm);
        }
}

/// Returns the rows of the table in docs/reconstruction.md: name, guarantee and reason.
std::vector<std::array<std::string, 3>> documented_rows() {
    std::ifstream file(TESSERA_SOURCE_DIR "/docs/reconstruction.md");
    std::vector<std::array<std::string, 3>> rows;
    bool is_inside = false;
    for (std::string line; std::getline(file, line);) {
        if (line == "<!-- guarantees -->" || line == "<!-- /guarantees -->")
            is_inside = line == "<!-- guarantees -->";
        std::vector<std::string> cells;
        std::istringstream words(line);
        for (std::string cell; std::getline(words, cell, '|');)
            cells.push_back(cell.size() > 2 ? cell.substr(1, cell.size() - 2) : "");
        if (is_inside && cells.size() == 5 && cells[1] != "reconstruction" && cells[1].front() != '-')
            rows.push_back({cells[1], cells[3], cells[4]});
    }
    return rows;
}

TEST(Guarantee, EqualsTheTableInMethods) {
    std::vector<std::array<std::string, 3>> rows;
    for (const Norm norm : all_norms) {
        const Guarantee g = guarantee_of(norm);
        rows.push_back(
            {std::string(to_string(norm)), std::string(to_string(g.convergence)), std::string(g.reason)});
    }
    EXPECT_EQ(documented_rows(), rows);
}

TEST(Norm, NamesAreUnique) {
    std::set<std::string_view> names;
    for (const Norm norm : all_norms)
        names.insert(to_string(norm));
    EXPECT_EQ(names.size(), all_norms.size());
}

TEST(Norm, FallsBackToNoneWithoutGradients) {
    for (const Norm norm : all_norms) {
        EXPECT_EQ(applied(norm, true), norm);
        const bool needs_none = norm == Norm::smoothed || norm == Norm::oidn;
        EXPECT_EQ(applied(norm, false), needs_none ? norm : Norm::none) << to_string(norm);
    }
}

} // namespace

} // namespace tessera::test
