#pragma once
// Runs a graph on a scene made in memory, for tests of passes below the program. The fixture's root holds copies of all
// shaders, beside which a test may write shaders and graphs of its own.

#include "graph/graph.h"
#include "scene/describe.h"
#include "support/errors.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <filesystem>
#include <string>
#include <vector>

namespace bounce {

/// A scene of quads and triangles, each one material; no file between the test and its corners.
class MadeScene {
  public:
    MadeScene() { scene.nodes.emplace_back().mesh = 0, scene.meshes.emplace_back(); }
    MadeScene& triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 colour = glm::vec3(0.5f)) {
        return add({a, b, c}, {0, 1, 2}, colour);
    }
    /// Corners in order around; the normal is (b − a) × (c − a).
    MadeScene& quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec3 colour = glm::vec3(0.5f)) {
        return add({a, b, c, d}, {0, 1, 2, 0, 2, 3}, colour);
    }
    /// All six sides; they face outward, or inward for a room.
    MadeScene& box(glm::vec3 l, glm::vec3 h, glm::vec3 colour = glm::vec3(0.5f), bool inward = false) {
        for (int axis = 0; axis < 3; ++axis) {
            int u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (bool high : {false, true}) {
                glm::vec3 corners[4];
                for (int i = 0; i < 4; ++i) {
                    corners[i][axis] = high ? h[axis] : l[axis];
                    corners[i][u] = (i == 1 || i == 2) ? h[u] : l[u];
                    corners[i][v] = i >= 2 ? h[v] : l[v];
                }
                if (high == inward) std::swap(corners[1], corners[3]);
                quad(corners[0], corners[1], corners[2], corners[3], colour);
            }
        }
        return *this;
    }
    Material& material() { return scene.materials.back(); } ///< of what was added last
    /// Vertex k of what was added last.
    Vertex& vertex(size_t k) { return scene.vertices[scene.vertices.size() - last_ + k]; }

    Scene scene;

  private:
    MadeScene& add(const std::vector<glm::vec3>& corners, const std::vector<uint32_t>& order, glm::vec3 colour) {
        Primitive primitive;
        primitive.first_index = uint32_t(scene.indices.size());
        primitive.index_count = uint32_t(order.size());
        primitive.material = int(scene.materials.size());
        glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        for (uint32_t i : order)
            scene.indices.push_back(uint32_t(scene.vertices.size()) + i);
        for (glm::vec3 p : corners) {
            Vertex& vertex_here = scene.vertices.emplace_back();
            vertex_here.position = p;
            vertex_here.normal = glm::normalize(normal);
        }
        Material& paint = scene.materials.emplace_back();
        paint.base_colour = glm::vec4(colour, 1);
        paint.metallic = 0;
        scene.meshes[0].primitives.push_back(primitive);
        last_ = corners.size();
        return *this;
    }
    size_t last_ = 0;
};

inline Light spot_light(glm::vec3 position, glm::vec3 direction, glm::vec3 intensity, float inner_deg,
                        float outer_deg) {
    Light light;
    light.type = LightType::spot;
    light.position = position;
    light.direction = glm::normalize(direction);
    light.intensity = intensity;
    light.inner_cone = glm::radians(inner_deg);
    light.outer_cone = glm::radians(outer_deg);
    return light;
}
inline Light directional_light(glm::vec3 direction, glm::vec3 intensity) {
    Light light;
    light.type = LightType::directional;
    light.direction = glm::normalize(direction);
    light.intensity = intensity;
    return light;
}
inline Light point_light(glm::vec3 position, glm::vec3 intensity) {
    Light light;
    light.position = position;
    light.intensity = intensity;
    return light;
}

class SceneRunner {
  public:
    /// `sets`: "pass.parameter" → text.
    SceneRunner(Scene made, std::vector<Light> lit_by, const std::filesystem::path& file,
                const std::vector<std::pair<std::string, std::string>>& sets = {}, glm::ivec2 picture = {16, 16})
        : scene(std::move(made)), state(evaluate_scene(scene, 0, 0)), facts(scene_facts(scene, true)), size(picture),
          gpu_scene_(scene, Environment{}), graph(file, TimerMode::finish) {
        set_lights(std::move(lit_by));
        for (const auto& [name, text] : sets)
            graph.model().set(name, text, ParameterOrigin::command_line);
    }

    const Scene scene;
    SceneState state;
    SceneFacts facts;
    Camera camera;
    glm::ivec2 size;
    int frame_index = 0;
    int diffuse_only = 1;
    int material_model = 0; ///< MaterialModel

    void set_lights(std::vector<Light> lit_by) {
        state.lights = std::move(lit_by);
        facts.point_lights = facts.spot_lights = facts.directional_lights = 0;
        for (const Light& light : state.lights)
            ++(light.type == LightType::point  ? facts.point_lights
               : light.type == LightType::spot ? facts.spot_lights
                                               : facts.directional_lights);
    }
    /// A constant environment; W/(sr·m²).
    void set_environment(glm::vec3 radiance) {
        environment_ = radiance;
        facts.environment = radiance != glm::vec3(0);
        graph.touch();
    }
    void set(const std::string& name, const std::string& text) {
        graph.model().set(name, text, ParameterOrigin::command_line);
        graph.touch();
    }
    /// Plans and renders one frame; problems are test failures.
    void frame() {
        graph.prepare(facts, size);
        gpu_scene_.update(state);
        FrameInputs inputs{&gpu_scene_, &facts, {}};
        FrameConstants& c = inputs.constants;
        const Bounds& bounds = facts.bounds_over_animation;
        set_camera(c, camera, size, bounds.diagonal());
        c.previous_view_projection = frame_index > 0 ? last_view_projection_ : c.view_projection;
        last_view_projection_ = c.view_projection;
        c.frame_index = frame_index++;
        c.environment_radiance = environment_;
        c.scene_min = bounds.min, c.scene_max = bounds.max, c.scene_diagonal = bounds.diagonal();
        c.light_count = int(state.lights.size());
        c.shadow_view_count = gpu_scene_.shadow_view_count();
        c.diffuse_only = diffuse_only;
        c.material_model = material_model;
        graph.execute(inputs);
        for (const GraphProblem& problem : graph.problems())
            ADD_FAILURE() << problem.where << ": " << problem.error.text();
    }
    const GpuTexture& texture(const std::string& resource) const {
        const GpuTexture* found = graph.texture(resource);
        if (!found) throw Error("no texture '" + resource + "' in the graph");
        return *found;
    }
    std::vector<float> read(const std::string& resource, int mip = 0) const { return texture(resource).read(mip); }
    template <class T>
    std::vector<T> read_buffer(const std::string& resource) const {
        const Buffer* found = graph.buffer(resource);
        if (!found) throw Error("no buffer '" + resource + "' in the graph");
        return found->read_all<T>();
    }

  private:
    GpuScene gpu_scene_;
    glm::vec3 environment_{0};
    glm::mat4 last_view_projection_{1};

  public:
    Graph graph;
};

class SceneGraphTest : public GpuTest {
  protected:
    /// Writes assets/graphs/g.json around the given members and returns its path.
    std::filesystem::path graph_file(const std::string& members) const {
        root.write("assets/graphs/g.json", "{\"version\": 1, " + members + "}");
        return root / "assets/graphs/g.json";
    }
    void shader(const std::string& name, const std::string& body) const { root.write("glsl/" + name, body); }

    TempRoot root;
};

} // namespace bounce
