#include "graph/draw_starts.h"

namespace bounce {

ResourceDeclaration& declare_draw_starts(Declaration& d, const std::string& slot) {
    d.writes(slot, Usage::storage);
    return d.creates_buffer(slot, std::to_string(d.fact(&SceneFacts::instances) + 1), 4);
}

DrawStarts write_draw_starts(PassContext& c, const std::string& slot, const std::function<bool(const GpuDraw&)>& has) {
    std::vector<uint32_t> starts{0};
    for (const GpuDraw& draw : c.draws())
        starts.push_back(starts.back() + (!has || has(draw) ? draw.index_count / 3 : 0));
    const DrawStarts result{int(starts.size()) - 1, int(starts.back())};
    const Buffer& buffer = c.buffer(slot);
    // Facts may count more instances than this frame draws: what is left over repeats the end.
    starts.resize(buffer.bytes() / sizeof(uint32_t), starts.back());
    buffer.update(0, starts.size() * sizeof(uint32_t), starts.data());
    return result;
}

} // namespace bounce
