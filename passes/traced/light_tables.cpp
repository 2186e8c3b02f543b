// Tables by which emissive triangles and directions of the environment are drawn: triangles by power, directions by
// luminance. glsl/traced/light_tables.glsl reads them.
#include "core/error.h"
#include "graph/context.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace bounce {

namespace {

float luminance(const float* rgb) {
    return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

/// Running sums of weights as shares of their total, and each entry's own share. No weight at all: no entries.
struct Shares {
    std::vector<float> up_to, own;
    explicit Shares(const std::vector<float>& weights) {
        double total = 0;
        for (const float weight : weights)
            if (weight > 0 && std::isfinite(weight)) total += weight;
        if (!(total > 0)) return;
        double sum = 0;
        float before = 0;
        for (const float weight : weights) {
            if (weight > 0 && std::isfinite(weight)) sum += weight;
            up_to.push_back(std::min(float(sum / total), 1.0f));
            own.push_back(up_to.back() - before); // what is drawn, as floats have it
            before = up_to.back();
        }
    }
};

} // namespace

class LightTablesPass : public Pass {
  public:
    void describe(PassDescription& description) override {
        description.program("weights", {"traced/emitter_weights.comp"});
        description.constant("entries");
    }

    std::string skip_reason(const SceneFacts& facts) const override {
        return facts.emissive_materials || facts.environment ? ""
                                                             : "the scene has no emissive material and no environment";
    }

    void declare(Declaration& d) override {
        emissive_ = d.fact(&SceneFacts::emissive_materials) > 0;
        const auto most = int64_t(d.fact(&SceneFacts::triangles));
        capacity_ = emissive_ ? std::min(most, std::max<int64_t>(grown_, 65536)) : 0;
        draws_ = int64_t(d.fact(&SceneFacts::instances));
        // Directions: a map's texels are not known before it is seen; 64 × 32 of its regions at least.
        const int64_t words = k_header + draws_ + 4 * capacity_ + k_max_directions;
        d.creates_buffer("traced.light_tables", std::to_string(words), 4).overwritten = true;
        // Shaders go by whether it is there.
        if (emissive_)
            d.creates_buffer("traced.emitters", std::to_string(std::max<int64_t>(capacity_, 1)), 16).overwritten = true;
        d.creates_buffer("traced.table_counts", "2", 4).overwritten = true;
        for (const char* name : {"traced.light_tables", "traced.table_counts"})
            d.writes(name, Usage::storage);
        if (emissive_) d.uses("weights");
        d.counts("emissive triangles", "traced.table_counts", 0);
        d.counts("dropped emissive triangles", "traced.table_counts", 1, true);
    }

    bool needs_larger_buffers(const std::vector<int64_t>& counted) override {
        if (counted.size() < 2 || counted[1] <= 0) return false;
        grown_ = counted[0];
        return true;
    }

    void execute(PassContext& c) override {
        std::vector<uint32_t> words(k_header, 0);
        const uint32_t counts[2] = {emissive_ ? add_emitters(c, words) : 0, lacking_};
        add_directions(c, words);
        c.buffer("traced.light_tables").update(0, words.size() * sizeof(uint32_t), words.data());
        c.buffer("traced.table_counts").update(0, sizeof(counts), counts);
    }

  private:
    static constexpr int64_t k_header = 8;
    static constexpr int k_columns = 256, k_rows = 128; ///< of the environment's table, at most
    static constexpr int64_t k_max_directions = int64_t(k_columns) * k_rows;

    struct Emitter { // std430
        uint32_t draw, corner;
        float weight;
        uint32_t padding;
    };

