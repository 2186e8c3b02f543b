#include "scene/extent_pieces.h"

#include <algorithm>

namespace bounce {

void ScenePieces::add_movers() {
    std::vector<Mover> movers;
    std::vector<ScenePiece> parts;
    for (size_t n = 0; n < scene_.nodes.size(); ++n) {
        if (scene_.nodes[n].mesh < 0 || !scene_.nodes[n].dynamic) continue;
        for (const Primitive& primitive : scene_.meshes[size_t(scene_.nodes[n].mesh)].primitives)
            add_parts(n, primitive, movers, parts);
    }
    if (movers.empty()) return;
    std::vector<bool> started(movers.size(), false);
    visit_motion(scene_, movers, [&](size_t m, const Bounds& box, size_t times) {
        ScenePiece piece = parts[m];
        piece.box = box;
        piece.area /= double(times), piece.emission /= double(times), piece.triangles /= double(times);
        piece.later = started[m];
        started[m] = true;
        moving_.push_back(piece);
    });
}

void ScenePieces::add_parts(size_t node, const Primitive& primitive, std::vector<Mover>& movers,
                            std::vector<ScenePiece>& parts) const {
    std::vector<std::pair<uint32_t, ScenePiece>> triangles;
    each_triangle(primitive, worlds_[node],
                  [&](uint32_t first, const ScenePiece& piece) { triangles.emplace_back(first, piece); });
    PieceSum all, core; // by rule 1, for the mesh alone
    for (const auto& [first, piece] : triangles)
        all.add(piece);
    float limit = k_spanning_share * longest_edge(all.box);
    for (const auto& [first, piece] : triangles)
        if (piece.reach < limit) core.add(piece);
    bool split = core.triangles > 0 && all.triangles - core.triangles <= k_few_strays * all.triangles &&
                 longest_edge(core.box) * k_collapse <= longest_edge(all.box);
    std::vector<uint32_t> used[2];
    ScenePiece sums[2];
    for (const auto& [first, piece] : triangles) {
        size_t part = split && !(piece.reach < limit);
        for (uint32_t k = 0; k < 3; ++k)
            used[part].push_back(scene_.indices[primitive.first_index + first + k]);
        sums[part].area += piece.area, sums[part].emission += piece.emission, sums[part].triangles += 1;
        sums[part].reach = std::max(sums[part].reach, piece.reach);
    }
    for (size_t part = 0; part < 2; ++part) {
        if (used[part].empty()) continue;
        sums[part].moving = true;
        movers.push_back({node, points_of(scene_, std::move(used[part]))});
        parts.push_back(sums[part]);
    }
}

} // namespace bounce
