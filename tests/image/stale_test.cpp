// A result is never stale: whatever changes while a session runs, it shows the bytes that a fresh start with the change
// shows; and nothing stands that should not, whether passes run in every frame or on change.
#include "support/stale_fixture.h"

#include "core/error.h"

#include <cctype>
#include <fstream>
#include <functional>
#include <iostream>
#include <set>

using namespace bounce;

namespace {

const char* const k_tuned[] = {"dvs_tuned", "lrsm_tuned", "ldm_ao_tuned"};

class Stale : public StaleTest, public testing::WithParamInterface<const char*> {};
class StaleMeans : public StaleTest {
  protected:
    std::vector<std::function<void(Session&)>> changes_;
};
class StaleParameters : public StaleTest, public testing::WithParamInterface<const char*> {};

struct Edit {
    size_t at;
    std::string from, to;
};

/// Where code stands: not in comments, directives, declarations.
bool is_code(const std::string& text, size_t at) {
    size_t begin = text.rfind('\n', at) + 1;
    std::string line = text.substr(begin, text.find('\n', at) - begin);
    size_t comment = line.find("//");
    if (comment != std::string::npos && begin + comment < at) return false;
    for (const char* no_code : {"#", "uniform", "layout", "const ", "struct ", "in ", "out "})
        if (line.find_first_not_of(" ") != std::string::npos &&
            line.substr(line.find_first_not_of(" ")).starts_with(no_code))
            return false;
    return true;
}

/// Edits of one token each that may change what a shader makes: another number, another sign.
std::vector<Edit> edits_of(const std::string& text) {
    std::vector<Edit> edits;
    size_t body = text.find("void main()");
    for (size_t i = 1; i + 2 < text.size(); ++i) { // 0.5 → 0.75
        if (text[i] != '.' || !std::isdigit(text[i - 1]) || !std::isdigit(text[i + 1]) || !is_code(text, i)) continue;
        size_t begin = i, end = i + 1;
        while (begin > 0 && std::isdigit(text[begin - 1]))
            --begin;
        while (end < text.size() && std::isdigit(text[end]))
            ++end;
        if (text[end] == 'e' || std::isalpha(text[begin - 1]) || text[begin - 1] == '_') continue;
        std::string from = text.substr(begin, end - begin);
        edits.push_back({begin, from, std::to_string(std::stod(from) * 0.5 + 0.25)});
    }
    for (const auto& [from, to] : {std::pair(" + ", " - "), std::pair(" * ", " + "), std::pair(" = ", " = 2u * "),
                                   std::pair(" = ", " = 0.5 * "), std::pair(" < ", " >= ")})
        for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + 1))
            if (is_code(text, at) && at > body) edits.push_back({at, from, to});
    return edits;
}

/// The stage, and the files of its own folder that it includes: some stages are no more than an include.
std::vector<std::string> with_its_includes(const std::string& stage) {
    std::vector<std::string> files{stage};
    std::ifstream stream(std::filesystem::path(std::getenv("BOUNCE_ROOT")) / stage);
    std::string folder = std::filesystem::path(stage).parent_path().filename().string() + "/";
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("#include \"" + folder))
            files.push_back("glsl/" + line.substr(10, line.find('"', 10) - 10));
    return files;
}

/// Another value of a parameter, not a dearer one.
std::string another_value(const Parameter& parameter) {
    const ParameterInfo& info = parameter.info;
    ParameterValue value = parameter.value;
    if (auto* b = std::get_if<bool>(&value)) {
        *b = !*b;
    } else if (auto* i = std::get_if<int>(&value)) {
        if (info.kind == ParameterKind::enumeration)
            *i = (*i + 1) % int(info.choices.size());
        else
            *i = *i / 2 >= info.min && *i > 0 ? *i / 2 : *i + 1;
    } else if (auto* f = std::get_if<float>(&value)) {
        float half = *f / 2;
        if (half == *f) half = info.max < 1e30 ? float(0.5 * (info.max + std::max(info.min, -1.0))) : *f + 1;
        *f = half >= float(info.min) ? half
             : float(info.min) == *f ? float(0.5 * (info.min + info.max))
                                     : float(info.min);
    } else if (auto* v = std::get_if<glm::vec2>(&value)) {
        *v = glm::vec2(0.3f, 0.6f);
    } else if (auto* v3 = std::get_if<glm::vec3>(&value)) {
        *v3 = *v3 * 0.5f + glm::vec3(0.1f);
    }
    return to_text(info, value);
}

} // namespace