    /// Words: 0 number of entries, 1 where each draw's first entry is told, 2 where entries are: four words each, share
    /// up to it, own share, draw, corner.
    uint32_t add_emitters(PassContext& c, std::vector<uint32_t>& words) {
        const std::vector<GpuDraw>& draws = c.draws();
        const std::vector<Material>& materials = c.materials();
        std::vector<Emitter> emitters;
        words[1] = uint32_t(words.size());
        for (uint32_t i = 0; i < draws.size(); ++i) {
            const bool emits = materials[draws[i].material].is_emissive();
            words.push_back(emits ? uint32_t(emitters.size()) : ~0u);
            for (uint32_t k = 0; emits && k + 2 < draws[i].index_count; k += 3)
                emitters.push_back({i, draws[i].first_index + k, 0, 0});
        }
        const auto found = uint32_t(emitters.size());
        lacking_ = found > uint64_t(capacity_) ? found - uint32_t(capacity_) : 0;
        if (lacking_ || emitters.empty()) return found;
        const Buffer& buffer = c.buffer("traced.emitters");
        buffer.update(0, emitters.size() * sizeof(Emitter), emitters.data());
        c.set("entries", int(found));
        c.dispatch("weights", {int(found), 1, 1});
        c.barrier();
        buffer.read(0, emitters.size() * sizeof(Emitter), emitters.data());
        std::vector<float> weights;
        for (const Emitter& emitter : emitters)
            weights.push_back(emitter.weight);
        const Shares shares(weights);
        words[0] = uint32_t(shares.up_to.size());
        words[2] = uint32_t(words.size());
        for (size_t i = 0; i < shares.up_to.size(); ++i)
            words.insert(words.end(), {std::bit_cast<uint32_t>(shares.up_to[i]), std::bit_cast<uint32_t>(shares.own[i]),
                                       emitters[i].draw, emitters[i].corner});
        return found;
    }

    /// Words: 3 columns, 4 rows (0: a constant environment, which is not drawn from), 5 where the shares up to each
    /// region are, row by row.
    static void add_directions(PassContext& c, std::vector<uint32_t>& words) {
        if (!c.frame(&FrameConstants::environment_map)) return;
        const GpuTexture& map = c.environment();
        const glm::ivec2 size(map.desc().size), regions = glm::min(size, glm::ivec2(k_columns, k_rows));
        const std::vector<float> texels = map.read();
        const size_t channels = texels.size() / (size_t(size.x) * size_t(size.y));
        // A region's largest texel and those around it: reading a map between texels spreads them, and whatever is
        // bright can be drawn. Half by their mean keeps bright points from drawing all around them alike.
        std::vector<float> weights;
        for (int row = 0; row < regions.y; ++row) {
            const float solid_angle =
                std::cos(k_pi * float(row) / float(regions.y)) - std::cos(k_pi * float(row + 1) / float(regions.y));
            for (int column = 0; column < regions.x; ++column) {
                const glm::ivec2 low = glm::ivec2(column, row) * size / regions - 1;
                const glm::ivec2 high = glm::ivec2(column + 1, row + 1) * size / regions + 1;
                float largest = 0, sum = 0;
                for (int y = low.y; y < high.y; ++y)
                    for (int x = low.x; x < high.x; ++x) {
                        const size_t at =
                            size_t(std::clamp(y, 0, size.y - 1)) * size_t(size.x) + size_t((x + size.x) % size.x);
                        const float value = luminance(&texels[at * channels]);
                        largest = std::max(largest, value);
                        sum += value;
                    }
                const glm::ivec2 width = high - low;
                weights.push_back(solid_angle * 0.5f * (largest + sum / float(width.x * width.y)));
            }
        }
        const Shares shares(weights);
        if (shares.up_to.empty()) return;
        words[3] = uint32_t(regions.x);
        words[4] = uint32_t(regions.y);
        words[5] = uint32_t(words.size());
        for (const float share : shares.up_to)
            words.push_back(std::bit_cast<uint32_t>(share));
    }

    static constexpr float k_pi = 3.14159265358979f;
    bool emissive_ = false;
    int64_t capacity_ = 0, draws_ = 0, grown_ = 0;
    uint32_t lacking_ = 0;
};

BOUNCE_REGISTER_PASS("light_tables", LightTablesPass,
                     "tables by which emissive triangles and directions of the environment are drawn")

} // namespace bounce
