// Edits of JSON text that leave its comments and its layout alone.
#include "core/json_edit.h"
#include "support/errors.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::HasSubstr;

static std::string set(const std::string& text, const std::vector<std::string>& path, const std::string& value) {
    JsonEdit json(text);
    json.set(path, value);
    return json.text();
}

static std::string insert(const std::string& text, const std::vector<std::string>& path, size_t before,
                          const std::string& value) {
    JsonEdit json(text);
    json.insert(path, before, value);
    return json.text();
}

TEST(JsonEdit, NamesAreWhatTheirEscapesStandFor) {
    JsonEdit edit(R"({"a \\b": 1, "\u00e9": 2})");
    edit.set({R"(a \b)"}, "3");
    edit.set({"é"}, "4");
    edit.set({"say \"no\""}, "5");
    EXPECT_EQ(edit.text(), R"({"a \\b": 3, "\u00e9": 4, "say \"no\"": 5})");
}

// The reader ends a comment at a carriage return too, and leaves a byte order mark out.
TEST(JsonEdit, CommentsEndAndFilesBeginWhereTheReaderHasThem) {
    EXPECT_EQ(set("{ // first\r\"a\": 1 }", {"a"}, "2"), "{ // first\r\"a\": 2 }");
    EXPECT_EQ(set("{\r\n  \"a\": 1 // last\r\n}", {"b"}, "2"), "{\r\n  \"a\": 1, // last\n  \"b\": 2\r\n}");
    EXPECT_EQ(set("\xEF\xBB\xBF{\"a\": 1}", {"a"}, "2"), "\xEF\xBB\xBF{\"a\": 2}");
}

TEST(JsonEdit, ValuesAreReplaced) {
    const std::string text = "// head\n{ \"a\": 1, /* of b */ \"b\": { \"c\": [1, {\"d\": \"x,]}\\\"\"}] } } // tail\n";
    EXPECT_EQ(set(text, {"a"}, "2"),
              "// head\n{ \"a\": 2, /* of b */ \"b\": { \"c\": [1, {\"d\": \"x,]}\\\"\"}] } } // tail\n");
    EXPECT_EQ(set(text, {"b", "c", "1", "d"}, "true"),
              "// head\n{ \"a\": 1, /* of b */ \"b\": { \"c\": [1, {\"d\": true}] } } // tail\n");
    EXPECT_EQ(set(text, {"b"}, "{}"), "// head\n{ \"a\": 1, /* of b */ \"b\": {} } // tail\n");
}

TEST(JsonEdit, MembersAreAddedAsTheOthersStand) {
    EXPECT_EQ(set("{}", {"a"}, "1"), "{ \"a\": 1 }");
    EXPECT_EQ(set("{ \"a\": 1 }", {"b"}, "2"), "{ \"a\": 1, \"b\": 2 }");
    EXPECT_EQ(set("{ \"a\": 1 }", {"b", "c"}, "2"), "{ \"a\": 1, \"b\": { \"c\": 2 } }");
    EXPECT_EQ(set("{\n  \"a\": 1 // one\n}\n", {"b"}, "2"), "{\n  \"a\": 1, // one\n  \"b\": 2\n}\n");
    EXPECT_EQ(set("{\n  \"a\": 1\n}\n", {"b"}, "2"), "{\n  \"a\": 1,\n  \"b\": 2\n}\n");
}

TEST(JsonEdit, ElementsAreInserted) {
    EXPECT_EQ(insert("{ \"a\": [] }", {"a"}, 0, "1"), "{ \"a\": [1] }");
    EXPECT_EQ(insert("{ \"a\": [1, 2] }", {"a"}, 1, "9"), "{ \"a\": [1, 9, 2] }");
    EXPECT_EQ(insert("{ \"a\": [1, 2] }", {"a"}, 5, "9"), "{ \"a\": [1, 2, 9] }");
    EXPECT_EQ(insert("{\n  \"a\": [\n    1, // one\n    2  // two\n  ]\n}", {"a"}, 1, "9"),
              "{\n  \"a\": [\n    1, // one\n    9,\n    2  // two\n  ]\n}");
    EXPECT_EQ(insert("{\n  \"a\": [\n    1, // one\n    2  // two\n  ]\n}", {"a"}, 2, "9"),
              "{\n  \"a\": [\n    1, // one\n    2,  // two\n    9\n  ]\n}");
    EXPECT_EQ(insert("{ \"b\": 0 }", {"a"}, 0, "1"), "{ \"b\": 0, \"a\": [1] }");
}

TEST(JsonEdit, PathsThroughValuesAreAnError) {
    EXPECT_THAT(error_of([] { set("{ \"a\": 1 }", {"a", "b"}, "2"); }), HasSubstr("'b' is in no object"));
    EXPECT_THAT(error_of([] { set("{ \"a\": [1] }", {"a", "3"}, "2"); }), HasSubstr("no element 3"));
    EXPECT_THAT(error_of([] { insert("{ \"a\": 1 }", {"a"}, 0, "2"); }), HasSubstr("'a' is no list"));
    EXPECT_THAT(error_of([] { set("{ \"a\": ", {"a"}, "2"); }), HasSubstr("not JSON"));
}
