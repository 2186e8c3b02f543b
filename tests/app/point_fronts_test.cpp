// Pareto fronts are of points that are compared by the same light.
#include "app/experiments/svg_scatter.h"
#include "app/experiments/transport.h"
#include "app/ui/point_fronts.h"

#include <gmock/gmock.h>
#include <set>

namespace bounce {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ChartPoint point(const std::string& graph, int bounces, std::vector<std::string> parts, double ms, double error) {
    ChartPoint out;
    out.task.session.shot = "cornell";
    out.task.session.graph = graph;
    out.transport_bounces = bounces;
    out.parts = std::move(parts);
    out.total_ms = ms;
    out.same_transport.set("relative_rmse", error);
    return out;
}

TEST(PointFronts, OfAChartAreByTransport) {
    // Direct light alone is easy: it would beat all that models more.
    std::vector<ChartPoint> points = {
        point("direct", 0, {"out.direct"}, 1, 0.01), point("lrsm", 1, {"out.indirect_diffuse"}, 5, 0.3),
        point("lrsm_tuned", 1, {"out.indirect_diffuse"}, 8, 0.2), point("slow", 1, {"out.indirect_diffuse"}, 9, 0.25),
        point("ao", 0, {"out.ambient_occlusion"}, 4, 0.05)};
    mark_pareto(points, find_metric(k_default_error));
    std::set<std::string> front;
    for (const ChartPoint& p : points)
        if (p.on_front) front.insert(p.task.session.graph);
    EXPECT_EQ(front, (std::set<std::string>{"direct", "lrsm", "lrsm_tuned", "ao"}));
    const std::string svg = svg_scatter(points);
    EXPECT_THAT(svg, HasSubstr("on the Pareto front of 1 bounce: indirect_diffuse"));
    EXPECT_THAT(svg, HasSubstr(">0 bounces: direct</text>"));
    EXPECT_THAT(svg, HasSubstr(">occlusion: ambient_occlusion</text>"));
}

TEST(PointFronts, OfTheComparePanelToo) {
    std::vector<ComparePoint> points(6);
    const double ms[] = {1, 5, 8, 9, 0, 7}, error[] = {0.01, 0.3, 0.2, 0.25, 0.1, 0.3};
    for (size_t i = 0; i < points.size(); ++i) {
        points[i].transport = i == 0 ? "direct" : "1 bounce";
        points[i].ms = ms[i];
        points[i].figures.set("relative_rmse", error[i]);
    }
    const auto fronts = pareto_fronts(points, [](const ComparePoint& p) { return p.figures["relative_rmse"]; });
    ASSERT_EQ(fronts.size(), 2u);
    EXPECT_THAT(fronts.at("direct"), ElementsAre(0u));
    EXPECT_THAT(fronts.at("1 bounce"), ElementsAre(1u, 2u)) << "one has no time, one is as bad and slower";
}

TEST(PointFronts, TransportsHaveNames) {
    EXPECT_EQ(transport_text(1, {"out.indirect_diffuse", "out.emitted"}), "1 bounce: indirect_diffuse + emitted");
    EXPECT_EQ(transport_text(-1, {"out.radiance"}), "all light: radiance");
    EXPECT_EQ(transport_text(2, {"out.direct"}), "2 bounces: direct");
}

} // namespace
} // namespace bounce
