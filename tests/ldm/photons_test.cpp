// Photon differentials against closed forms: the flux of the primaries, what is split off, the differentials, where
// photons arrive, and what the splats add up to.
#include "ldm/photons.h"

#include "ldm/directions.h"
#include "support/scene_runner.h"

#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <numbers>

namespace bounce {
namespace {

constexpr double k_pi = std::numbers::pi;

constexpr const char* k_graph = R"(
    "resources": {"out.indirect_diffuse": {"format": "rgba32f", "clear": false}},
    "passes": [ {"type": "gbuffer"}, {"type": "rsm", "params": {"resolution": 24}},
        {"type": "ldm", "params": {"maps": 32, "resolution": 64, "tilted": true, "nodes": "surface"}},
        {"type": "photons", "params": {"own_surface": "nearest", "exact_split": true, "visibility": "plane", "snap": true},
         "bind": {"prefix.values": "photons.places", "prefix.sums": "photons.place_sums"},
         "repeat": {"over": "count", "count": "ldm.batches.count", "loop": "ldm"}},
        {"type": "splat", "repeat": {"over": "count", "count": "ldm.batches.count", "loop": "ldm"}},
        {"id": "shade", "type": "compute", "shader": "surface/shade_diffuse.comp",
         "bind": {"gathered.irradiance": "photons.irradiance"}} ])";

/// A lit floor and a wall beside it, open elsewhere; the camera sees all of both.
Scene floor_and_wall() {
    return MadeScene()
        .quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, {0.5f, 0.6f, 0.7f})
        .quad({-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2}, {0.8f, 0.4f, 0.2f})
        .scene;
}
std::vector<Light> a_spot() {
    return {spot_light({0.2f, 2.5f, 0.1f}, {0, -1, -0.1f}, {10, 8, 6}, 25, 35)};
}
Camera looking_at_it() {
    Camera camera;
    camera.position = {0, 2.5f, 9};
    camera.target = {0, 1, 0};
    camera.vfov = glm::radians(40.0f);
    return camera;
}

class Photons : public SceneGraphTest {
  protected:
    std::unique_ptr<SceneRunner> run(Scene scene, const std::vector<std::pair<std::string, std::string>>& sets = {},
                                     std::vector<Light> lights = a_spot()) {
        auto runner = std::make_unique<SceneRunner>(std::move(scene), std::move(lights), graph_file(k_graph), sets,
                                                    glm::ivec2(64, 48));
        runner->camera = looking_at_it();
        do {
            runner->frame();
        } while (runner->graph.needs_larger_buffers());
        return runner;
    }
    static std::vector<Photon> stored(const SceneRunner& run) {
        auto commands = run.read_buffer<uint32_t>("photons.commands");
        auto photons = run.read_buffer<Photon>("photons.stored");
        photons.resize(commands.at(7));
        return photons;
    }
};

// ∫ I dω over the cone of a spot of one intensity inside, none outside, is 2π(1 − cos θ)·I: the texels' solid angles
// must add up to it. (An equal share for each texel of a perspective map would be off by a quarter.)
TEST_F(Photons, PrimariesCarryTheLightsFlux) {
    std::vector<Light> lights = {spot_light({0, 2.5f, 0}, {0, -1, 0}, {10, 8, 6}, 34.9f, 35)};
    auto r = run(floor_and_wall(), {{"rsm.resolution", "96"}, {"ldm.maps", "64"}}, lights);
    std::vector<Emitter> emitters = r->read_buffer<Emitter>("photons.emitters");
    glm::dvec3 sum(0);
    for (const Emitter& e : emitters) {
        if (e.pitch_texel <= 0) continue;
        double cosines = 0;
        for (glm::vec3 axis : ldm_directions(64))
            cosines += std::abs(glm::dot(tilt_off_axes() * axis, e.normal));
        sum += glm::dvec3(e.flux) * cosines;
    }
    glm::dvec3 rho(0.5, 0.6, 0.7); // all of the cone falls on the floor
    double cone = 2 * k_pi * (1 - std::cos(glm::radians(34.95)));
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(sum[i] / (rho[i] * lights[0].intensity[i] * cone), 1, 0.01); // the rim falls on whole texels
}

