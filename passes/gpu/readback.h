#pragma once
// A buffer's contents on the CPU some frames later, without waiting for the GPU.

#include "gpu/objects.h"

#include <cstddef>

namespace bounce {

class Readback {
  public:
    Readback() = default;
    ~Readback();
    Readback(const Readback&) = delete;
    Readback& operator=(const Readback&) = delete;

    /// Copies the whole buffer on the GPU's own time. While an earlier copy is on its way nothing is done.
    void request(const Buffer& source);
    bool pending() const { return fence_ != nullptr; }
    /// Whether a copy has arrived since the last call; data() is it then.
    bool arrived();
    const std::vector<std::byte>& data() const { return data_; }

  private:
    Buffer staging_;
    const void* mapped_ = nullptr;
    GLsync fence_ = nullptr;
    std::vector<std::byte> data_;
};

} // namespace bounce
