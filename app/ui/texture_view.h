#pragma once
// A picture of any texture of the graph: one mip of one layer or slice, one channel or all, mapped from a range to 8
// bits.

#include "app/ui/panel_context.h"
#include "gpu/program.h"

#include <map>
#include <memory>

namespace bounce {

/// What the viewport shows: ui.hovered, else ui.pinned, else ui.viewer.resource, else out.display; the first of them
/// that is a texture of the graph. The settings are ui.viewer's where it is meant for that texture, else
/// default_view(). `resource` is empty when the graph has none of them.
ViewerSettings shown_view(const Graph& graph, const UiState& ui);

/// Keeps a texture in the viewport, shown by default_view(); "" lets go of what was there.
void pin(UiState& ui, const Graph& graph, const std::string& resource);

/// Settings that show a texture usefully: out.display as it is, normals from −1 to 1, radiance from 0 to 1 with the
/// sRGB curve, depth, integers and single channels over the range that they have.
ViewerSettings default_view(const std::string& resource, const TextureDesc& desc);

/// Mip, layer and channel brought to what the texture has.
ViewerSettings clamp_view(ViewerSettings settings, const TextureDesc& desc);

inline constexpr int k_histogram_steps = 64;

class TextureView {
  public:
    TextureView();

    /// Draws `source` into an rgba8 picture of the mip's size, magnified without interpolation, row 0 first. Valid
    /// until the next call; mip and layer are clamped. Throws Error when a shader of ours does not compile.
    /// The first three channels are multiplied by `scale` first (Session::value_scale).
    const GpuTexture& draw(const GpuTexture& source, const ViewerSettings& settings, float scale = 1);
    const GpuTexture& picture() const { return picture_; }

    /// The values that were black and white in the last picture (those found, with an automatic range). Stalls.
    glm::vec2 range() const;
    /// How many of its texels were not finite, in what was shown. Known with an automatic range only. Stalls.
    uint32_t non_finite() const;

    /// How many texels' values lie in each of k_histogram_steps equal steps of the last picture's range, as its curve
    /// has them, then below and above it; of several channels, their luminance. Stalls.
    std::vector<uint32_t> histogram(const GpuTexture& source, const ViewerSettings& settings);

  private:
    Program& program(const char* file, const TextureDesc& desc);
    void bind_source(const Program& program, const GpuTexture& source, const ViewerSettings& settings) const;
    void find_range(const GpuTexture& source, const ViewerSettings& settings);

    std::map<std::string, std::unique_ptr<Program>> programs_; ///< by file, kind and class of the texture
    Sampler sampler_;
    Buffer range_, histogram_;
    GpuTexture picture_;
    float scale_ = 1;
};

} // namespace bounce
