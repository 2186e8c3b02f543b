#include "graph/plan_memory.h"

#include "core/limits.h"
#include "core/memory.h"
#include "core/text.h"
#include "gpu/capabilities.h"
#include "gpu/device_memory.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace bounce {

namespace {

/// What is to become smaller, of a plan.
using Measure = std::function<double(const Plan&)>;

class Remedy {
  public:
    Remedy(GraphModel& model, const SceneFacts& facts, const Plan& plan) : model_(model), facts_(facts), plan_(plan) {}

    /// "lower shadow_maps.resolution (2048): at half of it there would be 1.00 GiB": the whole number of the graph
    /// whose half makes least of `measure`, or else the size.
    std::string text(const Measure& measure, const std::function<std::string(double)>& shown) {
        best_ = measure(plan_);
        const double before = best_;
        try_set("graph", model_.graph_parameters(), measure);
        for (const auto& node : model_.nodes())
            if (plan_has(node->id())) try_set(node->id(), node->parameters, measure);
        if (double at_half = measured(plan_.size / 2, measure); at_half < best_) {
            best_ = at_half;
            name_ = "the size";
            value_ = fmt::format("{}x{}", plan_.size.x, plan_.size.y);
        }
        if (best_ < before) return fmt::format("lower {} ({}): half of it would need {}", name_, value_, shown(best_));
        return facts_.lights() > 1
                   ? fmt::format("use fewer lights ({}; a point light counts six times)", facts_.lights())
                   : std::string("use a smaller graph or scene");
    }

  private:
    bool plan_has(const std::string& id) const {
        return std::any_of(plan_.passes.begin(), plan_.passes.end(),
                           [&](const PlanPass& pass) { return pass.id == id; });
    }

    double measured(glm::ivec2 size, const Measure& measure) const {
        try {
            return measure(model_.plan(facts_, glm::max(size, glm::ivec2(1))));
        } catch (const Error&) {
            return std::numeric_limits<double>::infinity(); // no plan at all with this value
        }
    }

    void try_set(const std::string& id, ParameterSet& set, const Measure& measure) {
        for (Parameter& p : set.all()) {
            if (p.info.kind != ParameterKind::integer) continue;
            const ParameterValue value = p.value;
            const ParameterOrigin origin = p.origin;
            const int half = std::get<int>(value) / 2;
            if (half < 1 || half < p.info.min || half > p.info.max) continue;
            set.set(p.info.name, half, origin);
            if (const double with_half = measured(plan_.size, measure); with_half < best_) {
                best_ = with_half;
                name_ = id + "." + p.info.name;
                value_ = std::to_string(std::get<int>(value));
            }
            set.set(p.info.name, value, origin);
        }
    }

    GraphModel& model_;
    const SceneFacts& facts_;
    const Plan& plan_;
    double best_ = 0;
    std::string name_, value_;
};

/// The side of a texture that is above the driver's limit: its length, or 0 when all fit.
struct TooLong {
    const char* side = "";
    int64_t length = 0;
    int64_t most = 0;
    int axis = 0; ///< of the size
};

TooLong too_long(const TextureDesc& desc) {
    const bool volume = desc.kind == TextureKind::texture_3d;
    const int64_t side = driver_limit(volume ? GL_MAX_3D_TEXTURE_SIZE : GL_MAX_TEXTURE_SIZE);
    const int64_t depth = volume                                       ? side
                          : desc.kind == TextureKind::texture_2d_array ? driver_limit(GL_MAX_ARRAY_TEXTURE_LAYERS)
                                                                       : 1;
    if (desc.size.x > side) return {"wide", desc.size.x, side, 0};
    if (desc.size.y > side) return {"high", desc.size.y, side, 1};
    if (desc.size.z > depth) return {volume ? "deep" : "layers", desc.size.z, depth, 2};
    return {};
}

} // namespace

void check_plan_fits(GraphModel& model, const SceneFacts& facts, const Plan& plan, uint64_t held) {
    for (const PlanResource& resource : plan.resources) {
        if (resource.is_buffer()) continue;
        const TooLong too = too_long(resource.texture);
        if (too.length == 0) continue;
        const std::string name = resource.name();
        const Measure longest = [&](const Plan& other) {
            const PlanResource* same = other.find_resource(name);
            return same ? double(same->texture.size[too.axis]) : 0.0;
        };
        const std::string remedy =
            Remedy(model, facts, plan).text(longest, [&](double length) { return grouped(uint64_t(length)); });
        throw Error(fmt::format("graph '{}': '{}' would be {} {}; this driver allows {}: {}", model.file().name, name,
                                grouped(uint64_t(too.length)), too.side, grouped(uint64_t(too.most)), remedy));
    }
    const double needed = double(plan.total_bytes()) - double(held);
    const uint64_t free = available_device_memory();
    if (needed <= double(free)) return;
    const auto largest = std::max_element(plan.resources.begin(), plan.resources.end(),
                                          [](auto& a, auto& b) { return a.total_bytes() < b.total_bytes(); });
    const std::string remedy = Remedy(model, facts, plan)
                                   .text([](const Plan& other) { return double(other.total_bytes()); },
                                         [](double bytes) { return format_bytes(bytes) + " in all"; });
    throw Error(fmt::format("graph '{}' needs {} of memory at {}x{} ('{}' alone {}), but {} are free: {}",
                            model.file().name, format_bytes(needed), plan.size.x, plan.size.y, largest->name(),
                            format_bytes(double(largest->total_bytes())), format_bytes(double(free)), remedy));
}

} // namespace bounce
