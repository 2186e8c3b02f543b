#pragma once
// Shader text: includes expanded with a table from flat line to file and line (drivers' #line handling is unreliable,
// so none is emitted), parameters and slots read from the text before anything is compiled. No OpenGL calls.

#include "core/parameters.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bounce {

enum class ShaderStage { vertex, geometry, fragment, compute };
/// By extension: .vert .geom .frag .comp. Throws Error for others.
ShaderStage stage_of(const std::filesystem::path& file);

/// One thing that is wrong with a shader, as a row of the Shaders panel shows it.
struct ShaderError {
    std::filesystem::path file; ///< relative to the glsl folder where possible
    int line = 0;               ///< 1-based; 0 = the file as a whole
    std::string source_line;
    std::string message; ///< the driver's words, or ours
    std::string text() const;
};

enum class SlotKind { sampled, image, storage };

/// An opaque uniform or storage block of a shader. `gbuffer_normal` in GLSL is the slot "gbuffer.normal": the first
/// underscore is the dot.
struct ShaderSlot {
    std::string identifier; ///< as in GLSL
    std::string name;       ///< with the dot
    SlotKind kind = SlotKind::sampled;
    std::string type; ///< "sampler2D", "uimage3D"; empty for storage blocks
    bool reads = true;
    bool writes = false;
    bool optional = false; ///< "//! optional": a neutral value is read when nothing produces it (see slot_note.h)
    std::optional<glm::vec4> neutral; ///< "//! neutral 1"
    std::string required_if;          ///< "//! optional unless EXPRESSION"
    std::string from, from_mip,
        from_layer;      ///< "//! from group.name mip iteration": its source unless the graph binds one
    std::string ordered; ///< "//! ordered: REASON": why invocations that read and write it do not meet
    bool certain = true; ///< false inside an #if whose outcome only the compiler knows
    std::string where;   ///< "glsl/x.comp:12"
};
/// "gbuffer_normal" ↔ "gbuffer.normal".
std::string slot_name(const std::string& identifier);
std::string slot_identifier(const std::string& name);

struct SourceLocation {
    int file = 0; ///< index into ShaderSource::files
    int line = 0; ///< 1-based
};

struct ShaderSource {
    std::string text;                           ///< complete GLSL, with #version
    std::vector<std::filesystem::path> files;   ///< closure: the stage file first, then includes in order
    std::vector<std::filesystem::path> missing; ///< includes that were not found (watched for their appearance)
    std::vector<SourceLocation> lines;          ///< per flat line of `text` (0-based); line 0 = ours
    std::vector<ParameterInfo> parameters;      ///< of enumerations the values have names: `visibility_cones` is 1
    std::vector<ShaderSlot> slots;
    std::vector<ShaderError> errors; ///< missing files, malformed //! lines
};

using Defines = std::map<std::string, std::string>;

/// The value as a GLSL expression, for //! static parameters.
std::string static_literal(const ParameterInfo& info, const ParameterValue& value);

/// Expands a stage. `folder` is the glsl folder: includes are looked up beside the including file, then in it. A file
/// is included once a stage. `static_values`: GLSL literals for //! static parameters by name (their default when
/// absent). Never throws for bad shaders: see `errors`.
ShaderSource expand_shader(const std::filesystem::path& file, const std::filesystem::path& folder,
                           const Defines& defines, const Defines& static_values);

/// Translates a driver's log: Mesa "0:12(5): error: …", NVIDIA "0(12) : error …", AMD and Intel "ERROR: 0:12: …".
std::vector<ShaderError> translate_log(const std::string& log, const ShaderSource& source,
                                       const std::filesystem::path& folder);
/// The same for a program's log, when its stages do not link: what the driver says of a stage is told with its file,
/// and with the line where one is given; the rest with the first stage's file. Never empty.
std::vector<ShaderError> translate_link_log(const std::string& log, const std::vector<ShaderSource>& stages,
                                            const std::filesystem::path& folder);

} // namespace bounce
