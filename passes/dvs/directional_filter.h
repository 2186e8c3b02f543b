#pragma once
// The directional volumes from a radiance volume (DVS, section VII): directional leaves or the first level of half the
// resolution, then the chain of mips.

#include "graph/context.h"

namespace bounce {

class DirectionalFilter {
  public:
    static void describe(PassDescription& description);
    /// Slots: dvs.filtered (the radiance volume) and dvs.directional.
    void declare(Declaration& declaration) const;
    void run(PassContext& context) const;
};

} // namespace bounce
