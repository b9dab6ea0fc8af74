// The gallery knows every scene of the suite, with a picture, what fails there and the verdicts.
#include "app/commands/commands.h"
#include "app/experiment/stability.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(Gallery, HasAllScenesOfTheSuite) {
    const std::vector<GalleryEntry> entries = gallery();
    ASSERT_EQ(entries.size(), 1 + built_in_stability_scenes().size());
    EXPECT_TRUE(entries.front().file.empty());
    for (const GalleryEntry& entry : entries) {
        EXPECT_EQ(entry.picture.width(), 128) << entry.title << ": scripts/gallery makes its picture";
        EXPECT_TRUE(entry.file.empty() || std::filesystem::exists(entry.file)) << entry.file;
    }
    const auto glossy =
        std::ranges::find(entries, std::string("glossy"), [](const GalleryEntry& e) { return e.title; });
    ASSERT_NE(glossy, entries.end());
    EXPECT_THAT(glossy->help, testing::HasSubstr("\nglossy-0.01:  pr worse 1.39"));
    EXPECT_THAT(glossy->verdict, testing::StartsWith("G-PR worse"));
    EXPECT_TRUE(glossy->is_worse);
}

} // namespace

} // namespace tessera::test
