#pragma once
// An OpenGL context without a window, by EGL: devices first (a real GPU before a software one), then surfaceless.

#include "gpu/capabilities.h"

#include <memory>
#include <string>
#include <vector>

namespace bounce {

struct HeadlessDevice {
    int index = 0;
    std::string name; ///< "/dev/dri/card0", "software", …
    bool software = false;
};

/// EGL's devices, as --device N counts them.
std::vector<HeadlessDevice> list_headless_devices();

class HeadlessContext {
  public:
    /// Makes a robust OpenGL 4.6 core context current. `device` −1 chooses. Throws Error when there is none, or names
    /// what the driver lacks.
    explicit HeadlessContext(int device = -1);
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    /// A new context in the place of this one, whose objects are gone. Throws Error.
    void make_again();

    const Capabilities& capabilities() const { return capabilities_; }

  private:
    struct Egl;
    std::unique_ptr<Egl> egl_;
    Capabilities capabilities_;
};

} // namespace bounce
