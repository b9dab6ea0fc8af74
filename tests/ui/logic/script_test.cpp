#include "ui/settings/settings_file.h"
#include "ui/state/actions.h"
#include "ui/viewer/script.h"

#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera {
namespace {

std::vector<ScriptStep> parse(const std::string& text) {
    std::istringstream stream(text);
    return parse_script(stream, "steps.txt");
}

std::string error_of(const std::string& text) {
    try {
        parse(text);
    } catch (const ScriptError& error) {
        return error.what();
    }
    return "";
}

TEST(Script, StepsQuotesAndComments) {
    const auto steps = parse("# a comment\n\n  wait spp 16  # another\nclick \"menu View/Statistics\"\nquit");
    ASSERT_EQ(steps.size(), 3u);
    EXPECT_EQ(steps[0].word, "wait");
    EXPECT_EQ(steps[0].arguments, (std::vector<std::string>{"spp", "16"}));
    EXPECT_EQ(steps[0].line, 3);
    EXPECT_EQ(steps[1].arguments, std::vector<std::string>{"menu View/Statistics"});
    EXPECT_EQ(steps[2].line, 5);
}

TEST(Script, AHyphenIsStandardInput) {
    std::istringstream steps("quit\nunknown\n");
    std::streambuf* const before = std::cin.rdbuf(steps.rdbuf());
    try {
        read_script("-");
        ADD_FAILURE() << "an unknown step was read";
    } catch (const ScriptError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("standard input:2: unknown step unknown"));
    }
    std::cin.rdbuf(before);
}

TEST(Script, ErrorsNameFileAndLine) {
    EXPECT_EQ(error_of("wait scene\njump 3").rfind("steps.txt:2: unknown step jump; the steps are wait, key", 0),
              0u);
    EXPECT_EQ(error_of("\n\nset tile"), "steps.txt:3: usage: set NAME VALUE");
    EXPECT_EQ(error_of("print \"no end"), "steps.txt:1: missing closing quotation mark");
    EXPECT_EQ(error_of("print \"\""), "");
    EXPECT_THROW(read_script("/nowhere/steps.txt"), ScriptError);
}

TEST(Script, KeysAreNamedAsInTheMenus) {
    EXPECT_EQ(shortcut_named("M"), (Shortcut{Key::m, false, false, 0}));
    EXPECT_EQ(shortcut_named("Ctrl+Shift+K"), (Shortcut{Key::k, true, true, 0}));
    EXPECT_EQ(shortcut_named("F12"), (Shortcut{Key::f12, false, false, 0}));
    EXPECT_EQ(shortcut_named("Space"), (Shortcut{Key::space, false, false, 0}));
    EXPECT_EQ(shortcut_named("?"), (Shortcut{Key::none, false, false, '?'}));
    EXPECT_EQ(shortcut_named("+"), (Shortcut{Key::none, false, false, '+'}));
    EXPECT_FALSE(shortcut_named("Hyper"));
    EXPECT_FALSE(shortcut_named(""));
    for (int key = 1; key < static_cast<int>(Key::count); ++key) {
        const Shortcut shortcut{static_cast<Key>(key), true, false, 0};
        EXPECT_EQ(shortcut_named(to_string(shortcut)), shortcut);
    }
}

TEST(NamedSettings, SetPaneAndViewerSettings) {
    ViewerState state;
    for (const PaneSettings& settings : default_panes(2))
        state.panes.push_back({settings, nullptr, 0, {100, 100}});
    set_by_name(state, "tile", "4");
    EXPECT_EQ(state.panes[1].settings.render.tile, 4); // linked
    set_by_name(state, "panes", "4");
    EXPECT_EQ(state.panes.size(), 4u);
    set_by_name(state, "active", "3");
    set_by_name(state, "method", "pr");
    set_by_name(state, "buffer", "dx");
    set_by_name(state, "comparison", "wipe");
    EXPECT_EQ(state.panes[2].settings.render.method, Method::pr);
    EXPECT_EQ(state.panes[2].settings.buffer, Buffer::dx);
    EXPECT_EQ(state.panes[2].settings.comparison.kind, Comparison::Kind::wipe);
    set_by_name(state, "exposure", "-1.5");
    EXPECT_EQ(state.display.tone.exposure, -1.5f);
    set_by_name(state, "size", "64x32");
    EXPECT_EQ(state.rendering.size.custom, glm::ivec2(64, 32));
    set_by_name(state, "norm", "l1");
    EXPECT_EQ(state.panes[0].settings.reconstruction.norm, Norm::l1);
    set_by_name(state, "compare_with", "reference");
    EXPECT_EQ(state.panes[2].settings.comparison.with, the_reference);
    set_by_name(state, "compare_with", "2");
    EXPECT_EQ(state.panes[2].settings.comparison.with, 1);
    for (const auto& [name, value] :
         {std::pair("tile", "99"), std::pair("nothing", "1"), std::pair("size", "3"), std::pair("theme", "red"),
          std::pair("exposure", "nan"), std::pair("alpha", "0"), std::pair("compare_with", "5"),
          std::pair("size", "9000x1")})
        EXPECT_THROW(set_by_name(state, name, value), std::invalid_argument) << name;
}

TEST(FrameTimes, Quantiles) {
    FrameTimes times{"idle", {}, 2, {}};
    EXPECT_EQ(quantile(times.seconds, 0.5), 0);
    for (int i = 100; i > 0; --i)
        times.seconds.push_back(i * 1e-3);
    EXPECT_DOUBLE_EQ(quantile(times.seconds, 0.5), 0.050);
    EXPECT_DOUBLE_EQ(quantile(times.seconds, 0.99), 0.099);
    EXPECT_DOUBLE_EQ(quantile(times.seconds, 1), 0.100);
    EXPECT_EQ(times.text(), "frames idle: 100, median 50.0 ms, 99th percentile 99.0 ms");
    times.behind = {0.03, 0.01, 0.02};
    times.seconds = {0.5, 0.5, 0.5};
    EXPECT_EQ(times.text(), "frames idle: 3, median 500.0 ms, 99th percentile 500.0 ms; 3 pictures, 1.5 a second, "
                            "behind the camera by a median of 20.0 ms");
}

} // namespace
} // namespace tessera