/// One token of each shader that runs, which changes the picture.
TEST_P(Stale, AnEditedShaderShowsWhatAFreshStartShows) {
    SessionOptions given = options(GetParam());
    Session session(given);
    const Parts base = rendered(session);
    std::set<std::string> files;
    for (const PlanPass& pass : session.graph().plan().passes) {
        for (const auto& program : session.graph().model().nodes()[size_t(pass.node)]->programs)
            for (const auto& stage : program->stages())
                if (pass.runs(program->name())) files.insert("glsl/" + stage.string());
    }
    files.erase(
        "glsl/ldm/start_batch.comp"); // clears what the graph does not: a wrong one leaves the last frame's lists
    EXPECT_GT(files.size(), 10u);
    constexpr int k_tries = 16;
    std::set<std::string> unchanged; // by any of the edits that were tried
    for (const std::string& stage : files) {
        bool changed = false;
        int tries = 0;
        for (const std::string& file : with_its_includes(stage)) {
            const std::string text = root.read(file);
            for (const Edit& edit : edits_of(text)) {
                if (changed || ++tries > k_tries) break;
                std::string edited = text;
                root.write(file, edited.replace(edit.at, edit.from.size(), edit.to));
                session.poll_files();
                Parts now = rendered(session);
                if (!session.graph().problems().empty()) continue; // it does not compile
                changed = now != base;
                if (!changed && tries < k_tries) continue;
                Session fresh(given);
                ASSERT_EQ(differences(now, rendered(fresh)), "")
                    << file << ": '" << edit.from << "' → '" << edit.to << "' at character " << edit.at;
            }
            root.write(file, text);
            session.poll_files();
            ASSERT_EQ(differences(rendered(session), base), "") << file << " as it was";
            if (changed) break;
        }
        if (!changed) unchanged.insert(stage);
    }
    for (const std::string& file : unchanged)
        std::cout << file << ": no edit of one token that was tried changes the picture\n";
    EXPECT_LT(unchanged.size(), files.size() / 3);
}

/// A frame that is left after any of its passes, before or after a change, leaves nothing that is wrong in the next
/// one.
TEST_P(Stale, AFrameThatIsCutShortShowsWhatAFreshStartShows) {
    Camera camera;
    camera.position = {1.2f, 0.9f, 1.5f};
    camera.target = {0, 0.3f, 0};
    const auto change = [&](Session& session) {
        session.set_camera(camera);
        session.shot().scene.lights[1].intensity *= 0.5f;
        session.scene_edited();
    };
    for (const char* rebuild : {"every_frame", "on_change"}) {
        SessionOptions given = options(GetParam());
        given.sets.emplace_back("graph.rebuild", rebuild);
        Session still(given), moved(given);
        const Parts base = rendered(still);
        change(moved);
        const Parts after = rendered(moved);
        ASSERT_NE(differences(base, after), "");
        size_t calls = 0;
        Session session(given);
        ASSERT_TRUE(session.render(false, [&](float) { return ++calls > 0; })) << "cut, but not short";
        ASSERT_EQ(differences(parts(session), base), "") << rebuild;
        ASSERT_GT(calls, 4u);
        for (size_t last = 1; last <= calls; last += std::max(calls / 6, size_t(1))) {
            size_t call = 0;
            const BetweenPasses until_last = [&](float) { return ++call < last; };
            Session cut(given);
            EXPECT_FALSE(cut.render(false, until_last)); // its first frame
            ASSERT_EQ(differences(rendered(cut), base), "") << rebuild << ", first frame left after " << last;
            change(cut);
            call = 0;
            cut.render(false, until_last); // fewer passes may run than it waits for
            ASSERT_EQ(differences(rendered(cut), after), "") << rebuild << ", left after " << last;
        }
        // What is put back while its frame is cut is as it was.
        Session back(given);
        rendered(back);
        back.resize({24, 20});
        size_t call = 0;
        back.render(false, [&](float) { return ++call < calls / 2; });
        back.resize({32, 18});
        EXPECT_EQ(differences(rendered(back), base), "") << rebuild << ", another size for half a frame";
    }
}

