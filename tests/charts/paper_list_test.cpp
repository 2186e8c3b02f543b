// The list of the papers' tables and figures: each once, and each with a result that is there or a reason.
#include "app/experiments/paper_list.h"
#include "app/listing.h"
#include "core/error.h"
#include "core/text.h"
#include "support/temp_folder.h"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>

namespace bounce {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

TEST(PaperList, HoldsAllOfTheFourPapers) {
    const PaperList list = load_paper_list(paper_list_path()); // checks numbers and links
    std::vector<std::pair<std::string, size_t>> counts;
    for (const Paper& paper : list.papers)
        counts.emplace_back(paper.name, paper.items.size());
    // Figures and tables, as the papers number them.
    EXPECT_THAT(counts, testing::ElementsAre(std::pair("LRSM", 8 + 3), std::pair("DVS", 17 + 6), std::pair("VF", 6 + 1),
                                             std::pair("LDM", 11)));
}

TEST(PaperList, CommandsNameWhatThereIs) {
    const std::vector<std::string> graphs = names_of("graphs"), shots = names_of("shots"), tables = names_of("tables"),
                                   cases = names_of("cases");
    for (const Paper& paper : load_paper_list(paper_list_path()).papers) {
        for (const PaperItem& item : paper.items) {
            SCOPED_TRACE(paper.name + ", " + item.item + ": " + item.command);
            const std::vector<std::string> words = split(item.command, ' ');
            ASSERT_GE(words.size(), 3u);
            ASSERT_EQ(words[0], "bounce");
            std::vector<std::pair<const std::vector<std::string>*, std::string>> named;
            if (words[1] == "table") named.emplace_back(&tables, words[2]);
            if (words[1] == "graph" || words[1] == "params") named.emplace_back(&graphs, words[2]);
            if (words[1] == "render" || words[1] == "view" || words[1] == "info") named.emplace_back(&shots, words[2]);
            for (size_t i = 3; i + 1 < words.size(); ++i) {
                if (words[i] == "--cases") named.emplace_back(&cases, words[i + 1]);
                if (words[i] == "--shot") named.emplace_back(&shots, words[i + 1]);
                if (words[i] != "--graph" && words[i] != "--graphs") continue;
                for (const std::string& graph : split(words[i + 1], ','))
                    named.emplace_back(&graphs, graph);
            }
            for (const auto& [known, name] : named)
                EXPECT_THAT(*known, Contains(name));
        }
    }
}

TEST(PaperList, WhatIsMissingTwiceOrNowhereIsAnError) {
    TempFolder folder;
    const std::filesystem::path path = folder.path() / "papers.json";
    std::ofstream(path) << R"({"papers": [{"name": "P", "title": "t", "figures": 2, "tables": 2, "items": [
        {"item": "Figure 1", "shows": "s", "reason": "r"}, {"item": "Figure 1", "shows": "s", "reason": "r"},
        {"item": "Table II", "shows": "s", "command": "bounce list", "result": "nowhere.md"},
        {"item": "Figure 7", "shows": "s"}]}]})";
    try {
        load_paper_list(path);
        FAIL() << "was taken";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("Figure 1 is named 2 times"), HasSubstr("Figure 2 is named 0 times"),
                                        HasSubstr("Table 1 is named 0 times"), HasSubstr("no result 'nowhere.md'"),
                                        HasSubstr("invalid item 'Figure 7'"),
                                        HasSubstr("expected either a 'result', or the 'reason'")));
    }
}

TEST(PaperList, LinksAndReasonsArePrinted) {
    const PaperList list{
        "about",
        {{"P",
          "title",
          {{"Table 1", "a|b", "on a room", "bounce x", "dir/r.md", ""}, {"Figure 1", "c", "", "", "", "why"}}}}};
    const std::string text = paper_list_markdown(list);
    EXPECT_THAT(text, HasSubstr("title: 1 of 2 are linked"));
    EXPECT_THAT(text, HasSubstr("`bounce x` | [r.md](dir/r.md): on a room |"));
    EXPECT_THAT(text, HasSubstr("| Figure 1 | c | – | why |"));
}

} // namespace
} // namespace bounce
