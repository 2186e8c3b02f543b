// The search of tune on made-up graphs whose best settings are known, and what it takes for settings.

#include "app/experiments/tune.h"
#include "core/error.h"
#include "graph/graph_file.h"
#include "scene/shot.h"
#include "support/temp_folder.h"

#include <cmath>
#include <gmock/gmock.h>

namespace bounce {
namespace {

TuneParameter number(const std::string& name, int own, int low, int high) {
    ParameterInfo info;
    info.name = name;
    info.kind = ParameterKind::integer;
    info.min = low, info.max = high;
    return {name, info, std::to_string(own)};
}

TuneParameter choice(const std::string& name, const std::string& own, std::vector<std::string> choices) {
    ParameterInfo info;
    info.name = name;
    info.kind = ParameterKind::enumeration;
    info.choices = std::move(choices);
    return {name, info, own};
}

/// The value of a parameter in a variant.
std::string text_of(const Variant& variant, const TuneParameter& parameter) {
    const auto set = variant.sets.find(parameter.name);
    return set == variant.sets.end() ? parameter.own : set->second;
}

/// A gather whose error falls with rays and resolution, as its time grows; a filter that halves the error for little; a
/// switch that only costs. At 2 % of error, 64 rays at resolution 32 with the filter are fastest, without the switch.
class MadeUp {
  public:
    const std::vector<TuneParameter> parameters = {number("rays", 16, 1, 256), number("resolution", 64, 16, 256),
                                                   choice("filter", "none", {"none", "box", "broken"}),
                                                   choice("waste", "on", {"off", "on"})};
    int evaluated = 0;

    TuneEvaluator evaluator() {
        return [this](const Variant& variant) -> std::optional<TuneFigures> {
            ++evaluated;
            const double rays = std::stod(text_of(variant, parameters[0]));
            const double resolution = std::stod(text_of(variant, parameters[1]));
            const std::string filter = text_of(variant, parameters[2]);
            if (filter == "broken") return std::nullopt;
            const double error = (filter == "box" ? 0.2 : 0.4) / std::sqrt(rays) * (1 + 16 / resolution);
            const double ms = 0.1 * rays + 0.0005 * resolution * resolution + (filter == "box" ? 0.5 : 0) +
                              (text_of(variant, parameters[3]) == "on" ? 5 : 0);
            return TuneFigures{ms, error, resolution * resolution};
        };
    }

