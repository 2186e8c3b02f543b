// Shot files: every key, every error with its neighbours, and what is filled in.

#include "gltf_builder.h"
#include "scene/describe.h"
#include "scene/find_scene.h"

#include <cstdlib>
#include <gmock/gmock.h>

namespace bounce::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A folder with a triangle scene, into which shots are written.
class ShotTest : public ::testing::Test {
  protected:
    ShotTest() {
        GltfBuilder b;
        b.triangle();
        folder.write("triangle.gltf", b.text());
        GltfBuilder lit;
        lit.triangle();
        lit.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 3}}};
        lit.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0, 5, 0}}});
        folder.write("sub/lit.gltf", lit.text());
    }
    Shot load(const json& shot) { return load_shot(folder.write("shot.json", shot.dump()).string()); }
    std::string error_of(const std::string& text) {
        try {
            load_shot(folder.write("shot.json", text).string());
        } catch (const Error& problem) {
            return problem.what();
        }
        ADD_FAILURE() << "loaded, but an Error was expected";
        return "";
    }
    std::string error(const json& shot) { return error_of(shot.dump()); }

    TempFolder folder;
};

TEST_F(ShotTest, EveryKey) {
    Shot shot =
        load({{"about", "all of it"},
              {"scene", "triangle.gltf"},
              {"width", 64},
              {"height", 48},
              {"camera", {{"position", {0, 0, 4}}, {"target", {0, 1, 0}}, {"up", {1, 0, 0}}, {"vfov_deg", 90}}},
              {"time", 2.5},
              {"fps", 10},
              {"diffuse_only", true},
              {"normal_maps", false},
              {"environment", {0.1, 0.2, 0.3}},
              {"lights",
               {{{"type", "spot"},
                 {"name", "lamp"},
                 {"position", {0, 2, 0}},
                 {"direction", {0, -3, 0}},
                 {"intensity", {1, 2, 3}},
                 {"inner_cone_deg", 10},
                 {"outer_cone_deg", 60},
                 {"radius", 0.1}},
                {{"type", "directional"}, {"target", {1, 0, 0}}, {"intensity", 4}, {"angular_radius_deg", 0.25}},
                {{"type", "point"}, {"position", {1, 1, 1}}, {"enabled", false}}}}});
    EXPECT_EQ(shot.name, "shot");
    EXPECT_EQ(shot.width, 64);
    EXPECT_EQ(shot.height, 48);
    EXPECT_EQ(shot.camera.position, glm::vec3(0, 0, 4));
    EXPECT_EQ(shot.camera.target, glm::vec3(0, 1, 0));
    EXPECT_EQ(shot.camera.up, glm::vec3(1, 0, 0));
    EXPECT_FLOAT_EQ(shot.camera.vfov, glm::radians(90.0f));
    EXPECT_TRUE(shot.diffuse_only);
    EXPECT_FALSE(shot.normal_maps);
    EXPECT_EQ(shot.environment.radiance, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_FLOAT_EQ(shot.time_at(5), 3.0f);
    EXPECT_EQ(shot.light_paths.size(), 3u);

    ShotState state = evaluate_shot(shot, 5);
    EXPECT_FLOAT_EQ(state.time, 3);
    ASSERT_EQ(state.scene.lights.size(), 2u);
    const Light& lamp = state.scene.lights[0];
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.position, glm::vec3(0, 2, 0));
    EXPECT_NEAR(glm::distance(lamp.direction, glm::vec3(0, -1, 0)), 0, 1e-6);
    EXPECT_EQ(lamp.intensity, glm::vec3(1, 2, 3));
    EXPECT_FLOAT_EQ(lamp.inner_cone, glm::radians(10.0f));
    EXPECT_FLOAT_EQ(lamp.outer_cone, glm::radians(60.0f));
    EXPECT_EQ(lamp.radius, 0.1f);
    EXPECT_NEAR(glm::distance(state.scene.lights[1].direction, glm::vec3(1, 0, 0)), 0, 1e-6);
    EXPECT_EQ(state.scene.lights[1].intensity, glm::vec3(4));
    EXPECT_FLOAT_EQ(state.scene.lights[1].angular_radius, glm::radians(0.25f));

    SceneFacts facts = shot_facts(shot);
    EXPECT_EQ(facts.spot_lights, 1u);
    EXPECT_EQ(facts.point_lights, 0u);
    EXPECT_EQ(facts.lights(), 2u);
    EXPECT_TRUE(facts.environment);
}

