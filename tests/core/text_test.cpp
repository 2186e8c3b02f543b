// Nearest names, as error messages offer them.
#include "core/text.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::ElementsAre;

TEST(Text, TheNearestNameByEdits) {
    std::vector<std::string> names = {"albedo", "normal", "depth", "roughness_metallic"};
    EXPECT_EQ(nearest_name("nromal", names), "normal");
    EXPECT_EQ(nearest_name("normals", names), "normal");
    EXPECT_EQ(nearest_name("dept", names), "depth");
    EXPECT_EQ(nearest_name("roughness", names), "roughness_metallic");
    EXPECT_EQ(nearest_name("zzzzzzzzzz", names), std::nullopt);
    EXPECT_EQ(nearest_name("depth", {}), std::nullopt);
}

TEST(Text, DidYouMean) {
    EXPECT_EQ(did_you_mean("depht", {"albedo", "depth"}), " (did you mean 'depth'?)");
    EXPECT_EQ(did_you_mean("qqqqqqqqqqqq", {"albedo", "depth"}), " (there are: albedo, depth)");
    EXPECT_EQ(did_you_mean("x", {}), " (there are none)");
    std::vector<std::string> many(100, "filter.width");
    many.insert(many.begin(), {"gather.rays", "gather.bounces"});
    EXPECT_EQ(did_you_mean("gather.estimator_of", many), " (there are, among others: gather.rays, gather.bounces)");
    EXPECT_EQ(did_you_mean("occlusion_voxels.resolution", many), " (there are 102)");
}

TEST(Text, SplitTrimJoinAndBytes) {
    EXPECT_THAT(split(" a, b ,,c", ','), ElementsAre("a", "b", "", "c"));
    EXPECT_THAT(split("", ','), ElementsAre(""));
    EXPECT_EQ(trim(" \t x y \r\n"), "x y");
    EXPECT_EQ(trim(" \n"), "");
    EXPECT_EQ(join({"a", "b"}, ", "), "a, b");
    EXPECT_EQ(format_bytes(640), "640 B");
    EXPECT_EQ(format_bytes(1536), "1.5 KiB");
    EXPECT_EQ(format_bytes(12.25 * 1024 * 1024), "12.25 MiB");
}

TEST(Text, LongNamesAreNotCompared) {
    // A million characters against a million would take a day.
    std::string name(1 << 20, 'a'), other(1 << 20, 'b');
    EXPECT_EQ(nearest_name(name, {other}), std::nullopt);
    EXPECT_EQ(nearest_name("some", {other, "same"}), "same");
}
