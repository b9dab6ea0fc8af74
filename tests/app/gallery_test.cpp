// The gallery lists every scene of the suite, with a picture, its known failures and the verdicts.
#include "app/commands/commands.h"
#include "app/experiment/stability.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(Gallery, HasAllScenesOfTheSuite) {
    const GalleryContents found = gallery(built_in_stability_scenes);
    const std::vector<GalleryEntry>& entries = found.entries;
    EXPECT_EQ(found.problem, "");
    ASSERT_EQ(entries.size(), 1 + built_in_stability_scenes().size());
    EXPECT_TRUE(entries.front().file.empty());
    for (const GalleryEntry& entry : entries) {
        EXPECT_EQ(entry.picture.width(), 128) << entry.title << ": scripts/gallery makes its picture";
        EXPECT_TRUE(entry.file.empty() || std::filesystem::exists(entry.file)) << entry.file;
    }
    const auto entry = [&](const std::string& title) {
        const auto place = std::ranges::find(entries, title, [](const GalleryEntry& e) { return e.title; });
        return place == entries.end() ? GalleryEntry{} : *place;
    };
    // Verdicts of the last run of the suite, whatever they are.
    const ErrorTable& errors = entry("glossy").errors;
    EXPECT_THAT(errors.columns,
                testing::ElementsAre("Scene", "PR", "G-PT guided", "G-PR weighted", "G-PR guided"));
    const auto row = std::ranges::find(errors.rows, "glossy-0.03", [](const auto& r) { return r.front().text; });
    ASSERT_NE(row, errors.rows.end());
    for (std::size_t i = 1; i < row->size(); ++i)
        EXPECT_THAT((*row)[i].text, testing::ContainsRegex("^[0-9.]+$")) << errors.columns[i];
    EXPECT_THAT(entry("normal-map").verdict, testing::ContainsRegex("^G-PR [a-z]+ [0-9.]+$"));
}

/// The verdict is that of the default method and reconstruction, for the worst variation of the scene.
TEST(Gallery, MarksScenesWhereTheDefaultIsWorse) {
    const GalleryContents found = gallery(built_in_stability_scenes, "scene,method,recon,verdict,factor\n"
                                                                     "glossy-0.01,gpr,guided,worse than PT,1.25\n"
                                                                     "glossy-0.1,gpr,guided,ok,0.5\n"
                                                                     "glossy-0.1,gpr,weighted,worse than PT,1.1\n"
                                                                     "edges,pr,none,worse than PT,3\n"
                                                                     "edges,gpr,guided,ok,0.25\n");
    for (const GalleryEntry& entry : found.entries) {
        EXPECT_EQ(entry.is_worse, entry.title == "glossy") << entry.title;
        EXPECT_EQ(entry.verdict, entry.title == "glossy"  ? "G-PR worse 1.25"
                                 : entry.title == "edges" ? "G-PR ok 0.25"
                                                          : "");
        if (entry.title == "glossy") {
            ASSERT_EQ(entry.errors.rows.size(), 2u);
            const auto& row = entry.errors.rows[1];
            EXPECT_EQ(row[0].text, "glossy-0.1");
            EXPECT_EQ(row[1].text, "-") << "PR was not measured";
            EXPECT_EQ(row[3].text, "1.1");
            EXPECT_TRUE(row[3].is_worse);
            EXPECT_EQ(row[4].text, "0.5");
            EXPECT_FALSE(row[4].is_worse);
        }
    }
}

TEST(Gallery, ListsTheBuiltInSceneIfOthersAreMissing) {
    const GalleryContents found =
        gallery([]() -> std::vector<std::filesystem::path> { throw std::runtime_error("no room in /tmp"); });
    ASSERT_EQ(found.entries.size(), 1u);
    EXPECT_TRUE(found.entries.front().file.empty());
    EXPECT_THAT(found.problem, testing::HasSubstr("no room in /tmp"));
}

} // namespace

} // namespace tessera::test
