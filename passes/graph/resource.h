#pragma once
// Resources as passes and graph files declare them: sizes may be expressions. Names have exactly one dot, and no
// underscore before it: `gbuffer.normal` is `gbuffer_normal` in GLSL.

#include "gpu/objects.h"

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

enum class ResourceKind { texture_2d, texture_2d_array, texture_3d, buffer };
const char* to_string(ResourceKind kind);

/// Width, height, depth (slices or layers) as expressions over `width`, `height` (the picture's), graph parameters,
/// pass parameters ("voxels.resolution") and other resources ("gbuffer.normal.width").
struct Extent {
    std::array<std::string, 3> parts{"width", "height", "1"};
    Extent() = default; ///< the picture's size
    Extent(int x, int y, int z = 1) : parts{std::to_string(x), std::to_string(y), std::to_string(z)} {}
    Extent(std::string x, std::string y, std::string z = "1") : parts{std::move(x), std::move(y), std::move(z)} {}
    /// The size of another resource, times `scale`, rounded up.
    static Extent relative_to(const std::string& resource, double scale = 1);
};

struct ResourceDeclaration {
    std::string name;
    ResourceKind kind = ResourceKind::texture_2d;
    std::string format = "rgba16f";
    Extent size;
    std::string mips = "1";  ///< expression, or "full"
    std::string count = "0"; ///< buffers: elements
    int stride = 4;          ///< buffers: bytes an element
    bool persistent = false; ///< not cleared between frames: its pass adds to what earlier frames left
    /// Not cleared between frames either; but its content follows from this frame's inputs alone, and what stands from
    /// earlier frames only saves work. It is reset when anything but the passing of frames changes it.
    bool incremental = false;
    bool overwritten = false; ///< every element is written each frame, so it need not be cleared first
    /// The first three channels are proportional to light: stored times FrameConstants::pre_exposure. holds_radiance()
    /// of the name unless said otherwise.
    bool radiance = false;
    glm::vec4 neutral{0};    ///< what consumers read when its pass is skipped; also the clear value
    std::string declared_by; ///< pass id or "graph file"
};

/// Whether a resource of this name is light when nothing else is said: any .radiance, .irradiance or .emission, and the
/// parts that make up out.radiance.
bool holds_radiance(const std::string& name);

/// Throws Error unless the name has exactly one dot, no underscore before it, and only letters, digits and underscores.
void check_resource_name(const std::string& name);

} // namespace bounce
