// Results of the stability suite as rows, for its page, its Markdown report and its CSV file.
#pragma once

#include "app/experiment/stability.h"
#include "app/report/reports.h"

#include <string>
#include <vector>

namespace tessera {

/// Results of one setup on one scene.
struct StabilityRow {
    const StabilityCase* of;
    Result result;
    Findings findings;
    Verdict verdict;
};

/// Returns the significance level of a single test, by Bonferroni correction: the probability that any test of
/// the suite (energy and bias of each setup) calls an unbiased mean biased is at most 1 %.
double level_of(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases);

/// Returns the rows of all cases: setups with at least two runs, if PT has two on the same kind of machine.
std::vector<StabilityRow> rows_of(const std::vector<StabilityCase>& cases, double level);

const ReferenceImage& reference_of(const StabilityCase& c);

/// Returns the name of the setup, with the kind of machine if results are separated by it.
std::string name_of(const Result& result);

std::string to_csv(const std::vector<StabilityRow>& rows);

} // namespace tessera
