// Every graph of the tree has the memory barriers that it needs; and each that is taken away is missed, or told to be
// one that no command needed.
#include "core/asset_files.h"
#include "gpu/barrier.h"
#include "gpu/shader_order.h"
#include "support/stale_fixture.h"

#include <algorithm>
#include <iostream>

using namespace bounce;

namespace {

class Hazards : public StaleTest, public testing::WithParamInterface<std::string> {
  protected:
    using Events = std::vector<HazardCheck::Event>;

    /// The hazards of what was told, without its n-th barrier (−1: with all).
    static size_t hazards_without(const Events& events, int n) {
        HazardCheck check;
        for (const HazardCheck::Event& event : events) {
            if (!event.barrier)
                check.command(event.command);
            else if (n-- != 0)
                check.barrier(event.barrier, event.place);
        }
        return check.hazards().size();
    }
};

} // namespace

TEST_P(Hazards, EveryBarrierIsThereAndIsMissedWithoutIt) {
    SessionOptions given = options(GetParam());
    given.size = {16, 9};
    Session session(given);
    session.render(true);
    Events events;
    hazard_check().forget_barriers();
    hazard_check().trace = &events;
    session.render(true); // whose first commands follow the barrier that ends a frame
    session.render(true);
    hazard_check().trace = nullptr;
    const std::vector<HazardCheck::Barrier> barriers = hazard_check().barriers();
    ASSERT_FALSE(barriers.empty());
    EXPECT_EQ(hazards_without(events, -1), 0u);
    int needed = 0;
    for (size_t i = 0; i < barriers.size(); ++i) {
        const size_t hazards = hazards_without(events, int(i));
        EXPECT_EQ(hazards > 0, barriers[i].needed != 0) << barriers[i].place;
        needed += barriers[i].needed != 0;
    }
    std::cout << "    " << GetParam() << ": " << barriers.size() << " barriers in two frames, " << needed
              << " needed\n";
    for (const HazardCheck::Barrier& barrier : barriers)
        if (!barrier.needed)
            std::cout << "      not needed: " << barrier.place << " " << barrier_text(barrier.bits)
                      << (barrier.used ? " (doubled)" : "") << "\n";
}

TEST_P(Hazards, ShadersArgueTheOrderOfTheirInvocations) {
    SessionOptions given = options(GetParam());
    given.size = {16, 9};
    Session session(given);
    session.render(true);
    for (const auto& node : session.graph().model().nodes())
        for (const auto& program : node->programs)
            for (const ShaderSource& source : program->sources())
                for (const std::string& problem : order_problems(source))
                    ADD_FAILURE() << node->id() << ": " << problem;
}

INSTANTIATE_TEST_SUITE_P(Graphs, Hazards, testing::ValuesIn(asset_names("graphs")), [](auto& of) {
    std::string name = of.param;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
    return name;
});