TEST_F(ShotTest, AllErrorsAreToldTogether) {
    std::string text = error_of(R"({
        "scene": "trangle.gltf", "widht": 64, "height": 0, "fps": "fast", "diffuse_only": 1,
        "camera": {"position": [0, 0], "target": [0, 0, 0], "vfov_degre": 40},
        "lights": [{"type": "spit", "position": [0, 0, 0]},
                   {"type": "spot", "position": [0, 0, 0], "direction": [0, -1, 0], "inner_cone_deg": 50, "outer_cone_deg": 40},
                   {"type": "directional", "direction": [0, 0, 0], "intensity": -1}],
        "lights_mode": "replce",
        "objects": [{"scene": "nowhere", "scale": 0, "rotation": [1]}],
        "environment": "gone.hdr",
        "camera_path": [{"t": 1, "position": [0, 0, 0]}, {"t": 1, "position": [0, 0, 1], "target": [0, 0, 0]}]})");
    for (const char* part :
         {"trangle.gltf", "unknown key 'widht' (did you mean 'width'?)",
          "height must be a whole number from 1 to 16384", "fps must be a number", "diffuse_only must be true or false",
          "camera.position must be an array of 3 numbers", "unknown key 'camera.vfov_degre' (did you mean 'vfov_deg'?)",
          "lights[0].type is 'spit'", "did you mean 'spot'?",
          "lights[1].inner_cone_deg (50) must be less than outer_cone_deg (40)",
          "lights[2].direction gives no direction", "lights[2].intensity must be", "lights_mode is 'replce'",
          "objects[0].scene: no scene 'nowhere'", "objects[0].scale must be", "objects[0].rotation must be", "gone.hdr",
          "camera_path: t must increase", "camera_path: either all keys have a target, or none"})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST_F(ShotTest, OtherErrors) {
    EXPECT_THAT(error_of(std::string("{\"scene\": ")), HasSubstr("not valid JSON"));
    EXPECT_THAT(error_of(std::string("[1]")), HasSubstr("the file must be an object, but is an array of 1"));
    EXPECT_THAT(error(json{{"width", 5}}), HasSubstr("scene is missing"));
    EXPECT_THAT(error(json{{"scene", "triangle.gltf"}, {"lights", {{{"type", "point"}}}}}),
                HasSubstr("lights[0].position is missing"));
    EXPECT_THAT(error(json{{"scene", "triangle.gltf"}, {"lights", {{{"type", "spot"}, {"position", {0, 0, 0}}}}}}),
                HasSubstr("lights[0].direction is missing"));
    EXPECT_THAT(error(json{{"scene", "triangle.gltf"}, {"lights", 3}}), HasSubstr("lights must be an array"));
    EXPECT_THAT(error(json{{"scene", "triangle.gltf"}, {"camera", {{"position", {1, 2, 3}}}}}),
                HasSubstr("camera.target is missing"));
    EXPECT_THAT(error(json{{"scene", "triangle.gltf"}, {"camera", {{"position", {1, 2, 3}}, {"target", {1, 2, 3}}}}}),
                HasSubstr("camera.target is the camera's position"));
    EXPECT_THAT(error(json{{"scene", "triangle.gltf"}, {"environment", -1}}), HasSubstr("environment must be"));
    EXPECT_THAT(error(json{{"scene", "triangle.gltf"}, {"environment", {{"scale", 2}}}}), HasSubstr("must have a map"));
    EXPECT_THAT(error(json{{"scene", "triangle.gltf"}, {"camera_path", {{{"t", 0}, {"position", {0, 0, 1}}}}}}),
                HasSubstr("camera_path has no targets"));
    EXPECT_THROW(load_shot("surely_no_shot_of_this_name"), Error);
    EXPECT_THROW(load_shot(""), Error);
    EXPECT_THROW(load_shot(folder.write("a.txt", "hello").string()), Error);
}