// The first footprint on a floor straight below is the texel itself; its parallelogram is pitch² / cosine in general.
TEST_F(Photons, DifferentialsSpanTheTexelOnTheSurface) {
    auto r = run(floor_and_wall());
    const glm::ivec3 map = r->texture("rsm.depth").desc().size;
    std::vector<Emitter> emitters = r->read_buffer<Emitter>("photons.emitters");
    int compared = 0;
    for (int y = 1; y + 1 < map.y; ++y) {
        for (int x = 1; x + 1 < map.x; ++x) {
            const Emitter& left = emitters[size_t(y * map.x + x - 1)];
            const Emitter& right = emitters[size_t(y * map.x + x + 1)];
            const Emitter& here = emitters[size_t(y * map.x + x)];
            bool alike = left.pitch_texel > 0 && right.pitch_texel > 0 && here.pitch_texel > 0 &&
                         left.normal == here.normal && right.normal == here.normal;
            if (!alike) continue;
            // The central difference of the positions themselves, of which D_u x is the derivative.
            glm::dvec3 measured = 0.5 * glm::dvec3(right.position - left.position);
            double off = glm::length(measured - glm::dvec3(here.du_position)) / glm::length(measured);
            EXPECT_LT(off, 0.01) << x << ' ' << y;
            EXPECT_NEAR(glm::dot(here.du_position, glm::vec4(here.normal, 0)), 0, 1e-5);
            ++compared;
        }
    }
    EXPECT_GT(compared, 100);
}

// Exact split: what is stored, what left and what was rejected add up to what the first hits reflect.
TEST_F(Photons, NoFluxIsLostUnaccounted) {
    auto r = run(floor_and_wall());
    std::vector<Emitter> emitters = r->read_buffer<Emitter>("photons.emitters");
    std::vector<uint32_t> outcomes = r->read_buffer<uint32_t>("photons.outcomes");
    ASSERT_EQ(outcomes.size(), emitters.size() * 32) << "one batch";
    std::vector<glm::vec3> axes = ldm_directions(32);
    double reflected = 0, by_outcome[5] = {}, carried = 0;
    for (size_t e = 0; e < emitters.size(); ++e) {
        if (emitters[e].pitch_texel <= 0) continue;
        double cosines = 0;
        for (size_t slot = 0; slot < axes.size(); ++slot) {
            double cosine = std::abs(glm::dot(tilt_off_axes() * axes[slot], emitters[e].normal));
            cosines += cosine;
            by_outcome[outcomes[slot * emitters.size() + e]] += cosine * double(emitters[e].flux.g);
        }
        reflected += cosines * double(emitters[e].flux.g);
    }
    for (const Photon& photon : stored(*r))
        carried += double(photon.flux.g);
    double left = by_outcome[int(PhotonFate::left)], unseen = by_outcome[int(PhotonFate::unseen)],
           wide = by_outcome[int(PhotonFate::too_wide)];
    EXPECT_GT(carried, 0.05 * reflected);
    EXPECT_GT(left, 0.2 * reflected); // the scene is open
    EXPECT_NEAR(carried / (reflected - left - unseen - wide), 1, 1e-3);
    // Published split: 2cosθ/N instead of cosθ/Σcos. Reported, not judged.
    auto published = run(floor_and_wall(), {{"photons.exact_split", "false"}});
    std::vector<Emitter> emitters_published = published->read_buffer<Emitter>("photons.emitters");
    double sum = 0;
    for (size_t e = 0; e < emitters.size(); ++e)
        for (glm::vec3 axis : axes)
            sum += std::abs(glm::dot(tilt_off_axes() * axis, emitters_published[e].normal)) *
                   double(emitters_published[e].flux.g);
    RecordProperty("published_split_over_exact", std::to_string(sum / reflected));
    EXPECT_NEAR(sum / reflected, 1, 0.05); // 32 axes: the cosines' mean is 1/2 within some percent
}

