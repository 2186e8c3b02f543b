// Lines of code without their comments, and the scanners that read them.
#include "core/scanner.h"
#include "core/source_lines.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::ElementsAre;

namespace {

/// The code of each line, its mark behind a '!', and what it was written over when that is more than one line.
std::vector<std::string> code_of(const std::string& text) {
    std::optional<std::string> why_not;
    CodeLines lines(split_lines(text, why_not));
    EXPECT_FALSE(why_not) << *why_not;
    std::vector<std::string> out;
    while (std::optional<CodeLine> line = lines.next()) {
        std::string shown = line->directive ? "D:" : "";
        shown += line->code;
        if (line->mark) shown += "!" + *line->mark;
        out.push_back(shown);
    }
    return out;
}

std::optional<std::string> why_no_text(std::string_view text) {
    std::optional<std::string> why_not;
    split_lines(text, why_not);
    return why_not;
}

} // namespace

TEST(SourceLines, EndsOfLinesAndTheByteOrderMark) {
    std::optional<std::string> why_not;
    EXPECT_THAT(split_lines("\xEF\xBB\xBF"
                            "a\r\nb\rc\n\nd",
                            why_not),
                ElementsAre("a", "b", "c", "", "d"));
    EXPECT_THAT(split_lines("", why_not), ElementsAre());
    EXPECT_THAT(split_lines("a\n", why_not), ElementsAre("a"));
    EXPECT_FALSE(why_not);
    EXPECT_EQ(why_no_text(std::string_view("a\0b", 3)), "the file holds a zero byte: expected UTF-8 text");
    EXPECT_EQ(why_no_text("\xFF\xFE"
                          "a"),
              "the file is UTF-16: expected UTF-8 text");
}

TEST(SourceLines, BlockCommentsBeginAndEndAnywhere) {
    EXPECT_THAT(code_of("a /* b */ c\nd /* e\nf */ g\nh"), ElementsAre("a   c", "d  ", "  g", "h"));
    EXPECT_THAT(code_of("/**/a/***/b/*/*/c"), ElementsAre(" a b c"));
    EXPECT_THAT(code_of("a */ b"), ElementsAre("a */ b")) << "no comment is open: for the compiler to tell";
}

TEST(SourceLines, EachKindOfCommentHidesTheOther) {
    EXPECT_THAT(code_of("a // b /* c\nd"), ElementsAre("a ", "d"));
    EXPECT_THAT(code_of("a /* // */ b\n/* //! c */ d"), ElementsAre("a   b", "  d"));
    EXPECT_THAT(code_of("// /*\na\n// */ b"), ElementsAre("", "a", ""));
    EXPECT_THAT(code_of("a /* b // c\nd */ e"), ElementsAre("a  ", "  e"));
}

TEST(SourceLines, ABackslashJoinsLinesBeforeCommentsAreSeen) {
    EXPECT_THAT(code_of("a \\\nb\nc"), ElementsAre("a b", "c"));
    EXPECT_THAT(code_of("// a \\\nb\nc"), ElementsAre("", "c")) << "the comment goes on";
    EXPECT_THAT(code_of("a /\\\n/ b\nc"), ElementsAre("a ", "c"));
    EXPECT_THAT(code_of("a /\\\n* b *\\\n/ c"), ElementsAre("a   c"));
    EXPECT_THAT(code_of("#define A \\\r\n  1\nb"), ElementsAre("D:#define A   1", "b"));
    EXPECT_THAT(code_of("a \\ \nb"), ElementsAre("a \\ ", "b")) << "a blank behind it: it joins nothing";
    EXPECT_THAT(code_of("a \\"), ElementsAre("a ")) << "nothing is left to join";
}

TEST(SourceLines, MarksAreCommentsOfTheirOwn) {
    EXPECT_THAT(code_of("a; //! b  // c"), ElementsAre("a; !b  // c"));
    EXPECT_THAT(code_of("a; // b //! c"), ElementsAre("a; "));
    EXPECT_THAT(code_of("a; /* b */ //! c"), ElementsAre("a;   !c"));
}

