// Who is on the front and who is beaten, what is said of it, and errors at the edges of shadows: on made-up points.
#include "app/experiments/method_gallery.h"
#include "app/experiments/method_text.h"

#include <cmath>
#include <gmock/gmock.h>

namespace bounce {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

ChartPoint point(const std::string& graph, double ms, double error) {
    ChartPoint out;
    out.task.session.shot = "room";
    out.task.session.graph = graph;
    out.task.session.size = glm::ivec2(8, 8);
    out.task.bounces = 1;
    out.task.diffuse_only = true;
    out.parts = {"out.indirect_diffuse"};
    out.transport_bounces = 1;
    out.total_ms = ms;
    out.bytes = uint64_t(ms) << 20;
    out.same_transport.set("relative_rmse", error);
    out.full.set("relative_rmse", 1 - error / 2); // whoever is best against its own light is worst against all
    return out;
}

MethodSuite suite_of(std::vector<std::string> graphs) {
    MethodSuite suite;
    suite.scenes.push_back({});
    suite.scenes.back().shot = "room";
    MethodGroup& group = suite.groups.emplace_back();
    group.name = "bounce";
    group.title = "one bounce";
    group.parts = {"out.indirect_diffuse"};
    group.bounces = 1;
    group.diffuse_only = true;
    for (const std::string& graph : graphs)
        group.methods.push_back({graph, "published", {{}}});
    return suite;
}

std::vector<MethodScore> scores(const std::vector<ChartPoint>& points) {
    std::vector<const ChartPoint*> all;
    for (const ChartPoint& p : points)
        all.push_back(&p);
    return scores_of(all, [](const ChartPoint& p) { return std::optional(p.error(find_metric("relative_rmse"))); });
}

std::vector<std::string> graphs_of(const std::vector<MethodScore>& of) {
    std::vector<std::string> names;
    for (const MethodScore& score : of)
        names.push_back(score.point->task.session.graph);
    return names;
}

const std::vector<ChartPoint> k_points = {point("fast", 1, 0.5),  point("fast", 8, 0.4),  point("good", 4, 0.1),
                                          point("slow", 9, 0.1),  point("worse", 5, 0.3), point("worse", 6, 0.2),
                                          point("best", 20, 0.05)};

TEST(MethodFront, IsWhatNoOtherBeats) {
    EXPECT_THAT(graphs_of(front_of(scores(k_points))), ElementsAre("fast", "good", "best"));
    // As accurate, and as fast: a twin stands for both.
    EXPECT_THAT(graphs_of(front_of(scores({point("a", 1, 0.5), point("b", 1, 0.5)}))), ElementsAre("a"));
}

TEST(MethodFront, ABeatenMethodNamesTheFastestThatIsAtLeastAsAccurate) {
    std::vector<ChartPoint> points = k_points;
    points.push_back(point("also", 5.5, 0.15)); // beats worse's best too, but is slower than good
    const auto of = scores(points);
    const std::vector<BeatenMethod> beaten = beaten_everywhere(of);
    ASSERT_EQ(beaten.size(), 3u) << "also, slow and worse; fast has one beaten point and one that is not";
    EXPECT_EQ(beaten[1].best.point->task.session.graph, "slow");
    EXPECT_EQ(beaten[2].best.point->task.session.graph, "worse");
    EXPECT_EQ(beaten[2].best.error, 0.2);
    EXPECT_EQ(beaten[2].by.point->task.session.graph, "good");
}

TEST(MethodFront, WithinATimeTheMostAccurateIsShown) {
    const auto of = scores(k_points);
    const auto within = best_within(of, 5);
    EXPECT_EQ(within.at("fast").ms, 1) << "its better point takes longer";
    EXPECT_EQ(within.at("worse").error, 0.3);
    EXPECT_FALSE(within.contains("best"));
    EXPECT_FALSE(within.contains("slow"));
}

TEST(MethodText, SaysWhatThePointsSay) {
    const MethodSuite suite = suite_of({"fast", "good", "slow", "worse", "best"});
    const std::string text = scene_text(suite, suite.scenes.front(), k_points, find_metric("relative_rmse"));
    EXPECT_THAT(text, HasSubstr("**one bounce** (7 points of 5 graphs)"));
    EXPECT_THAT(text,
                HasSubstr("`fast` (1.0 ms, 50.00 %), `good` (4.0 ms, 10.00 %), `best` (20 ms, 5.00 %). The last takes "
                          "20 times the time of the first, and has 1/10 of its error."));
    EXPECT_THAT(text,
                HasSubstr("by `good` (4.0 ms, 10.00 %) `slow` (2.2 times the time, 10.00 %), `worse` (1.5 times the "
                          "time, 20.00 %)."));
    // Against all light the made-up points are the other way round.
    EXPECT_THAT(text,
                HasSubstr("whatever a graph models of it. One point beats all others in both time and error: `fast` "
                          "(1.0 ms, 75.00 %)"));
    EXPECT_THAT(text, HasSubstr("the least has `fast` (1.0 MiB), the most `best` (20.0 MiB)"));
    EXPECT_THAT(text, Not(HasSubstr("Flicker"))) << "nothing moves";
    EXPECT_THAT(text, Not(HasSubstr("Not measured")));
    MethodSuite more = suite;
    more.groups.push_back({"two", "two bounces", {"out.indirect_diffuse"}, 2, true, {}, {}});
    more.groups.push_back({"sky", "the sky", {"out.environment"}, {}, {}, {"yard"}, {}});
    EXPECT_THAT(scene_text(more, more.scenes.front(), k_points, find_metric("relative_rmse")),
                HasSubstr("Not measured on this scene: two bounces."))
        << "the sky is meant for another scene";
}

TEST(MethodText, ABlackPictureIsOnNoFront) {
    std::vector<ChartPoint> points = k_points;
    points.push_back(point("black", 0.1, 1));
    points.back().same_transport.set("mean", 0);
    const MethodSuite suite = suite_of({"fast", "good", "slow", "worse", "best", "black"});
    const std::string text =
        group_text(suite, suite.groups.front(), points_of(points, suite.scenes.front(), suite.groups.front()),
                   find_metric("relative_rmse"));
    EXPECT_THAT(text, HasSubstr("accurate: `fast`"));
    EXPECT_THAT(text, HasSubstr("Black here, because they make none of this light, and so on no front: `black`."));
}

TEST(MethodText, TunedStandsBesidePublished) {
    const std::vector<ChartPoint> points = {point("x", 10, 0.4), point("x_tuned", 20, 0.1)};
    const MethodSuite suite = suite_of({"x", "x_tuned"});
    EXPECT_THAT(scene_text(suite, suite.scenes.front(), points, find_metric("relative_rmse")),
                HasSubstr("`x_tuned` has 0.25 of the error of `x` in 2 times the time. Nobody is beaten everywhere."));
}

TEST(MethodText, PointsOfAnotherLightAreNotOfTheGroup) {
    ChartPoint other = point("fast", 1, 0.01);
    other.task.bounces = 2;
    const MethodSuite suite = suite_of({"fast"});
    EXPECT_EQ(scene_text(suite, suite.scenes.front(), {other}, find_metric("relative_rmse")), "");
}

TEST(MethodFigures, ShadowEdgesStandApart) {
    // A shadow over the left half. The picture's shadow reaches one column too far, and its light is 10 % too bright.
    Image truth(8, 8, 3), picture(8, 8, 3);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 3; ++c) {
                truth.at(x, y)[c] = x < 4 ? 0.0f : 1.0f;
                picture.at(x, y)[c] = x < 5 ? 0.0f : 1.1f;
            }
    MethodFigures figures;
    add_shadow_errors(figures, picture, truth, Mask(8, 8));
    EXPECT_DOUBLE_EQ(figures.shadow_edge_share, 0.25) << "two columns: on either side of the edge";
    EXPECT_NEAR(figures.shadow_edge_rmse, std::sqrt(0.5) / 0.5, 1e-6)
        << "of 16 pixels, half are wrong by 1; their mean is ½";
    EXPECT_NEAR(figures.direct_rmse, std::sqrt(0.5 * 0.01) / 0.5, 1e-6);
    // Textures that are dark, but no shadows, are no edges.
    for (float& v : truth.pixels)
        v = v > 0 ? 1.0f : 0.1f;
    MethodFigures textured;
    add_shadow_errors(textured, picture, truth, Mask(8, 8));
    EXPECT_EQ(textured.shadow_edge_share, 0);
    EXPECT_TRUE(std::isnan(textured.shadow_edge_rmse));
}

TEST(MethodFigures, AreKeptInFiles) {
    MethodFigures figures;
    figures.first_ms = 2;
    figures.flicker = 0.25;
    ChartPoint p = point("x", 1, 1);
    p.key = "0123456789abcdef";
    p.task.thorough = true;
    p.figures = figures;
    const ChartPoint again = point_from_json(point_to_json(p), "test");
    EXPECT_EQ(again.task.name(), p.task.name()) << "merged parts find their points by it";
    EXPECT_EQ(again.figures->first_ms, 2);
    EXPECT_EQ(again.figures->flicker, 0.25);
    EXPECT_TRUE(std::isnan(again.figures->direct_rmse));
}

} // namespace
} // namespace bounce
