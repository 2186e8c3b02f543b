// The table of metrics: names that are unique and found, values that survive JSON, numbers as a person reads them.

#include "core/error.h"
#include "core/metric_table.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

using namespace bounce;

TEST(MetricTable, EachNameStandsForOneMetric) {
    std::set<std::string> names;
    for (const Metric& metric : metrics()) {
        EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
        EXPECT_EQ(&find_metric(metric.name), &metric);
        EXPECT_FALSE(metric.title.empty());
        if (!metric.absolute.empty()) {
            EXPECT_EQ(metric_for(metric, true).unit, MetricUnit::image) << metric.name;
        }
        EXPECT_EQ(&metric_for(metric, false), &metric);
    }
    try {
        find_metric("relative_rms");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'relative_rmse'"));
    }
}

TEST(MetricTable, EqualPicturesHaveTheIdealValues) {
    Image image(16, 16, 3);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = float(i % 7) / 7;
    const Mask mask(16, 16);
    const MetricValues values =
        compute_metrics({image, image, mask, 0, 0, error_figures(image, image, mask), &image, &image});
    for (const Metric& metric : metrics()) {
        ASSERT_TRUE(values.find(metric.name)) << metric.name;
        const bool of_one = metric.name == "pixels" || metric.name == "mean" || metric.name == "reference_mean";
        if (!of_one) {
            EXPECT_NEAR(values[metric.name], metric.ideal, 1e-6) << metric.name;
        }
    }
    // Without display values, what needs them is not there.
    const MetricValues cheap = compute_metrics({image, image, mask, 0, 0, error_figures(image, image, mask)});
    for (const Metric& metric : metrics())
        EXPECT_EQ(cheap.find(metric.name).has_value(), metric.needs == MetricNeeds::values) << metric.name;
}

TEST(MetricTable, ValuesSurviveJson) {
    MetricValues values;
    values.set("bias", std::numeric_limits<double>::infinity());
    values.set("flip", 0.125);
    const std::string text = metrics_json(values).dump();
    EXPECT_EQ(text, R"({"bias":null,"flip":0.125})");
    const MetricValues read = metrics_from_json(nlohmann::ordered_json::parse(text));
    EXPECT_TRUE(std::isinf(read["bias"]));
    EXPECT_EQ(read["flip"], 0.125);
    EXPECT_TRUE(std::isnan(read["ssim"]));
}

TEST(MetricTable, TellsNumbersInTheirUnits) {
    MetricValues values;
    values.set("bias", 0.0125);
    values.set("mean_difference", 0.03125);
    values.set("ssim", 0.5);
    const Metric& bias = find_metric("bias");
    EXPECT_EQ(metric_heading(bias), "bias %");
    EXPECT_EQ(metric_text(bias, values, false), "+1.25 %");
    EXPECT_EQ(metric_text(bias, values, true), "+0.0312 AO");
    EXPECT_EQ(metric_text(find_metric("ssim"), values, true), "0.5000");
    EXPECT_EQ(metric_text(find_metric("flip"), values, false), "–");
}
