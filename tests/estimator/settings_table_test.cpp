// The table that command line, panel and files are made from.
#include "render/estimator/settings_table.h"
#include "render/trace/rays.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {

namespace {

using testing::HasSubstr;

std::string refusal(std::string_view id, std::string_view text) {
    RenderSettings settings;
    try {
        setting_named(id).set_text(settings, text);
    } catch (const std::invalid_argument& error) {
        EXPECT_EQ(settings, RenderSettings()) << id << ' ' << text;
        return error.what();
    }
    return "";
}

/// Choices are by position: one for each value, and none too many.
TEST(SettingsTable, HasAChoiceForEachValue) {
    const auto choices = [](std::string_view id) {
        return std::get<Setting::OneOf>(setting_named(id).kind).choices.size();
    };
    EXPECT_EQ(choices("shift"), enumerator_count<ShiftKind>);
    EXPECT_EQ(choices("pattern"), enumerator_count<Pattern>);
    EXPECT_EQ(choices("roulette"), enumerator_count<RouletteKind>);
    EXPECT_EQ(choices("primal"), enumerator_count<PrimalSource>);
}

TEST(SettingsTable, TheLargestTileHasLanes) {
    EXPECT_EQ(std::get<Setting::Whole>(setting_named("tile").kind).most, most_tile);
    EXPECT_LE((most_tile + 1) * (most_tile + 1), most_lanes);
}

TEST(SettingsTable, SetTextUndoesText) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
        {"tile", {"1", "16"}},
        {"adapt_tile", {"on", "off"}},
        {"jitter", {"off", "on"}},
        {"pattern", {"tile", "rooks"}},
        {"roulette", {"relative", "absolute", "none"}},
        {"rr_scale", {"0", "0.25"}},
        {"rr_delta", {"1e+30", "0.001"}},
        {"primal", {"reuse", "base"}},
        {"shift", {"half-vector", "replay-reconnection"}},
        {"max_depth", {"1", "64"}},
        {"q_min", {"0.0001", "1"}},
        {"roulette_depth", {"0", "12"}},
    };
    for (const auto& [id, values] : cases) {
        RenderSettings settings;
        for (const std::string& value : values) {
            setting_named(id).set_text(settings, value);
            EXPECT_EQ(setting_named(id).text(settings), value) << id;
        }
    }
}

TEST(SettingsTable, SetTextOfItsOwnTextChangesNothing) {
    for (const Setting& setting : all_settings()) {
        RenderSettings settings;
        setting.set_text(settings, setting.text(settings));
        EXPECT_EQ(settings, RenderSettings()) << setting.id;
    }
}

TEST(SettingsTable, RefusesWhatItMayNotBe) {
    const std::string tile = "must be a whole number from 1 to 16";
    for (const char* text : {"0", "17", "-1", "4.5", "4x", " 4", "", "four", "99999999999"})
        EXPECT_THAT(refusal("tile", text), HasSubstr(tile)) << text;
    for (const char* text : {"-0.1", "1.1", "nan", "inf", "", "0.1,0.2"})
        EXPECT_THAT(refusal("weight_threshold", text), HasSubstr("must be a number from 0 to 1")) << text;
    for (const char* text : {"true", "1", "", "ON"})
        EXPECT_THAT(refusal("adapt_tile", text), HasSubstr("must be on or off")) << text;
    EXPECT_EQ(refusal("roulette", "fair"), "roulette is \"fair\": must be one of relative, absolute, none");
}

TEST(SettingsTable, SettingsHaveTheNamesOfTheirOptions) {
    EXPECT_EQ(&setting_named("rr-delta"), &setting_named("rr_delta"));
    EXPECT_EQ(setting_named("rr_delta").id, "rr_delta");
    try {
        setting_named("tiles");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr("there is no setting \"tiles\", only: tile, adapt_tile"));
        EXPECT_THAT(error.what(), HasSubstr("roulette_depth"));
    }
}

TEST(SettingsTable, CheckNamesTheSettingAndItsLimits) {
    RenderSettings settings;
    EXPECT_NO_THROW(check(settings));
    settings.q_min = 0;
    try {
        check(settings);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "q_min is 0: must be a number from 0.0001 to 1");
    }
}

} // namespace

} // namespace tessera
