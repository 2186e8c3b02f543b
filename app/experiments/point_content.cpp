#include "app/experiments/point_content.h"

#include "app/capture.h"
#include "core/error.h"
#include "core/text.h"
#include "graph/graph_overlay.h"
#include "graph/model.h"
#include "reference/content_key.h"

#include <algorithm>
#include <fmt/format.h>

namespace bounce {

/// The whole graph, whatever is said about it and however it is laid out in files.
static std::string digest_of_graph(const GraphModel& model) {
    OrderedJson whole = expand_graph(model.file().path).root;
    whole.erase("about");
    ContentHash hash;
    hash.add(nlohmann::json(whole).dump()); // members have no order
    return hash.text();
}

const ContentReader::GraphContent& ContentReader::graph_content(const std::string& graph) {
    auto known = graphs_.find(graph);
    if (known != graphs_.end()) return known->second;
    GraphContent content;
    const GraphModel model(read_graph_file(find_graph(graph)));
    content.text = digest_of_graph(model);
    for (const auto& node : model.nodes()) {
        ContentHash hash;
        for (const auto& program : node->programs) {
            for (const ShaderSource& source : program->sources())
                hash.add(source.text);
        }
        if (!node->programs.empty()) content.shaders[node->id()] = hash.text();
    }
    return graphs_.emplace(graph, std::move(content)).first->second;
}

std::string ContentReader::graph_digest(const std::string& graph) {
    const GraphContent& content = graph_content(graph);
    ContentHash hash;
    hash.add(content.text);
    for (const auto& [pass, digest] : content.shaders)
        hash.add(pass + digest);
    return hash.text();
}

PointContent ContentReader::content_of(const PointTask& task) {
    const SessionOptions& session = task.session;
    const int frames = task.warm_up + task.frames;
    std::string& shot = shots_[{session.shot, frames}];
    if (shot.empty()) {
        const Shot loaded = load_shot(session.shot);
        shot = shot_digest(loaded, frames);
        facts_[session.shot] = {shot_facts(loaded), glm::ivec2(loaded.width, loaded.height)};
    }
    const GraphContent& graph = graph_content(session.graph);
    const auto& [facts, own_size] = facts_.at(session.shot);
    GraphModel model(read_graph_file(find_graph(session.graph)));
    apply_options(model, session);
    PointContent content;
    content.commit = program_commit();
    content.graph = graph.text;
    content.shot = shot;
    // The shaders of what runs: a view that is off, or a pass that the scene does not need, changes nothing.
    for (const PlanPass& pass : model.plan(facts, session.size.value_or(own_size)).passes) {
        const auto shader = graph.shaders.find(pass.id);
        if (shader != graph.shaders.end()) content.shaders[pass.id] = shader->second;
    }
    return content;
}

/// Passes that both have, with another text.
static std::vector<std::string> changed_shaders(const PointContent& a, const PointContent& b) {
    std::vector<std::string> changed;
    for (const auto& [pass, digest] : a.shaders) {
        const auto other = b.shaders.find(pass);
        if (other != b.shaders.end() && other->second != digest) changed.push_back("'" + pass + "'");
    }
    return changed;
}

std::vector<std::string> content_differences(const PointContent& before, const PointContent& now) {
    if (before.commit.empty()) return {"unknown, because the point does not say what it was measured with"};
    std::vector<std::string> differences;
    if (before.commit != now.commit)
        differences.push_back(fmt::format("the program ({}, now {})", before.commit, now.commit));
    if (before.graph != now.graph) differences.push_back("the graph");
    if (before.shot != now.shot) differences.push_back("the shot");
    if (const auto changed = changed_shaders(before, now); !changed.empty())
        differences.push_back("the shaders of " + join(changed, ", "));
    else if (before.shaders != now.shaders && differences.empty())
        differences.push_back("which passes run");
    return differences;
}

/// Why the point cannot stand beside the other; "" when it can.
static std::string clash(const ChartPoint& point, const ChartPoint& other) {
    const PointContent &a = point.content, &b = other.content;
    std::vector<std::string> reasons;
    if (a.commit != b.commit)
        reasons.push_back(fmt::format("the program ({}, not {})", a.commit.empty() ? "not told" : a.commit, b.commit));
    const SessionOptions &s = point.task.session, &t = other.task.session;
    const int frames = point.task.warm_up + point.task.frames, others = other.task.warm_up + other.task.frames;
    if (s.shot == t.shot && frames == others && a.shot != b.shot) reasons.push_back("the shot " + s.shot);
    if (s.graph == t.graph) {
        if (a.graph != b.graph) reasons.push_back("the graph " + s.graph);
        if (const auto changed = changed_shaders(a, b); !changed.empty())
            reasons.push_back("the shaders of " + join(changed, ", "));
    }
    return join(reasons, ", ");
}

std::vector<ChartPoint> points_of_one_program(std::vector<ChartPoint> points, std::vector<std::string>& left_out) {
    std::stable_sort(points.begin(), points.end(), [](const ChartPoint& a, const ChartPoint& b) {
        return std::tie(b.measured, a.key) < std::tie(a.measured, b.key); // the newest first
    });
    std::vector<ChartPoint> kept;
    for (ChartPoint& point : points) {
        std::string reason;
        for (const ChartPoint& other : kept) {
            if (point.key == other.key) reason = " "; // the same point again
            if (reason.empty()) reason = clash(point, other);
        }
        if (reason.empty())
            kept.push_back(std::move(point));
        else if (reason != " ")
            left_out.push_back(fmt::format("{}: left out, because it was measured with another version of {}; "
                                           "measure it again",
                                           point.task.label(), reason));
    }
    return kept;
}

} // namespace bounce
