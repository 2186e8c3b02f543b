// A reset of the GPU costs the GPU's objects and nothing else: another context takes the lost one's place, and what a
// person sees and has set is there again.
#include "app/tiny_session.h"
#include "gpu/context_loss.h"
#include "gpu/objects.h"
#include "support/errors.h"
#include "support/gpu_context.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SessionReset : public GpuTest {
  protected:
    SessionOptions options() { return tiny_session(root.path()); }
    static std::vector<float> picture(Session& session) { return session.graph().texture("out.radiance")->read(); }
    static std::string problems(const Session& session) {
        std::string text;
        for (const GraphProblem& problem : session.graph().problems())
            text += problem.where + ": " + problem.error.text() + "\n";
        return text;
    }
    /// The context is gone, and there is another.
    static void reset(Session& session, ResetCause cause = ResetCause::guilty) {
        pretend_reset(cause);
        session.release_gpu();
        EXPECT_EQ(live_objects().textures, 0);
        EXPECT_EQ(live_objects().programs, 0);
        gpu_context().make_again();
        EXPECT_FALSE(context_is_lost());
        session.restore_gpu();
    }
    void edit(Session& session, const std::string& file, const std::string& from, const std::string& to) {
        root.edit("glsl/surface/" + file, from, to);
        session.poll_files();
        session.render();
    }
    TempRoot root;
};

TEST_F(SessionReset, WhatAPersonSeesAndHasSetIsThereAgain) {
    root.write("assets/graphs/direct.json", R"({"version":1,"extends":"base/surface",
        "passes":[{"id":"gbuffer","params":{"cull_back_faces":true}}]})");
    Session session(options());
    session.set_frame(3);
    Camera camera = session.camera();
    camera.position.x += 0.2f;
    session.set_camera(camera);
    session.shot().scene.lights[0].intensity = {1, 4, 2};
    session.shot().scene.materials[0].base_colour = {0.2f, 0.9f, 0.4f, 1};
    session.scene_edited();
    session.set_parameter("tonemap.exposure", "1", ParameterOrigin::panel);
    session.set_parameter("gbuffer.cull_back_faces", "false", ParameterOrigin::panel); // its default, not the graph's
    session.set_parameter("graph.rebuild", "on_change", ParameterOrigin::panel);
    session.graph().model().switch_pass("shadow_maps", false);
    session.graph().check_nan = true;
    session.render();
    const std::vector<float> before = picture(session);
    const std::string line = session.command_line("x.png");
    const uint64_t edits = session.edits();
    reset(session);
    session.render();
    EXPECT_EQ(picture(session), before);
    EXPECT_EQ(problems(session), "") << "nothing was edited, so nothing is to blame";
    EXPECT_EQ(session.command_line("x.png"), line);
    EXPECT_THAT(line, AllOf(HasSubstr("--set gbuffer.cull_back_faces=false"), HasSubstr("--disable shadow_maps"),
                            HasSubstr("--frames 4")));
    EXPECT_EQ(session.camera().position, camera.position);
    EXPECT_EQ(session.edits(), edits) << "a reference of it is still one";
    EXPECT_TRUE(session.graph().check_nan);
    session.shot().scene.lights[0].intensity = {2, 8, 4};
    session.scene_edited();
    session.render();
    EXPECT_NE(picture(session), before) << "it lives on";
}

TEST_F(SessionReset, TheProgramThatWasEditedLastIsDisabledWithItsReason) {
    Session session(options());
    session.render();
    const std::vector<float> before = picture(session);
    edit(session, "compose.comp", "void main()", "// first\nvoid main()");
    edit(session, "tonemap.comp", "void main()", "// last\nvoid main()");
    reset(session);
    session.render();
    EXPECT_EQ(picture(session), before) << "what else was edited runs";
    EXPECT_THAT(problems(session),
                AllOf(HasSubstr("tonemap.comp: disabled: the GPU was reset, and it was compiled last"),
                      Not(HasSubstr("compose.comp"))));
    session.render();
    EXPECT_THAT(problems(session), HasSubstr("disabled")) << "it stays so";
    edit(session, "tonemap.comp", "// last", "// again");
    EXPECT_EQ(problems(session), "");
    EXPECT_EQ(picture(session), before);

    reset(session, ResetCause::innocent);
    session.render();
    EXPECT_EQ(problems(session), "") << "another program's reset is no fault of the edit";
}

