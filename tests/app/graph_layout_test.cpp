// Drawn graphs: every pass has its place, nothing overlaps, and wires lead from left to right around the boxes.
#include "app/graph_layout.h"
#include "app/graph_svg.h"
#include "scene/find_scene.h"
#include "scene/shot.h"
#include "support/every_graph.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <set>

namespace bounce {

namespace {

struct Drawn {
    GraphModel model;
    SceneFacts facts;
    Plan plan;
    GraphLayout layout;

    Drawn(GraphFile file, SceneFacts scene)
        : model(std::move(file)), facts(std::move(scene)), plan(model.plan(facts, {320, 180})),
          layout(lay_out_graph(model, plan, facts)) {}

    const LayoutBox& box(const std::string& id) const {
        return *std::find_if(layout.boxes.begin(), layout.boxes.end(), [&](const LayoutBox& b) { return b.id == id; });
    }
    bool wired(const std::string& resource, const std::string& from, const std::string& to, bool back = false) const {
        return std::any_of(layout.wires.begin(), layout.wires.end(), [&](const LayoutWire& w) {
            return w.resource == resource && layout.boxes[size_t(w.from)].id == from &&
                   layout.boxes[size_t(w.to)].id == to && w.back == back;
        });
    }
};

/// A scene of everything, or one without any light, so that passes are skipped for their reasons.
SceneFacts facts_of(bool everything) {
    TempFolder folder;
    Shot shot = load_shot(tiny_shot(folder));
    SceneFacts facts = shot_facts(shot);
    if (everything) return facts;
    facts.point_lights = facts.spot_lights = facts.directional_lights = facts.emissive_materials = 0;
    facts.environment = false;
    return facts;
}

bool overlap(const LayoutBox& a, const LayoutBox& b) {
    return a.min.x < b.min.x + b.size.x && b.min.x < a.min.x + a.size.x && a.min.y < b.min.y + b.size.y &&
           b.min.y < a.min.y + a.size.y;
}

/// Whether a straight part of a wire passes through the inside of a box. Those of a column are horizontal.
bool crosses(glm::vec2 from, glm::vec2 to, const LayoutBox& box) {
    const float slack = 1e-3f;
    const float x0 = std::min(from.x, to.x), x1 = std::max(from.x, to.x), y0 = std::min(from.y, to.y),
                y1 = std::max(from.y, to.y);
    return x0 < box.min.x + box.size.x - slack && x1 > box.min.x + slack && y0 < box.min.y + box.size.y - slack &&
           y1 > box.min.y + slack;
}

void expect_drawn_well(const Drawn& drawn) {
    const GraphLayout& layout = drawn.layout;
    std::multiset<std::string> expected, found;
    for (const auto& node : drawn.model.nodes())
        expected.insert(node->id());
    for (const LayoutBox& box : layout.boxes) {
        found.insert(box.id);
        EXPECT_EQ(box.plan < 0, !box.skipped.empty()) << box.id;
        EXPECT_GE(box.min.x, 0) << box.id;
        EXPECT_GE(box.min.y, 0) << box.id;
        EXPECT_LE(box.min.x + box.size.x, layout.size.x + 1e-3f) << box.id;
        EXPECT_LE(box.min.y + box.size.y, layout.size.y + 1e-3f) << box.id;
    }
    EXPECT_EQ(found, expected);
    for (size_t a = 0; a < layout.boxes.size(); ++a)
        for (size_t b = a + 1; b < layout.boxes.size(); ++b)
            EXPECT_FALSE(overlap(layout.boxes[a], layout.boxes[b]))
                << layout.boxes[a].id << " lies on " << layout.boxes[b].id;
    for (const LayoutWire& wire : layout.wires) {
        const LayoutBox &from = layout.boxes[size_t(wire.from)], &to = layout.boxes[size_t(wire.to)];
        const std::string name = wire.resource + ": " + from.id + " → " + to.id;
        ASSERT_GE(wire.points.size(), 2u) << name;
        EXPECT_FLOAT_EQ(wire.points.front().x, from.min.x + from.size.x) << name;
        EXPECT_FLOAT_EQ(wire.points.front().y, layout_row_y(from, wire.output)) << name;
        EXPECT_EQ(from.outputs.at(size_t(wire.output)), wire.resource) << name;
        EXPECT_FLOAT_EQ(wire.points.back().x, to.min.x) << name;
        EXPECT_GT(wire.points.back().y, to.min.y) << name;
        EXPECT_LT(wire.points.back().y, to.min.y + to.size.y) << name;
        if (!wire.back) {
            EXPECT_LT(from.layer, to.layer) << name;
            for (size_t i = 1; i < wire.points.size(); ++i)
                EXPECT_GT(wire.points[i].x, wire.points[i - 1].x) << name << " goes back";
        }
        for (size_t i = 1; i < wire.points.size(); ++i) {
            const bool straight = wire.back || i % 2 == 0; // the others curve in the gap between two columns
            for (const LayoutBox& box : layout.boxes)
                EXPECT_FALSE(straight && crosses(wire.points[i - 1], wire.points[i], box))
                    << name << " crosses " << box.id;
        }
    }
}

/// Every read of a resource that a pass made is a wire.
void expect_all_reads(const Drawn& drawn) {
    for (const PlanPass& pass : drawn.plan.passes) {
        for (const PlanSlot& slot : pass.slots) {
            if (!slot.use.reads || slot.resource < 0 || slot.builtin) continue;
            const PlanResource& resource = drawn.plan.resources[size_t(slot.resource)];
            const bool only_own = std::all_of(resource.writers.begin(), resource.writers.end(),
                                              [&](const std::string& writer) { return writer == pass.id; });
            if (only_own && !slot.bind.previous) continue;
            EXPECT_TRUE(std::any_of(drawn.layout.wires.begin(), drawn.layout.wires.end(),
                                    [&](const LayoutWire& wire) {
                                        return wire.resource == resource.name() &&
                                               drawn.layout.boxes[size_t(wire.to)].id == pass.id;
                                    }))
                << pass.id << " reads " << resource.name();
        }
    }
}

TEST(GraphLayout, EveryShippedGraphIsDrawnWell) {
    for (const std::string& name : graph_names()) {
        for (bool everything : {true, false}) {
            SCOPED_TRACE(name + (everything ? ", a scene of everything" : ", a scene without light"));
            const Drawn drawn(read_graph_file(find_graph(name)), facts_of(everything));
            expect_drawn_well(drawn);
            expect_all_reads(drawn);
        }
    }
}

TEST(GraphLayout, WiresFollowTheNewestWriter) {
    const Drawn drawn(read_graph_file(find_graph("direct")), facts_of(true));
    EXPECT_TRUE(drawn.wired("gbuffer.normal", "gbuffer", "direct"));
    EXPECT_TRUE(drawn.wired("shadow.depth", "shadow_maps", "direct"));
    EXPECT_TRUE(drawn.wired("out.radiance", "compose", "tonemap"));
    EXPECT_FALSE(drawn.wired("gbuffer.normal", "direct", "gbuffer"));
    EXPECT_EQ(drawn.box("tonemap").layer, drawn.box("compose").layer + 1);
}

TEST(GraphLayout, TheSamePlanGivesTheSameLayout) {
    const Drawn first(read_graph_file(find_graph("dvs_tuned")), facts_of(true)),
        second(read_graph_file(find_graph("dvs_tuned")), facts_of(true));
    EXPECT_EQ(graph_svg(first.model, first.plan, first.facts), graph_svg(second.model, second.plan, second.facts));
}

TEST(GraphLayout, SkippedPassesSayWhy) {
    const Drawn drawn(read_graph_file(find_graph("direct")), facts_of(false));
    EXPECT_THAT(drawn.box("shadow_maps").skipped, testing::HasSubstr("light"));
    EXPECT_LT(drawn.box("shadow_maps").plan, 0);
    EXPECT_TRUE(std::none_of(drawn.layout.wires.begin(), drawn.layout.wires.end(), [&](const LayoutWire& wire) {
        return drawn.layout.boxes[size_t(wire.from)].id == "shadow_maps" && !wire.skipped;
    }));
}

TEST(GraphLayout, SkippedPassesCanBeLeftOut) {
    const Drawn drawn(read_graph_file(find_graph("direct")), facts_of(false));
    const GraphLayout shown = lay_out_graph(drawn.model, drawn.plan, drawn.facts, false);
    EXPECT_EQ(shown.boxes.size(), drawn.plan.passes.size());
    EXPECT_LT(shown.boxes.size(), drawn.layout.boxes.size());
    for (const LayoutBox& box : shown.boxes)
        EXPECT_GE(box.plan, 0) << box.id;
}

} // namespace

} // namespace bounce
