// Materials, textures, lights, cameras and the node tree, against what was written.

#include "gltf_builder.h"

#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// 2×1 PNGs of known texels.
std::string png_uri(const TempFolder& folder, const std::vector<uint8_t>& rgba, int width, int height) {
    write_png(folder.path() / "made.png", Image8{width, height, rgba});
    return "data:image/png;base64," + base64(read_file(folder.path() / "made.png"));
}

TEST(Material, FactorsAndDefaults) {
    GltfBuilder b;
    b.add("materials", json::object());
    b.add("materials",
          {{"name", "paint"},
           {"pbrMetallicRoughness",
            {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.5}}},
           {"emissiveFactor", {1, 0.5, 0}},
           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 17}}}}},
           {"alphaMode", "MASK"},
           {"alphaCutoff", 0.3},
           {"doubleSided", true}});
    b.add("materials", {{"alphaMode", "BLEND"}, {"alphaCutoff", 0.9}});
    Scene scene = b.load();
    ASSERT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(scene.materials[0].base_colour, glm::vec4(1));
    EXPECT_EQ(scene.materials[0].metallic, 1);
    EXPECT_EQ(scene.materials[0].roughness, 1);
    EXPECT_FALSE(scene.materials[0].is_emissive());
    const Material& paint = scene.materials[1];
    EXPECT_EQ(paint.name, "paint");
    EXPECT_EQ(paint.base_colour, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(paint.metallic, 0.25f);
    EXPECT_EQ(paint.roughness, 0.5f);
    EXPECT_EQ(paint.emission, glm::vec3(17, 8.5f, 0));
    EXPECT_EQ(paint.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(paint.alpha_cutoff, 0.3f);
    EXPECT_TRUE(paint.double_sided);
    EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(scene.materials[2].alpha_mode, AlphaMode::blend);
    EXPECT_THAT(scene.notes, IsEmpty());
}

TEST(Material, TexturesWithSamplersAndTransforms) {
    TempFolder folder;
    GltfBuilder b;
    b.add("images", {{"uri", png_uri(folder, {255, 0, 0, 255, 0, 255, 0, 128}, 2, 1)}});
    b.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
    b.add("textures", {{"source", 0}, {"sampler", 0}});
    b.add("textures", {{"source", 0}});
    json transform{{"offset", {0.5, 0.25}}, {"rotation", 0.1}, {"scale", {2, 3}}, {"texCoord", 1}};
    b.add("materials", {{"pbrMetallicRoughness",
                         {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}},
                          {"metallicRoughnessTexture", {{"index", 0}}}}},
                        {"emissiveTexture", {{"index", 1}, {"texCoord", 1}}},
                        {"normalTexture", {{"index", 1}, {"scale", 0.5}, {"texCoord", 7}}}});
    Scene scene = b.load();
    const Material& m = scene.materials[0];
    // Colour and data uses of one picture are different textures: one is decoded from sRGB, the other is not.
    ASSERT_EQ(scene.textures.size(), 4u);
    const Texture& base = scene.textures[size_t(m.base_colour_texture.texture)];
    EXPECT_TRUE(base.srgb);
    EXPECT_EQ(base.wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(base.wrap_v, Wrap::mirrored_repeat);
    EXPECT_TRUE(base.nearest);
    EXPECT_EQ(base.image.rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 255, 0, 128}));
    EXPECT_FALSE(scene.textures[size_t(m.metallic_roughness_texture.texture)].srgb);
    EXPECT_TRUE(scene.textures[size_t(m.emission_texture.texture)].srgb);
    EXPECT_EQ(scene.textures[size_t(m.emission_texture.texture)].wrap_u, Wrap::repeat);
    EXPECT_EQ(m.base_colour_texture.uv_set, 1);
    EXPECT_EQ(m.base_colour_texture.offset, glm::vec2(0.5f, 0.25f));
    EXPECT_EQ(m.base_colour_texture.scale, glm::vec2(2, 3));
    EXPECT_EQ(m.base_colour_texture.rotation, 0.1f);
    EXPECT_EQ(m.metallic_roughness_texture.uv_set, 0);
    EXPECT_EQ(m.emission_texture.uv_set, 1);
    EXPECT_EQ(m.normal_scale, 0.5f);
    EXPECT_EQ(m.normal_texture.uv_set, 0);
    EXPECT_THAT(scene.notes, Contains(HasSubstr("TEXCOORD_2 or above")));
}

TEST(Material, PictureInABufferView) {
    TempFolder folder;
    write_png(folder.path() / "a.png", Image8{1, 1, {1, 2, 3, 4}});
    GltfBuilder b;
    b.add("images", {{"bufferView", b.view(read_file(folder.path() / "a.png"))}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    Scene scene = b.load();
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].image.rgba, (std::vector<uint8_t>{1, 2, 3, 4}));
}