/// What is in the scene and how it is looked at.
TEST_P(Stale, AChangedSceneShowsWhatAFreshStartShows) {
    const std::string other = write_shot_of("other");
    Camera camera;
    camera.position = {1.2f, 0.9f, 1.5f};
    camera.target = {0, 0.3f, 0};
    using Change = std::pair<const char*, std::function<void(Session&)>>;
    const std::vector<Change> changes = {
        {"a light moved",
         [](Session& s) {
             for (Node& node : s.shot().scene.nodes)
                 if (node.light >= 0) node.translation += glm::vec3(0.1f, 0.2f, 0);
             s.scene_edited();
         }},
        {"a light dimmed", [](Session& s) { s.shot().scene.lights[1].intensity *= 0.5f, s.scene_edited(); }},
        {"a light switched off", [](Session& s) { s.shot().scene.lights[0].enabled = false, s.scene_edited(); }},
        {"an object moved",
         [](Session& s) {
             for (Node& node : s.shot().scene.nodes)
                 if (node.mesh >= 0 && !node.dynamic) node.translation.x += 0.07f;
             s.scene_edited();
         }},
        {"another material",
         [](Session& s) { s.shot().scene.materials[0].base_colour *= glm::vec4(0.5f, 1, 1, 1), s.scene_edited(); }},
        {"one emissive material less",
         [](Session& s) {
             for (Material& material : s.shot().scene.materials)
                 material.emission = glm::vec3(0);
             s.scene_edited();
         }},
        {"another environment", [](Session& s) { s.shot().environment.radiance *= 2.0f, s.scene_edited(); }},
        {"another path",
         [](Session& s) {
             for (Node& node : s.shot().scene.nodes)
                 for (PathKey& key : node.path.keys)
                     key.position.z += 0.2f;
             s.scene_edited();
         }},
        {"the camera moved", [&](Session& s) { s.set_camera(camera); }},
        {"another frame", [](Session& s) { s.set_frame(7); }},
        {"another size",
         [](Session& s) {
             s.resize({24, 20});
         }},
        {"diffuse only", [](Session& s) { s.shot().diffuse_only = true, s.scene_edited(); }},
        {"another scene", [&](Session& s) { s.open_shot(other); }},
    };
    for (const char* rebuild : {"every_frame", "on_change"}) {
        SessionOptions given = options(GetParam());
        given.sets.emplace_back("graph.rebuild", rebuild);
        for (const auto& [what, change] : changes) {
            Session session(given), fresh(given);
            session.render(true);
            Parts before = rendered(session);
            change(session);
            change(fresh);
            Parts after = rendered(session);
            EXPECT_EQ(differences(after, rendered(fresh)), "") << what << ", " << rebuild;
            EXPECT_NE(after, before) << what << " changes nothing, " << rebuild;
        }
        // Frame by frame, an object moves by itself.
        Session session(given), fresh(given);
        session.render(true);
        for (int i = 0; i < 4; ++i)
            session.advance(), session.render(true);
        fresh.set_frame(4);
        EXPECT_EQ(differences(parts(session), rendered(fresh)), "") << "time went on, " << rebuild;
    }
}

