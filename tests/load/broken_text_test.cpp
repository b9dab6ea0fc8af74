// Scenes with broken text encoding, or with entities and variables that expand exponentially.

#include "render/load/mitsuba_xml.h"

#include <gtest/gtest.h>

namespace tessera {

namespace {

const std::string plain =
    "<scene version='3.0.0'><sensor type='perspective'/><bsdf type='diffuse' id='Holz'/></scene>";

std::string error_of(const std::string& xml) {
    try {
        parse_mitsuba_xml(xml, "b.xml");
    } catch (const LoadError& e) {
        return e.what();
    }
    return "no error";
}

std::string utf16(const std::string& text, bool big_endian) {
    std::string result = big_endian ? "\xfe\xff" : "\xff\xfe";
    for (const char c : text) {
        result += big_endian ? '\0' : c;
        result += big_endian ? c : '\0';
    }
    return result;
}

} // namespace

TEST(BrokenText, SkipsAByteOrderMark) {
    EXPECT_EQ(parse_mitsuba_xml("\xef\xbb\xbf" + plain, "b.xml").notes.size(), 0u);
    EXPECT_EQ(error_of("\xef\xbb\xbf<scene version='x'/>").substr(0, 11), "b.xml:1:17:");
}

TEST(BrokenText, Utf16IsConverted) {
    for (const bool big_endian : {false, true}) {
        std::string text = utf16(plain, big_endian);
        EXPECT_EQ(parse_mitsuba_xml(text, "b.xml").description.materials.at(0).name, "Holz");
        EXPECT_EQ(error_of(text.substr(2)), "no error"); // without its byte order mark
        const std::size_t z = 2 + 2 * plain.find('z');
        text.replace(z, 2, big_endian ? "\x67\x28" : "\x28\x67"); // U+6728
        EXPECT_EQ(parse_mitsuba_xml(text, "b.xml").description.materials.at(0).name, "Hol\xe6\x9c\xa8");
        text.replace(z, 2, big_endian ? "\xd8\x3d\xde\x00" : "\x3d\xd8\x00\xde", 4); // U+1F600
        EXPECT_EQ(parse_mitsuba_xml(text, "b.xml").description.materials.at(0).name, "Hol\xf0\x9f\x98\x80");
        text.erase(z + 2, 2); // half of a pair
        EXPECT_EQ(error_of(text), "b.xml: the file is not valid UTF-16");
        EXPECT_EQ(error_of(utf16(plain, big_endian) + "x"), "b.xml: the file is not valid UTF-16");
    }
}

TEST(BrokenText, RejectsNulBytes) {
    std::string text = plain;
    text[30] = '\0';
    EXPECT_EQ(error_of(text), "b.xml: there are NUL bytes in the file; scenes are text in UTF-8 or UTF-16");
}

TEST(BrokenText, Latin1IsConverted) {
    std::string text = plain;
    text.replace(text.find("Holz"), 4, "Gr\xfcn");
    const LoadedScene loaded = parse_mitsuba_xml(text, "b.xml");
    EXPECT_EQ(loaded.description.materials.at(0).name, "Gr\xc3\xbcn");
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_EQ(loaded.notes[0].text, "the file is not UTF-8; it is read as Latin-1");
    text.replace(text.find("Gr\xfcn"), 4, "Gr\xc3\xbcn");
    EXPECT_EQ(parse_mitsuba_xml(text, "b.xml").notes.size(), 0u);
}

TEST(BrokenText, EntitiesAreNotExpanded) {
    // The "billion laughs" attack: each entity reconstructs_components to ten copies of the previous one.
    std::string text = "<?xml version='1.0'?>\n<!DOCTYPE scene [\n<!ENTITY e0 'laugh'>\n";
    for (int i = 1; i < 10; ++i) {
        text += "<!ENTITY e" + std::to_string(i) + " '";
        for (int j = 0; j < 10; ++j)
            text += "&e" + std::to_string(i - 1) + ";";
        text += "'>\n";
    }
    text += "<!ENTITY file SYSTEM 'file:///etc/passwd'>\n]>\n";
    const LoadedScene loaded =
        parse_mitsuba_xml(text + "<scene version='3.0.0'><bsdf type='diffuse' id='&e9;'/><bsdf type='diffuse' "
                                 "id='&file;&lt;'/></scene>",
                          "b.xml");
    EXPECT_EQ(loaded.description.materials.at(0).name, "&e9;");
    EXPECT_EQ(loaded.description.materials.at(1).name, "&file;<");
}

TEST(BrokenText, LimitsTheExpansionOfVariables) {
    std::string body = "<default name='v0' value='laugh'/>";
    for (int i = 1; i < 12; ++i) {
        body += "<default name='v" + std::to_string(i) + "' value='";
        for (int j = 0; j < 10; ++j)
            body += "$v" + std::to_string(i - 1) + " ";
        body += "'/>";
    }
    EXPECT_NE(error_of("<scene version='3.0.0'>" + body + "</scene>")
                  .find("the variables make a value of more than a million characters"),
              std::string::npos);
}

TEST(BrokenText, RejectsInvalidVersionsAndReportsNewerOnes) {
    EXPECT_EQ(error_of("<scene version='-1'/>").substr(0, 36), "b.xml:1:17: '-1' is not a version\n  ");
    EXPECT_EQ(error_of("<scene version=''/>").substr(0, 34), "b.xml:1:17: '' is not a version\n  ");
    const LoadedScene newer =
        parse_mitsuba_xml("<scene version='12.1'><sensor type='perspective'/></scene>", "b.xml");
    ASSERT_EQ(newer.notes.size(), 1u);
    EXPECT_EQ(newer.notes[0].text, "the version 12.1 is newer than those known (0.x to 3.x)");
    EXPECT_EQ(newer.notes[0].where.column, 17);
}

} // namespace tessera
