#include "core/limits.h"

#include "core/json_text.h"

#include <fmt/format.h>

namespace bounce {

static uint64_t g_max_texture_pixels = k_max_texture_pixels;

uint64_t max_texture_pixels() {
    return g_max_texture_pixels;
}

void set_max_texture_pixels(uint64_t pixels) {
    g_max_texture_pixels = pixels;
}

std::string grouped(uint64_t number) {
    std::string text = std::to_string(number);
    for (long at = long(text.size()) - 3; at > 0; at -= 3)
        text.insert(size_t(at), ",");
    return text;
}

/// "16 MiB": limits in bytes are whole powers of two.
static std::string bytes_text(uint64_t bytes) {
    return bytes >> 30 ? fmt::format("{} GiB", bytes >> 30) : fmt::format("{} MiB", bytes >> 20);
}

std::vector<LimitRow> limit_rows() {
    const std::string refused = "refused before it is read";
    return {
        {"side of a picture, texture or environment", fmt::format("{} pixels", grouped(k_max_picture_side)),
         "refused; before decoding"},
        {"pixels of all textures of a scene", grouped(k_max_texture_pixels),
         "refused before decoding; `--max-texture` sets another limit"},
        {"pixels of an image for each of its bytes", "PNG 8,256, JPEG 512, BMP and TGA 64",
         "refused before decoding: cut off, or a false header"},
        {"values of an OpenEXR file", grouped(k_max_exr_floats), "refused before decoding"},
        {"values of an OpenEXR file for each of its bytes", grouped(k_max_exr_floats_per_byte),
         "refused before decoding"},
        {"pixels of a reference", grouped(uint64_t(k_max_reference_pixels)), "refused before rendering"},
        {"frames of a run", grouped(k_max_frames), "refused before rendering"},
        {"combinations of a sweep", grouped(k_max_sweep_points), "refused before they are made"},
        {"a shot, graph, sweep, table or point", bytes_text(k_max_json_text), refused},
        {"an image file", bytes_text(k_max_image_bytes), refused},
        {"a .gltf or .glb", bytes_text(k_max_scene_bytes), refused},
        {"a buffer of a scene", bytes_text(k_max_buffer_bytes), refused},
        {"an OpenEXR file", bytes_text(k_max_exr_bytes), refused},
        {"a state of a reference in the cache", bytes_text(k_max_state_bytes), "rendered anew"},
        {"levels of nested JSON", grouped(k_max_json_depth), "refused while it is parsed"},
        {"values in a JSON file; of a large scene", grouped(k_max_json_values) + "; " + grouped(5 * k_max_json_values),
         "refused while it is parsed"},
        {"vertices of a scene", grouped(k_max_vertices), "refused before they are made"},
        {"vertices of a scene for each byte of its buffers",
         fmt::format("{}, and {} besides", k_max_vertices_per_byte, grouped(k_max_free_vertices)),
         "refused before they are made"},
        {"triangles of a scene", grouped(k_max_indices / 3), "refused before they are made"},
        {"elements that a scene's primitives read", grouped(k_max_elements_read), "refused before they are read"},
        {"elements of an accessor without bytes", grouped(k_max_zero_elements), "refused before they are made"},
        {"primitives drawn", grouped(k_max_instances), "refused before they are made"},
        {"keys of a scene's animations", grouped(k_max_animation_keys), "refused before they are read"},
        {"memory of a scene, graph or reference", "what the machine, control group or ulimit leaves",
         "refused before it is taken, from an estimate that names what to lower"},
        {"lights", "what the driver's layers of a texture allow: a point light has six shadow maps, others one",
         "refused before a frame is rendered"},
        {"sizes and layers of textures, buffers, work groups", "what the driver allows",
         "refused before a frame is rendered"},
    };
}

std::string limits_markdown() {
    std::string out = "| what | at most | beyond |\n| --- | --- | --- |\n";
    for (const LimitRow& row : limit_rows())
        out += fmt::format("| {} | {} | {} |\n", row.what, row.limit, row.beyond);
    return out;
}

} // namespace bounce
