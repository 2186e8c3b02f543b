// The order of the passes, from what each reads and writes.
#include "core/text.h"
#include "graph/declared.h"

#include <algorithm>
#include <set>

namespace bounce {

std::vector<int> order_passes(const PlanDraft& draft, ErrorList& errors) {
    const std::vector<Declared>& passes = draft.passes;
    int n = int(passes.size());
    std::vector<std::set<int>> after(n); // after[i]: passes that must come before i
    for (const ResourceDeclaration& resource : draft.resources) {
        std::vector<int> writers, readers;
        for (int p = 0; p < n; ++p) {
            if (!passes[p].skipped.empty()) continue;
            bool writes = false, reads = false;
            for (size_t i = 0; i < passes[p].uses.size(); ++i) {
                if (passes[p].targets[i].resource != resource.name) continue;
                writes = writes || passes[p].uses[i].writes;
                reads = reads || (passes[p].uses[i].reads && !passes[p].targets[i].previous);
            }
            if (writes)
                writers.push_back(p);
            else if (reads)
                readers.push_back(p);
        }
        for (size_t i = 1; i < writers.size(); ++i)
            after[writers[i]].insert(writers[i - 1]);
        for (int reader : readers) {
            bool any_before = std::any_of(writers.begin(), writers.end(), [&](int w) { return w < reader; });
            for (int writer : writers) {
                if (writer < reader || !any_before)
                    after[reader].insert(writer);
                else
                    after[writer].insert(reader);
            }
        }
    }
    std::vector<int> order;
    std::vector<bool> done(n, false);
    size_t wanted = size_t(std::count_if(passes.begin(), passes.end(), [](auto& p) { return p.skipped.empty(); }));
    while (order.size() < wanted) {
        int next = -1;
        for (int p = 0; p < n && next < 0; ++p) {
            bool ready = !done[p] && passes[p].skipped.empty() &&
                         std::all_of(after[p].begin(), after[p].end(), [&](int before) { return done[before]; });
            if (ready) next = p;
        }
        if (next < 0) {
            std::vector<std::string> names;
            for (int p = 0; p < n; ++p) {
                if (!done[p] && passes[p].skipped.empty()) names.push_back(passes[p].node->id());
            }
            errors.add("these passes wait for each other in a circle: " + join(names, ", ") +
                       " (read last frame's copy with previous(name) to break it)");
            break;
        }
        done[next] = true;
        order.push_back(next);
    }
    return order;
}

} // namespace bounce
