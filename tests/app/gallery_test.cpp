// The gallery knows every scene of the suite, with a picture, what fails there and the verdicts.
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
    EXPECT_THAT(entry("glossy").help, testing::HasSubstr("\nglossy-0.03:  pr worse 1.49"));
    EXPECT_THAT(entry("glossy").verdict, testing::StartsWith("G-PR ok"));
    EXPECT_FALSE(entry("glossy").is_worse);
    EXPECT_THAT(entry("normal-map").verdict, testing::StartsWith("G-PR ok"));
    for (const GalleryEntry& e : entries) // of whatever the results say
        EXPECT_EQ(e.is_worse, e.verdict.find("worse") != std::string::npos ||
                                  e.verdict.find("fails") != std::string::npos ||
                                  e.verdict.find("undecided") != std::string::npos)
            << e.title << ": " << e.verdict;
}

TEST(Gallery, HasTheSceneWithinTheProgramWhereOthersAreNotFound) {
    const GalleryContents found =
        gallery([]() -> std::vector<std::filesystem::path> { throw std::runtime_error("no room in /tmp"); });
    ASSERT_EQ(found.entries.size(), 1u);
    EXPECT_TRUE(found.entries.front().file.empty());
    EXPECT_THAT(found.problem, testing::HasSubstr("no room in /tmp"));
}

} // namespace

} // namespace tessera::test
