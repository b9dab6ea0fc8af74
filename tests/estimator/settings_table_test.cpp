// The table from which the command line, the panel and files get the settings.
#include "recon/enumeration.h"
#include "render/settings/settings_table.h"
#include "render/trace/rays.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

using testing::HasSubstr;

/// Returns the message of the rejection of a text; empty: it was accepted.
std::string rejection(const Setting& setting, std::string_view text) {
    const std::string before = setting.text();
    try {
        setting.set_text(text);
    } catch (const std::invalid_argument& error) {
        EXPECT_EQ(setting.text(), before) << setting.id << ' ' << text;
        return error.what();
    }
    return "";
}

std::string rejection(std::string_view id, std::string_view text) {
    RenderSettings settings;
    return rejection(setting_named(settings_of(settings), id), text);
}

/// Choices are matched to values by position.
TEST(SettingsTable, HasAChoiceForEachValue) {
    RenderSettings settings;
    const auto choices = [&](std::string_view id) {
        return std::get<Setting::OneOf>(setting_named(settings_of(settings), id).kind).choices.size();
    };
    EXPECT_EQ(choices("shift"), enumerator_count<ShiftKind>);
    EXPECT_EQ(choices("pattern"), enumerator_count<Pattern>);
    EXPECT_EQ(choices("roulette"), enumerator_count<RouletteKind>);
}

TEST(SettingsTable, TheLargestSetFitsIntoTheLanes) {
    RenderSettings settings;
    EXPECT_EQ(std::get<Setting::Whole>(setting_named(settings_of(settings), "tile").kind).most, most_tile);
    EXPECT_LE((most_tile + 1) * (most_tile + 1), most_lanes);
}

TEST(SettingsTable, TextReturnsWhatSetTextTook) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
        {"tile", {"1", "16"}},
        {"adapt_tile", {"on", "off"}},
        {"pattern", {"tile", "rooks"}},
        {"roulette", {"relative", "absolute", "none"}},
        {"rr_delta", {"1e+30", "0.001"}},
        {"shift", {"half-vector", "replay-reconnection"}},
        {"max_depth", {"1", "64"}},
        {"shift_distance", {"0", "1000"}},
        {"roulette_depth", {"0", "12"}},
    };
    for (const auto& [id, values] : cases) {
        RenderSettings settings;
        for (const std::string& value : values) {
            setting_named(settings_of(settings), id).set_text(value);
            EXPECT_EQ(setting_named(settings_of(settings), id).text(), value) << id;
        }
    }
}

TEST(SettingsTable, CoversSettingsOutsideRenderSettings) {
    ReconstructionSettings reconstruction;
    Method method{};
    std::uint64_t seed = 0;
    int spp = 1, threads = 1;
    glm::ivec2 size(1);
    std::vector<Setting> settings = settings_of(reconstruction);
    for (const Setting& setting : {method_setting(method), seed_setting(seed), spp_setting(spp, 2),
                                   threads_setting(threads), size_setting(size, 8192)})
        settings.push_back(setting);
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
        {"norm", {"none", "l2", "l1", "mixed", "uniform", "weighted"}},
        {"alpha", {"0.0001", "1000"}},
        {"method", {"pt", "pr", "gpt", "gpr"}},
        {"seed", {"0", "18446744073709551615"}},
        {"spp", {"2", "100000000"}},
        {"threads", {"0", "1024"}},
        {"size", {"1x8192", "64x32"}},
    };
    for (const auto& [id, values] : cases)
        for (const std::string& value : values) {
            setting_named(settings, id).set_text(value);
            EXPECT_EQ(setting_named(settings, id).text(), value) << id;
        }
    EXPECT_EQ(method, Method::gpr);
    EXPECT_EQ(reconstruction, (ReconstructionSettings{Norm::weighted, 1000}));
    EXPECT_EQ(size, glm::ivec2(64, 32));
    EXPECT_EQ(rejection(setting_named(settings, "spp"), "1"),
              "spp is \"1\": must be a whole number from 2 to 100000000");
    for (const char* text : {"-1", "18446744073709551616", "1.5", ""})
        EXPECT_THAT(rejection(setting_named(settings, "seed"), text), HasSubstr("must be a whole number from 0"));
    for (const char* text : {"64", "64x", "x32", "0x32", "64x8193", "64x32x", "-1x5", "64 x32"})
        EXPECT_THAT(rejection(setting_named(settings, "size"), text),
                    HasSubstr("must be WIDTHxHEIGHT, such as 640x360, each from 1 to 8192 pixels"))
            << text;
}

