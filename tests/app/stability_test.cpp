// Stability cases: what their files mean, and what is measured, held to closed forms.

#include "app/experiments/stability_report.h"
#include "app/experiments/stability_rung.h"
#include "core/error.h"
#include "scene/shot.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

namespace bounce {
namespace {

using testing::HasSubstr;
using testing::Not;

class Stability : public GpuTest {
  protected:
    StabilityCase read(const std::string& text) {
        folder.write("case.json", text);
        return load_stability_case((folder / "case.json").string());
    }
    std::string refused(const std::string& text) {
        try {
            read(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    /// A floor that the sun lights from above: radiance albedo / π · intensity.
    static std::string floor_case(const std::string& more, const std::string& shot_more = "") {
        return R"({"about": "a floor", "resource": "out.direct", "size": [8, 8], "most": 0.001, )" + more +
               R"(, "shot": {"diffuse_only": true, "camera": {"position": [0, 1, 0.1], "target": [0, 0, 0], "vfov_deg": 40},
                    "lights": [{"type": "directional", "direction": [0, -1, 0], "intensity": 3}])" +
               shot_more + R"(},
                   "scenes": {"floor": [{"quad": [[-2, 0, 2], [2, 0, 2], [2, 0, -2], [-2, 0, -2]], "colour": "=a"}]}})";
    }
    static StabilityCell measured(const StabilityCase& which) { return measure_stability(which, "direct"); }

    TempFolder folder;
};

} // namespace

TEST_F(Stability, ShippedCasesMakeShots) {
    const std::vector<std::string> names = stability_case_names();
    EXPECT_GE(names.size(), 20u);
    for (const std::string& name : names) {
        SCOPED_TRACE(name);
        const StabilityCase which = load_stability_case(name);
        EXPECT_FALSE(which.about.empty());
        for (double rung : which.ladder)
            for (bool against : {false, true}) {
                const StabilityNames values = names_of_rung(which, rung, against, 1);
                const Shot shot = load_shot(write_rung(which, values, folder.path()));
                EXPECT_GT(shot_facts(shot).instances, 0u);
                EXPECT_TRUE(shot.scene.notes.empty()) << shot.scene.notes.front();
            }
    }
}

TEST_F(Stability, NamesFollowOneAnotherAndThoseOfAgainstReplaceThem) {
    const StabilityCase which =
        read(floor_case(R"("ladder": {"n": [2, 3]}, "names": {"a": "=n / 4", "b": "=a * 10", "c": 7},
        "against": {"a": "=n / 8", "c": 1}, "set": {"direct.filter_radius": "=n", "no.such": 1})"));
    StabilityNames names = names_of_rung(which, 2, false, 5);
    EXPECT_EQ(names["a"], 0.5);
    EXPECT_EQ(names["b"], 5);
    EXPECT_EQ(names["c"], 7);
    EXPECT_EQ(names["bounces"], 5);
    names = names_of_rung(which, 2, true, 5);
    EXPECT_EQ(names["a"], 0.25);
    EXPECT_EQ(names["b"], 2.5);
    EXPECT_EQ(names["c"], 1);
    // Only what the graph has is set, and whole numbers are written as such.
    EXPECT_EQ(sets_of_rung(which, names, {"direct.filter_radius", "x.y"}),
              (ParameterValues{{"direct.filter_radius", "2"}}));
}

TEST_F(Stability, RepeatedPartsAreCounted) {
    const StabilityCase which = read(
        R"({"about": "", "most": 1, "ladder": {"n": [3]}, "shot": {"camera": {"position": [0, 0, 5], "target": [0, 0, 0]},
             "lights": [{"repeat": "=n", "of": {"type": "point", "position": ["=i", 1, 0], "intensity": "=i + 1"}}]},
             "scenes": {"blocks": [{"repeat": 2, "of": {"box": [["=3 * i", 0, 0], ["=3 * i + 1", 1, 1]]}},
                                   {"quad": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "if": "=n > 3"}]}})");
    const Shot shot = load_shot(write_rung(which, names_of_rung(which, 3, false, 0), folder.path()));
    ASSERT_EQ(shot.scene.lights.size(), 3u);
    EXPECT_EQ(shot.scene.lights[2].intensity.x, 3);
    EXPECT_EQ(shot_facts(shot).instances, 12u);
}