TEST(Material, UndecodablePictureReadsAsWhiteAndSaysSo) {
    TempFolder folder;
    GltfBuilder b;
    b.add("images", {{"uri", "data:image/png;base64,AAAA"}});
    b.add("images", {{"uri", png_uri(folder, {9, 9, 9, 9}, 1, 1)}});
    b.add("images", {{"uri", "data:image/png;base64,!!!!"}});
    b.add("textures", {{"source", 0}});
    b.add("textures", {{"source", 1}});
    b.add("textures", {{"source", 2}});
    b.add("textures", json::object());
    b.add("materials", {{"pbrMetallicRoughness",
                         {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 3}}}}},
                        {"emissiveTexture", {{"index", 1}}},
                        {"normalTexture", {{"index", 2}}}});
    Scene scene = b.load();
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials[0].base_colour_texture.texture, -1);
    EXPECT_EQ(scene.materials[0].metallic_roughness_texture.texture, -1);
    EXPECT_EQ(scene.materials[0].normal_texture.texture, -1);
    EXPECT_EQ(scene.materials[0].emission_texture.texture, 0);
    EXPECT_EQ(scene.notes.size(), 3u);
}

TEST(Material, MissingPictureFileIsAnErrorThatNamesIt) {
    GltfBuilder b;
    b.add("images", {{"uri", "not%20there.png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    EXPECT_THAT(load_error(b.text()), HasSubstr("not there.png"));
}

TEST(Nodes, LightsLookAlongMinusZ) {
    GltfBuilder b;
    b.root["extensionsUsed"] = {"KHR_lights_punctual"};
    json lights = {{{"type", "point"}, {"intensity", 5}, {"color", {1, 0.5, 0.25}}, {"range", 3}},
                   {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
                   {{"type", "spot"}},
                   {{"type", "directional"}, {"intensity", 2}}};
    b.root["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    auto light = [](int i) { return json{{"KHR_lights_punctual", {{"light", i}}}}; };
    // Turned by −90° about x, −z becomes −y. A parent's scale moves a light but does not brighten it.
    float half = std::sqrt(0.5f);
    b.node({{"extensions", light(0)}, {"translation", {1, 2, 3}}});
    b.node({{"extensions", light(1)}, {"rotation", {-half, 0, 0, half}}, {"translation", {0, 1, 0}}});
    b.node({{"extensions", light(2)}});
    b.node({{"extensions", light(3)}});
    b.node({{"children", {0, 1, 2, 3}}, {"scale", {2, 2, 2}}});
    Scene scene = b.load();
    SceneState state = evaluate_scene(scene, 0, 0);
    ASSERT_EQ(state.lights.size(), 4u);
    EXPECT_EQ(state.lights[0].type, LightType::point);
    EXPECT_EQ(state.lights[0].position, glm::vec3(2, 4, 6));
    EXPECT_EQ(state.lights[0].intensity, glm::vec3(5, 2.5f, 1.25f));
    EXPECT_EQ(state.lights[1].type, LightType::spot);
    EXPECT_NEAR(glm::distance(state.lights[1].direction, glm::vec3(0, -1, 0)), 0, 1e-6);
    EXPECT_FLOAT_EQ(state.lights[1].inner_cone, 0.1f);
    EXPECT_FLOAT_EQ(state.lights[1].outer_cone, 0.5f);
    EXPECT_FLOAT_EQ(state.lights[2].outer_cone, 0.78539816f);
    EXPECT_EQ(state.lights[3].type, LightType::directional);
    EXPECT_EQ(state.lights[3].direction, glm::vec3(0, 0, -1));
    EXPECT_THAT(scene.notes, Contains(HasSubstr("range of 1 light")));

    scene.lights[0].enabled = false;
    EXPECT_EQ(evaluate_scene(scene, 0, 0).lights.size(), 3u);
}

TEST(Nodes, TransformsMultiplyDownTheTree) {
    GltfBuilder b;
    b.triangle(json::object(), {{"translation", {1, 0, 0}}});
    float half = std::sqrt(0.5f);
    b.node({{"children", {0}}, {"rotation", {0, 0, half, half}}}); // +90° about z
    b.node({{"children", {1}}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1}}});
    Scene scene = b.load();
    SceneState state = evaluate_scene(scene, 0, 0);
    ASSERT_EQ(state.instances.size(), 1u);
    for (size_t i = 0; i < scene.nodes.size(); ++i)
        EXPECT_LT(scene.nodes[i].parent, int(i));
    // (1,0,0) → (2,0,0) → (0,2,0) → (10,24,30)
    glm::vec3 p = glm::vec3(state.instances[0].world * glm::vec4(1, 0, 0, 1));
    EXPECT_NEAR(glm::distance(p, glm::vec3(10, 24, 30)), 0, 1e-5);
    Bounds bounds = scene_bounds(scene, 0);
    EXPECT_NEAR(glm::distance(bounds.min, glm::vec3(8, 22, 30)), 0, 1e-5);
    EXPECT_NEAR(glm::distance(bounds.max, glm::vec3(10, 24, 30)), 0, 1e-5);
}

TEST(Nodes, OnlyTheChosenSceneIsRead) {
    GltfBuilder b;
    b.triangle();
    b.triangle();
    b.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    b.root["scene"] = 1;
    Scene scene = b.load();
    EXPECT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.nodes[0].mesh, 1);
    EXPECT_THAT(scene.notes, Contains(HasSubstr("2 scenes")));
    EXPECT_THAT(scene.notes, Contains(HasSubstr("1 node outside")));
}

TEST(Nodes, Cameras) {
    GltfBuilder b;
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
    b.add("cameras",
          {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 0}}}});
    float half = std::sqrt(0.5f);
    b.node({{"camera", 0}, {"translation", {0, 0, 7}}, {"rotation", {0, half, 0, half}}});
    b.node({{"camera", 1}});
    Scene scene = b.load();
    SceneState state = evaluate_scene(scene, 0, 0);
    ASSERT_EQ(state.cameras.size(), 2u);
    EXPECT_EQ(state.cameras[0].vfov, 0.5f);
    EXPECT_EQ(state.cameras[0].near_plane, 0.1f);
    EXPECT_EQ(state.cameras[1].near_plane, 0); // that of an orthographic camera says nothing about a perspective one
    EXPECT_EQ(state.cameras[0].position, glm::vec3(0, 0, 7));
    EXPECT_NEAR(glm::distance(state.cameras[0].target, glm::vec3(-1, 0, 7)), 0, 1e-6);
    EXPECT_THAT(scene.notes, Contains(HasSubstr("orthographic")));
}