// Every photon lies on a surface that the scene has there, in front of the camera, and faces where it came from.
TEST_F(Photons, ArriveOnSurfaces) {
    auto r = run(floor_and_wall());
    std::vector<Photon> photons = stored(*r);
    ASSERT_GT(photons.size(), 200u);
    for (const Photon& p : photons) {
        bool on_wall = std::abs(p.position.z + 2) < 2e-3f, on_floor = std::abs(p.position.y) < 2e-3f;
        EXPECT_TRUE(on_wall || on_floor) << p.position.x << ' ' << p.position.y << ' ' << p.position.z;
        glm::vec3 across = glm::cross(glm::vec3(p.du), glm::vec3(p.dv));
        EXPECT_NEAR(p.area, 0.25f * float(k_pi) * glm::length(across), 1e-4f * p.area);
        EXPECT_GT(glm::dot(across, on_wall ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0)), 0);
    }
}

// ∫ of what the splats add to a large plane equals the photons' flux: Σ over pixels of E times the pixel's area on the
// plane. By both routes, which must also agree with each other pixel by pixel.
TEST_F(Photons, SplatsKeepTheFlux) {
    std::vector<float> pictures[2];
    for (const char* route : {"blend", "tiles"}) {
        auto r = run(floor_and_wall(), {{"splat.route", route}, {"photons.footprint_scale", "2"}});
        std::vector<float>& picture = pictures[route[0] == 't'];
        picture = r->read("photons.irradiance");
        std::vector<float> depth = r->read("gbuffer.depth"), normal = r->read("gbuffer.normal");
        double arrived = 0, on_wall = 0;
        for (const Photon& p : stored(*r))
            if (std::abs(p.position.z + 2) < 2e-3f) on_wall += double(p.flux.g);
        Camera camera = looking_at_it();
        glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target - camera.position));
        double tangent = std::tan(0.5 * double(camera.vfov)), pixel = 2 * tangent / 48;
        for (size_t i = 0; i < depth.size(); ++i) {
            if (depth[i] <= 0 || std::abs(normal[4 * i + 2]) < 0.9f) continue;
            int x = int(i % 64), y = int(i / 64);
            glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0))),
                       up = glm::cross(right, forward);
            glm::dvec3 ray =
                forward + tangent * (((x + 0.5) / 64 * 2 - 1) * (64.0 / 48) * right - ((y + 0.5) / 48 * 2 - 1) * up);
            double along = (-2 - double(camera.position.z)) / ray.z; // to the wall
            double area = pixel * pixel * along * along / std::abs(ray.z);
            arrived += k_pi * double(picture[4 * i + 1]) * area;
        }
        // Footprints that reach past the wall's rim, and coarse pixels, cost some percent.
        EXPECT_NEAR(arrived / on_wall, 1, 0.06) << route;
    }
    double difference = 0, sum = 0;
    for (size_t i = 0; i < pictures[0].size(); ++i) {
        if (i % 4 == 3) continue;
        difference += std::abs(double(pictures[0][i]) - double(pictures[1][i]));
        sum += double(pictures[0][i]);
    }
    EXPECT_LT(difference / sum, 0.01); // pixels at the rim of a quad whose footprint bends off its plane
}

