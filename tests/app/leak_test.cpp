// A thousand frames and two hundred reloads leave nothing behind: no OpenGL object, no memory.
#include "app/session.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"
#include "support/tiny_scene.h"

#include <fmt/format.h>
#include <fstream>
#include <malloc.h>
#include <unistd.h>

using namespace bounce;

namespace {

double resident_mib() {
    long total = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> total >> resident;
    return double(resident) * double(::sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

const char* const k_variants[] = {"x = x * 1.0;", "x = x * (2.0 - 1.0);"};

class Leaks : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        TinyScene()
            .quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1})
            .box({-0.3f, 0, -0.3f}, {0.2f, 0.6f, 0.2f})
            .write(root.path(), "tiny");
        SessionOptions options;
        options.shot = write_shot(root.path(), "tiny", "tiny.gltf", {0.4f, 1, 2}, {0, 0.2f, 0},
                                  R"({"type":"spot","position":[-0.7,1,0.4],"direction":[0.5,-1,-0.3],"intensity":2})");
        options.size = {32, 18};
        options.sets = {{"shadow_maps.resolution", "64"}};
        session = std::make_unique<Session>(options);
        tonemap = root.read("glsl/surface/tonemap.comp");
        graph = root.read("assets/graphs/direct.json");
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) {
            session->poll_files();
            session->render();
            session->advance();
        }
    }
    void reload(int turn) {
        // Two texts in turn, so that a driver's cache of compiled shaders does not grow with the test.
        std::string text = tonemap;
        text.replace(text.find("    if (curve == curve_aces_like)"), 0,
                     std::string("    ") + k_variants[turn % 2] + "\n");
        root.write("glsl/surface/tonemap.comp", text);
        if (turn % 3 == 0) root.write("assets/graphs/direct.json", graph);
        if (turn % 5 == 0) session->resize({32 + turn % 2, 18});
        frames(1);
    }
    void expect_no_growth(int objects, double before, const char* what) {
        ::malloc_trim(0);
        double after = resident_mib();
        fmt::print("    {}: {:.1f} → {:.1f} MiB ({:+.2f} %), {} objects\n", what, before, after,
                   100 * (after / before - 1), live_objects().total());
        EXPECT_EQ(live_objects().total(), objects) << what;
#ifndef __SANITIZE_ADDRESS__ // which keeps freed memory for a while
        EXPECT_LT(after, before * 1.01) << what;
#endif
        for (const GraphProblem& problem : session->graph().problems())
            ADD_FAILURE() << problem.error.text();
    }

    TempRoot root;
    std::unique_ptr<Session> session;
    std::string tonemap, graph;
};

} // namespace

TEST_F(Leaks, AThousandFrames) {
    frames(200);
    ::malloc_trim(0);
    int objects = live_objects().total();
    double before = resident_mib();
    frames(1000);
    expect_no_growth(objects, before, "1,000 frames");
}

TEST_F(Leaks, TwoHundredReloads) {
    for (int turn = 0; turn < 60; ++turn)
        reload(turn);
    ::malloc_trim(0);
    int objects = live_objects().total();
    double before = resident_mib();
    for (int turn = 60; turn < 260; ++turn)
        reload(turn);
    expect_no_growth(objects, before, "200 reloads");
}

TEST_F(Leaks, NothingOutlivesTheSession) {
    frames(2);
    session.reset();
    EXPECT_EQ(live_objects().total(), 0);
}

/// Empty layers are found on the GPU and counters come back behind a fence: a steady frame makes nothing anew.
TEST_F(Leaks, SteadyFramesOfLayeredMaps) {
    for (const char* graph_name : {"lrsm", "lrsm_tuned"}) {
        SessionOptions options = session->options();
        options.graph = graph_name;
        options.sets = {
            {"rsm.resolution", "64"}, {"occlusion_voxels.resolution", "16"}, {"gather.hit_lookup", "layers"}};
        Session steady(options);
        auto render = [&](int count) {
            for (int i = 0; i < count; ++i, steady.advance())
                steady.render();
        };
        render(8);
        int objects = live_objects().total();
        render(30);
        EXPECT_EQ(live_objects().total(), objects) << graph_name;
        EXPECT_FALSE(steady.graph().counters().empty()) << graph_name << ": counters arrive without being waited for";
        for (const GraphProblem& problem : steady.graph().problems())
            ADD_FAILURE() << graph_name << ": " << problem.error.text();
    }
}
