#pragma once
// What Bounce reads and makes at most. A file may say anything of itself, so nothing is allocated from what it says
// before one of these has bounded it. Messages and the table of `bounce table limits` follow from them.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bounce {

// --- pictures ---
constexpr int k_max_picture_side = 16384; ///< pixels; what every OpenGL 4.6 driver takes
/// Pixels of all textures of a scene together, unless --max-texture says otherwise: 1 GiB of RGBA8.
constexpr uint64_t k_max_texture_pixels = uint64_t(16384) * 16384;
constexpr size_t k_max_exr_floats = size_t(1) << 29; ///< 2 GiB
/// Floats for each byte of an OpenEXR file: more than any of its compressions reaches.
constexpr size_t k_max_exr_floats_per_byte = 10000;
constexpr int64_t k_max_reference_pixels = int64_t(1) << 27;
constexpr int k_max_frames = 1000000;
constexpr size_t k_max_sweep_points = 100000; ///< combinations of a sweep's values

// --- bytes of a file ---
constexpr uint64_t k_max_image_bytes = uint64_t(1) << 30;
constexpr uint64_t k_max_scene_bytes = uint64_t(2) << 30;  ///< a .gltf or .glb
constexpr uint64_t k_max_buffer_bytes = uint64_t(2) << 30; ///< a buffer of a scene; the parser counts in an int
constexpr uint64_t k_max_exr_bytes = uint64_t(4) << 30;
constexpr uint64_t k_max_state_bytes = uint64_t(64) << 30; ///< the samples that a reference keeps

// --- scenes: a file may use the same bytes many times, so its size does not bound what it unfolds to ---
constexpr size_t k_max_vertices = size_t(1) << 25; ///< 2 GiB of them, which is what drivers address
constexpr size_t k_max_vertices_per_byte = 16;     ///< of the scene's buffers, beyond a first million
constexpr size_t k_max_free_vertices = size_t(1) << 20;
constexpr size_t k_max_indices = size_t(1) << 28;
constexpr size_t k_max_elements_read = size_t(1) << 29; ///< of accessors, in all
constexpr size_t k_max_zero_elements = size_t(1) << 20; ///< of an accessor without bytes behind it
constexpr size_t k_max_instances = size_t(1) << 22;
constexpr size_t k_max_animation_keys = size_t(1) << 24;

/// The value in force: k_max_texture_pixels, or what --max-texture said.
uint64_t max_texture_pixels();
void set_max_texture_pixels(uint64_t pixels);

/// A row of the table of limits.
struct LimitRow {
    std::string what;
    std::string limit;
    std::string beyond; ///< what happens
};
/// Every limit above, in its order.
std::vector<LimitRow> limit_rows();
/// "| limit | … |" as Markdown.
std::string limits_markdown();

/// "268,435,456".
std::string grouped(uint64_t number);

} // namespace bounce