TEST_F(Stability, WhatIsHeldToTheMark) {
    const std::vector<double> curve = {0.5, -2, 1};
    EXPECT_EQ(summary_of(StabilitySummary::worst, curve), -2);
    EXPECT_EQ(summary_of(StabilitySummary::first, curve), 0.5);
    EXPECT_EQ(summary_of(StabilitySummary::last, curve), 1);
    EXPECT_EQ(summary_of(StabilitySummary::growth, curve), 2);
}

TEST_F(Stability, TheMeanIsThatOfTheClosedForm) {
    const StabilityCell cell = measured(
        read(floor_case(R"("quantity": "mean", "ladder": {"a": [0.25, 0.5, 1]}, "expected": "3 * a / 3.14159265")")));
    ASSERT_EQ(cell.failure, "");
    EXPECT_EQ(cell.curve.size(), 3u);
    EXPECT_TRUE(cell.reached) << *cell.figure;
    const StabilityCell wrong = measured(
        read(floor_case(R"("quantity": "mean", "ladder": {"a": [0.5]}, "expected": "2 * 3 * a / 3.14159265")")));
    EXPECT_NEAR(*wrong.figure, -0.5, 1e-3);
    EXPECT_FALSE(wrong.reached);
}

TEST_F(Stability, SharesAndDifferencesAreThoseOfTheLight) {
    const StabilityCell share = measured(read(floor_case(
        R"("quantity": "share", "ladder": {"s": [0, 0.1, 0.5]}, "names": {"a": "=s"}, "against": {"a": 1})")));
    ASSERT_EQ(share.failure, "");
    for (size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(share.curve[i], std::vector<double>({0, 0.1, 0.5})[i], 2e-3);
    // RMS of the difference over the mean of what it is held to: |a − b| / b for pictures that are even.
    const StabilityCell difference =
        measured(read(floor_case(R"("quantity": "difference", "ladder": {"a": [0.4, 0.8]}, "against": {"a": 0.8})")));
    ASSERT_EQ(difference.failure, "");
    EXPECT_NEAR(difference.curve[0], 0.5, 2e-3);
    EXPECT_EQ(difference.curve[1], 0);
}

TEST_F(Stability, CopiesFaceAsInstancesDo) {
    for (const char* mirror : {"1", "-1"}) {
        const std::string text =
            R"({"about": "", "quantity": "difference", "most": 1e-6, "resource": "out.direct", "size": [32, 32],
                "ladder": {"own": [0]}, "against": {"own": 1}, "set": {"gbuffer.cull_back_faces": "true"},
                "shot": {"diffuse_only": true, "camera": {"position": [1, 2, 4], "target": [1, 0, 0]},
                         "lights": [{"type": "directional", "direction": [-0.4, -1, -0.6], "intensity": 3}]},
                "scenes": {"blocks": [{"name": "block", "parts": [{"box": [[0, 0, 0], [1, 0.5, 1]]}]},
                    {"instance": "block", "position": [2, 0, 0], "scale": [MIRROR, 1, 1], "if": "=!own"},
                    {"copy": "block", "position": [2, 0, 0], "scale": [MIRROR, 1, 1], "if": "=own"}]}})";
        std::string own = text;
        for (size_t at; (at = own.find("MIRROR")) != std::string::npos;)
            own.replace(at, 6, mirror);
        const StabilityCell cell = measured(read(own));
        EXPECT_EQ(cell.failure, "");
        EXPECT_TRUE(cell.reached) << mirror << ": " << cell.figure.value_or(-1);
    }
}

