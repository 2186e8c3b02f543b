// Normal maps on quads whose nodes, pictures or tangents are mirrored, or whose tangents are made: the mapped normal of
// G-buffer, reflective shadow map and reference is n = x·T + y·B + z·N with T, B, N as glTF 2.0 has them.

#include "core/image.h"
#include "reference/render.h"
#include "scene/gltf_builder.h"
#include "support/scene_runner.h"

#include <cmath>
#include <fmt/format.h>

using namespace bounce;
using bounce::testing::GltfBuilder;
using nlohmann::json;

namespace {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr int k_texel[3] = {176, 204, 220}; // x to the right of the picture, y up in it

glm::dvec3 mapped() {
    return glm::normalize(glm::dvec3(k_texel[0], k_texel[1], k_texel[2]) / 127.5 - 1.0);
}

/// A quad of 4 × 4 m that faces +z, its picture upright.
struct QuadFile {
    std::vector<float> uv{0, 1, 1, 1, 1, 0, 0, 0};
    std::vector<float> tangents; ///< empty: they are to be made
    std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::vector<json> chain{json::object()}; ///< nodes from the root down

    Scene load() const {
        GltfBuilder b;
        Image8 texel{4, 4, {}};
        for (int i = 0; i < 16; ++i)
            texel.rgba.insert(texel.rgba.end(),
                              {uint8_t(k_texel[0]), uint8_t(k_texel[1]), uint8_t(k_texel[2]), uint8_t(255)});
        b.add("images", {{"uri", "data:image/png;base64," + bounce::testing::base64(encode_png(texel))}});
        b.add("textures", {{"source", 0}});
        b.add("materials",
              {{"normalTexture", {{"index", 0}}},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}});
        json attributes{{"POSITION", b.vec3s({-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2, 0})},
                        {"NORMAL", b.vec3s(normals)},
                        {"TEXCOORD_0", b.vec2s(uv)}};
        if (!tangents.empty()) attributes["TANGENT"] = b.vec4s(tangents);
        int indices = b.accessor_of<uint8_t>({0, 1, 2, 0, 2, 3}, bounce::testing::u8, "SCALAR", 1);
        int mesh = b.mesh({{"attributes", attributes}, {"indices", indices}, {"material", 0}});
        for (size_t i = 0; i < chain.size(); ++i) {
            json node = chain[i];
            if (i + 1 < chain.size())
                node["children"] = {i + 1};
            else
                node["mesh"] = mesh;
            b.node(node);
        }
        b.root["scenes"] = {{{"nodes", {0}}}};
        return b.load();
    }
};

std::vector<float> four_of(glm::vec4 v) {
    return {v.x, v.y, v.z, v.w, v.x, v.y, v.z, v.w, v.x, v.y, v.z, v.w, v.x, v.y, v.z, v.w};
}

struct Case {
    const char* name;
    QuadFile file;
    glm::dvec2 turn; ///< signs of the mapped normal's x and y in the world
};

json scaled(float x, float y, float z) {
    return {{"scale", {x, y, z}}};
}