    /// By trying everything.
    TuneFigures best(const TuneGoal& goal) {
        std::optional<TuneFigures> best;
        for (int rays = 1; rays <= 256; rays *= 2)
            for (int resolution = 16; resolution <= 256; resolution *= 2)
                for (const char* filter : {"none", "box"}) {
                    Variant variant;
                    variant.sets = {{"rays", std::to_string(rays)},
                                    {"resolution", std::to_string(resolution)},
                                    {"filter", filter},
                                    {"waste", "off"}};
                    const TuneFigures figures = *evaluator()(variant);
                    if (!best || tune_objective(goal, figures) < tune_objective(goal, *best)) best = figures;
                }
        return *best;
    }
};

} // namespace

TEST(Tune, NeighboursAreHalfDoubleAndEveryOtherChoice) {
    EXPECT_EQ(neighbours_of(number("n", 8, 1, 12), "8"), (std::vector<std::string>{"4"}));
    EXPECT_EQ(neighbours_of(number("n", 1, 0, 12), "1"), (std::vector<std::string>{"0", "2"}));
    EXPECT_EQ(neighbours_of(number("n", 0, 0, 12), "0"), (std::vector<std::string>{"1"}));
    EXPECT_EQ(neighbours_of(choice("c", "a", {"a", "b", "c"}), "b"), (std::vector<std::string>{"a", "c"}));
}

TEST(Tune, ALimitOutweighsEverything) {
    TuneGoal goal;
    goal.error = 0.1;
    EXPECT_LT(tune_objective(goal, {10, 0.1, 0}), tune_objective(goal, {5, 0.2, 0}));
    EXPECT_LT(tune_objective(goal, {5, 0.1, 0}), tune_objective(goal, {10, 0.01, 0}));
    goal = {};
    goal.ms = 10;
    EXPECT_LT(tune_objective(goal, {10, 0.1, 0}), tune_objective(goal, {5, 0.2, 0}));
    EXPECT_LT(tune_objective(goal, {10, 0.1, 0}), tune_objective(goal, {20, 0.05, 0}));
    goal.bytes = 100;
    EXPECT_LT(tune_objective(goal, {10, 0.2, 100}), tune_objective(goal, {10, 0.1, 200}));
}

TEST(Tune, FindsTheFastestSettingsForAnError) {
    for (double wanted : {0.2, 0.05, 0.02}) {
        MadeUp graph;
        TuneGoal goal;
        goal.error = wanted;
        const TuneFigures best = graph.best(goal);
        graph.evaluated = 0;
        const TuneResult found = tune_search(graph.parameters, goal, 200, graph.evaluator(), [] { return true; });
        EXPECT_LE(found.best.figures.error, wanted);
        EXPECT_LE(found.best.figures.ms, 1.1 * best.ms) << wanted << ": " << found.best.variant.text();
        EXPECT_LE(graph.evaluated, 120); // of the 270 that there are
    }
}

TEST(Tune, FindsTheLeastErrorWithinATimeAndAMemory) {
    MadeUp graph;
    TuneGoal goal;
    goal.ms = 8;
    goal.bytes = 64 * 64;
    const TuneFigures best = graph.best(goal);
    const TuneResult found = tune_search(graph.parameters, goal, 200, graph.evaluator(), [] { return true; });
    EXPECT_LE(found.best.figures.ms, 8);
    EXPECT_LE(found.best.figures.bytes, 64 * 64);
    EXPECT_LE(found.best.figures.error, 1.1 * best.error) << found.best.variant.text();
}

TEST(Tune, WithoutAGoalTheErrorStaysAndTheTimeFalls) {
    MadeUp graph;
    const TuneResult found = tune_search(graph.parameters, {}, 200, graph.evaluator(), [] { return true; });
    EXPECT_LE(found.best.figures.error, found.start.figures.error);
    EXPECT_LT(found.best.figures.ms, 0.5 * found.start.figures.ms);
}

/// Three choices of which one or two make it worse, and all three together much better: planes, their filter, fewer
/// rays.
TEST(Tune, FindsChoicesThatHelpOnlyTogether) {
    std::vector<TuneParameter> parameters;
    for (const char* name : {"a", "b", "c", "d", "e", "f"})
        parameters.push_back(choice(name, "off", {"off", "on"}));
    const TuneEvaluator evaluate = [&](const Variant& variant) -> std::optional<TuneFigures> {
        const int on = int(variant.sets.size());
        const bool together = variant.sets.contains("b") && variant.sets.contains("d") && variant.sets.contains("e");
        return TuneFigures{10.0 + on, (together ? 0.1 : 1) * (1 + 0.1 * on), 0};
    };
    TuneGoal goal;
    goal.ms = 20;
    const TuneResult found = tune_search(parameters, goal, 200, evaluate, [] { return true; });
    EXPECT_EQ(found.best.variant.text(), "b=on, d=on, e=on");
}

TEST(Tune, FromFarBeyondTheTimeAllSizesShrinkAtOnce) {
    MadeUp graph;
    TuneGoal goal;
    goal.ms = 1;
    const TuneEvaluator inner = graph.evaluator();
    tune_search(
        graph.parameters, goal, 3,
        [&](const Variant& variant) {
            EXPECT_EQ(variant.sets.size(), variant == Variant{} ? 0u : 2u) << variant.text();
            return inner(variant);
        },
        [] { return true; });
}

TEST(Tune, ABudgetIsKeptAndNothingIsEvaluatedTwice) {
    MadeUp graph;
    std::set<Variant> seen;
    const TuneEvaluator inner = graph.evaluator();
    const TuneEvaluator once = [&](const Variant& variant) {
        EXPECT_TRUE(seen.insert(variant).second) << variant.text();
        return inner(variant);
    };
    tune_search(graph.parameters, {}, 9, once, [] { return true; });
    EXPECT_LE(seen.size(), 9u);
    EXPECT_THROW(tune_search(
                     graph.parameters, {}, 9, [](const Variant&) { return std::nullopt; }, [] { return true; }),
                 Error);
}

TEST(Tune, TheFrontFallsFromTheFastestOn) {
    const auto point = [](double ms, double error) { return TunePoint{{}, {ms, error, 0}}; };
    const std::vector<TunePoint> front = tune_front({point(4, 1), point(1, 3), point(2, 3), point(2, 2), point(5, 2)});
    ASSERT_EQ(front.size(), 3u);
    EXPECT_EQ(front[0].figures.ms, 1);
    EXPECT_EQ(front[1].figures.error, 2);
    EXPECT_EQ(front[2].figures.ms, 4);
}

TEST(Tune, ParametersAreThoseOfPassesThatCount) {
    const GraphModel model(read_graph_file(find_graph("lrsm")));
    const Plan plan = model.plan(shot_facts(load_shot("cornell")), {32, 32});
    std::vector<std::string> names;
    for (const TuneParameter& parameter : tunable_parameters(model, plan, {}))
        names.push_back(parameter.name);
    EXPECT_THAT(names, testing::Contains("rsm.resolution"));
    EXPECT_THAT(names, testing::Not(testing::Contains("tonemap.exposure")));
    EXPECT_THAT(names, testing::Not(testing::Contains("graph.rebuild")));
    EXPECT_EQ(tunable_parameters(model, plan, {"rsm.resolution"}).size(), 1u);
    EXPECT_THROW(tunable_parameters(model, plan, {"rsm.resolutoin"}), Error);
}

TEST(Tune, MemoryHoldsWhatWasMeasuredForTheSameRun) {
    TempFolder folder;
    Variant variant{{{"a.b", "1"}}, {{"c", false}}};
    {
        TuneMemory memory(folder / "points.json", "key");
        memory.add(0, variant, TuneFigures{1, 2, 3});
        memory.add(1, variant, std::nullopt);
    }
    const TuneMemory again(folder / "points.json", "key");
    ASSERT_NE(again.find(0, variant), nullptr);
    EXPECT_EQ(*again.find(0, variant), (TuneFigures{1, 2, 3}));
    ASSERT_NE(again.find(1, variant), nullptr);
    EXPECT_FALSE(*again.find(1, variant));
    EXPECT_EQ(again.find(0, {}), nullptr);
    EXPECT_EQ(TuneMemory(folder / "points.json", "other").size(), 0u);
    folder.write("broken.json", R"({"key": "key", "points": [{"stage": 0}]})");
    EXPECT_THROW(TuneMemory(folder / "broken.json", "key"), Error);
}

} // namespace bounce
