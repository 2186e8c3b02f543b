// The gather: one virtual point light against its closed form, and whole cells by spherical harmonics from afar.
#include "vf/vf_fixture.h"

#include <cmath>

using namespace bounce;

namespace {

class VfGather : public VfTest {
  protected:
    /// A lit floor and a wall edge-on to the light, which it does not shade.
    static Scene floor_and_wall() {
        return MadeScene()
            .quad({-0.5f, 0, 0.5f}, {0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {-0.5f, 0, -0.5f}, {0.8f, 0.4f, 0.2f})
            .quad({-1.5f, 0.1f, -1}, {1.5f, 0.1f, -1}, {1.5f, 2.1f, -1}, {-1.5f, 2.1f, -1})
            .scene;
    }
    struct Seen {
        glm::dvec3 position, normal;
        double light; ///< green
        bool surface;
    };
    std::vector<Seen> seen(const VfSets& sets) {
        shader("test/start.comp", k_start_shader);
        make(floor_and_wall(), {directional_light({0, -1, 0}, {3, 3, 3})}, sets,
             R"("test.start":{"format":"rgba32f"},)", R"({"id":"start","type":"compute","shader":"test/start.comp"})");
        std::vector<float> start = run->read("test.start"), normal = run->read("gbuffer.normal"),
                           light = run->read("vf.irradiance");
        std::vector<Seen> all(start.size() / 4);
        for (size_t i = 0; i < all.size(); ++i)
            all[i] = {{start[4 * i], start[4 * i + 1], start[4 * i + 2]},
                      {normal[4 * i], normal[4 * i + 1], normal[4 * i + 2]},
                      light[4 * i + 1],
                      start[4 * i + 3] > 0};
        return all;
    }
    /// E/π of the wall's points by all proxies, or one by one.
    double by_proxies(const Seen& at) const {
        std::vector<VfProxy> all = entries();
        std::vector<VfProxyLight> lit = run->read_buffer<VfProxyLight>("vf.light");
        double sum = 0;
        for (size_t i = 0; i < all.size(); ++i) {
            glm::dvec3 to = at.position - glm::dvec3(all[i].position);
            double squared = glm::dot(to, to), cosine = glm::dot(glm::dvec3(all[i].normal), to);
            double intensity = cosine > 0 ? lit[i].front.g : lit[i].back.g;
            sum += intensity * std::abs(cosine) * std::max(-glm::dot(at.normal, to), 0.0) / squared /
                   (squared + double(all[i].area) / M_PI) / M_PI;
        }
        return sum;
    }
};

} // namespace

/// One cell holds all, so that every list that is not empty holds all light: the gather is the sum over the proxies.
TEST_F(VfGather, OfProxiesIsTheirClosedForm) {
    for (const char* proxies : {"20", "60"}) {
        std::vector<Seen> all =
            seen({{"vf_proxies.cells", "1"}, {"vf_proxies.proxies", proxies}, {"vf_proxies.disc_scale", "4"}});
        int compared = 0;
        for (const Seen& at : all) {
            if (!at.surface || at.normal.z < 0.9 || at.light == 0) continue;
            double expected = by_proxies(at);
            EXPECT_NEAR(at.light, expected, 2e-3 * expected + 1e-7) << proxies;
            ++compared;
        }
        EXPECT_GT(compared, 20) << proxies;
    }
}

/// Far cells by their lobes, against the same lists disc by disc: the clamped lobe is nearer to them than ¼ + ½cosθ.
TEST_F(VfGather, OfFarCellsFollowsTheLobe) {
    VfSets sets{
        {"vf_proxies.cells", "8"}, {"vf_proxies.disc_scale", "4"}, {"visibility.rays", "64"}, {"gather.near", "1000"}};
    std::vector<Seen> by_discs = seen(sets);
    sets[3].second = "0";
    double error[2];
    int k = 0;
    for (const char* lobe : {"linear", "clamped"}) {
        VfSets far = sets;
        far.push_back({"gather.lobe", lobe});
        std::vector<Seen> all = seen(far);
        double sum = 0, reference = 0;
        for (size_t i = 0; i < all.size(); ++i) {
            if (!all[i].surface || all[i].normal.z < 0.9) continue;
            sum += std::abs(all[i].light - by_discs[i].light), reference += by_discs[i].light;
        }
        ASSERT_GT(reference, 0);
        error[k++] = sum / reference;
    }
    EXPECT_LT(error[1], error[0]);
    RecordProperty("error", fmt::format("{:.3f} linear, {:.3f} clamped", error[0], error[1]));
}

/// Every n²-th proxy, n² times as bright: the same in the mean over a block of texels.
TEST_F(VfGather, InterleavedIsTheSameInTheMean) {
    const VfSets base{{"vf_proxies.cells", "1"}, {"vf_proxies.disc_scale", "4"}};
    auto mean = [](const std::vector<double>& light) {
        double sum = 0;
        for (double value : light)
            sum += value;
        return sum;
    };
    std::vector<double> whole, part;
    for (const Seen& at : seen(base))
        if (at.normal.z > 0.9) whole.push_back(at.light);
    VfSets interleaved = base;
    interleaved.push_back({"gather.interleave", "4"});
    for (const Seen& at : seen(interleaved))
        if (at.normal.z > 0.9) part.push_back(at.light);
    ASSERT_GT(mean(whole), 0);
    EXPECT_NEAR(mean(part) / mean(whole), 1, 0.05);
}
