// The debug views of layered depth maps show what is there: layers, lengths and points against the lists, recorded rays
// against the occlusion. With many batches each view shows the map asked for, as with one that holds all maps.
#include "app/session.h"
#include "ldm/lists_fixture.h"
#include "ldm/trace_record.h"
#include "support/tiny_scene.h"

#include <cstring>
#include <gmock/gmock.h>

using namespace bounce;

namespace {

constexpr int k_maps = 8, k_side = 24;

class LdmViews : public GpuTest {
  protected:
    std::unique_ptr<Session> open(const std::string& graph, Sets sets, const std::vector<std::string>& passes) {
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0.7f, 0.6f, 0.5f})
            .quad({-1, 0, 1}, {-1, 0, -1}, {-1, 1, -1}, {-1, 1, 1}, {0.8f, 0.2f, 0.1f})
            .box({-0.3f, 0.02f, -0.3f}, {0.2f, 0.6f, 0.2f}, {0.4f, 0.5f, 0.8f})
            .write(folder.path(), "tiny");
        SessionOptions options;
        options.shot = write_shot(folder.path(), "tiny", "tiny.gltf", {1.4f, 1.1f, 2.4f}, {0, 0.2f, 0},
                                  R"({"type":"directional","direction":[-0.7,-1,-0.2],"intensity":1})");
        options.graph = graph;
        options.size = {48, 40};
        options.sets = {{"ldm.maps", std::to_string(k_maps)},
                        {"ldm.resolution", std::to_string(k_side)},
                        {"ldm.tilted", "true"},
                        {"ldm.memory", "1"}};
        options.sets.insert(options.sets.end(), sets.begin(), sets.end());
        for (const std::string& pass : passes)
            options.switches.emplace_back(pass, true);
        auto session = std::make_unique<Session>(options);
        render(*session);
        return session;
    }
    static void render(Session& session) {
        session.render(true);
        for (const GraphProblem& problem : session.graph().problems())
            ADD_FAILURE() << problem.error.text();
    }
    static void set(Session& session, const std::string& name, const std::string& text) {
        session.set_parameter(name, text, ParameterOrigin::panel);
    }
    static std::vector<float> read(const Session& session, const std::string& name) {
        return session.graph().texture(name)->read();
    }
    /// Room for a thousand fragments a texel: a map fills the memory limit.
    static constexpr std::pair<const char*, const char*> k_a_batch_a_map{"ldm.fragments", "1000"};

    TempFolder folder;
};

glm::vec3 heat(float share) {
    static const glm::vec3 stops[] = {{0, 0, 0},         {0.05f, 0.05f, 0.6f}, {0.6f, 0.05f, 0.55f},
                                      {1, 0.35f, 0.05f}, {1, 0.9f, 0.1f},      {1, 1, 1}};
    float x = std::clamp(share, 0.0f, 1.0f) * 5;
    int i = std::min(int(x), 4);
    return glm::mix(stops[i], stops[i + 1], x - float(i));
}

} // namespace

TEST_F(LdmViews, AreOffUntilAskedFor) {
    for (const char* graph : {"ldm_ao", "ldm_ao_tuned"}) {
        auto session = open(graph, {}, {});
        for (const std::string& name : session->graph().plan().resource_names())
            EXPECT_FALSE(name.starts_with("debug.")) << graph << " makes " << name;
        const GraphModel& model = session->graph().model();
        EXPECT_THAT(model.off_for("debug.cloud"), testing::UnorderedElementsAre("mark_cloud", "view_cloud"));
        EXPECT_THAT(model.off_for("debug.rays_view"), testing::UnorderedElementsAre("inspect", "view_rays"));
        EXPECT_THAT(model.off_for("debug.ldm_layers"), testing::ElementsAre("view_layers"));
    }
}

