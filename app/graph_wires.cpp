#include "app/graph_wires.h"

#include "app/pass_rows.h"
#include "core/error.h"
#include "graph/declared.h"

#include <algorithm>
#include <map>
#include <set>

namespace bounce {

namespace {

struct Access {
    std::string resource;
    bool reads = false, writes = false, previous = false;
};

std::vector<Access> accesses_of(const PlanPass& pass) {
    std::vector<Access> all;
    for (const PlanSlot& slot : pass.slots)
        if (!slot.builtin)
            all.push_back(
                {slot.bind.resource, slot.use.reads, slot.use.writes && slot.resource >= 0, slot.bind.previous});
    return all;
}

/// A plan has no slots of skipped passes: they declare again.
std::map<std::string, std::vector<Access>> accesses_of_all(const GraphModel& model, const Plan& plan,
                                                           const SceneFacts& facts) {
    PlanDraft draft{model, facts, plan.size, {}, {}};
    ErrorList ignored; // told when it was planned
    declare_passes(draft, ignored);
    std::map<std::string, std::vector<Access>> all;
    for (const Declared& pass : draft.passes) {
        std::vector<Access>& list = all[pass.node->id()];
        for (size_t i = 0; i < pass.uses.size(); ++i)
            if (!is_builtin(pass.targets[i].resource))
                list.push_back(
                    {pass.targets[i].resource, pass.uses[i].reads, pass.uses[i].writes, pass.targets[i].previous});
    }
    for (const PlanPass& pass : plan.passes)
        all[pass.id] = accesses_of(pass);
    return all;
}

/// Rows that hold the newest content of a resource: one, unless several write parts of it.
struct Writer {
    int box, row;
};
using Writers = std::map<std::string, std::vector<Writer>>;

class Connection {
  public:
    Connection(GraphLayout& layout, std::map<std::string, std::vector<Access>> accesses)
        : layout_(layout), accesses_(std::move(accesses)) {
        for (LayoutBox& box : layout_.boxes)
            for (const Access& access : accesses_[box.id])
                if (access.writes &&
                    std::find(box.outputs.begin(), box.outputs.end(), access.resource) == box.outputs.end())
                    box.outputs.push_back(access.resource);
        for (int i = 0; i < int(layout_.boxes.size()); ++i)
            write(i, last_);
    }

    void connect() {
        for (int i = 0; i < int(layout_.boxes.size()); ++i) {
            for (const Access& access : accesses_[layout_.boxes[size_t(i)].id])
                if (access.reads) read(i, access);
            write(i, now_);
        }
    }

  private:
    bool skipped(int box) const { return layout_.boxes[size_t(box)].plan < 0; }

    void write(int box, Writers& writers) {
        const LayoutBox& from = layout_.boxes[size_t(box)];
        for (int row = 0; row < int(from.outputs.size()); ++row) {
            std::vector<Writer>& list = writers[from.outputs[size_t(row)]];
            // What it updates holds what the earlier ones wrote.
            const auto& accesses = accesses_[from.id];
            const bool updates = std::any_of(accesses.begin(), accesses.end(), [&](const Access& a) {
                return a.resource == from.outputs[size_t(row)] && a.reads && !a.previous;
            });
            if (updates && !skipped(box)) list.clear();
            list.push_back({box, row});
        }
    }

    void read(int box, const Access& access) {
        const bool made = !access.previous && now_.contains(access.resource);
        std::vector<Writer> writers = (made ? now_ : last_)[access.resource];
        const auto idle = [&](const Writer& writer) { return skipped(writer.box); };
        if (!skipped(box) && !std::all_of(writers.begin(), writers.end(), idle)) std::erase_if(writers, idle);
        for (const Writer& writer : writers) {
            // What it left itself in an earlier step stays in the box, and what is not read needs no way back.
            if (!made && ((writer.box == box && !access.previous) || skipped(box) || skipped(writer.box))) continue;
            const LayoutWire wire{
                access.resource, writer.box, writer.row, box, !made, skipped(box) || skipped(writer.box), {}};
            const bool there = std::any_of(layout_.wires.begin(), layout_.wires.end(), [&](const LayoutWire& other) {
                return other.from == wire.from && other.output == wire.output && other.to == wire.to &&
                       other.back == wire.back;
            });
            if (!there) layout_.wires.push_back(wire);
        }
    }

    GraphLayout& layout_;
    std::map<std::string, std::vector<Access>> accesses_;
    Writers now_, last_; ///< so far, and at the end of a frame
};

} // namespace

GraphLayout connect_graph(const GraphModel& model, const Plan& plan, const SceneFacts& facts, bool with_skipped) {
    GraphLayout layout;
    for (const PassRow& row : pass_rows(model, plan)) {
        if (row.plan < 0 && !with_skipped) continue;
        LayoutBox box;
        box.id = row.id, box.plan = row.plan, box.skipped = row.skipped;
        layout.boxes.push_back(box);
    }
    Connection(layout, accesses_of_all(model, plan, facts)).connect();
    return layout;
}

} // namespace bounce
