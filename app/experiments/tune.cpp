#include "app/experiments/tune.h"

#include "app/experiments/ablation.h"
#include "app/origin.h"
#include "core/digest.h"
#include "core/error.h"
#include "core/image.h"
#include "core/json_text.h"
#include "core/printable.h"
#include "core/text.h"
#include "graph/graph_file.h"
#include "graph/graph_overlay.h"
#include "graph/model_values.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace bounce {

using nlohmann::json;

namespace {

constexpr int k_first = 0, k_last = 1; ///< stages
constexpr int k_attempts = 3;          ///< at what is fast enough at full size

std::string figures_text(const TuneFigures& f) {
    return fmt::format("{:.3g} ms, error {:.2f} %, {:.1f} MiB", f.ms, 100 * f.error, f.bytes / 1048576);
}

json json_of(const Variant& variant) {
    return {{"sets", variant.sets}, {"switches", variant.switches}};
}

/// One stage: a measurer for each shot, made when it is first needed.
class Stage {
  public:
    Stage(const TuneSettings& settings, int number, glm::ivec2 size) : settings_(settings), number_(number) {
        for (const std::string& shot : settings.shots) {
            options_.push_back(settings.session);
            options_.back().shot = shot;
            options_.back().size = size;
        }
        measurers_.resize(options_.size());
    }

    std::optional<TuneFigures> measure(const Variant& variant, TuneMemory& memory,
                                       const std::function<void(const std::string&)>& say) {
        if (const auto* known = memory.find(number_, variant)) return *known;
        std::optional<TuneFigures> figures;
        try {
            figures = all_shots(variant);
            say(fmt::format("{}: {}", variant.text(), figures_text(*figures)));
        } catch (const Error& error) {
            say(fmt::format("{}: {}", variant.text(), error.what()));
        }
        memory.add(number_, variant, figures);
        return figures;
    }

    VariantMeasurer& measurer(size_t i) {
        if (!measurers_[i])
            measurers_[i] = std::make_unique<VariantMeasurer>(options_[i], settings_.samples, settings_.frames);
        return *measurers_[i];
    }

  private:
    TuneFigures all_shots(const Variant& variant) {
        TuneFigures all{1, 1, 0};
        for (size_t i = 0; i < options_.size(); ++i) {
            const VariantFigures one = measurer(i).measure(variant);
            const double share = 1 / double(options_.size());
            all.ms *= std::pow(std::max(one.ms, 1e-6), share);
            all.error *= std::pow(std::max(one.error, 1e-6), share);
            all.bytes = std::max(all.bytes, double(one.bytes));
        }
        return all;
    }

    const TuneSettings& settings_;
    int number_;
    std::vector<SessionOptions> options_;
    std::vector<std::unique_ptr<VariantMeasurer>> measurers_;
};

void sort_by(const TuneGoal& goal, std::vector<TunePoint>& points) {
    std::stable_sort(points.begin(), points.end(), [&](const TunePoint& a, const TunePoint& b) {
        return tune_objective(goal, a.figures) < tune_objective(goal, b.figures);
    });
}

std::vector<TunePoint> survivors_of(std::vector<TunePoint> points, const TuneGoal& goal, size_t most) {
    sort_by(goal, points);
    if (points.size() > most) points.resize(most);
    return points;
}

bool matches(const std::string& name, const std::string& pattern) {
    return pattern.ends_with("*") ? name.starts_with(pattern.substr(0, pattern.size() - 1)) : name == pattern;
}

} // namespace

TuneMemory::TuneMemory(std::filesystem::path file, std::string key) : file_(std::move(file)), key_(std::move(key)) {
    std::error_code ignored;
    if (!std::filesystem::exists(file_, ignored)) return;
    const json stored = read_json_file(file_);
    if (!stored.is_object() || stored.value("key", "") != key_ || !stored.contains("points")) return;
    try {
        for (const json& point : stored["points"]) {
            Variant variant{point.at("sets"), point.at("switches")};
            std::optional<TuneFigures> figures;
            if (point.contains("ms"))
                figures = TuneFigures{point.at("ms").get<double>(), point.at("error").get<double>(),
                                      point.at("bytes").get<double>()};
            points_[{point.at("stage").get<int>(), variant}] = figures;
        }
    } catch (const json::exception& error) {
        throw Error(file_.string() + ": not what tune writes: " + error.what());
    }
}

const std::optional<TuneFigures>* TuneMemory::find(int stage, const Variant& variant) const {
    const auto found = points_.find({stage, variant});
    return found == points_.end() ? nullptr : &found->second;
}

void TuneMemory::add(int stage, const Variant& variant, const std::optional<TuneFigures>& figures) {
    points_[{stage, variant}] = figures;
    json points = json::array();
    for (const auto& [at, known] : points_) {
        json point = json_of(at.second);
        point["stage"] = at.first;
        if (known) point["ms"] = known->ms, point["error"] = known->error, point["bytes"] = known->bytes;
        points.push_back(point);
    }
    write_file_atomically(file_, json({{"key", key_}, {"points", points}}).dump(1) + "\n");
}