TEST(SourceLines, DirectivesAreTheFirstOfTheirLine) {
    EXPECT_THAT(code_of("  # define A\n/* b */ #define C\nd #define E"),
                ElementsAre("D:  # define A", "D:  #define C", "d #define E"));
    EXPECT_THAT(code_of("/* a\n*/ #define B\nc /* d\n*/ #define E"),
                ElementsAre(" ", "D:  #define B", "c  ", "  #define E"))
        << "what a comment joins is one line to a compiler";
    EXPECT_THAT(code_of("#define A /* b\nc */ 1\nd"), ElementsAre("D:#define A   1", "d"));
}

TEST(SourceLines, NamesOfIncludedFilesHoldNoComments) {
    EXPECT_THAT(code_of("#include \"a//b.glsl\" // c\n#include <a/*b> /* c */\n"),
                ElementsAre("D:#include \"a//b.glsl\" ", "D:#include <a/*b>  "));
    EXPECT_THAT(code_of("#define A \"//\""), ElementsAre("D:#define A \"")) << "GLSL has no strings";
}

TEST(SourceLines, TimeIsLinearInTheText) {
    // Each would take minutes at n².
    std::string blanks(1 << 20, ' ');
    EXPECT_EQ(code_of(blanks + std::string(1 << 20, '<')).size(), 1u);
    EXPECT_EQ(code_of("#define A " + std::string(1 << 21, 'x')).size(), 1u);
    std::string opened;
    for (int i = 0; i < 200000; ++i)
        opened += "/**/\\\n";
    EXPECT_EQ(code_of(opened).size(), 1u);
}

TEST(Scanner, WordsNumbersAndWhatStandsBetween) {
    Scanner scanner("  uniform x1=12;rest");
    EXPECT_FALSE(scanner.take_word("uniform"));
    EXPECT_TRUE(scanner.space().take_word("uniform"));
    EXPECT_FALSE(scanner.space().take_word("x")) << "it is a part of the word";
    EXPECT_EQ(scanner.word(), "x1");
    EXPECT_TRUE(scanner.take('='));
    EXPECT_EQ(Scanner(scanner.rest()).number(1), std::nullopt) << "two digits";
    EXPECT_EQ(scanner.number(2), 12);
    EXPECT_EQ(scanner.until('#'), std::nullopt);
    EXPECT_EQ(scanner.until(';'), "");
    EXPECT_EQ(scanner.rest(), "rest");
}

TEST(Scanner, Sizes) {
    using Size = std::pair<int, int>;
    EXPECT_EQ(scan_size("1280x720", 1, 5), Size(1280, 720));
    for (const char* bad :
         {"", "x", "12", "12x", "x12", "12x34 ", " 12x34", "12x34x56", "123456x1", "1x123456", "-1x5", "1X1"})
        EXPECT_EQ(scan_size(bad, 1, 5), std::nullopt) << bad;
    EXPECT_EQ(scan_size("99x100", 3, 5), std::nullopt);
    EXPECT_EQ(scan_size("100x99", 3, 5), std::nullopt);
    EXPECT_EQ(scan_size(std::string(1 << 20, '1') + "x1", 1, 5), std::nullopt);
}

TEST(Scanner, Names) {
    EXPECT_TRUE(is_lower_case_name("a_1", true));
    for (const char* bad : {"", "_a", "1a", "A", "a-b", "a b", "ä"})
        EXPECT_FALSE(is_lower_case_name(bad, true)) << bad;
    EXPECT_FALSE(is_lower_case_name("a_1", false));
    EXPECT_FALSE(is_lower_case_name(std::string(1 << 20, 'a'), true));
    EXPECT_EQ(shortened("short"), "short");
    EXPECT_EQ(shortened(std::string(59, 'x') + "ä and more"), std::string(59, 'x') + "…") << "no half character";
}
