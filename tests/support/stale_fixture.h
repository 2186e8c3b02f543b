#pragma once
// Sessions that live through changes, compared with sessions that start with them: the same bytes.

#include "app/session.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace bounce {

/// Pictures of the parts that a graph makes, by name.
using Parts = std::map<std::string, std::vector<float>>;

class StaleTest : public GpuTest {
  protected:
    /// Every kind of light, glossy, emissive and alpha-tested materials, an object that moves.
    void SetUp() override {
        GpuTest::SetUp();
        write_scene("tiny", {0.7f, 0.6f, 0.5f});
        write_scene("other", {0.3f, 0.7f, 0.4f});
        TinyScene().box({-0.1f, 0, -0.1f}, {0.1f, 0.25f, 0.1f}, {0.8f, 0.3f, 0.3f}).write(root.path(), "mover");
        shot = write_shot_of("tiny");
    }

    /// Cheap settings of all that takes time.
    SessionOptions options(const std::string& graph) const {
        SessionOptions out;
        out.shot = shot;
        out.graph = graph;
        out.size = {32, 18};
        GraphModel model(read_graph_file(find_graph(graph)));
        for (const auto& [name, value] :
             std::initializer_list<std::pair<const char*, const char*>>{{"shadow_maps.resolution", "64"},
                                                                        {"rsm.resolution", "32"},
                                                                        {"voxelization.resolution", "16"},
                                                                        {"occlusion_voxels.resolution", "16"},
                                                                        {"ldm.maps", "8"},
                                                                        {"ldm.resolution", "16"}})
            if (model.find_parameter(name)) out.sets.emplace_back(name, value);
        return out;
    }

    static Parts parts(const Session& session) {
        Parts out;
        for (const PlanResource& resource : session.graph().plan().resources)
            if (resource.name().starts_with("out."))
                out[resource.name()] = session.graph().texture(resource.name())->read();
        return out;
    }
    static Parts rendered(Session& session) {
        session.render(true);
        return parts(session);
    }
    /// Names of the parts that differ, or "" when none does.
    static std::string differences(const Parts& a, const Parts& b) {
        std::string names;
        for (const auto& [name, pixels] : a)
            if (!b.contains(name) || b.at(name) != pixels) names += " " + name;
        for (const auto& [name, pixels] : b)
            if (!a.contains(name)) names += " " + name;
        return names;
    }

    std::string write_shot_of(const std::string& scene) const {
        std::string file = write_shot(
            root.path(), scene, scene + ".gltf", {0.4f, 1, 2}, {0, 0.2f, 0},
            R"({"type":"spot","position":[0.5,2,0.5],"direction":[-0.2,-1,-0.2],"intensity":4,"outer_cone_deg":40},)"
            R"({"type":"point","position":[-0.7,1,0.4],"intensity":2},)"
            R"({"type":"directional","direction":[0.3,-1,-0.2],"intensity":1})",
            R"(,"environment":[0.2,0.3,0.4],"fps":10,"objects":[{"scene":"mover.gltf","path":[)"
            R"({"t":0,"position":[0.5,0,0.3]},{"t":1,"position":[0.5,0.4,-0.4]}]}])");
        root.edit(scene + ".json", "\"diffuse_only\":true", "\"diffuse_only\":false");
        return file;
    }

    TempRoot root;
    std::string shot;

  private:
    void write_scene(const std::string& name, glm::vec3 floor) const {
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, floor)
            .box({-0.3f, 0, -0.3f}, {0.2f, 0.6f, 0.2f}, {0.4f, 0.5f, 0.8f})
            .quad({-0.8f, 0.01f, 0.6f}, {-0.5f, 0.01f, 0.6f}, {-0.5f, 0.3f, 0.5f}, {-0.8f, 0.3f, 0.5f})
            .emission({0.9f, 0.8f, 0.3f})
            .write(root.path(), name);
        std::string file = name + ".gltf";
        root.edit(file, "\"metallicFactor\":0.0,\"roughnessFactor\":1.0}",
                  "\"metallicFactor\":0.3,\"roughnessFactor\":0.4},\"alphaMode\":\"MASK\"");
    }
};

} // namespace bounce
