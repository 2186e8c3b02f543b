// Every table of the tree can be read; columns say their own sizes.
#include "app/experiments/cost_table.h"
#include "app/experiments/error_table.h"
#include "app/experiments/table_file.h"
#include "app/listing.h"
#include "core/error.h"
#include "support/temp_folder.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bounce;

TEST(Tables, EachOfTheTreeCanBeRead) {
    const std::vector<std::string> names = names_of("tables");
    EXPECT_GT(names.size(), 10u);
    for (const std::string& name : names) {
        SCOPED_TRACE(name);
        const std::filesystem::path path = find_table(name);
        if (is_error_table(path))
            EXPECT_NO_THROW(load_error_table(path));
        else
            EXPECT_NO_THROW(load_cost_table(name));
    }
}

TEST(Tables, AColumnHasItsOwnSize) {
    EXPECT_EQ(load_cost_table("vf").columns.front().size, glm::ivec2(512, 512));
    EXPECT_EQ(load_cost_table("lrsm").columns.front().size, std::nullopt);

    TempFolder folder;
    const std::filesystem::path path = folder.path() / "wrong.json";
    std::ofstream(path) << R"({"columns": [{"name": "a", "shot": "cornell", "graph": "direct", "size": [512, 0]}]})";
    try {
        load_cost_table(path.string());
        FAIL() << "a size of 0 was taken";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("columns[0], size: expected [width, height]"));
    }
}
