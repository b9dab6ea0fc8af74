#pragma once

#include "tests/ui/viewer_harness.h"
#include "ui/state/companions.h"

#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

/// A viewer at rest, optionally with a reference of one colour.
struct Charts : testing::Test, ViewerHarness {
    Charts() { rest(2); }

    void set_reference(Rgb value) {
        state().companions.reference = make_reference("a reference", RgbImage(48, 36, value), {});
    }

    /// Returns a pane's newest curve of errors or estimates; empty: it has none.
    std::vector<ErrorPoint> errors(int i) {
        const PaneChart& chart = state().charts.of(pane(i));
        const auto& curves = chart.curves;
        return curves.empty() || chart.reference != state().companions.reference ? std::vector<ErrorPoint>()
                                                                                 : curves.back().points();
    }

    void wait_for_errors(int i, int spp) {
        wait_until([&] { return !errors(i).empty() && errors(i).back().spp == spp; });
    }
};

} // namespace tessera::test
