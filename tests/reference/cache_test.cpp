// Finished references: found again, resumed, and the same whether they come from the cache or not.

#include "core/error.h"
#include "core/paths.h"
#include "reference/reference_image.h"
#include "reference/state_cache.h"
#include "scenes.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bounce;
using namespace bounce::test;
namespace fs = std::filesystem;

namespace {

Shot small_room() {
    SceneMaker maker;
    maker.shot.width = 20;
    maker.shot.height = 12;
    maker.box({-1, -1, -1}, {1, 1, 1}, maker.material({0.5f, 0.4f, 0.3f}));
    maker.light(LightType::spot, {0, 0.5f, 0.2f}, {0.2f, -1, 0}, 3, 0.5f, 0.9f);
    maker.camera({0, 0, 0.9f}, {0, -0.2f, -1}, 70);
    return maker.shot;
}

class ReferenceCache : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "bounce-cache-XXXXXX").string();
        folder = mkdtemp(pattern.data());
        if (const char* set = std::getenv("XDG_CACHE_HOME")) before = set;
        setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    }
    void TearDown() override {
        if (before.empty())
            unsetenv("XDG_CACHE_HOME");
        else
            setenv("XDG_CACHE_HOME", before.c_str(), 1);
        fs::remove_all(folder);
    }
    size_t files() const {
        return size_t(std::distance(fs::directory_iterator(reference_cache_folder()), fs::directory_iterator()));
    }
    static bool same(const ReferenceResult& a, const ReferenceResult& b) {
        if (a.image.metadata != b.image.metadata) return false;
        for (const auto& [name, layer] : a.image.layers) {
            if (layer.pixels != b.image.layers.at(name).pixels) return false;
        }
        return true;
    }
    fs::path folder;
    std::string before;
};

ReferenceGoal samples_goal(int samples) {
    ReferenceGoal goal;
    goal.samples = samples;
    return goal;
}

ReferenceGoal noise_goal(double noise) {
    ReferenceGoal goal;
    goal.noise = noise;
    return goal;
}

ReferenceResult run(const ReferenceGoal& goal, bool use_cache = true, const ReferenceSettings& settings = {}) {
    return reference_image(small_room(), settings, 0, goal, nullptr, use_cache);
}

} // namespace

TEST(Checkpoints, Grow) {
    std::vector<int> counts;
    for (int n = 0; n < 200; n = reference_checkpoint(n))
        counts.push_back(reference_checkpoint(n));
    EXPECT_THAT(counts, testing::ElementsAre(16, 24, 32, 48, 64, 96, 128, 192, 256));
    EXPECT_EQ(reference_checkpoint(17), 24);
}

TEST_F(ReferenceCache, ASecondRunRendersNothing) {
    const ReferenceResult first = run(samples_goal(20)), second = run(samples_goal(20));
    EXPECT_TRUE(first.complete);
    EXPECT_FALSE(first.cached);
    EXPECT_EQ(first.samples, 20);
    EXPECT_TRUE(second.cached);
    EXPECT_TRUE(same(first, second));
    EXPECT_TRUE(same(first, run(samples_goal(20), false)));
    ReferenceSettings other;
    other.bounces = 1;
    EXPECT_FALSE(run(samples_goal(20), true, other).cached);
}

TEST_F(ReferenceCache, MoreSamplesBuildOnFewerAndFewerAreRenderedAnew) {
    run(samples_goal(20));
    const ReferenceResult more = run(samples_goal(40));
    EXPECT_EQ(more.resumed_from, 20);
    EXPECT_TRUE(same(more, run(samples_goal(40), false)));
    const ReferenceResult fewer = run(samples_goal(8));
    EXPECT_EQ(fewer.samples, 8);
    EXPECT_EQ(fewer.resumed_from, 0);
    EXPECT_TRUE(same(fewer, run(samples_goal(8), false)));
    EXPECT_TRUE(run(samples_goal(40)).cached); // and spoils nothing
}