TEST_F(SessionReset, AParameterOfThePassTriesADisabledProgramAgain) {
    Session session(options());
    session.render();
    edit(session, "tonemap.comp", "void main()", "// edited\nvoid main()");
    reset(session);
    session.render();
    EXPECT_THAT(problems(session), HasSubstr("disabled"));
    session.set_parameter("tonemap.exposure", "1", ParameterOrigin::panel);
    session.render();
    EXPECT_EQ(problems(session), "");
}

/// After a first reset passes are watched one by one: what hangs without having been edited is found by the second.
TEST_F(SessionReset, ASecondResetNamesItsPass) {
    Session session(options());
    session.render();
    const std::vector<float> before = picture(session);
    reset(session);
    static int asked = 0;
    asked = 0;
    const auto driver = glad_glGetGraphicsResetStatus;
    glad_glGetGraphicsResetStatus = +[]() -> GLenum { return ++asked == 2 ? GL_GUILTY_CONTEXT_RESET : GL_NO_ERROR; };
    const std::string text = error_of([&] { session.render(); });
    glad_glGetGraphicsResetStatus = driver;
    const std::string second = session.graph().plan().passes[1].id;
    EXPECT_THAT(text, AllOf(HasSubstr("the GPU was reset because of what this program did"),
                            HasSubstr("graph 'direct'"), HasSubstr("in pass '" + second + "'")));
    session.release_gpu();
    gpu_context().make_again();
    session.restore_gpu();
    session.render();
    EXPECT_THAT(problems(session), HasSubstr("disabled: the GPU was reset while pass '" + second + "' ran"));
    EXPECT_NE(picture(session), before);
    EXPECT_THAT(error_of([&] { session.render(); }), "");
}

TEST_F(SessionReset, WhatIsBrokenStaysBrokenAndTheLastGoodPictureStays) {
    Session session(options());
    session.render();
    const std::vector<float> before = picture(session);
    edit(session, "compose.comp", "void main()", "undeclared\nvoid main()");
    root.write("assets/graphs/direct.json", "{ no graph");
    session.poll_files();
    session.render();
    const std::string wrong = problems(session);
    EXPECT_THAT(wrong, AllOf(HasSubstr("compose.comp"), HasSubstr("direct.json")));
    ASSERT_EQ(picture(session), before);
    reset(session, ResetCause::innocent);
    session.render();
    EXPECT_EQ(picture(session), before);
    EXPECT_EQ(problems(session), wrong);
    edit(session, "compose.comp", "undeclared\n", "");
    EXPECT_THAT(problems(session), Not(HasSubstr("compose.comp")));
    EXPECT_EQ(picture(session), before);
}

TEST_F(SessionReset, APlanThatDoesNotFitKeepsTheLastGoodOne) {
    Session session(options());
    session.render();
    const std::vector<float> before = picture(session);
    root.edit("glsl/surface/tonemap.comp", "void main()", "uniform sampler2D no_source;\nvoid main()");
    session.poll_files();
    session.render();
    const std::string wrong = problems(session);
    EXPECT_THAT(wrong, HasSubstr("no.source"));
    reset(session, ResetCause::innocent);
    session.render();
    EXPECT_EQ(picture(session), before);
    EXPECT_EQ(problems(session), wrong);
}

TEST_F(SessionReset, ManyResetsLeaveNothingBehind) {
    Session session(options());
    session.render();
    const std::vector<float> before = picture(session);
    const LiveObjects objects = live_objects();
    for (int i = 0; i < 5; ++i) {
        reset(session);
        session.render();
    }
    EXPECT_EQ(picture(session), before);
    EXPECT_EQ(live_objects().total(), objects.total());
}
