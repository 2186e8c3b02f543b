// A metric that is added to the table, here and nowhere else, is in every output.

#include "app/experiments/comparison_text.h"
#include "app/experiments/cost_table.h"
#include "app/experiments/report.h"
#include "app/experiments/sweep.h"
#include "app/panel_fixture.h"
#include "app/ui/live_comparison.h"
#include "core/text.h"

#include <chrono>
#include <thread>

namespace bounce {
namespace {

using testing::HasSubstr;

const Metric k_added{"half_mean",
                     "HALF",
                     MetricUnit::number,
                     MetricNeeds::values,
                     [](const ComparedPair& pair) { return pair.figures.mean / 2; },
                     ".3f"};

/// While it lives, the table holds one metric more.
struct AddedMetric {
    AddedMetric() { metrics().push_back(k_added); }
    ~AddedMetric() { metrics().pop_back(); }
};

LayeredImage picture(float value) {
    LayeredImage image;
    Image& direct = image.layers["out.direct"] = Image(16, 16, 3);
    std::fill(direct.pixels.begin(), direct.pixels.end(), value);
    return image;
}

class MetricOutputs : public testing::Test {
  protected:
    AddedMetric added;
    LayerComparison comparison = compare_layers(picture(0.5f), picture(0.4f), {});

    ChartPoint point() {
        ChartPoint point;
        point.key = "0123456789abcdef";
        point.task.session.shot = "cornell";
        point.task.session.graph = "direct";
        point.task.session.size = glm::ivec2(16);
        point.parts = {"out.direct"};
        point.total_ms = 2;
        point.same_transport = comparison.parts.front().figures;
        point.full = compare_layers(picture(0.5f), picture(0.9f), {}).parts.front().figures;
        return point;
    }
};

TEST_F(MetricOutputs, Compare) {
    const ComparisonReport report{"a", "b", comparison, {}, 1, 1};
    EXPECT_THAT(comparison_text(report), HasSubstr("HALF"));
    EXPECT_THAT(comparison_text(report), HasSubstr("0.250"));
    EXPECT_EQ(nlohmann::json::parse(comparison_json(report))["parts"]["out.direct"]["half_mean"], 0.25);
}

TEST_F(MetricOutputs, CompareOverWindowsAndSurfaces) {
    ComparisonOptions options;
    options.window = 3;
    comparison = compare_layers(picture(0.5f), picture(0.4f), options);
    ComparisonReport report{"a", "b", comparison, {{7, "+x", "out.direct", comparison.parts.front().figures}}, 1, 3};
    const auto json = nlohmann::json::parse(comparison_json(report));
    EXPECT_EQ(json["parts"]["out.direct"]["windowed"]["half_mean"], 0.25);
    EXPECT_EQ(json["parts"]["out.direct"]["windowed"]["window"], 3);
    EXPECT_EQ(json["surfaces"][0]["half_mean"], 0.25);
}

TEST_F(MetricOutputs, ChartTables) {
    const std::string csv = chart_csv({point()});
    const std::vector<std::string> lines = split(csv, '\n');
    const std::vector<std::string> header = split(lines[0], ','), row = split(lines[1], ',');
    for (const char* column : {"half_mean", "full_half_mean"}) {
        const auto at = std::find(header.begin(), header.end(), column);
        ASSERT_NE(at, header.end());
        EXPECT_EQ(row[size_t(at - header.begin())], "0.25");
    }
    EXPECT_THAT(chart_html({point()}), HasSubstr("<th>HALF</th>"));
    EXPECT_THAT(chart_html({point()}), HasSubstr("<td>0.250<br><small>0.250</small></td>"));
    EXPECT_THAT(chart_markdown({point()}), HasSubstr(" HALF |"));
    EXPECT_THAT(chart_markdown({point()}), HasSubstr(" 0.250 |"));
}

TEST_F(MetricOutputs, ChartPointFiles) {
    const ChartPoint read = point_from_json(point_to_json(point()), "here");
    EXPECT_EQ(read.same_transport["half_mean"], 0.25);
    EXPECT_EQ(read.full["half_mean"], 0.25);
    EXPECT_EQ(read.same_transport["flip"], point().same_transport["flip"]);
}

TEST_F(MetricOutputs, ChartAxes) {
    const std::string drawn = svg_scatter({point()}, {"", "half_mean"});
    EXPECT_THAT(drawn, HasSubstr(">HALF, same transport</text>"));
    EXPECT_THAT(drawn, HasSubstr("HALF 0.250"));
    EXPECT_NEAR(point().error(find_metric("half_mean")), 0.25, 1e-12);
}

TEST_F(MetricOutputs, SweepsAndCostTables) {
    const fs::path folder = fs::temp_directory_path() / ("bounce_metric_test_" + std::to_string(getpid()));
    fs::create_directories(folder);
    std::ofstream(folder / "sweep.json") << R"({"metric": "half_mean"})";
    EXPECT_EQ(load_sweep((folder / "sweep.json").string()).metric, "half_mean");
    std::ofstream(folder / "wrong.json") << R"({"metric": "half_maen"})";
    EXPECT_THROW(load_sweep((folder / "wrong.json").string()), Error);
    std::ofstream(folder / "table.json") << R"({"graph": "direct", "columns": [{"name": "a", "shot": "cornell"}],
                                                "errors": {"samples": 4, "metrics": ["half_mean"]}})";
    CostTableMeasured measured;
    measured.errors = comparison.parts.front().figures;
    EXPECT_THAT(cost_table_markdown(load_cost_table((folder / "table.json").string()), {measured}),
                HasSubstr("| HALF | 0.250 |"));
    fs::remove_all(folder);
}

TEST_F(PanelsTest, ComparePanelHasARowForEachMetric) {
    AddedMetric added;
    show(draw_compare_panel);
    ui.comparison->noise = 0.5f;
    click("compare.start");
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while ((ui.comparison->running() || !ui.comparison->measured()) && std::chrono::steady_clock::now() < end) {
        frame();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(ui.comparison->measured()) << ui.comparison->problem();
    frame();
    for (const Metric* metric : brief_metrics())
        EXPECT_EQ(has("compare.metric." + metric->name), metric->needs == MetricNeeds::values) << metric->name;
    EXPECT_TRUE(has("compare.metric.half_mean"));
    EXPECT_NEAR(ui.comparison->figures()["half_mean"], ui.comparison->figures()["mean"] / 2, 1e-12);
    // The points are drawn by the metric that was clicked.
    click("compare.metric.half_mean");
    EXPECT_EQ(ui.comparison->metric, "half_mean");
    // Those of display values are computed when asked for.
    click("compare.shown");
    frame();
    EXPECT_TRUE(has("compare.metric.flip"));
}

} // namespace
} // namespace bounce