TEST_F(LdmViews, LayersAndLengthsAreThoseOfTheLists) {
    auto one = open("ldm_ao", {}, {});
    LdmLists lists(one->graph());
    ASSERT_EQ(lists.info.batches, 1);
    for (const char* storage : {"lists", "arrays"}) {
        auto many = open("ldm_ao",
                         {k_a_batch_a_map,
                          {"ldm.storage", storage},
                          {"view_layers.columns", "2"},
                          {"view_layers.rows", "2"},
                          {"view_layers.layer", "1"},
                          {"view_lengths.max_length", "8"}},
                         {"view_layers", "view_lengths"});
        ASSERT_EQ(LdmLists(many->graph()).info.batches, k_maps);
        for (int map : {0, 3, 7}) {
            set(*many, "view_layers.map", std::to_string(map));
            set(*many, "view_lengths.map", std::to_string(map));
            render(*many);
            std::vector<float> layers = read(*many, "debug.ldm_layers"), lengths = read(*many, "debug.ldm_lengths");
            int width = 2 * (k_side + 2), longest = 0;
            ASSERT_EQ(many->graph().texture("debug.ldm_layers")->desc().size.x, width);
            for (int y = 0; y < k_side; ++y) {
                for (int x = 0; x < k_side; ++x) {
                    std::vector<LdmFragment> list = lists.list(map, x, y);
                    longest = std::max(longest, int(list.size()));
                    int row = k_side - 1 - y;
                    size_t at = size_t(4 * (row * k_side + x));
                    ASSERT_EQ(lengths[at + 3], float(list.size())) << "map " << map << " at " << x << ", " << y;
                    for (int k = 0; k < 3; ++k)
                        ASSERT_NEAR(lengths[at + size_t(k)], heat(float(list.size()) / 8)[k], 1e-3f);
                    for (int tile = 0; tile < 4; ++tile) {
                        glm::ivec2 to(tile % 2 * (k_side + 2) + 1 + x, tile / 2 * (k_side + 2) + 1 + row);
                        const float* shown = &layers[size_t(4 * (to.y * width + to.x))];
                        size_t layer = size_t(1 + tile);
                        bool held = layer < list.size();
                        ASSERT_NEAR(shown[0], held ? list[layer].depth : 0, 5e-4f) << "layer " << layer;
                        ASSERT_NEAR(shown[2], held ? list[layer].depth : 0.12f, 5e-4f) << "layer " << layer;
                    }
                }
            }
            EXPECT_GE(longest, 3) << "map " << map;
        }
    }
}

TEST_F(LdmViews, SlopesAndAlbedoToo) {
    auto session = open("ldm_ao", {{"ldm.nodes", "surface"}, {"view_layers.columns", "1"}, {"view_layers.rows", "1"}},
                        {"view_layers"});
    LdmLists lists(session->graph());
    for (const char* quantity : {"slope", "albedo"}) {
        set(*session, "view_layers.quantity", quantity);
        set(*session, "view_layers.map", "2");
        render(*session);
        std::vector<float> layers = read(*session, "debug.ldm_layers");
        int compared = 0;
        for (int y = 0; y < k_side; ++y) {
            for (int x = 0; x < k_side; ++x) {
                std::vector<LdmFragment> list = lists.list(2, x, y);
                if (list.empty()) continue;
                const float* shown = &layers[size_t(4 * ((k_side - y) * (k_side + 2) + 1 + x))];
                ++compared;
                if (quantity[0] == 'a') {
                    for (int k = 0; k < 3; ++k)
                        ASSERT_NEAR(shown[k], float(list[0].albedo >> (8 * k) & 255u) / 255, 1e-3f);
                } else {
                    ASSERT_EQ(shown[2], 0.5f);
                    ASSERT_TRUE(shown[0] >= 0 && shown[0] <= 1 && (shown[0] != 0.5f || shown[1] != 0.5f));
                }
            }
        }
        EXPECT_GT(compared, 100);
    }
}

