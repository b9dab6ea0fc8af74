#include "app/cli/opened_scene.h"

#include <gtest/gtest.h>

namespace tessera {

namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::vector<LoadNote>& notes) {
    Lines lines;
    for (const SceneNote& note : group_notes(notes))
        lines.push_back((note.is_error ? "error: " : "") + note.text);
    return lines;
}

TEST(LoadNotes, EqualTextsShareALine) {
    EXPECT_EQ(lines_of({}), Lines{});
    EXPECT_EQ(lines_of({{{"s.xml", 3, 5}, "odd"}}), Lines{"s.xml:3:5: odd"});
    EXPECT_EQ(lines_of({{{"s.xml", 3, 5}, "odd"}, {{"s.xml", 4, 1}, "strange"}, {{"s.xml", 9, 2}, "odd"}}),
              (Lines{"s.xml:3:5: odd (also at 9:2)", "s.xml:4:1: strange"}));
}

TEST(LoadNotes, ManyPlacesAreCounted) {
    std::vector<LoadNote> notes;
    for (int line = 1; line <= 5; ++line)
        notes.push_back({{"s.xml", line, 2}, "odd"});
    EXPECT_EQ(lines_of(notes), Lines{"s.xml:1:2: odd (also at 2:2, 3:2, 4:2 and 1 more place)"});
    for (int line = 6; line <= 100; ++line)
        notes.push_back({{"s.xml", line, 2}, "odd"});
    EXPECT_EQ(lines_of(notes), Lines{"s.xml:1:2: odd (also at 2:2, 3:2, 4:2 and 96 more places)"});
}

TEST(LoadNotes, ErrorsComeFirst) {
    EXPECT_EQ(lines_of({{{"s.xml", 3, 5}, "odd"}, {{"s.xml", 4, 1}, "missing", true}}),
              (Lines{"error: s.xml:4:1: missing", "s.xml:3:5: odd"}));
}

TEST(LoadNotes, OtherFilesAreNamed) {
    EXPECT_EQ(lines_of({{{"s.xml", 3, 5}, "odd"}, {{"t.xml", 9, 2}, "odd"}, {{"s.xml", 0, 0}, "odd"}}),
              Lines{"s.xml:3:5: odd (also at t.xml:9:2, s.xml)"});
}

} // namespace

} // namespace tessera
