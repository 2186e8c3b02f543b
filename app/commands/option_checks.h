#pragma once
// What option values must be. A refused one is told as "invalid --option 'value': expected …" before anything is done.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace bounce {

/// A finite number from `least` to `most`.
CLI::Validator number_between(double least, double most);
/// A whole number from `least` to `most`.
CLI::Validator whole_between(long long least, long long most);
/// WxH, each side from 1 to k_max_picture_side.
CLI::Validator picture_size();
/// Any text but the empty one.
CLI::Validator not_empty();
/// WxH, each side from 100.
CLI::Validator window_size();
/// WxH for pixels in all, each side from 1 to 65536.
CLI::Validator texture_pixels();
/// i/n with i = 0 … n − 1.
CLI::Validator shard();
/// An odd whole number from `least` to `most`.
CLI::Validator odd_between(int least, int most);
/// One of these.
CLI::Validator one_of(std::vector<std::string> names);
/// A limit of gpu/shader_limits.h, as private_bytes=262144.
CLI::Validator shader_limit();
/// --material-model of k_material_models.
void add_material_model_option(CLI::App& command, std::string& model);

/// The numbers of "1280x720" and of "2/8". Want what the checks above let pass.
glm::ivec2 parse_size(const std::string& text);
uint64_t parse_texture_pixels(const std::string& text);
std::pair<int, int> parse_shard(const std::string& text);

/// --device: which of `bounce --list-devices`.
void add_device_option(CLI::App& command, int& device);

} // namespace bounce