TEST_F(Stability, WhatCannotBeMeasuredIsTold) {
    StabilityCase which = read(floor_case(R"("quantity": "mean", "ladder": {"a": [0.5]}, "expected": "1")"));
    which.resource = "out.indirect_diffuse"; // direct light alone has none
    const StabilityCell none = measured(which);
    EXPECT_THAT(none.failure, HasSubstr("out.indirect_diffuse"));
    EXPECT_FALSE(none.figure);
    EXPECT_FALSE(none.reached);
    which = read(floor_case(R"("quantity": "mean", "ladder": {"a": [0.5]}, "expected": "albedo")"));
    EXPECT_THAT(measured(which).failure, HasSubstr("albedo"));
}

TEST_F(Stability, ALadderOfParametersThatAGraphLacksIsTold) {
    StabilityCase which = load_stability_case("resolution");
    which.sets = {{"no.such", "=n"}, {"shadow_maps.resolution", 64}};
    EXPECT_THAT(measured(which).failure, HasSubstr("none of the parameters"));
}

TEST_F(Stability, FilesThatMeanNothingAreRefusedWhole) {
    EXPECT_THAT(refused("[]"), HasSubstr("object"));
    const std::string told = refused(
        R"({"about": 1, "ladder": {}, "quantity": "shares", "size": [0, 1], "frames": "x", "mst": 1, "scenes": {"a": []},
            "shot": "cornell", "against": {"q": 1}})");
    for (const char* words : {"'about'", "'ladder'", "'shares'", "size", "frames", "'most'", "'mst'", "'shot'", "'q'"})
        EXPECT_THAT(told, HasSubstr(words));
    const auto failure = [&](const std::string& parts) {
        return measured(read(R"({"about": "", "most": 1, "resource": "out.direct", "quantity": "mean", "expected": "1",
                                 "ladder": {"n": [1]}, "shot": {"camera": {"position": [0, 0, 5], "target": [0, 0, 0]}},
                                 "scenes": {"a": )" +
                             parts + "}}"))
            .failure;
    };
    EXPECT_THAT(failure(R"([{"quad": [[0, 0, 0]]}])"), HasSubstr("scenes.a[0].quad: expected 4 points"));
    EXPECT_THAT(failure(R"([{"ball": 1}])"), HasSubstr("'ball'"));
    EXPECT_THAT(failure(R"([{"instance": "b"}])"), HasSubstr("no part of that name"));
    EXPECT_THAT(failure(R"([{"repeat": 100000, "of": {}}])"), HasSubstr("repeat"));
    EXPECT_THAT(failure(R"({"quad": 1})"), HasSubstr("list of parts"));
}

TEST_F(Stability, TablesHoldEveryCell) {
    StabilityCase which = read(floor_case(R"("quantity": "mean", "ladder": {"a": [0.5, 1]}, "expected": "1")"));
    which.about = "<script>|";
    StabilityCell reached{"lrsm", {0.0, 0.0005}, "", 0.0005, 1, true}, missed{"dvs", {0.0, -0.5}, "", -0.5, 1, false};
    StabilityCell failed{"vct", {}, "no | picture", std::nullopt, 1, false};
    const std::vector<StabilityRow> rows = {{which, {reached, missed, failed}}};
    const std::string table = stability_markdown(rows, Origin());
    EXPECT_THAT(table, HasSubstr("| case | figure | mark | lrsm | dvs | vct |"));
    EXPECT_THAT(table, HasSubstr("+0.05 % ✓ | -50 % ✗ | – |"));
    EXPECT_THAT(table, HasSubstr("vct: no \\| picture"));
    const std::string csv = stability_csv(rows);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 + 2 + 1);
    const std::string page = stability_html(rows, Origin());
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;|"));
    EXPECT_THAT(page, Not(HasSubstr("<script>|")));
    EXPECT_THAT(page, HasSubstr("a 1: -50 %"));
    const auto json = nlohmann::json::parse(stability_json(rows, Origin()));
    EXPECT_EQ(json["cases"][0]["graphs"]["dvs"]["curve"][1], -0.5);
}

} // namespace bounce
