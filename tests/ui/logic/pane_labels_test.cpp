// Labels of panes, badges and curves.

#include "ui/panes/pane_parts.h"
#include "ui/panes/showing.h"
#include "ui/state/pane_labels.h"

#include <initializer_list>
#include <string>

#include <gtest/gtest.h>

namespace tessera {
namespace {

/// Returns panes of these methods with default settings.
ViewerState panes_of(std::initializer_list<Method> methods) {
    ViewerState state;
    for (Method method : methods)
        state.panes.emplace_back().settings.render.method = method;
    return state;
}

TEST(PaneLabels, ShowTheMethodOnlyIfMethodsDiffer) {
    ViewerState state = panes_of({Method::pt, Method::gpr});
    state.panes[1].settings.render.tile = 5; // PT has no tiles
    state.panes[1].settings.reconstruction.norm = Norm::l1;
    EXPECT_EQ(pane_label(state, 0), "PT");
    EXPECT_EQ(pane_label(state, 1), "G-PR");
}

TEST(PaneLabels, ShowTheDifferenceOfPanesOfOneMethod) {
    ViewerState state = panes_of({Method::gpr, Method::gpr});
    state.panes[0].settings.reconstruction.norm = Norm::l2;
    state.panes[1].settings.reconstruction.norm = Norm::l1;
    EXPECT_EQ(pane_label(state, 0), "G-PR, L2");
    EXPECT_EQ(pane_label(state, 1), "G-PR, L1");
    state.panes[0].settings.render.tile = 6;
    state.panes[1].settings.render.tile = 8;
    EXPECT_EQ(pane_label(state, 0), "G-PR, tile 6, L2");
    EXPECT_EQ(pane_label(state, 1), "G-PR, tile 8, L1");
    state.panes[1].settings.render.adapt_tile = !state.panes[0].settings.render.adapt_tile;
    EXPECT_EQ(pane_label(state, 1), state.panes[1].settings.render.adapt_tile
                                        ? "G-PR, tile 8, adaptive tiles on, L1"
                                        : "G-PR, tile 8, adaptive tiles off, L1");
}

TEST(PaneLabels, AreUsedByBadgesAndStatus) {
    ViewerState state = panes_of({Method::gpr, Method::gpr});
    state.panes[1].settings.reconstruction.norm = Norm::l1;
    EXPECT_EQ(label_of(Showing{0}, state), "1  G-PR, guided  Result");
    EXPECT_EQ(label_of(Showing{1}, state), "2  G-PR, L1  Result");
    EXPECT_EQ(label_of(Showing{0, 1}, state), "1  G-PR, guided  minus  2  G-PR, L1");
    EXPECT_EQ(status_text(state, 1).rfind("G-PR, L1   ", 0), 0u) << status_text(state, 1);
}

} // namespace
} // namespace tessera