/// Means over frames start anew with every change but the passing of frames.
TEST_F(StaleMeans, AreThoseOfAFreshStart) {
    for (const char* rebuild : {"every_frame", "on_change"}) {
        SessionOptions given = options("ldm_ao_tuned");
        given.sets.insert(given.sets.end(), {{"ldm.rotate", "true"}, {"graph.rebuild", rebuild}});
        given.switches = {{"accumulate", true}};
        Session session(given);
        auto frames = [](const Session& of) { return of.graph().texture("accumulate.mean")->read()[3]; };
        auto check = [&](const char* what, const std::function<void(Session&)>& change) {
            change(session);
            session.advance();
            session.render(true);
            EXPECT_EQ(frames(session), 1) << what << ", " << rebuild;
            Session fresh(given);
            fresh.set_frame(session.frame());
            changes_.push_back(change);
            for (const auto& made : changes_)
                made(fresh);
            EXPECT_EQ(differences(parts(session), rendered(fresh)), "") << what << ", " << rebuild;
            session.advance(), session.render(true);
            fresh.advance(), fresh.render(true);
            EXPECT_EQ(frames(session), 2) << what << ", " << rebuild;
            EXPECT_EQ(differences(parts(session), parts(fresh)), "") << "a frame after " << what << ", " << rebuild;
        };
        session.render(true);
        for (int i = 0; i < 3; ++i)
            session.advance(), session.render(true);
        EXPECT_EQ(frames(session), 4) << "time went on";
        session.set_parameter("tonemap.exposure", "1", ParameterOrigin::panel);
        session.advance(), session.render(true);
        EXPECT_EQ(frames(session), 5) << "what comes after the mean";
        session.set_parameter("tonemap.exposure", "0", ParameterOrigin::panel);
        changes_.clear();
        check("a parameter of what comes before",
              [](Session& s) { s.set_parameter("ldm.tilted", "false", ParameterOrigin::panel); });
        check("the camera", [](Session& s) {
            Camera camera;
            camera.position = {1.2f, 0.9f, 1.5f};
            s.set_camera(camera);
        });
        check("an object that stands", [](Session& s) {
            for (Node& node : s.shot().scene.nodes)
                if (node.mesh >= 0 && !node.dynamic) node.translation.x += 0.07f;
            s.scene_edited();
        });
        check("the path of one that moves", [](Session& s) {
            for (Node& node : s.shot().scene.nodes)
                for (PathKey& key : node.path.keys)
                    key.position.z += 0.2f;
            s.scene_edited();
        });
        session.shot().scene.lights[0].intensity *= 2.0f; // occlusion knows no light
        session.scene_edited();
        session.advance(), session.render(true);
        EXPECT_EQ(frames(session), 3) << rebuild;
    }
}

/// Some parameters here; all of them with BOUNCE_EVERY_PARAMETER in the environment (minutes).
TEST_P(StaleParameters, ChangedAndChangedBackShowWhatAFreshStartShows) {
    SessionOptions given = options(GetParam());
    given.sets.emplace_back("graph.rebuild", "on_change");
    // Published averages depend on the order in which fragments come: two fresh starts may differ.
    const std::string averaging = "voxelization.averaging";
    const GraphModel file(read_graph_file(find_graph(GetParam())));
    const Parameter* published = file.find_parameter(averaging);
    const bool by_sums = published && to_text(published->info, published->value) == "average";
    if (by_sums) given.sets.emplace_back(averaging, "sum");
    Session session(given);
    const Parts base = rendered(session);
    const GraphModel& model = session.graph().model();
    const size_t step = std::getenv("BOUNCE_EVERY_PARAMETER") ? 1 : 11;
    const std::vector<std::string> names = model.parameter_names();
    int refused = 0;
    const size_t first = std::hash<std::string>()(GetParam()) % step;
    for (size_t i = 0; i < names.size(); ++i) {
        const std::string& name = names[i];
        // With one bounce a pass is gone that wrote on top of another's voxels: always tried.
        if (i % step != first && name != "voxel_bounce.bounces") continue;
        const Parameter* parameter = model.find_parameter(name);
        if (!parameter || name == "graph.rebuild" || (by_sums && name == averaging)) continue;
        const std::string before = to_text(parameter->info, parameter->value), after = another_value(*parameter);
        session.set_parameter(name, after, ParameterOrigin::panel);
        Parts now = rendered(session);
        SessionOptions changed = given;
        changed.sets.emplace_back(name, after);
        try {
            Session fresh(changed);
            EXPECT_EQ(differences(now, rendered(fresh)), "") << name << " = " << after;
        } catch (const Error&) {
            ++refused; // values that do not go together: the last good plan stays
            EXPECT_FALSE(session.graph().problems().empty()) << name << " = " << after;
        }
        session.set_parameter(name, before, ParameterOrigin::panel);
        EXPECT_EQ(differences(rendered(session), base), "") << name << " = " << before << " again";
    }
    EXPECT_LT(refused, 5);
}

INSTANTIATE_TEST_SUITE_P(Graphs, Stale, testing::ValuesIn(k_tuned), [](auto& of) { return std::string(of.param); });
INSTANTIATE_TEST_SUITE_P(Graphs, StaleParameters,
                         testing::Values("direct", "dvs", "dvs_tuned", "hbao", "hbao_tuned", "ldm_ao", "ldm_ao_tuned",
                                         "ldm_environment", "ldm_indirect", "ldm_indirect_tuned", "lrsm", "lrsm_tuned",
                                         "traced", "vct", "vct_tuned", "voxel_ao"),
                         [](auto& of) { return std::string(of.param); });
