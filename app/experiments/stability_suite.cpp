#include "app/experiments/stability_suite.h"

#include "app/broken_shaders.h"
#include "app/experiments/error_table.h"
#include "app/experiments/flicker.h"
#include "app/experiments/point_content.h"
#include "app/experiments/stability_rung.h"
#include "app/origin.h"
#include "core/digest.h"
#include "core/temporary_folder.h"
#include "core/text.h"
#include "graph/shader_log.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <numeric>

namespace bounce {

namespace {

double mean_of(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(std::max<size_t>(values.size(), 1));
}

} // namespace

class StabilityMeasurement::Rungs {
  public:
    Rungs(const StabilityCase& which, const std::string& graph, const Variant& own)
        : which_(which), graph_(graph), own_(own) {
        const GraphModel model(read_graph_file(find_graph(graph)));
        parameters_ = model.parameter_names();
        bounces_ = model.file().transport.bounces;
        if (which.ladder.size() > 1 && which.scenes.empty() && sets(which.ladder.front()) == sets(which.ladder.back()))
            throw Error("the graph has none of the parameters that the ladder goes over");
    }

    double measure(double value) {
        const StabilityNames names = names_of_rung(which_, value, false, bounces_);
        switch (which_.quantity) {
        case StabilityQuantity::share: {
            const double whole = mean_of(picture(names_of_rung(which_, value, true, bounces_)));
            if (!(whole > 0)) throw Error("there is no light even with the names of 'against'");
            return mean_of(picture(names)) / whole;
        }
        case StabilityQuantity::difference:
            return difference(picture(names), picture(names_of_rung(which_, value, true, bounces_)));
        case StabilityQuantity::flicker:
        case StabilityQuantity::flip: {
            const std::unique_ptr<Session> session = open(names);
            const FlickerFigures figures = measure_flicker(*session, which_.resource, which_.frames);
            if (!(figures.mean > 0)) throw Error("there is no light");
            return which_.quantity == StabilityQuantity::flip ? figures.flip : figures.flicker;
        }
        case StabilityQuantity::mean:
            return mean_of(picture(names)) / expected_of(which_, names) - 1;
        case StabilityQuantity::time: {
            const std::unique_ptr<Session> session = open(names);
            render(*session);
            session->graph().finish_timings();
            return session->graph().frame_ms();
        }
        case StabilityQuantity::error:
        case StabilityQuantity::bias:
            break;
        }
        return against_reference(names);
    }

  private:
    ParameterValues sets(double rung) const {
        return sets_of_rung(which_, names_of_rung(which_, rung, false, bounces_), parameters_);
    }

    /// The case's settings count more than the graph's own.
    ParameterValues all_sets(const StabilityNames& names) const {
        ParameterValues all(own_.sets.begin(), own_.sets.end());
        for (auto& set : sets_of_rung(which_, names, parameters_))
            all.push_back(std::move(set));
        return all;
    }

    std::unique_ptr<Session> open(const StabilityNames& names) {
        SessionOptions options;
        options.shot = write_rung(which_, names, folder_.path());
        options.graph = graph_;
        options.size = which_.size;
        options.sets = all_sets(names);
        options.switches.assign(own_.switches.begin(), own_.switches.end());
        if (which_.resource.find('+') == std::string::npos) options.resource = which_.resource;
        auto session = std::make_unique<Session>(options);
        throw_if_broken(*session, which_.name);
        return session;
    }

    void render(Session& session) const {
        for (int frame = 0; frame < which_.frames; ++frame) {
            if (frame > 0) session.advance();
            session.render(true);
        }
        throw_if_broken(session, which_.name);
    }

    std::vector<float> picture(const StabilityNames& names) {
        const std::unique_ptr<Session> session = open(names);
        render(*session);
        std::vector<float> sum;
        for (const std::string& part : split(which_.resource, '+')) {
            // Of a sum, what the graph does not make is black.
            if (which_.resource != part && !session->graph().texture(part)) continue;
            const std::vector<float> values = luminance_of(*session, part);
            sum.resize(values.size());
            for (size_t i = 0; i < values.size(); ++i)
                sum[i] += values[i];
        }
        if (sum.empty()) throw Error("the graph makes no part of " + which_.resource);
        return sum;
    }