/// Every fragment is marked at the pixel that it projects to, and nothing else is.
TEST_F(LdmViews, CloudsAreTheFragmentsInTheScene) {
    auto one = open("ldm_ao", {}, {});
    LdmLists lists(one->graph());
    auto many =
        open("ldm_ao", {k_a_batch_a_map, {"mark_cloud.map", "5"}, {"view_cloud.points", "in_sight"}}, {"view_cloud"});
    std::vector<float> shown = read(*many, "debug.cloud"), depths = read(*many, "gbuffer.depth");
    const FrameConstants& c = many->constants();
    const LdmView& view = lists.views[5];
    glm::ivec2 size = many->size();
    std::vector<int> marks(size_t(size.x * size.y), 0); // 1: must be white · 2: may be
    auto inverse = [](glm::vec4 row) { return glm::dvec3(row) / glm::dot(glm::dvec3(row), glm::dvec3(row)); };
    for (int i = 0; i < k_side * k_side; ++i) {
        for (const LdmFragment& f : lists.list(5, i % k_side, i / k_side)) {
            glm::dvec3 x = inverse(view.to_x) * (i % k_side + 0.5 - view.to_x.w) +
                           inverse(view.to_y) * (i / k_side + 0.5 - view.to_y.w) +
                           inverse(view.to_z) * (double(f.depth) - view.to_z.w);
            glm::dvec4 clip = glm::dmat4(c.view_projection) * glm::dvec4(x, 1);
            glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(size);
            if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) continue;
            glm::ivec2 pixel(at);
            double apart = std::min({at.x - pixel.x, at.y - pixel.y, pixel.x + 1 - at.x, pixel.y + 1 - at.y});
            double depth = depths[size_t(pixel.y * size.x + pixel.x)],
                   surface = depth > 0 ? c.near_plane / depth : 1e30;
            int& mark = marks[size_t(pixel.y * size.x + pixel.x)];
            bool doubtful = apart < 1e-3 || std::abs(clip.w - 1.01 * surface) < 1e-4 * surface;
            if (doubtful) {
                for (int k = -1; k <= 1; ++k)
                    for (int l = -1; l <= 1; ++l) {
                        glm::ivec2 p = glm::clamp(pixel + glm::ivec2(k, l), glm::ivec2(0), size - 1);
                        int& near = marks[size_t(p.y * size.x + p.x)];
                        if (near == 0) near = 2;
                    }
            } else if (clip.w <= 1.01 * surface) {
                mark = 1;
            }
        }
    }
    int white = 0;
    for (size_t i = 0; i < marks.size(); ++i) {
        bool is_white = shown[4 * i] == 1 && shown[4 * i + 1] == 1;
        white += is_white;
        if (marks[i] == 2) continue;
        ASSERT_EQ(is_white, marks[i] == 1) << "pixel " << i % size_t(size.x) << ", " << i / size_t(size.x);
    }
    EXPECT_GT(white, 100);
    EXPECT_LT(white, size.x * size.y / 2);
    set(*many, "view_cloud.points", "all");
    render(*many);
    std::vector<float> all = read(*many, "debug.cloud");
    int hidden = 0;
    for (size_t i = 0; i < marks.size(); ++i)
        hidden += all[4 * i] > all[4 * i + 1] + 0.1f && all[4 * i] > shown[4 * i];
    EXPECT_GT(hidden, 30) << "points behind the box and the wall";
}