std::vector<Case> cases() {
    std::vector<float> given = four_of({1, 0, 0, 1}), mirrored_uv{1, 1, 0, 1, 0, 0, 1, 0},
                       turned_uv{0, 0, 1, 0, 1, 1, 0, 1};
    json matrix{{"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
    auto file = [](std::vector<float> tangents, std::vector<json> chain = {json::object()}) {
        QuadFile out;
        out.tangents = std::move(tangents);
        out.chain = std::move(chain);
        return out;
    };
    auto with_uv = [&](QuadFile quad, const std::vector<float>& uv) {
        quad.uv = uv;
        return quad;
    };
    QuadFile zero_normals = file({}), bad_normals = file({}, {scaled(-1, 1, 1)});
    zero_normals.normals.assign(12, 0);
    bad_normals.normals.assign(12, k_nan);
    return {
        {"given", file(given), {1, 1}},
        {"generated", file({}), {1, 1}},
        {"given, mirrored node", file(given, {scaled(-1, 1, 1)}), {-1, 1}},
        {"generated, mirrored node", file({}, {scaled(-1, 1, 1)}), {-1, 1}},
        {"given, mirrored by a parent", file(given, {scaled(-1, 1, 1), scaled(2, 1, 1)}), {-1, 1}},
        {"generated, mirrored by a parent", file({}, {scaled(1, -3, 1), json::object()}), {1, -1}},
        {"given, mirrored by a matrix", file(given, {matrix}), {-1, 1}},
        {"two mirrorings cancel", file({}, {scaled(-1, 1, 1), scaled(-1, 1, 1)}), {1, 1}},
        {"two mirrorings turn", file(given, {scaled(-1, 1, 1), scaled(1, -1, 1)}), {-1, -1}},
        {"mirrored and tiny", file({}, {scaled(-1e-9f, 1e-9f, 1e-9f), scaled(1e9f, 1e9f, 1e9f)}), {-1, 1}},
        {"mirrored through a point",
         file({}, {scaled(-1, -1, -1)}),
         {1, 1}}, // the back is seen: turned toward the viewer
        {"mirrored picture", with_uv(file({}), mirrored_uv), {-1, 1}},
        {"mirrored picture, mirrored node", with_uv(file({}, {scaled(-1, 1, 1)}), mirrored_uv), {1, 1}},
        {"picture upside down", with_uv(file({}), turned_uv), {1, -1}},
        {"left-handed tangents given", file(four_of({1, 0, 0, -1})), {1, -1}},
        {"left-handed tangents given, mirrored node", file(four_of({1, 0, 0, -1}), {scaled(-1, 1, 1)}), {-1, -1}},
        {"handedness 0", file(four_of({1, 0, 0, 0})), {1, 1}},
        {"handedness no number", file(four_of({1, 0, 0, k_nan}), {scaled(-1, 1, 1)}), {-1, 1}},
        {"handedness 0, mirrored picture", with_uv(file(four_of({-1, 0, 0, 0})), mirrored_uv), {-1, 1}},
        {"tangents of length 0", file(four_of({0, 0, 0, 1})), {1, 1}},
        {"tangents that are no numbers", file(four_of({k_nan, 0, 0, 1})), {1, 1}},
        {"zero normals", zero_normals, {1, 1}},
        {"normals that are no numbers, mirrored node", bad_normals, {-1, 1}},
    };
}

class TangentFrame : public SceneGraphTest {
  protected:
    /// Normals in the middle of G-buffer, reflective shadow map and reference.
    struct Normals {
        glm::dvec3 gbuffer, rsm, reference;
        double direct, direct_by_reference;
    };
    Normals render(const Scene& scene, const Light& light) {
        Camera camera;
        camera.position = {0, 0, 5};
        camera.target = glm::vec3(0);
        camera.vfov = 0.3f;
        SceneRunner run(scene, {light},
                        graph_file(R"("resources":{"out.direct":{"format":"rgba32f"}},"passes":[{"type":"gbuffer"},
                            {"type":"rsm","params":{"resolution":32}},{"type":"shadow_maps","params":{"resolution":64}},
                            {"id":"direct","type":"compute","shader":"surface/direct.comp"}])"),
                        {}, {8, 8});
        run.camera = camera;
        run.frame();
        auto middle = [](const std::vector<float>& pixels, int width) {
            const float* p = &pixels[4 * size_t(width / 2 * width + width / 2)];
            return glm::dvec3(p[0], p[1], p[2]);
        };
        Shot shot;
        shot.scene = scene;
        shot.camera = camera;
        shot.width = shot.height = 8;
        shot.diffuse_only = true;
        Node lamp;
        lamp.light = 0;
        lamp.rotation = glm::quat(glm::vec3(0, 0, -1), light.direction);
        shot.scene.lights = {light};
        shot.scene.nodes.push_back(lamp);
        ReferenceSettings settings;
        settings.bounces = 0;
        ReferenceRender reference(shot, settings);
        reference.render_to(4);
        Image normal = reference.image().layers.at("gbuffer.normal"), direct = reference.part("out.direct");
        return {glm::normalize(middle(run.read("gbuffer.normal"), 8)),
                glm::normalize(middle(run.read("rsm.normal"), 32)),
                glm::dvec3(normal.at(4, 4)[0], normal.at(4, 4)[1], normal.at(4, 4)[2]),
                middle(run.read("out.direct"), 8).r, double(direct.at(4, 4)[0])};
    }
};

} // namespace