std::vector<TuneParameter> tunable_parameters(const GraphModel& model, const Plan& plan,
                                              const std::vector<std::string>& over) {
    std::vector<TuneParameter> out;
    const auto add = [&](const std::string& owner, const Parameter& p) {
        const std::string name = owner + "." + p.info.name;
        const bool named = std::any_of(over.begin(), over.end(), [&](auto& pattern) { return matches(name, pattern); });
        if (p.info.name == k_rebuild || (!over.empty() && !named)) return;
        TuneParameter parameter{name, p.info, to_text(p.info, p.value)};
        if (!neighbours_of(parameter, parameter.own).empty()) out.push_back(std::move(parameter));
    };
    for (const Parameter& p : model.graph_parameters().all())
        add("graph", p);
    const std::vector<AblatedPart> parts = parts_to_leave_out(model, nullptr, plan);
    for (const AblatedPart& part : parts) {
        const std::string& id = part.without.switches.begin()->first;
        // What is seen is not a question of quality, unless somebody asks.
        if (id == "gbuffer" && over.empty()) continue;
        for (const Parameter& p : model.find_node(id)->parameters.all())
            add(id, p);
    }
    for (const std::string& pattern : over)
        if (std::none_of(out.begin(), out.end(), [&](const TuneParameter& p) { return matches(p.name, pattern); }))
            throw Error(fmt::format("invalid --over '{}': expected parameters of passes that run, as gather.*{}",
                                    pattern, did_you_mean(pattern, model.parameter_names())));
    return out;
}

glm::ivec2 tune_first_size(const TuneSettings& settings) {
    const glm::vec2 size = *settings.session.size;
    return glm::max(glm::ivec2(glm::round(size * float(settings.first_scale))), glm::ivec2(16));
}

std::string tune_key(const TuneSettings& settings) {
    Digest digest;
    digest.add(origin_here().commit);
    digest.add(expand_graph(find_graph(settings.session.graph)).root.dump());
    for (const std::string& shot : settings.shots)
        digest.add(shot);
    for (const auto& [name, value] : settings.session.sets)
        digest.add(name).add(value);
    digest.add(fmt::format("{}x{} {} {} {}", settings.session.size->x, settings.session.size->y, settings.samples,
                           settings.frames, settings.first_scale));
    return fmt::format("{:016x}", digest.value());
}

TuneOutcome tune(const TuneSettings& settings, TuneMemory& memory, const std::function<void(const std::string&)>& say) {
    const auto start = std::chrono::steady_clock::now();
    const auto in_time = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < settings.seconds;
    };
    Stage first(settings, k_first, tune_first_size(settings)), last(settings, k_last, *settings.session.size);
    first.measurer(0).measure({}); // a plan is what tells which parameters matter
    Session& session = first.measurer(0).session();
    const std::vector<TuneParameter> parameters =
        tunable_parameters(session.graph().model(), session.graph().plan(), settings.over);
    TuneOutcome outcome;
    for (const TuneParameter& parameter : parameters) {
        outcome.over.push_back(parameter.name);
        outcome.own[parameter.name] = parameter.own;
    }
    say(fmt::format("{} parameters: {}", parameters.size(), join(outcome.over, ", ")));
    const std::optional<TuneFigures> own = last.measure({}, memory, say);
    if (!own) throw Error("the graph does not work as it is at full size");
    const std::optional<TuneFigures> own_first = first.measure({}, memory, say);
    TuneGoal goal = settings.goal;
    if (!goal.error && !goal.ms) goal.error = own->error;

    // Small pictures take less time: the search keeps to a share of what is allowed. What is found says better than the
    // start how large that share is.
    double share = own_first ? own_first->ms / own->ms : 1;
    std::vector<TunePoint> survivors;
    for (int attempt = 0; attempt < k_attempts; ++attempt) {
        TuneGoal first_goal = settings.goal;
        if (first_goal.ms) *first_goal.ms *= share;
        outcome.search = tune_search(
            parameters, first_goal, settings.budget,
            [&](const Variant& variant) { return first.measure(variant, memory, say); }, in_time);
        if (!first_goal.error && !first_goal.ms) first_goal.error = outcome.search.start.figures.error;
        survivors = survivors_of(outcome.search.points, first_goal, size_t(settings.survivors));
        share = 1;
        std::erase_if(survivors, [&](TunePoint& point) {
            const auto figures = last.measure(point.variant, memory, say);
            if (figures) share = std::min(share, point.figures.ms / figures->ms), point.figures = *figures;
            return !figures;
        });
        sort_by(goal, survivors);
        if (!goal.ms || survivors.empty() || survivors.front().figures.ms <= *goal.ms || !in_time()) break;
        say(fmt::format("the best takes {:.3g} ms at full size: again, with {:.0f} % of the time",
                        survivors.front().figures.ms, 100 * share));
    }
    outcome.finals.push_back({{}, *own});
    outcome.finals.insert(outcome.finals.end(), survivors.begin(), survivors.end());
    return outcome;
}

std::string tune_markdown(const TuneSettings& settings, const TuneOutcome& outcome) {
    std::string out = fmt::format("{} on {}: {} variants of {} parameters.\n\n| settings | ms | error | MiB |\n"
                                  "| --- | ---: | ---: | ---: |\n",
                                  markdown_cell(settings.session.graph), markdown_cell(join(settings.shots, ", ")),
                                  outcome.search.points.size(), outcome.over.size());
    const auto row = [&](const std::string& name, const TunePoint& point) {
        out += fmt::format("| {}{} | {:.3g} | {:.2f} % | {:.1f} |\n", name, markdown_cell(point.variant.text()),
                           point.figures.ms, 100 * point.figures.error, point.figures.bytes / 1048576);
    };
    for (size_t i = 0; i < outcome.finals.size(); ++i)
        row(i == 0 ? "start: " : i == 1 ? "found: " : "", outcome.finals[i]);
    out += "\nThe front at the size of the first stage:\n\n| settings | ms | error | MiB |\n| --- | ---: | ---: | ---: "
           "|\n";
    for (const TunePoint& point : tune_front(outcome.search.points))
        row("", point);
    return out;
}

} // namespace bounce