/// The occlusion of the pixel follows from its recorded rays.
TEST_F(LdmViews, RecordedRaysAreThoseOfTheOcclusion) {
    for (const char* graph : {"ldm_ao", "ldm_ao_tuned"}) {
        auto session = open(graph, {k_a_batch_a_map, {"ldm.maps", "12"}}, {"inspect"});
        int surfaces = 0, hits = 0, open_rays = 0;
        for (glm::vec2 place : {glm::vec2(0.5f), {0.2f, 0.6f}, {0.45f, 0.8f}, {0.7f, 0.6f}, {0.02f, 0.02f}}) {
            set(*session, "inspect.pixel", fmt::format("{},{}", place.x, place.y));
            render(*session);
            std::vector<std::byte> bytes = session->graph().buffer("debug.rays")->read_all<std::byte>();
            ASSERT_EQ(bytes.size(), sizeof(TracedPixel) + 12 * sizeof(RecordedRay));
            TracedPixel traced;
            std::vector<RecordedRay> rays(12);
            std::memcpy(&traced, bytes.data(), sizeof traced);
            std::memcpy(rays.data(), bytes.data() + sizeof traced, 12 * sizeof(RecordedRay));
            glm::ivec2 size = session->size();
            EXPECT_EQ(traced.pixel, glm::ivec2(place * glm::vec2(size)));
            size_t at = size_t(traced.pixel.y * size.x + traced.pixel.x);
            bool surface = read(*session, "gbuffer.depth")[at] > 0;
            ASSERT_EQ(traced.rays, surface ? 12 : 0);
            if (!surface) continue;
            ++surfaces;
            glm::vec3 normal(0);
            std::vector<float> normals = read(*session, "gbuffer.normal");
            for (int k = 0; k < 3; ++k)
                normal[k] = normals[4 * at + size_t(k)];
            double sum = 0, near = 0;
            float most = 0.1f * session->constants().scene_diagonal;
            for (const RecordedRay& ray : rays) {
                EXPECT_NEAR(glm::length(ray.direction), 1, 1e-5f);
                if (ray.cosine > 0) {
                    EXPECT_NEAR(ray.cosine, glm::dot(glm::normalize(normal), ray.direction), 1e-5f);
                }
                sum += ray.distance < 1e30f ? 0 : ray.cosine;
                near += ray.distance < most ? 0 : ray.cosine;
                hits += ray.distance < 1e30f;
                open_rays += ray.distance == 1e30f;
            }
            // 16 bits a pixel.
            EXPECT_NEAR(read(*session, "out.ambient_occlusion")[at], std::min(2 * sum / 12, 1.0), 2e-5) << graph;
            EXPECT_NEAR(read(*session, "out.ambient_occlusion_dmax")[at], std::min(2 * near / 12, 1.0), 2e-5) << graph;
        }
        EXPECT_GE(surfaces, 3) << graph;
        EXPECT_LT(surfaces, 5) << graph; // one is background
        EXPECT_GT(hits, 4) << graph;
        EXPECT_GT(open_rays, 10) << graph;
    }
}

TEST_F(LdmViews, RaysAreDrawnOverThePicture) {
    auto session = open("ldm_ao", {{"inspect.pixel", "0.5,0.7"}, {"ldm.maps", "64"}}, {"view_rays"});
    auto decoded = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
    auto touched = [&] {
        std::vector<float> shown = read(*session, "debug.rays_view"), display = read(*session, "out.display");
        int count = 0;
        for (size_t i = 0; i < shown.size() / 4; ++i)
            for (size_t k = 0; k < 3; ++k)
                if (std::abs(shown[4 * i + k] - 0.5f * decoded(display[4 * i + k])) > 2e-3f) {
                    ++count;
                    break;
                }
        return count;
    };
    int all = touched(), pixels = session->size().x * session->size().y;
    EXPECT_GT(all, 200);
    EXPECT_LT(all, pixels);
    set(*session, "view_rays.show", "hits");
    render(*session);
    int hits = touched();
    set(*session, "view_rays.show", "open");
    render(*session);
    int open_rays = touched();
    EXPECT_LT(hits, all);
    EXPECT_LT(open_rays, all);
    EXPECT_GT(hits, 30);
    EXPECT_GT(open_rays, 30);
    // The cross beside the pixel.
    std::vector<float> shown = read(*session, "debug.rays_view");
    glm::ivec2 pixel(int(0.5f * 48), int(0.7f * 40));
    const float* cross = &shown[size_t(4 * (pixel.x + 6 + 48 * pixel.y))];
    EXPECT_NEAR(cross[0], 1, 1e-2f);
    EXPECT_NEAR(cross[2], 0.2f, 1e-2f);
}
