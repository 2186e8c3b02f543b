// The one reader of JSON: limits, and one message that says where.
#include "core/json_text.h"
#include "core/problem.h"
#include "support/errors.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using nlohmann::json;
using nlohmann::ordered_json;
using testing::HasSubstr;
using testing::StartsWith;

namespace {

std::string json_refusal(const std::string& text, JsonComments comments = JsonComments::allowed) {
    return error_of([&] { parse_json(text, "a.json", comments); });
}

std::string nested(int levels, const char* open, const char* close) {
    std::string text;
    for (int i = 0; i < levels; ++i)
        text += open;
    text += "1";
    for (int i = 0; i < levels; ++i)
        text += close;
    return text;
}

} // namespace

TEST(JsonText, OneMessageWithTheLine) {
    EXPECT_THAT(json_refusal("{\n\"a\": 1,\n\"b\" 2\n}"), StartsWith("a.json:3: not valid JSON: column "));
    EXPECT_THAT(json_refusal(""), StartsWith("a.json:1: not valid JSON: "));
    EXPECT_EQ(json_refusal(std::string("{ // a\n \0}", 10)), "a.json:2: not valid JSON: a zero byte");
    EXPECT_EQ(json_refusal(std::string("{}\0", 3), JsonComments::refused), "") << "padding of scenes";
    EXPECT_THAT(json_refusal("{\"a\": 1e999}"), StartsWith("a.json: not valid JSON: number overflow"));
    EXPECT_THAT(json_refusal("{\"a\": \"\xFF\"}"), StartsWith("a.json:1: not valid JSON: "));
    for (const char* bad : {"{", "[1,]", "{\"a\":}", "nul", "{\"a\": 1} x", "\"\\u12\""})
        EXPECT_THAT(json_refusal(bad), testing::Not(HasSubstr("[json."))) << bad;
    EXPECT_LT(json_refusal("{\"a\": \"" + std::string(1 << 20, 'x')).size(), 500u) << "what was read last is shortened";
}

TEST(JsonText, Depth) {
    EXPECT_EQ(json_refusal(nested(64, "[", "]")), "");
    EXPECT_EQ(json_refusal(nested(65, "[", "]")), "a.json: nested more than 64 levels deep");
    EXPECT_EQ(json_refusal(nested(65, "{\"a\":", "}")), "a.json: nested more than 64 levels deep");
    EXPECT_EQ(json_refusal(std::string(1 << 22, '[')), "a.json: nested more than 64 levels deep");
    EXPECT_EQ(json_refusal(nested(1 << 20, "{\"a\":[", "]}")), "a.json: nested more than 64 levels deep");
}

TEST(JsonText, SizeAndNumberOfValues) {
    EXPECT_THAT(error_of([] { parse_json("[1, 2, 3]", "a.json", JsonComments::refused, 8); }),
                HasSubstr("expected at most 8 B"));
    std::string many = "[[]";
    for (size_t i = 0; i < k_max_json_values; ++i)
        many += ",[]";
    EXPECT_EQ(json_refusal(many + "]"), "a.json: more than 2000000 values");
}

TEST(JsonText, CommentsAndKeysGivenTwice) {
    EXPECT_EQ(parse_json("// a\n{ /* b */ \"c\": \"// no comment\" }", "a.json", JsonComments::allowed)["c"],
              "// no comment");
    EXPECT_NE(json_refusal("// a\n{}", JsonComments::refused), "");
    EXPECT_EQ(json_refusal("{\"a\": 1, \"b\": {\"a\": 2}, \"c\": [{\"a\": 3}]}"), "");
    EXPECT_EQ(json_refusal("{\"a\": 1, \"b\": {}, \"a\": 2}"),
              "a.json: not valid JSON: an object has the key 'a' twice");
    EXPECT_EQ(json_refusal("{\"a\": 1, \"a\": 2}", JsonComments::refused), "") << "a file that is not ours";
}

TEST(JsonText, FilesOfOurs) {
    TempFolder folder;
    folder.write("a.json", "\xEF\xBB\xBF{\r\n \"b\": 1, // one\r\n \"a\": 2\r\n}\r\n");
    EXPECT_EQ(read_json_file<ordered_json>(folder / "a.json").dump(), R"({"b":1,"a":2})");
    folder.write("b.json", "{\n\n");
    EXPECT_THAT(error_of([&] { read_json_file(folder / "b.json"); }),
                AllOf(StartsWith((folder / "b.json").string() + ":"), HasSubstr("not valid JSON")));
    EXPECT_THAT(error_of([&] { read_json_file(folder / "none.json"); }), HasSubstr("none.json"));
}

TEST(JsonText, WritesNamesThatAreNoUtf8) {
    const json named = {{"shot", "a\xFF"}};
    EXPECT_EQ(json_dump(named), "{\"shot\":\"a\xEF\xBF\xBD\"}");
}

TEST(Problem, WordsForEveryKindOfException) {
    EXPECT_EQ(problem_text(Error("bad input")), "bad input");
    EXPECT_EQ(problem_text(std::bad_alloc()), "out of memory");
    EXPECT_EQ(problem_text(std::runtime_error("other")), "other");
    std::filesystem::filesystem_error files("status", "/a", std::make_error_code(std::errc::permission_denied));
    EXPECT_EQ(problem_text(files), "'/a': Permission denied");
    try {
        (void)json::parse("{}").at("a");
        FAIL();
    } catch (const std::exception& problem) {
        EXPECT_EQ(problem_text(problem), "key 'a' not found");
    }
}