TEST_F(ShotTest, LightsModes) {
    json own = {{{"type", "directional"}, {"direction", {0, -1, 0}}}};
    auto types = [&](const json& shot) {
        std::vector<LightType> out;
        for (const Light& light : evaluate_shot(load(shot), 0).scene.lights)
            out.push_back(light.type);
        return out;
    };
    using T = std::vector<LightType>;
    EXPECT_EQ(types({{"scene", "sub/lit.gltf"}}), T{LightType::point});
    EXPECT_EQ(types({{"scene", "sub/lit.gltf"}, {"lights", own}}), T{LightType::directional});
    EXPECT_EQ(types({{"scene", "sub/lit.gltf"}, {"lights", own}, {"lights_mode", "add"}}),
              (T{LightType::point, LightType::directional}));
    EXPECT_EQ(types({{"scene", "sub/lit.gltf"}, {"lights_mode", "replace"}}), T{});
    EXPECT_EQ(types({{"scene", "sub/lit.gltf"}, {"lights", json::array()}}), T{LightType::point});
}

TEST_F(ShotTest, Objects) {
    json path = {{{"t", 0}, {"position", {0, 0, 0}}}, {{"t", 2}, {"position", {4, 0, 0}}}};
    Shot shot =
        load({{"scene", "triangle.gltf"},
              {"fps", 1},
              {"objects",
               {{{"scene", "sub/lit.gltf"}, {"position", {10, 0, 0}}, {"rotation", {0, 0, 90}}, {"scale", 2}},
                {{"scene", "sub/lit.gltf"}, {"rotation", {0, 0, 0, 2}}, {"scale", {1, 2, 3}}, {"path", path}}}}});
    EXPECT_EQ(shot.scene.vertices.size(), 6u); // a file placed twice is held once
    ShotState state = evaluate_shot(shot, 1);
    ASSERT_EQ(state.scene.instances.size(), 3u);
    EXPECT_FALSE(state.scene.instances[1].dynamic);
    EXPECT_TRUE(state.scene.instances[2].dynamic);
    auto corner = [&](size_t i) { return glm::vec3(state.scene.instances[i].world * glm::vec4(1, 1, 1, 1)); };
    EXPECT_NEAR(glm::distance(corner(1), glm::vec3(8, 2, 2)), 0, 1e-5);
    EXPECT_NEAR(glm::distance(corner(2), glm::vec3(3, 2, 3)), 0, 1e-5);
    EXPECT_FLOAT_EQ(state.scene.instances[2].previous_world[3].x, 0);
    ASSERT_EQ(state.scene.lights.size(), 2u); // those of the placed files
    EXPECT_NEAR(glm::distance(state.scene.lights[0].position, glm::vec3(0, 0, 0)), 0, 1e-5);
    SceneFacts facts = shot_facts(shot);
    EXPECT_EQ(facts.triangles, 3u);
    EXPECT_EQ(facts.dynamic_instances, 1u);
    EXPECT_TRUE(facts.animated_lights);
    EXPECT_EQ(facts.animation_duration, 2);
    EXPECT_FLOAT_EQ(facts.bounds_over_animation.max.x, 10);
}

