#pragma once
// Layered reflective shadow maps made by hand: one view, 3 × 2 layers of 16 × 16 texels whose values a test's own
// shader writes; and a test shader that includes lrsm/sample.glsl and writes one vec4 a sample. The layers are read
// back, so a test knows exactly what was sampled.

#include "lrsm/layers_oracle.h"

#include <fmt/format.h>
#include <memory>

namespace bounce {

inline constexpr int k_hand_made_size = 16, k_hand_made_mips = 5;
inline constexpr int k_hand_made_depths = 3, k_hand_made_normals = 2;

class HandMadeTest : public SceneGraphTest {
  protected:
    /// A view from the origin along +z over ±45°, or an orthographic one of ±2 m.
    static std::string view_code(bool orthographic) {
        return orthographic
                   ? R"(ShadowView(mat4(0.5,0,0,0, 0,0.5,0,0, 0,0,-0.1,0, 0,0,1,1), vec3(0), 0.01, vec3(0,0,1), 10.0,
                                 0.125, 1, 0, 0))"
                   : R"(ShadowView(mat4(1,0,0,0, 0,1,0,0, 0,0,0,1, 0,0,0.01,0), vec3(0), 0.01, vec3(0,0,1), 0.0,
                                 0.0625, 1, 0, 0))"; // a map of 32 texels: the layers' mip 0 is its mip 1
    }

    /// `body` sets vec4 result for sample i; `layers` sets radiance, normal, depth for texel p of `layer` and `mip`.
    std::unique_ptr<SceneRunner> make(int count, const std::string& body, const std::string& layers, bool orthographic,
                                      const std::vector<std::pair<std::string, std::string>>& sets = {}) {
        shader("test/hand_made.comp", fmt::format(R"(#include "lib/shadow.glsl"
#include "lrsm/partition.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_made_radiance) writeonly uniform image2DArray made_radiance;
layout(FORMAT_made_normal) writeonly uniform image2DArray made_normal;
layout(FORMAT_made_depth) writeonly uniform image2DArray made_depth;
layout(std430) writeonly buffer rsm_views {{ ShadowView views[]; }};
layout(std430) writeonly buffer lrsm_partitions {{ Partition partitions[]; }};
layout(std430) writeonly buffer lrsm_table {{ int table[]; }};
uniform int iteration;
void main() {{
    ivec3 p = ivec3(gl_GlobalInvocationID), size = imageSize(made_radiance);
    if (any(greaterThanEqual(p, size))) return;
    int layer = p.z, mip = iteration;
    vec2 uv = (vec2(p.xy) + 0.5) / vec2(size.xy);
    vec4 radiance = vec4(0.0), normal = vec4(0.0), depth = vec4(0.0);
    {}
    imageStore(made_radiance, p, radiance);
    imageStore(made_normal, p, normal);
    imageStore(made_depth, p, depth);
    if (p != ivec3(0) || mip != 0) return;
    views[0] = {};
    Partition q;
    q.depth = float[9](1.0, 2.0, 4.0, 7.0, 7.0, 7.0, 7.0, 7.0, 7.0);
    q.normal = float[5](0.0, 0.5, 1.0, 1.0, 1.0);
    q.overlap = 0.4;
    q.depth_layers = 3;
    partitions[0] = q;
    for (int d = 0; d < 8; ++d)
        for (int n = 0; n < 4; ++n) // stored back to front, so that places and layers differ; layer (1, 1) is empty
            table[table_index(0, d, n)] = d < 3 && n < 2 && !(d == 1 && n == 1) ? 5 - (2 * d + n) : -1;
}}
)",
                                                  layers, view_code(orthographic)));
        shader("test/sample.comp", fmt::format(R"(#include "lrsm/sample.glsl"
layout(local_size_x = 64) in;
layout(FORMAT_test_result) writeonly uniform image2D test_result;
void main() {{
    int i = int(gl_GlobalInvocationID.x);
    if (i >= imageSize(test_result).x) return;
    vec4 result = vec4(0.0);
    {}
    imageStore(test_result, ivec2(i, 0), result);
}}
)",
                                               body));
        auto texture = [](const char* name, const char* format) {
            return fmt::format(R"("{}":{{"kind":"texture_2d_array","format":"{}","size":[16,16,6],"mips":5}},)", name,
                               format);
        };
        std::string file = fmt::format(
            R"("resources":{{{}{}{}"rsm.views":{{"kind":"buffer","count":1,"stride":112}},
                "lrsm.partitions":{{"kind":"buffer","count":1,"stride":64}},"lrsm.table":{{"kind":"buffer","count":32,"stride":4}},
                "lrsm.normal_table":{{"format":"r32f","size":[256,1]}},"test.result":{{"format":"rgba32f","size":[{},1]}}}},
              "passes":[{{"id":"hand_made","type":"compute","shader":"test/hand_made.comp","dispatch":"made.radiance",
                "bind":{{"made.radiance":{{"resource":"lrsm.radiance","mip":"iteration"}},
                         "made.normal":{{"resource":"lrsm.normal","mip":"iteration"}},
                         "made.depth":{{"resource":"lrsm.depth","mip":"iteration"}}}},
                "repeat":{{"over":"mips","of":"lrsm.radiance"}}}},
               {{"id":"normal_table","type":"compute","shader":"lrsm/normal_table.comp"}},
               {{"id":"sample","type":"compute","shader":"test/sample.comp"}}])",
            texture("lrsm.radiance", "rgba16f"), texture("lrsm.normal", "rgba16f"), texture("lrsm.depth", "rgba16"),
            count);
        auto run = std::make_unique<SceneRunner>(MadeScene().triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 1}).scene,
                                                 std::vector<Light>{}, graph_file(file), sets);
        run->frame();
        return run;
    }
    static std::vector<glm::dvec4> results(const SceneRunner& run) {
        std::vector<float> got = run.read("test.result");
        std::vector<glm::dvec4> out;
        for (size_t i = 0; i < got.size(); i += 4)
            out.emplace_back(got[i], got[i + 1], got[i + 2], got[i + 3]);
        return out;
    }
};

} // namespace bounce
