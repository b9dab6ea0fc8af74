// What the stability suite has found, row by row, for its page, its text and its file of numbers.
#pragma once

#include "app/experiment/stability.h"
#include "app/report/reports.h"

#include <string>
#include <vector>

namespace tessera {

/// What was found of one setup on one scene.
struct StabilityRow {
    const StabilityCase* of;
    Result result;
    Findings findings;
    Verdict verdict;
};

/// The suite is to call a mean wrong that is not once in a hundred times, all its tests together [Bonferroni]:
/// energy and bias of each setup.
double level_of(const ExperimentOptions& suite, const std::vector<StabilityCase>& cases);

/// The rows of all cases, of setups that have two runs, as PT has on the same kind of machine.
std::vector<StabilityRow> rows_of(const std::vector<StabilityCase>& cases, double level);

const ReferenceImage& reference_of(const StabilityCase& c);

/// What the rows call a setup, and the kind of machine where results are told apart by it.
std::string name_of(const Result& result);

std::string to_csv(const std::vector<StabilityRow>& rows);

} // namespace tessera