TEST(SettingsTable, ChoicesAreInTheOrderOfTheirEnums) {
    ReconstructionSettings reconstruction;
    for (Norm norm : all_norms) {
        reconstruction.norm = norm;
        EXPECT_EQ(setting_named(settings_of(reconstruction), "norm").text(), to_string(norm));
    }
    for (Method method : all_methods)
        EXPECT_EQ(method_setting(method).text(), short_name(method));
}

TEST(SettingsTable, MattersDependsOnMethodAndNorm) {
    ReconstructionSettings reconstruction;
    for (Norm norm : all_norms) {
        reconstruction.norm = norm;
        EXPECT_EQ(setting_named(settings_of(reconstruction), "alpha").matters,
                  norm != Norm::none && norm != Norm::uniform && norm != Norm::smoothed && norm != Norm::oidn)
            << to_string(norm);
    }
    RenderSettings render;
    render.method = Method::pt;
    EXPECT_FALSE(setting_named(settings_of(render), "tile").matters);
    EXPECT_TRUE(setting_named(settings_of(render), "max_depth").matters);
    render.method = Method::gpr;
    EXPECT_TRUE(setting_named(settings_of(render), "tile").matters);
    EXPECT_FALSE(setting_named(settings_of(render), "pattern").matters);
}

TEST(SettingsTable, ValuesAreJson) {
    RenderSettings settings;
    const auto json = [&](std::string_view id) { return setting_named(settings_of(settings), id).json_value(); };
    EXPECT_EQ(json("tile"), nlohmann::json(6));
    EXPECT_EQ(json("rr_delta"), nlohmann::json(0.1f));
    EXPECT_EQ(json("adapt_tile"), nlohmann::json(true));
    EXPECT_EQ(json("shift"), nlohmann::json("half-vector"));
}

TEST(SettingsTable, SetTextOfItsOwnTextChangesNothing) {
    RenderSettings settings;
    for (const Setting& setting : settings_of(settings)) {
        setting.set_text(setting.text());
        EXPECT_EQ(settings, RenderSettings()) << setting.id;
    }
}

TEST(SettingsTable, RejectsInvalidText) {
    const std::string tile = "must be a whole number from 1 to 16";
    for (const char* text : {"0", "17", "-1", "4.5", "4x", " 4", "", "four", "99999999999"})
        EXPECT_THAT(rejection("tile", text), HasSubstr(tile)) << text;
    for (const char* text : {"-0.1", "1000.1", "nan", "inf", "", "0.1,0.2"})
        EXPECT_THAT(rejection("shift_distance", text), HasSubstr("must be a number from 0 to 1000")) << text;
    for (const char* text : {"true", "1", "", "ON"})
        EXPECT_THAT(rejection("adapt_tile", text), HasSubstr("must be on or off")) << text;
    EXPECT_EQ(rejection("roulette", "fair"), "roulette is \"fair\": must be one of relative, absolute, none");
}

TEST(SettingsTable, FindsSettingsByTheNamesOfOptions) {
    RenderSettings settings;
    EXPECT_EQ(setting_named(settings_of(settings), "rr-delta").id, "rr_delta");
    EXPECT_EQ(setting_named(settings_of(settings), "rr_delta").id, "rr_delta");
    try {
        setting_named(settings_of(settings), "tiles");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr("there is no setting \"tiles\", only: tile, adapt_tile, "));
        EXPECT_THAT(error.what(), HasSubstr("roulette_depth"));
    }
}

TEST(SettingsTable, CheckNamesTheSettingAndItsLimits) {
    RenderSettings settings;
    EXPECT_NO_THROW(check(settings));
    settings.rr_delta = -1;
    try {
        check(settings);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "rr_delta is -1: must be a number from 0 to 1e+30");
    }
}

} // namespace

} // namespace tessera