TEST_F(ShotTest, PlacedMaterialsAndTexturesKeepTheirOwn) {
    GltfBuilder b;
    write_png(folder.path() / "red.png", Image8{1, 1, {255, 0, 0, 255}});
    b.add("images", {{"uri", "red.png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials", {{"name", "plain"}});
    b.add("materials", {{"name", "red"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    b.triangle({{"material", 1}});
    folder.write("red.gltf", b.text());
    Shot shot = load({{"scene", "red.gltf"}, {"objects", {{{"scene", "triangle.gltf"}}, {{"scene", "sub/lit.gltf"}}}}});
    ShotState state = evaluate_shot(shot, 0);
    ASSERT_EQ(state.scene.instances.size(), 3u);
    EXPECT_EQ(shot.scene.materials[size_t(state.scene.instances[0].primitive.material)].name, "red");
    EXPECT_EQ(shot.scene.materials[size_t(state.scene.instances[1].primitive.material)].name, "default");

    Shot other = load({{"scene", "triangle.gltf"}, {"objects", {{{"scene", "red.gltf"}}, {{"scene", "red.gltf"}}}}});
    state = evaluate_shot(other, 0);
    const Material& red = other.scene.materials[size_t(state.scene.instances[2].primitive.material)];
    EXPECT_EQ(red.name, "red");
    ASSERT_EQ(other.scene.textures.size(), 1u);
    EXPECT_EQ(red.base_colour_texture.texture, 0);
    for (const Instance& instance : state.scene.instances)
        for (uint32_t i = 0; i < 3; ++i)
            EXPECT_LT(other.scene.indices[instance.primitive.first_index + i], other.scene.vertices.size());
}

TEST_F(ShotTest, LightsOnPaths) {
    json path = {{{"t", 0}, {"position", {0, 4, 0}}, {"target", {0, 0, 0}}},
                 {{"t", 1}, {"position", {4, 4, 0}}, {"target", {4, 4, -1}}}};
    Shot shot = load({{"scene", "triangle.gltf"}, {"fps", 2}, {"lights", {{{"type", "spot"}, {"path", path}}}}});
    EXPECT_EQ(shot.light_paths[0].keys.size(), 2u);
    Light start = evaluate_shot(shot, 0).scene.lights[0], middle = evaluate_shot(shot, 1).scene.lights[0];
    Light end = evaluate_shot(shot, 50).scene.lights[0];
    EXPECT_NEAR(glm::distance(start.direction, glm::vec3(0, -1, 0)), 0, 1e-6);
    EXPECT_EQ(middle.position, glm::vec3(2, 4, 0));
    EXPECT_NEAR(glm::distance(middle.direction, glm::normalize(glm::vec3(0, -2, -0.5f))), 0, 1e-6);
    EXPECT_NEAR(glm::distance(end.direction, glm::vec3(0, 0, -1)), 0, 1e-6);
    EXPECT_TRUE(shot_facts(shot).animated_lights);
}

TEST_F(ShotTest, CameraPaths) {
    json camera{{"position", {0, 0, 5}}, {"target", {0, 0, 3}}};
    json path = {{{"t", 0}, {"position", {0, 0, 0}}}, {{"t", 1}, {"position", {2, 0, 0}}}};
    Shot keeps = load({{"scene", "triangle.gltf"}, {"fps", 2}, {"camera", camera}, {"camera_path", path}});
    Camera moved = evaluate_shot(keeps, 1).camera;
    EXPECT_EQ(moved.position, glm::vec3(1, 0, 0));
    EXPECT_EQ(moved.target, glm::vec3(1, 0, -2));
    for (json& key : path)
        key["target"] = {0, 7, 0};
    Camera aimed = evaluate_shot(load({{"scene", "triangle.gltf"}, {"fps", 2}, {"camera_path", path}}), 1).camera;
    EXPECT_EQ(aimed.target, glm::vec3(0, 7, 0));
}

TEST_F(ShotTest, CameraOfTheFile) {
    GltfBuilder b;
    b.triangle();
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
    b.node({{"camera", 0}, {"translation", {0.5, 0.5, 3}}});
    folder.write("seen.gltf", b.text());
    Shot shot = load({{"scene", "seen.gltf"}});
    EXPECT_EQ(shot.camera.position, glm::vec3(0.5f, 0.5f, 3));
    EXPECT_EQ(shot.camera.vfov, 0.5f);
    EXPECT_NEAR(glm::distance(shot.camera.target, glm::vec3(0.5f, 0.5f, 0)), 0, 1e-5);
}

TEST_F(ShotTest, CameraJsonReadsBackExactly) {
    Camera camera;
    camera.position = {0.1f, -2.7182817f, 1e-7f};
    camera.target = {1.0f / 3, 100000.7f, 0};
    camera.up = {0, 0, 1};
    camera.vfov = glm::radians(47.3f);
    camera.near_plane = 0.3f;
    std::string text = camera_json(camera, {});
    EXPECT_THAT(text, HasSubstr("0.1,"));
    Shot shot = load({{"scene", "triangle.gltf"}, {"camera", json::parse(text)}});
    EXPECT_EQ(shot.camera.position, camera.position);
    EXPECT_EQ(shot.camera.target, camera.target);
    EXPECT_EQ(shot.camera.up, camera.up);
    EXPECT_FLOAT_EQ(shot.camera.vfov, camera.vfov);
    EXPECT_EQ(shot.camera.near_plane, camera.near_plane);
}

TEST_F(ShotTest, PlainScenesGetALightAndAView) {
    Shot shot = load_shot((folder.path() / "triangle.gltf").string());
    EXPECT_EQ(shot.name, "triangle");
    EXPECT_EQ(evaluate_shot(shot, 0).scene.lights.size(), 1u);
    EXPECT_TRUE(shot.environment.present());
    EXPECT_THAT(shot.scene.notes, Contains(HasSubstr("no light")));
    EXPECT_THAT(shot.scene.notes, Contains(HasSubstr("a default view was chosen")));
    // All of the triangle is in view.
    glm::vec3 forward = glm::normalize(shot.camera.target - shot.camera.position);
    for (const Vertex& v : shot.scene.vertices)
        EXPECT_GT(glm::dot(glm::normalize(v.position - shot.camera.position), forward),
                  std::cos(0.5f * 1.2f * shot.camera.vfov));

    Shot lit = load_shot((folder.path() / "sub/lit.gltf").string());
    EXPECT_EQ(lit.scene.lights.size(), 1u);
    EXPECT_FALSE(lit.environment.present());
    // A shot file means what it says: nothing is added, but it is told.
    Shot dark = load({{"scene", "triangle.gltf"}});
    EXPECT_TRUE(dark.scene.lights.empty());
    EXPECT_THAT(dark.scene.notes, Contains(HasSubstr("black")));
}

TEST_F(ShotTest, NormalMapsCanBeSwitchedOff) {
    GltfBuilder b;
    write_png(folder.path() / "n.png", Image8{1, 1, {128, 128, 255, 255}});
    b.add("images", {{"uri", "n.png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials",
          {{"normalTexture", {{"index", 0}}}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    b.triangle({{"material", 0}, {"attributes", {{"TEXCOORD_0", b.vec2s({0, 0, 1, 0, 0, 1})}}}});
    folder.write("bumpy.gltf", b.text());
    EXPECT_EQ(load({{"scene", "bumpy.gltf"}}).scene.textures.size(), 2u);
    Shot off = load({{"scene", "bumpy.gltf"}, {"normal_maps", false}});
    EXPECT_EQ(off.scene.textures.size(), 1u);
    EXPECT_EQ(off.scene.materials[0].normal_texture.texture, -1);
    EXPECT_TRUE(off.scene.textures[size_t(off.scene.materials[0].base_colour_texture.texture)].srgb);
}

TEST_F(ShotTest, EnvironmentMaps) {
    // 2×1 texels in Radiance RGBE: (1, 0.5, 0.25) and (0, 0, 2).
    folder.write("sky.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n") +
                                std::string("\x80\x40\x20\x81\x00\x00\x80\x82", 8));
    Shot plain = load({{"scene", "triangle.gltf"}, {"environment", "sky.hdr"}});
    ASSERT_EQ(plain.environment.map.width, 2);
    EXPECT_EQ(plain.environment.radiance, glm::vec3(1));
    EXPECT_EQ(plain.environment.map.at(0, 0)[1], 0.5f);
    EXPECT_EQ(plain.environment.map.at(1, 0)[2], 2.0f);
    Shot scaled = load({{"scene", "triangle.gltf"}, {"environment", {{"map", "sky.hdr"}, {"scale", 3}}}});
    EXPECT_EQ(scaled.environment.radiance, glm::vec3(3));
    EXPECT_EQ(load({{"scene", "triangle.gltf"}, {"environment", 0.5}}).environment.radiance, glm::vec3(0.5f));
}

TEST_F(ShotTest, ScenesByName) {
    fs::path lit = folder.path() / "sub" / "lit.gltf";
    EXPECT_TRUE(fs::equivalent(find_scene("sub/lit.gltf", folder.path()), lit));
    EXPECT_TRUE(fs::equivalent(find_scene("SUB/Lit", folder.path()), lit));
    EXPECT_TRUE(fs::equivalent(find_scene("sub", folder.path()), lit));
    EXPECT_TRUE(fs::equivalent(find_given_scene(lit.string()), lit));
    EXPECT_TRUE(fs::equivalent(find_given_scene(lit.parent_path().string()), lit));
    setenv("BOUNCE_SCENES", ("/nowhere:" + folder.path().string()).c_str(), 1);
    EXPECT_TRUE(fs::equivalent(find_scene("sub", ""), lit));
    EXPECT_TRUE(fs::equivalent(find_scene("triangle", "/"), folder.path() / "triangle.gltf"));
    try {
        find_scene("triangel", "");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("did you mean 'triangle'?"), HasSubstr("/nowhere")));
    }
    unsetenv("BOUNCE_SCENES");
    EXPECT_THROW(find_scene("triangle", ""), Error);
}

TEST_F(ShotTest, DescriptionSaysWhatIsNeeded) {
    Shot shot = load({{"scene", "triangle.gltf"}, {"environment", 1}});
    std::string text = describe_scene(shot);
    EXPECT_THAT(text, HasSubstr("1 drawn"));
    EXPECT_THAT(text, HasSubstr("light from emissive surfaces (no emissive material)"));
    EXPECT_THAT(text, HasSubstr("shadow maps and direct light (no lights)"));
    EXPECT_THAT(text, Not(HasSubstr("environment light (no environment)")));
}

TEST_F(ShotTest, FactsCountWhatIsUsed) {
    GltfBuilder b;
    write_png(folder.path() / "mr.png", Image8{2, 1, {0, 255, 0, 255, 0, 200, 0, 255}});
    b.add("images", {{"uri", "mr.png"}});
    b.add("textures", {{"source", 0}});
    json matte{{"metallicFactor", 0}};
    b.add("materials",
          {{"pbrMetallicRoughness", matte}, {"emissiveFactor", {1, 1, 1}}, {"alphaMode", "MASK"}}); // unused
    b.add("materials", {{"pbrMetallicRoughness", matte}});
    json textured = matte;
    textured["metallicRoughnessTexture"] = {{"index", 0}};
    b.add("materials", {{"pbrMetallicRoughness", textured}}); // roughness 200/255 somewhere
    b.add("materials", {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.95}}},
                        {"emissiveFactor", {0, 1, 0}}});
    for (int m : {1, 2, 3})
        b.triangle({{"material", m}});
    b.node({{"mesh", 0}}); // once more
    folder.write("facts.gltf", b.text());
    Shot shot = load({{"scene", "facts.gltf"}});
    SceneFacts facts = shot_facts(shot);
    EXPECT_EQ(facts.triangles, 4u);
    EXPECT_EQ(facts.instances, 4u);
    EXPECT_EQ(facts.materials, 3u);
    EXPECT_EQ(facts.glossy_materials, 1u);
    EXPECT_EQ(facts.emissive_materials, 1u);
    EXPECT_EQ(facts.alpha_tested_materials, 0u);
    EXPECT_EQ(facts.textures, 1u);
    EXPECT_EQ(facts.texture_bytes, 8u);
    shot.diffuse_only = true;
    EXPECT_EQ(shot_facts(shot).glossy_materials, 0u);
}

TEST_F(ShotTest, MaterialModel) {
    EXPECT_EQ(load({{"scene", "triangle.gltf"}}).material_model, MaterialModel::gltf);
    for (size_t i = 0; i < k_material_models.size(); ++i) {
        Shot shot = load({{"scene", "triangle.gltf"}, {"material_model", std::string(k_material_models[i])}});
        EXPECT_EQ(shot.material_model, MaterialModel(i));
        EXPECT_EQ(shot.effective_model(), MaterialModel(i));
        shot.diffuse_only = true;
        EXPECT_EQ(shot.effective_model(), MaterialModel::plain);
    }
    EXPECT_THAT(error({{"scene", "triangle.gltf"}, {"material_model", "gltd"}}), HasSubstr("material_model is 'gltd'"));
}

TEST_F(ShotTest, BlendedMaterialsAreNamedWithHowTheyAreTaken) {
    GltfBuilder b;
    b.add("materials", {{"name", "glass"}, {"alphaMode", "BLEND"}});
    b.add("materials", {{"name", "unused glass"}, {"alphaMode", "BLEND"}});
    b.triangle({{"material", 0}});
    folder.write("glass.gltf", b.text());
    const std::string text = describe_scene(load({{"scene", "glass.gltf"}}));
    for (const char* part : {"1 blended", "blended       glass\n", "probability 1 − alpha", "lrsm, dvs, vct",
                             "ldm graphs", "shadow maps", "model         gltf"})
        EXPECT_THAT(text, HasSubstr(part));
    EXPECT_THAT(text, ::testing::Not(HasSubstr("unused glass")));
    EXPECT_EQ(shot_facts(load({{"scene", "glass.gltf"}})).blended_materials, 1u);
    EXPECT_THAT(describe_scene(load({{"scene", "triangle.gltf"}})), ::testing::Not(HasSubstr("probability")));
}

} // namespace
} // namespace bounce::testing
