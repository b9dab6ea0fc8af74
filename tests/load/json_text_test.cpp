#include "render/io/json_text.h"
#include "render/io/text.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::test {
namespace {

const std::string text = R"(
{ "a" : [1, {"b": "}]\"", "c" :-2.5e3}, [[], 7]],
  "d":{ "a":true , "e" : null } }
)";
const std::string name = "file.json";

std::string found(std::string_view path) {
    const JsonText json(text, name);
    std::string value = json.only(path);
    value.erase(0, value.find_first_not_of(" \n"));
    value.erase(value.find_last_not_of(" \n") + 1);
    return value;
}

TEST(JsonText, ReplacesInvalidUtf8) {
    const nlohmann::json value{{"scene", "sc\xe8ne.xml"}};
    EXPECT_EQ(to_text(value), "{\"scene\":\"sc\xef\xbf\xbdne.xml\"}");
    EXPECT_EQ(to_text(nlohmann::ordered_json(value), 1), "{\n \"scene\": \"sc\xef\xbf\xbdne.xml\"\n}");
}

TEST(JsonText, FindsValuesByTheirPaths) {
    EXPECT_EQ(found("a/0"), "1");
    EXPECT_EQ(found("a/1/b"), R"("}]\"")");
    EXPECT_EQ(found("a/1/c"), "-2.5e3");
    EXPECT_EQ(found("a/2"), "[[], 7]");
    EXPECT_EQ(found("a/2/1"), "7");
    EXPECT_EQ(found("d/a"), "true");
    EXPECT_EQ(found("d/e"), "null");
    EXPECT_EQ(nlohmann::json::parse(found("")), nlohmann::json::parse(text));
}

TEST(JsonText, FindsTheInnermostParentOfAMissingValue) {
    EXPECT_EQ(found("d/x"), R"({ "a":true , "e" : null })");
    EXPECT_EQ(found("a/9/b"), R"([1, {"b": "}]\"", "c" :-2.5e3}, [[], 7]])");
    EXPECT_EQ(found("a/0/b"), "1");
}

TEST(JsonText, OnlyKeepsTheOffsetOfAValue) {
    const JsonText json(text, name);
    const std::string only = json.only("d/e");
    EXPECT_EQ(only.size(), text.size());
    EXPECT_EQ(only.find("null"), text.find("null"));
}

TEST(JsonText, RejectsDeepNesting) {
    const std::string fine = std::string(100, '[') + std::string(100, ']'),
                      in_quotes = '"' + std::string(500, '[') + '"';
    EXPECT_NO_THROW(JsonText(fine, name).parse());
    EXPECT_NO_THROW(JsonText(in_quotes, name).parse());
    EXPECT_TRUE(parse_json(fine).is_array());
    const std::string deep = "\n" + std::string(100, '[') + "{\"a\": 1}" + std::string(100, ']');
    try {
        JsonText(deep, name).parse();
        FAIL();
    } catch (const LoadError& error) {
        EXPECT_EQ(
            std::string(error.what()).find("file.json:2:101: objects and arrays are nested more than 100 deep"),
            0u)
            << error.what();
    }
    EXPECT_TRUE(parse_json(deep).is_null());
    EXPECT_TRUE(parse_json(std::string(1 << 20, '[')).is_null());
    EXPECT_TRUE(parse_json("{\"a\":").is_null());
}

TEST(JsonText, MessagesHaveLineAndColumn) {
    const JsonText json(text, name);
    try {
        json.fail_at(json.place_of("d/e"), "is wrong");
        FAIL();
    } catch (const LoadError& error) {
        EXPECT_EQ(std::string(error.what()).find("file.json:3:26: is wrong"), 0u) << error.what();
    }
}

} // namespace
} // namespace tessera::test
