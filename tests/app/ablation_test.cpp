// What can be left out of a graph, and what that is found to cost.

#include "app/experiments/ablation_report.h"
#include "core/error.h"
#include "graph/graph_file.h"
#include "scene/shot.h"
#include "support/gpu_context.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace bounce {
namespace {

std::vector<std::string> names(const std::vector<AblatedPart>& parts) {
    std::vector<std::string> out;
    for (const AblatedPart& part : parts)
        out.push_back(part.name);
    return out;
}

class Ablate : public GpuTest {
  protected:
    static AblationSettings settings(const std::string& graph) {
        AblationSettings settings;
        settings.session.shot = "cornell";
        settings.session.graph = graph;
        settings.session.size = glm::ivec2(24);
        settings.published = published_graph_of(graph);
        settings.samples = 16;
        settings.frames = 1;
        settings.pairs_of = 0;
        return settings;
    }
};

} // namespace

TEST_F(Ablate, PartsArePassesAndDepartures) {
    EXPECT_EQ(published_graph_of("dvs"), "");
    const std::string published = published_graph_of("dvs_tuned");
    EXPECT_THAT(published, testing::EndsWith("dvs.json"));
    const GraphModel tuned(read_graph_file(find_graph("dvs_tuned"))), plain(read_graph_file(published));
    const Plan plan = tuned.plan(shot_facts(load_shot("cornell")), {32, 32});
    const std::vector<std::string> found = names(parts_to_leave_out(tuned, &plain, plan));
    EXPECT_THAT(found,
                testing::IsSupersetOf({"voxelization off", "gather off", "voxelization.averaging: sum → average"}));
    EXPECT_THAT(found, testing::Not(testing::Contains("tonemap off"))); // shows the picture
    for (const auto& node : tuned.nodes())
        for (const Parameter& p : node->parameters.all()) {
            const std::string name = node->id() + "." + p.info.name;
            const Parameter* other = plain.find_parameter(name);
            if (!other) continue;
            const bool differs = to_text(p.info, p.value) != to_text(other->info, other->value);
            const bool told = std::any_of(found.begin(), found.end(),
                                          [&](const std::string& part) { return part.starts_with(name + ": "); });
            const bool runs = std::any_of(plan.passes.begin(), plan.passes.end(),
                                          [&](const PlanPass& pass) { return pass.id == node->id(); });
            EXPECT_EQ(told, differs && runs && node->enabled) << name;
        }
}

/// A variant leaves nothing behind for the next one.
TEST_F(Ablate, AVariantIsMeasuredAsAFreshStartIs) {
    AblationSettings s = settings("hbao");
    VariantMeasurer measurer(s.session, s.samples, 1);
    const VariantFigures before = measurer.measure({});
    Variant other;
    other.sets["blur.width"] = "1";
    other.sets["hbao_dmax.falloff"] = "none";
    EXPECT_NE(measurer.measure(other).picture.pixels, before.picture.pixels);
    EXPECT_THROW(measurer.measure({{{"no.such", "1"}}, {{"no_pass", false}}}), Error);
    const VariantFigures after = measurer.measure({});
    EXPECT_EQ(before.picture.pixels, after.picture.pixels);
    EXPECT_EQ(before.error, after.error);
    EXPECT_EQ(before.bytes, after.bytes);
}

/// gather.exact_hits is there only where cones look for hits, gather.map_voxels only where triangles are hit.
TEST_F(Ablate, AVariantMayBringAndTakeParameters) {
    const AblationSettings s = settings("lrsm");
    VariantMeasurer measurer(s.session, s.samples, 1);
    const GraphModel& model = measurer.session().graph().model();
    const std::vector<std::string> own = model.parameter_names();
    const ParameterOrigin origin = model.parameter("rsm.resolution").origin;
    Variant triangles, cones;
    triangles.sets = {{"gather.hit", "triangle"}, {"gather.map_voxels", "64"}};
    cones.sets = {{"gather.exact_hits", "true"}, {"gather.hit", "voxel"}, {"rsm.resolution", "128"}};
    EXPECT_FALSE(model.find_parameter("gather.map_voxels"));
    for (const Variant& variant : {triangles, cones, triangles, Variant{}, cones, Variant{}}) {
        EXPECT_NO_THROW(measurer.use(variant)) << variant.text();
        for (const auto& [name, text] : variant.sets)
            EXPECT_EQ(model.parameter(name).text(), text);
    }
    EXPECT_THAT(model.parameter_names(), testing::UnorderedElementsAreArray(own));
    EXPECT_EQ(model.parameter("rsm.resolution").origin, origin);
    EXPECT_EQ(model.parameter("gather.exact_hits").text(), "false");
    EXPECT_THROW(measurer.use({{{"gather.map_voxels", "64"}}, {}}), Error);
}

TEST_F(Ablate, WhatTheGraphDerivesFollowsAVariant) {
    const AblationSettings s = settings("lpv");
    VariantMeasurer measurer(s.session, s.samples, 1);
    const GraphModel& model = measurer.session().graph().model();
    EXPECT_EQ(model.number("lights.directions"), 0);
    measurer.use({{{"graph.angular", "ordinates"}}, {}});
    EXPECT_EQ(model.number("lights.directions"), 48);
    measurer.use({});
    EXPECT_EQ(model.number("lights.directions"), 0);
}

TEST_F(Ablate, WithoutItsGatherThereIsNoLight) {
    const AblationSettings s = settings("lrsm");
    VariantMeasurer measurer(s.session, s.samples, 1);
    Variant without;
    without.switches["gather"] = false;
    const VariantFigures figures = measurer.measure(without);
    EXPECT_EQ(figures.bias, -1);
    EXPECT_EQ(*std::max_element(figures.picture.pixels.begin(), figures.picture.pixels.end()), 0);
}

TEST_F(Ablate, TheMinimalGraphLosesLessThanItSaves) {
    AblationSettings s = settings("hbao_tuned");
    s.worth = 1e6; // whatever saves time goes
    VariantMeasurer measurer(s.session, s.samples, 1);
    const Ablation all = ablate(measurer, s, [](const std::string&) {});
    EXPECT_LE(all.minimal_figures.ms, all.whole.ms);
    EXPECT_EQ(all.dropped.empty(), all.minimal == Variant());
    s.worth = 0; // nothing may be lost: what goes does no harm
    const Ablation none = ablate(measurer, s, [](const std::string&) {});
    EXPECT_LE(none.minimal_figures.error, none.whole.error);
    const std::string table = ablation_markdown(all, s, Origin());
    for (const AblatedPart& part : all.parts)
        EXPECT_THAT(table, testing::HasSubstr(part.name));
}

} // namespace bounce