TEST_F(TangentFrame, MappedNormalsAreTheSpecifications) {
    Light light = directional_light({0.1f, -0.6f, -0.8f}, glm::vec3(1));
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.name);
        Normals got = render(c.file.load(), light);
        glm::dvec3 n = mapped() * glm::dvec3(c.turn, 1);
        EXPECT_NEAR(glm::distance(got.gbuffer, n), 0, 2e-3);
        EXPECT_NEAR(glm::distance(got.rsm, n), 0, 2e-3);
        EXPECT_NEAR(glm::distance(got.reference, n), 0, 1e-5);
        double expected = 0.5 / 3.14159265358979 * glm::dot(n, -glm::dvec3(light.direction));
        EXPECT_NEAR(got.direct / expected, 1, 2e-3);
        EXPECT_NEAR(got.direct_by_reference / expected, 1, 1e-4);
    }
}

TEST_F(TangentFrame, DegenerateCoordinatesGiveTheSameFrameToAll) {
    for (const std::vector<float>& uv : {std::vector<float>(8, 0.5f), {0, 0, 1, 1, 1, 1, 0, 0}}) {
        QuadFile file;
        file.uv = uv;
        Normals got = render(file.load(), directional_light({0, 0, -1}, glm::vec3(1)));
        EXPECT_NEAR(glm::distance(got.gbuffer, got.reference), 0, 2e-3);
        EXPECT_NEAR(glm::distance(got.rsm, got.reference), 0, 2e-3);
        EXPECT_NEAR(got.reference.z, mapped().z, 1e-5);
    }
}

TEST_F(TangentFrame, BackFaceCullingFollowsTheDeterminant) {
    // A quad that faces the camera in five guises, and one that turns its back.
    struct Twin {
        std::vector<json> chain;
        bool seen;
    };
    json back{{"rotation", {0, 1, 0, 0}}};
    const std::vector<Twin> twins = {{{json::object()}, true},
                                     {{scaled(-1, 1, 1)}, true},
                                     {{scaled(1, -2, 1), json::object()}, true},
                                     {{scaled(-1, 1, 1), scaled(1, -1, 1)}, true},
                                     {{scaled(-1, 1, 1), back}, false},
                                     {{back}, false},
                                     {{scaled(1, 1, -1)}, false},
                                     {{scaled(1, 1, -1), back}, true}};
    for (const Twin& twin : twins) {
        QuadFile file;
        file.chain = twin.chain;
        SCOPED_TRACE(json(twin.chain).dump());
        for (bool culls : {false, true}) {
            SceneRunner run(file.load(), {}, graph_file(R"("passes":[{"type":"gbuffer"}])"),
                            {{"gbuffer.cull_back_faces", culls ? "true" : "false"}}, {8, 8});
            run.camera.position = {0, 0, 5};
            run.camera.target = glm::vec3(0);
            run.frame();
            EXPECT_EQ(run.read("gbuffer.albedo")[4 * 36 + 3], !culls || twin.seen ? 1 : 0) << culls;
        }
    }
}

TEST_F(TangentFrame, CullingTurnsBetweenDrawsOfOnePicture) {
    // Twins side by side: mirrored, plain, mirrored, plain.
    GltfBuilder b;
    json attributes{{"POSITION", b.vec3s({0.2f, -1, 0, 0.8f, -1, 0, 0.8f, 1, 0, 0.2f, 1, 0})},
                    {"NORMAL", b.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})}};
    int indices = b.accessor_of<uint8_t>({0, 1, 2, 0, 2, 3}, bounce::testing::u8, "SCALAR", 1);
    int mesh = b.mesh({{"attributes", attributes}, {"indices", indices}});
    for (int i = 0; i < 4; ++i)
        b.node({{"mesh", mesh}, {"scale", {i % 2 ? 1 : -1, 1, 1}}, {"translation", {i < 2 ? -1 : 1, 0, 0}}});
    SceneRunner run(b.load(), {}, graph_file(R"("passes":[{"type":"gbuffer"}])"), {{"gbuffer.cull_back_faces", "true"}},
                    {64, 16});
    run.camera.position = {0, 0, 5};
    run.camera.target = glm::vec3(0);
    run.camera.vfov = 0.2f;
    run.frame();
    std::vector<float> albedo = run.read("gbuffer.albedo");
    // 4 m across: quads at −1.8 … −1.2, −0.8 … −0.2, 0.2 … 0.8, 1.2 … 1.8.
    double width = 2 * 5 * std::tan(0.1) * 4;
    for (double at : {-1.5, -0.5, 0.5, 1.5})
        EXPECT_EQ(albedo[4 * (8 * 64 + size_t(64 * (at / width + 0.5))) + 3], 1) << at;
    EXPECT_EQ(albedo[4 * (8 * 64 + 32) + 3], 0);
}
