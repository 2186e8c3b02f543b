// Alpha in the reference: blended surfaces stop each ray with the probability alpha.

#include "reference/render.h"
#include "scenes.h"

#include <gtest/gtest.h>

using namespace bounce;
using namespace bounce::test;

namespace {

double mean(const Image& image) {
    return image_mean(image, Mask(image.width, image.height));
}

int sheet_material(SceneMaker& maker, float alpha, AlphaMode mode = AlphaMode::blend) {
    const int index = maker.material(glm::vec3(0));
    Material& material = maker.shot.scene.materials[size_t(index)];
    material.base_colour.a = alpha;
    material.alpha_mode = mode;
    return index;
}

/// A wide sheet at the height y.
void sheet(SceneMaker& maker, float y, int material) {
    maker.quad({-200, y, -200}, {400, 0, 0}, {0, 0, 400}, material);
}

/// A floor under `layers` sheets, seen from below them, lit by a sun above.
SceneMaker covered_floor(int layers, float alpha) {
    SceneMaker maker;
    sheet(maker, 0, maker.material(glm::vec3(0.5f)));
    for (int i = 0; i < layers; ++i)
        sheet(maker, 2 + 0.1f * float(i), sheet_material(maker, alpha));
    maker.camera({0, 1, 0.001f}, {0, 0, 0}, 30);
    maker.light(LightType::directional, {0, 5, 0}, {0, -1, 0}, 2);
    return maker;
}

/// A corner with a lamp, a sky and a sheet across the view.
SceneMaker room(float alpha, AlphaMode mode, bool with_sheet = true) {
    SceneMaker maker;
    maker.shot.diffuse_only = false;
    const int wall = maker.material(glm::vec3(0.7f, 0.5f, 0.3f), glm::vec3(0), 0, 0.4f);
    maker.quad({-3, 0, -3}, {0, 0, 6}, {6, 0, 0}, wall);
    maker.quad({-3, 0, -3}, {6, 0, 0}, {0, 4, 0}, wall);
    maker.quad({-0.5f, 3, -0.5f}, {1, 0, 0}, {0, 0, 1}, maker.material(glm::vec3(0), glm::vec3(4)));
    maker.light(LightType::point, {1, 2, 1}, {0, -1, 0}, 3);
    maker.shot.environment.radiance = glm::vec3(0.3f);
    maker.camera({0, 1.5f, 6}, {0, 1, 0}, 50);
    if (with_sheet) {
        const int material = maker.material(glm::vec3(0.8f), glm::vec3(0.2f), 0, 0.3f);
        maker.shot.scene.materials[size_t(material)].base_colour.a = alpha;
        maker.shot.scene.materials[size_t(material)].alpha_mode = mode;
        maker.quad({-1, 0.2f, 1}, {2, 0, 0}, {0, 2, 0.5f}, material);
    }
    return maker;
}

void expect_same(const ReferenceRender& a, const ReferenceRender& b, float tolerance) {
    for (const ReferencePart& part : k_reference_parts) {
        const Image left = a.part(std::string(part.name)), right = b.part(std::string(part.name));
        ASSERT_EQ(left.pixels.size(), right.pixels.size());
        for (size_t i = 0; i < left.pixels.size(); ++i) {
            ASSERT_NEAR(left.pixels[i], right.pixels[i], tolerance * (1e-3f + std::abs(right.pixels[i])))
                << part.name << " at " << i;
        }
    }
}

} // namespace

TEST(Coverage, AlphaOneIsOpaque) {
    ReferenceRender blend(room(1, AlphaMode::blend).shot, {}), opaque(room(1, AlphaMode::opaque).shot, {});
    blend.render_to(4);
    opaque.render_to(4);
    expect_same(blend, opaque, 0);
    EXPECT_NE(blend.key(), opaque.key());
}

TEST(Coverage, AlphaZeroIsNotThere) {
    ReferenceSettings settings;
    settings.bounces = 3;
    ReferenceRender blend(room(0, AlphaMode::blend).shot, settings),
        none(room(0, AlphaMode::blend, false).shot, settings);
    blend.render_to(4);
    none.render_to(4);
    expect_same(blend, none, 1e-5f);
}