    static double difference(const std::vector<float>& picture, const std::vector<float>& other) {
        if (picture.size() != other.size()) throw Error("the two pictures have different sizes");
        double squares = 0;
        for (size_t i = 0; i < picture.size(); ++i)
            squares += std::pow(double(picture[i]) - other[i], 2);
        const double mean = mean_of(other);
        if (!(mean > 0)) throw Error("there is no light");
        return std::sqrt(squares / double(picture.size())) / mean;
    }

    double against_reference(const StabilityNames& names) {
        ErrorTableRow row;
        row.name = which_.name;
        row.shot = write_rung(which_, names, folder_.path());
        row.graph = graph_;
        row.resource = which_.resource;
        row.sets = all_sets(names);
        row.switches.assign(own_.switches.begin(), own_.switches.end());
        row.size = which_.size;
        row.frames = which_.frames;
        row.samples = which_.samples;
        row.diffuse_only = which_.diffuse_only;
        const ErrorTableMeasured measured = measure_row(row, [](const std::string&) {});
        if (!measured.skipped.empty()) throw Error(measured.skipped);
        const double figure =
            measured.errors[which_.quantity == StabilityQuantity::bias ? "bias" : "relative_rmse_denoised"];
        if (!std::isfinite(figure)) throw Error("what the graph models has none of this light");
        return figure;
    }

    const StabilityCase& which_;
    std::string graph_;
    Variant own_;
    std::vector<std::string> parameters_;
    int bounces_ = -1;
    TemporaryFolder folder_;
};

StabilityMeasurement::StabilityMeasurement(const StabilityCase& which, const std::string& graph, const Variant& own)
    : which_(which), rungs_(std::make_unique<Rungs>(which_, graph, own)) {}

StabilityMeasurement::~StabilityMeasurement() = default;

void StabilityMeasurement::step() {
    curve_.push_back(rungs_->measure(which_.ladder[curve_.size()]));
}

double summary_of(StabilitySummary summary, const std::vector<double>& curve) {
    switch (summary) {
    case StabilitySummary::first:
        return curve.front();
    case StabilitySummary::last:
        return curve.back();
    case StabilitySummary::growth:
        return curve.back() / curve.front();
    case StabilitySummary::worst:
        break;
    }
    return *std::max_element(curve.begin(), curve.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
}

StabilityCell measure_stability(const StabilityCase& which, const std::string& graph, const Variant& own) {
    StabilityCell cell;
    cell.graph = graph;
    const auto start = std::chrono::steady_clock::now();
    set_shader_errors_logged(false);
    try {
        StabilityMeasurement measurement(which, graph, own);
        while (!measurement.done()) {
            measurement.step();
            cell.curve = measurement.curve();
        }
        cell.figure = summary_of(which.summary, cell.curve);
        cell.reached = std::abs(*cell.figure) <= which.most;
    } catch (const Error& error) {
        cell.failure = error.what();
    }
    cell.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return cell;
}

static std::string key_of(const StabilityCase& which, const std::string& graph_digest, const Variant& own) {
    Digest digest;
    digest.add(origin_here().commit).add(which.text).add(own.text()).add(graph_digest);
    return fmt::format("{:016x}", digest.value());
}

static const StabilityCell* find_cell(const std::vector<StabilityRow>& rows, const StabilityCase& which,
                                      const std::string& graph, const std::string& key) {
    for (const StabilityRow& row : rows)
        for (const StabilityCell& cell : row.cells)
            if (row.which.name == which.name && cell.graph == graph && cell.key == key) return &cell;
    return nullptr;
}

std::vector<StabilityRow> run_stability(const StabilitySuite& suite,
                                        const std::function<void(const std::vector<StabilityRow>&, bool)>& done) {
    std::vector<StabilityRow> rows;
    ContentReader reader;
    for (const StabilityCase& which : suite.cases) {
        rows.push_back({which, {}});
        for (const std::string& graph : suite.graphs) {
            const std::string key = key_of(which, reader.graph_digest(graph), suite.own);
            const StabilityCell* known = find_cell(suite.known, which, graph, key);
            rows.back().cells.push_back(known ? *known : measure_stability(which, graph, suite.own));
            rows.back().cells.back().key = key;
            done(rows, known != nullptr);
        }
    }
    return rows;
}

} // namespace bounce
