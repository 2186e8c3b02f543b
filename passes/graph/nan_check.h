#pragma once
// Counts values that are not finite in a texture.

#include "gpu/objects.h"
#include "gpu/program.h"

#include <memory>

namespace bounce {

class NanCheck {
  public:
    NanCheck();
    /// NaN and infinite components of mip 0 (buffers are not looked at). Stalls.
    uint64_t count(const GpuTexture& texture);

  private:
    std::unique_ptr<Program> programs_[3]; ///< by TextureKind
    Buffer counter_;
};

} // namespace bounce