/// At the borders of the picture, what photons beside it bring: as in the middle of a picture twice as wide and high.
TEST_F(Photons, AGuardBandKeepsTheLightOfThePicturesBorders) {
    auto picture = [&](double tangent, glm::ivec2 size, const char* band) {
        SceneRunner runner(floor_and_wall(), a_spot(), graph_file(k_graph), {{"photons.guard_band", band}}, size);
        runner.camera.position = {0, 2, 3};
        runner.camera.target = {0, 1, -2};
        runner.camera.vfov = float(2 * std::atan(tangent));
        do {
            runner.frame();
        } while (runner.graph.needs_larger_buffers());
        return runner.read("out.indirect_diffuse");
    };
    const glm::ivec2 size(64, 48);
    std::vector<float> wide = picture(0.3, 2 * size, "0"), cut = picture(0.15, size, "0"),
                       guarded = picture(0.15, size, "0.5");
    auto border = [&](const std::vector<float>& values, int width, glm::ivec2 from) {
        double sum = 0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (x < 2 || y < 2 || x >= size.x - 2 || y >= size.y - 2)
                    sum += values[size_t(4 * ((y + from.y) * width + x + from.x))];
        return sum;
    };
    double wanted = border(wide, 2 * size.x, size / 2);
    ASSERT_GT(wanted, 0);
    fmt::print("    the outer two pixels have {:.3f} of their light, with a guard band {:.3f}\n",
               border(cut, size.x, {0, 0}) / wanted, border(guarded, size.x, {0, 0}) / wanted);
    EXPECT_LT(border(cut, size.x, {0, 0}), 0.9 * wanted);
    EXPECT_NEAR(border(guarded, size.x, {0, 0}), wanted, 0.02 * wanted);
}

TEST_F(Photons, TwoRunsGiveTheSameBytes) {
    auto a = run(floor_and_wall()), b = run(floor_and_wall());
    std::vector<Photon> first = stored(*a), second = stored(*b);
    ASSERT_EQ(first.size(), second.size());
    EXPECT_EQ(0, std::memcmp(first.data(), second.data(), first.size() * sizeof(Photon)));
    EXPECT_EQ(a->read("photons.irradiance"), b->read("photons.irradiance"));
}

TEST_F(Photons, OverflowIsCountedAndGrows) {
    auto ample = run(floor_and_wall(), {{"photons.photons", "1"}});
    auto tight = run(floor_and_wall(), {{"photons.photons", "0.001"}});
    EXPECT_EQ(ample->read("photons.irradiance"), tight->read("photons.irradiance"));
    EXPECT_LT(tight->read_buffer<Photon>("photons.stored").size(), ample->read_buffer<Photon>("photons.stored").size());
}

// Batches only change the order of the sums.
TEST_F(Photons, BatchesGiveTheSameLight) {
    auto one = run(floor_and_wall()), many = run(floor_and_wall(), {{"ldm.memory", "1"}});
    EXPECT_GT(many->read_buffer<uint32_t>("ldm.batches").size(), 1u);
    std::vector<float> a = one->read("photons.irradiance"), b = many->read("photons.irradiance");
    for (size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i], b[i], 1e-5 * (1e-3 + std::abs(double(a[i]))) + 1e-7);
}

// A second bounce adds light, and no more than the albedo allows: in the corner, less than ρ times the first.
TEST_F(Photons, SecondBounceAddsAShare) {
    auto one = run(floor_and_wall()), two = run(floor_and_wall(), {{"photons.second_axes", "8"}});
    auto flux = [](const std::vector<Photon>& photons) {
        double sum = 0;
        for (const Photon& p : photons)
            sum += double(p.flux.g);
        return sum;
    };
    double first = flux(stored(*one)), both = flux(stored(*two));
    EXPECT_GT(both, first * 1.02);
    EXPECT_LT(both, first * (1 + 0.6));
}

TEST_F(Photons, SecondBounceNeedsWhatNodesHold) {
    SceneRunner runner(floor_and_wall(), a_spot(), graph_file(k_graph),
                       {{"photons.second_axes", "4"}, {"ldm.nodes", "depth"}});
    EXPECT_NONFATAL_FAILURE(runner.frame(), "set ldm.nodes=surface");
}

} // namespace
} // namespace bounce