// k layers let (1 − α)^k through: what the camera sees through them, what light falls through them, and what of the sky
// rays from below meet.
TEST(Coverage, StacksLetThroughTheirPower) {
    for (float alpha : {0.25f, 0.6f}) {
        for (int layers : {1, 2, 4}) {
            const double through = std::pow(1.0 - double(alpha), layers);
            ReferenceRender below(covered_floor(layers, alpha).shot, {.bounces = 0});
            below.render_to(256);
            const double tolerance = 4 * std::sqrt(through * (1 - through) / (256.0 * 256));
            EXPECT_NEAR(mean(below.part("out.direct")) * k_pi_d, through, tolerance) << alpha << " " << layers;
            EXPECT_NEAR(mean(below.part("out.ambient_occlusion")), through, tolerance + 1e-3);

            SceneMaker above = covered_floor(layers, alpha);
            above.camera({0, 9, 0.001f}, {0, 0, 0}, 10);
            above.shot.scene.materials[0].emission = glm::vec3(1);
            ReferenceRender seen(above.shot, {.bounces = 0});
            seen.render_to(256);
            EXPECT_NEAR(mean(seen.part("out.emission")), through, tolerance);
            // Down to the floor and up again, through all layers twice.
            EXPECT_NEAR(mean(seen.part("out.direct")) * k_pi_d, through * through, tolerance);
        }
    }
}

// Texture, vertex colour and factor multiply.
TEST(Coverage, AlphaIsAProduct) {
    SceneMaker maker = covered_floor(1, 0.8f);
    Texture texture;
    texture.image = {1, 1, {255, 255, 255, 128}};
    maker.shot.scene.textures.push_back(texture);
    maker.shot.scene.materials[1].base_colour_texture.texture = 0;
    for (size_t i = 6; i < 12; ++i)
        maker.shot.scene.vertices[i].colour_ba = glm::packUnorm2x16({1, 0.5f});
    ReferenceRender render(maker.shot, {.bounces = 0});
    render.render_to(256);
    EXPECT_NEAR(mean(render.part("out.direct")) * k_pi_d, 1 - 0.8 * 0.5 * 128 / 255, 8e-3);
}

// A blended lamp shines by its share, whether it is met by chance or asked.
TEST(Coverage, BlendedEmittersShineByTheirShare) {
    auto scene = [](float alpha, bool diffuse_only) {
        SceneMaker maker;
        maker.shot.diffuse_only = diffuse_only;
        sheet(maker, 0, maker.material(glm::vec3(0.5f), glm::vec3(0), diffuse_only ? 0.0f : 1.0f, 0.2f));
        const int lamp = maker.material(glm::vec3(0), glm::vec3(3));
        maker.shot.scene.materials[size_t(lamp)].base_colour.a = alpha;
        maker.shot.scene.materials[size_t(lamp)].alpha_mode = AlphaMode::blend;
        maker.quad({-1, 1.5f, -1}, {2, 0, 0}, {0, 0, 2}, lamp);
        maker.camera({0, 1, 3}, {0, 0, 0}, 20);
        ReferenceRender render(maker.shot, {.bounces = 0});
        render.render_to(256);
        return mean(render.part("out.emitted"));
    };
    for (bool diffuse_only : {true, false})
        EXPECT_NEAR(scene(0.3f, diffuse_only) / scene(1, diffuse_only), 0.3, 4e-3) << diffuse_only;
}

// At a cutoff of 0 all is there, even alpha 0; above 1 nothing is.
TEST(Coverage, CutoffsAtTheirEnds) {
    for (float cutoff : {0.0f, 0.5f, 1.0f, 1.5f}) {
        SceneMaker maker;
        sheet(maker, 0, maker.material(glm::vec3(0.5f)));
        for (float alpha : {0.0f, 1.0f}) {
            const int material = sheet_material(maker, alpha, AlphaMode::mask);
            maker.shot.scene.materials[size_t(material)].alpha_cutoff = cutoff;
            maker.quad({alpha > 0.5f ? 0.0f : -10.0f, 1, -10}, {10, 0, 0}, {0, 0, 20}, material);
        }
        maker.camera({0, 4, 0.001f}, {0, 0, 0}, 30);
        ReferenceRender render(maker.shot, {.bounces = 0});
        render.render_to(2);
        const Image material = render.image().layers.at("gbuffer.material");
        EXPECT_EQ(*material.at(3, 8), cutoff == 0 ? 1 : 0) << "alpha 0, cutoff " << cutoff;
        EXPECT_EQ(*material.at(12, 8), cutoff <= 1 ? 2 : 0) << "alpha 1, cutoff " << cutoff;
    }
}

// The surface layers and the edge mask do not have the grain of single rays.
TEST(Coverage, SurfaceLayersTakeTheLikelierSurface) {
    for (float alpha : {0.4f, 0.6f}) {
        SceneMaker maker = covered_floor(1, alpha);
        maker.camera({0, 9, 0.001f}, {0, 0, 0}, 10);
        ReferenceRender render(maker.shot, {.bounces = 0});
        render.render_to(2);
        const Image material = render.image().layers.at("gbuffer.material");
        for (int i = 0; i < 16; ++i)
            EXPECT_EQ(*material.at(i, i), alpha < 0.5f ? 0 : 1);
    }
}