TEST(Nodes, ADeepChainIsNoProblem) {
    GltfBuilder b;
    b.triangle();
    for (int i = 1; i < 20000; ++i)
        b.node({{"children", {i - 1}}, {"translation", {1, 0, 0}}});
    Scene scene = b.load();
    EXPECT_EQ(scene.nodes.size(), 20000u);
    EXPECT_NEAR(scene_bounds(scene, 0).min.x, 19999, 0.01);
}

TEST(Notes, EverythingSkippedIsListed) {
    GltfBuilder b;
    b.root["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_lights_punctual"};
    b.triangle({{"targets", {{{"POSITION", 0}}}}}, {{"skin", 0}});
    b.root["skins"] = {{{"joints", {0}}}};
    b.add("images", {{"uri", "unused_and_absent.png"}});
    Scene scene = b.load();
    EXPECT_THAT(scene.notes, Contains(HasSubstr("KHR_materials_clearcoat")));
    EXPECT_THAT(scene.notes, Contains(HasSubstr("morph targets are not supported")));
    EXPECT_THAT(scene.notes, Contains(HasSubstr("skinning is not supported")));
}

TEST(Notes, MaterialsThatLoseAnExtensionAreCounted) {
    GltfBuilder b;
    b.root["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_sheen"};
    const json ior{{"KHR_materials_ior", {{"ior", 1.3}}}};
    b.add("materials", {{"extensions", {{"KHR_materials_unlit", json::object()}}}});
    b.add("materials", {{"extensions", ior}});
    b.add("materials", {{"extensions", ior}});
    b.add("materials", {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"glossinessFactor", 0.5}}}}}});
    b.add("materials", {{"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}});
    b.add("materials", {{"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}}}}});
    EXPECT_THAT(
        b.load().notes,
        ::testing::UnorderedElementsAre(
            "extension KHR_materials_unlit is ignored: 1 material shaded by the light that falls on it, not shown as "
            "painted",
            "extension KHR_materials_ior is ignored: 2 materials with the index of refraction 1.5 (F0 = 0.04)",
            "extension KHR_materials_pbrSpecularGlossiness is ignored: 1 material with its metallic-roughness values "
            "only (white metal of roughness 1 if it has none)",
            "extension KHR_materials_specular is ignored: 1 material with the whole, white specular reflection of the "
            "index of refraction 1.5",
            "extension KHR_materials_sheen is ignored"));
}

TEST(Material, AlphaModesAndCutoffs) {
    GltfBuilder b;
    b.add("materials", {{"alphaMode", "MASK"}});
    b.add("materials", {{"alphaMode", "MASK"}, {"alphaCutoff", 0}});
    b.add("materials", {{"alphaMode", "MASK"}, {"alphaCutoff", 1.5}});
    b.add("materials", {{"alphaMode", "OPAQUE"}, {"alphaCutoff", 0.2}});
    b.add("materials", {{"alphaMode", "BLEND"}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.materials[0].alpha_cutoff, 0.5f);
    EXPECT_EQ(scene.materials[1].alpha_cutoff, 0);
    EXPECT_EQ(scene.materials[2].alpha_cutoff, 1.5f);
    EXPECT_EQ(scene.materials[1].alpha_mode, AlphaMode::mask);
    EXPECT_EQ(scene.materials[3].alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(scene.materials[4].alpha_mode, AlphaMode::blend);
}

} // namespace
} // namespace bounce::testing