TEST_F(ReferenceCache, NoiseGoalsStopAtTheSameSampleWhateverIsKept) {
    const ReferenceResult alone = run(noise_goal(0.05), false);
    EXPECT_TRUE(alone.complete);
    EXPECT_LE(alone.noise, 0.05);
    EXPECT_EQ(reference_checkpoint(alone.samples - 1), alone.samples);
    run(samples_goal(20)); // ends between two checkpoints
    EXPECT_TRUE(same(alone, run(noise_goal(0.05))));
    const ReferenceResult finer = run(noise_goal(0.03));
    EXPECT_GT(finer.samples, alone.samples);
    EXPECT_GT(finer.resumed_from, 0);
    EXPECT_TRUE(same(finer, run(noise_goal(0.03), false)));
    EXPECT_TRUE(run(noise_goal(0.05)).cached);
    // The coarser goal, when only the finer state is left: its history tells that it is too far on.
    for (const KeptState& state : kept_states(ReferenceRender(small_room(), {}).key())) {
        if (state.samples <= alone.samples) fs::remove(state.path);
    }
    EXPECT_TRUE(same(alone, run(noise_goal(0.05))));
}

TEST_F(ReferenceCache, AStoppedRunIsKeptAndGoesOn) {
    const ReferenceGoal goal = samples_goal(1 << 20); // far off
    int calls = 0;
    const ReferenceResult stopped =
        reference_image(small_room(), {}, 0, goal, [&](const ReferenceProgress&) { return ++calls < 2; });
    EXPECT_FALSE(stopped.complete);
    EXPECT_LT(stopped.samples, 1 << 20);
    EXPECT_EQ(files(), 1u);
    EXPECT_EQ(stopped.kept_problem, "");
    const ReferenceResult finished = run(samples_goal(600));
    EXPECT_EQ(finished.resumed_from, stopped.samples <= 600 ? stopped.samples : 0);
    EXPECT_TRUE(same(finished, run(samples_goal(600), false)));
}

TEST_F(ReferenceCache, AnUnwritableCacheLosesNothing) {
    fs::create_directories(reference_cache_folder());
    fs::remove(reference_cache_folder());
    std::ofstream(folder / "bounce" / "reference") << "a file where the folder should be";
    EXPECT_THROW(reference_cache_folder(), Error);
    const ReferenceResult result = run(samples_goal(4));
    EXPECT_TRUE(result.complete);
    EXPECT_NE(result.kept_problem, "");
    EXPECT_TRUE(same(result, run(samples_goal(4), false)));
}

TEST_F(ReferenceCache, ADamagedStateIsRenderedAnew) {
    const ReferenceResult first = run(samples_goal(20));
    for (const auto& entry : fs::directory_iterator(reference_cache_folder())) {
        const std::string bytes = read_file(entry.path());
        write_file_atomically(entry.path(), bytes.substr(0, bytes.size() / 2));
    }
    const ReferenceResult second = run(samples_goal(20));
    EXPECT_FALSE(second.cached);
    EXPECT_TRUE(same(first, second));
    EXPECT_TRUE(run(samples_goal(20)).cached);
}

TEST_F(ReferenceCache, OldStatesMakeRoom) {
    run(samples_goal(4));
    run(samples_goal(6));
    EXPECT_EQ(files(), 2u);
    prune_states(0, ReferenceRender(small_room(), {}).key());
    EXPECT_EQ(files(), 2u);
    prune_states(0, "another");
    EXPECT_EQ(files(), 0u);
}

TEST_F(ReferenceCache, BadGoalsAreErrors) {
    EXPECT_THROW(run(ReferenceGoal{}), Error);
    EXPECT_THROW(run(samples_goal(1)), Error);
    ReferenceGoal both = samples_goal(4);
    both.noise = 0.1;
    EXPECT_THROW(run(both), Error);
    ReferenceGoal unknown = samples_goal(4);
    unknown.part = "out.glossy";
    EXPECT_THROW(run(unknown), Error);
}
