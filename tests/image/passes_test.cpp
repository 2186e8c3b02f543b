// Every registered pass, on a tiny scene with every kind of light: no OpenGL error, nothing that is not finite.
#include "app/session.h"
#include "core/paths.h"
#include "support/every_graph.h"
#include "support/gpu_context.h"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <regex>
#include <set>

using namespace bounce;

namespace {

std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

class Passes : public GpuTest {
  protected:
    TempFolder folder;
};

} // namespace

/// Objects that register themselves are dropped by a linker that sees no use of them.
TEST(Registry, HoldsEveryPassThatTheSourcesRegister) {
    std::set<std::string> written, known;
    static const std::regex line(R"re(^BOUNCE_REGISTER_PASS\(\s*"([a-z0-9_]+)")re");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(BOUNCE_TESTS_DIR).parent_path() / "passes")) {
        if (entry.path().extension() != ".cpp") continue;
        std::istringstream text(read_text(entry.path()));
        std::smatch match;
        for (std::string one; std::getline(text, one);)
            if (std::regex_search(one, match, line)) written.insert(match[1]);
    }
    for (const PassType& type : pass_types())
        known.insert(type.name);
    EXPECT_GE(written.size(), 3u);
    for (const std::string& name : written)
        EXPECT_TRUE(known.contains(name)) << name << " is in the sources but not in the program";
    for (const PassType& type : pass_types())
        EXPECT_FALSE(type.about.empty()) << type.name;
}

/// What a pass that is off makes, by its shaders or by targets that it draws to, is made when somebody asks for it.
TEST(SwitchedOff, WhatAPassWouldMakeIsMadeWhenItIsAskedFor) {
    SceneFacts facts;
    facts.triangles = facts.vertices = 1000;
    facts.materials = facts.instances = facts.glossy_materials = facts.emissive_materials = 1;
    facts.point_lights = facts.spot_lights = facts.directional_lights = 1;
    facts.environment = true;
    facts.bounds = facts.bounds_over_animation = {glm::vec3(-1), glm::vec3(1)};
    std::set<std::string> asked;
    for (const std::string& graph : graph_names()) {
        const auto file = real_root() / "assets/graphs" / (graph + ".json");
        const Plan usual = GraphModel(read_graph_file(file)).plan(facts, {64, 36});
        GraphModel all(read_graph_file(file));
        for (const auto& node : all.nodes())
            all.switch_pass(node->id(), true);
        for (const std::string& resource : all.plan(facts, {64, 36}).resource_names()) {
            GraphModel model(read_graph_file(file));
            const std::vector<std::string> ids = model.off_for(resource);
            if (usual.find_resource(resource)) {
                EXPECT_THAT(ids, testing::IsEmpty()) << graph << ": " << resource;
                continue;
            }
            model.ask_for(resource);
            EXPECT_TRUE(model.plan(facts, {64, 36}).find_resource(resource)) << graph << ": " << resource;
            GraphModel later(read_graph_file(file)); // another graph that takes its place
            later.adopt_values(model.values());
            EXPECT_TRUE(later.plan(facts, {64, 36}).find_resource(resource)) << graph << ": " << resource;
            asked.insert(resource);
        }
    }
    EXPECT_THAT(asked, testing::IsSupersetOf({"debug.footprints", "debug.voxels", "debug.cloud", "debug.rays"}));
}

TEST_F(Passes, EachRunsInSomeGraphWithoutErrorsAndWithFiniteResults) {
    std::string shot = tiny_shot(folder);
    std::set<std::string> ran;
    for (const std::string& graph : graph_names()) {
        SessionOptions options;
        options.shot = shot;
        options.graph = graph;
        options.size = {64, 36};
        options.check_nan = true;
        Session session(options);
        for (const std::string& name : session.graph().model().parameter_names()) // large maps are not what is tested
            for (const auto& [large, smaller] :
                 {std::pair("shadow_maps.resolution", "128"), std::pair("ldm.maps", "16"),
                  std::pair("ldm.resolution", "32"), std::pair("rsm.resolution", "64"),
                  std::pair("graph.accumulate", "true"), std::pair("vf_proxies.proxies", "2000"),
                  std::pair("points.proxies", "2000"), std::pair("vpls.vpls", "64"), std::pair("splat.points", "500"),
                  std::pair("inject.route", "blended")})
                if (name == large) session.set_parameter(name, smaller, ParameterOrigin::panel);
        for (const auto& node : session.graph().model().nodes()) // views of C++ are off until somebody looks
            if (!node->enabled && node->entry.type != "compute") session.graph().model().switch_pass(node->id(), true);
        session.graph().touch();
        for (int frame = 0; frame < 2; ++frame) {
            if (frame) session.advance();
            session.render();
            for (const auto& [resource, count] : session.graph().non_finite())
                ADD_FAILURE() << graph << ": " << count << " values of " << resource << " are not finite";
        }
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << graph << ": " << problem.error.text();
        for (const PlanPass& pass : session.graph().plan().passes)
            ran.insert(session.graph().model().nodes()[size_t(pass.node)]->entry.type);
        std::vector<float> picture = session.graph().texture("out.radiance")->read();
        EXPECT_GT(*std::max_element(picture.begin(), picture.end()), 0) << graph << " is black";
    }
    for (const PassType& type : pass_types())
        EXPECT_TRUE(ran.contains(type.name)) << "no published graph runs a pass of type " << type.name;
}

/// A scene without lights, emission or environment: nothing to do is no error either.
/// The default shot has textures of several sizes, alpha tests and gloss: enough to have crashed a driver's compiler.
TEST_F(Passes, EveryGraphRendersTheDefaultShot) {
    for (const std::string& graph : graph_names()) {
        SessionOptions options;
        options.graph = graph;
        options.size = glm::ivec2(32, 18);
        if (graph.starts_with("ldm")) options.sets = {{"ldm.maps", "8"}, {"ldm.resolution", "32"}}; // fast enough
        if (graph.starts_with("ism")) options.sets = {{"vpls.vpls", "64"}, {"splat.points", "500"}};
        Session session(options);
        session.render();
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << graph << ": " << problem.error.text();
    }
}

TEST_F(Passes, RunOnASceneThatNeedsNoneOfThem) {
    TinyScene().quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}).write(folder.path(), "dark");
    std::string shot = write_shot(folder.path(), "dark", "dark.gltf", {0, 1, 2}, {0, 0, 0}, "");
    for (const std::string& graph : graph_names()) {
        SessionOptions options;
        options.shot = shot;
        options.graph = graph;
        options.size = {32, 18};
        options.check_nan = true;
        Session session(options);
        session.render();
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << graph << ": " << problem.error.text();
        EXPECT_TRUE(session.graph().non_finite().empty()) << graph;
        EXPECT_THAT(session.graph().texture("out.radiance")->read(0), testing::Contains(0)) << graph;
        EXPECT_FALSE(session.graph().plan().skipped.empty()) << graph;
    }
}
