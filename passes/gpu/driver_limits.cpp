#include "gpu/driver_limits.h"

#include "core/error.h"
#include "core/scanner.h"
#include "core/text.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>

namespace bounce {

namespace {

constexpr int64_t k_none = std::numeric_limits<int64_t>::max();

struct Pretended {
    bool minimum = false;
    std::map<GLenum, int64_t> values;
};

Pretended parse_pretended(const std::string& text, const char* from) {
    Pretended found;
    for (const std::string& part : split(text, ',')) {
        const std::string word(trim(part));
        if (word.empty()) continue;
        if (word == "minimum") {
            found.minimum = true;
            continue;
        }
        const size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        std::vector<std::string> names = {"minimum"};
        const DriverLimit* limit = nullptr;
        for (const DriverLimit& known : driver_limits()) {
            names.emplace_back(known.text);
            if (name == known.text) limit = &known;
        }
        if (!limit)
            throw Error(fmt::format("invalid {} '{}': expected minimum or NAME=N{}", from, shortened(word),
                                    did_you_mean(name, names)));
        int64_t value = 0;
        const char* end = word.data() + word.size();
        const char* begin = equals == std::string::npos ? end : word.data() + equals + 1;
        auto [stop, problem] = std::from_chars(begin, end, value);
        if (problem != std::errc() || stop != end || begin == end || value < 0)
            throw Error(
                fmt::format("invalid {} '{}': expected {}=N, a whole number from 0", from, shortened(word), name));
        found.values[limit->name] = value;
    }
    return found;
}

std::optional<Pretended>& given() {
    static std::optional<Pretended> pretended;
    return pretended;
}

const Pretended& pretended() {
    if (!given()) {
        const char* text = std::getenv("BOUNCE_LIMITS");
        given() = parse_pretended(text ? text : "", "BOUNCE_LIMITS");
    }
    return *given();
}

} // namespace

const std::vector<DriverLimit>& driver_limits() {
#define BOUNCE_LIMIT(name, minimum, is_needed)                                                                         \
    { name, #name, minimum, is_needed }
    static const std::vector<DriverLimit> limits = {
        BOUNCE_LIMIT(GL_MAX_TEXTURE_SIZE, 16384, true),
        BOUNCE_LIMIT(GL_MAX_3D_TEXTURE_SIZE, 2048, true),
        BOUNCE_LIMIT(GL_MAX_ARRAY_TEXTURE_LAYERS, 2048, true),
        // of a stage
        BOUNCE_LIMIT(GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS, 16, true),
        BOUNCE_LIMIT(GL_MAX_GEOMETRY_TEXTURE_IMAGE_UNITS, 16, true),
        BOUNCE_LIMIT(GL_MAX_TEXTURE_IMAGE_UNITS, 16, true),
        BOUNCE_LIMIT(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, 16, true),
        BOUNCE_LIMIT(GL_MAX_VERTEX_IMAGE_UNIFORMS, 0, false),
        BOUNCE_LIMIT(GL_MAX_GEOMETRY_IMAGE_UNIFORMS, 0, false),
        BOUNCE_LIMIT(GL_MAX_FRAGMENT_IMAGE_UNIFORMS, 8, true),
        BOUNCE_LIMIT(GL_MAX_COMPUTE_IMAGE_UNIFORMS, 8, true),
        BOUNCE_LIMIT(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 0, false),
        BOUNCE_LIMIT(GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS, 0, false),
        BOUNCE_LIMIT(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, 8, true),
        BOUNCE_LIMIT(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, 8, true),
        BOUNCE_LIMIT(GL_MAX_VERTEX_UNIFORM_BLOCKS, 14, false),
        BOUNCE_LIMIT(GL_MAX_GEOMETRY_UNIFORM_BLOCKS, 14, false),
        BOUNCE_LIMIT(GL_MAX_FRAGMENT_UNIFORM_BLOCKS, 14, false),
        BOUNCE_LIMIT(GL_MAX_COMPUTE_UNIFORM_BLOCKS, 14, false),
        BOUNCE_LIMIT(GL_MAX_VERTEX_UNIFORM_COMPONENTS, 1024, false),
        BOUNCE_LIMIT(GL_MAX_GEOMETRY_UNIFORM_COMPONENTS, 1024, false),
        BOUNCE_LIMIT(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS, 1024, false),
        BOUNCE_LIMIT(GL_MAX_COMPUTE_UNIFORM_COMPONENTS, 1024, false),
        BOUNCE_LIMIT(GL_MAX_GEOMETRY_OUTPUT_VERTICES, 256, false),
        // of a program
        BOUNCE_LIMIT(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 80, false),
        BOUNCE_LIMIT(GL_MAX_IMAGE_UNITS, 8, true),
        BOUNCE_LIMIT(GL_MAX_COMBINED_IMAGE_UNIFORMS, 8, false),
        BOUNCE_LIMIT(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 8, true),
        BOUNCE_LIMIT(GL_MAX_COMBINED_SHADER_STORAGE_BLOCKS, 8, false),
        BOUNCE_LIMIT(GL_MAX_COMBINED_SHADER_OUTPUT_RESOURCES, 8, false),
        BOUNCE_LIMIT(GL_MAX_DRAW_BUFFERS, 8, true),
        BOUNCE_LIMIT(GL_MAX_COLOR_ATTACHMENTS, 8, true),
        BOUNCE_LIMIT(GL_MAX_VIEWPORTS, 16, true),
        // sizes
        BOUNCE_LIMIT(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, int64_t(1) << 27, true),
        BOUNCE_LIMIT(GL_MAX_UNIFORM_BLOCK_SIZE, 16384, true),
        BOUNCE_LIMIT(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, 32768, true),
        BOUNCE_LIMIT(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, 1024, true),
        BOUNCE_LIMIT(GL_MAX_COMPUTE_WORK_GROUP_SIZE, 1024, false), // 64 along z
        BOUNCE_LIMIT(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 65535, false),
    };
#undef BOUNCE_LIMIT
    return limits;
}

std::string limit_name(GLenum name) {
    for (const DriverLimit& known : driver_limits())
        if (known.name == name) return known.text;
    return fmt::format("{:#x}", name);
}

static int64_t minimum_of(GLenum name, int axis) {
    if (name == GL_MAX_COMPUTE_WORK_GROUP_SIZE && axis == 2) return 64;
    for (const DriverLimit& known : driver_limits())
        if (known.name == name) return known.minimum;
    return k_none;
}

/// Limits that the present driver was asked for.
static std::map<std::pair<GLenum, int>, int64_t>& asked() {
    static std::map<std::pair<GLenum, int>, int64_t> known;
    return known;
}

void forget_driver() {
    asked().clear();
}

int64_t true_limit(GLenum name, int axis) {
    if (!glGetInteger64v) return k_none;
    const auto key = std::make_pair(name, axis);
    if (auto known = asked().find(key); known != asked().end()) return known->second;
    GLint64 value = 0;
    if (name == GL_MAX_COMPUTE_WORK_GROUP_SIZE || name == GL_MAX_COMPUTE_WORK_GROUP_COUNT)
        glGetInteger64i_v(name, GLuint(axis), &value);
    else
        glGetInteger64v(name, &value);
    return asked()[key] = value;
}

int64_t driver_limit(GLenum name, int axis) {
    const Pretended& limits = pretended();
    const int64_t value = true_limit(name, axis);
    if (auto own = limits.values.find(name); own != limits.values.end()) return std::min(value, own->second);
    return limits.minimum ? std::min(value, minimum_of(name, axis)) : value;
}

void pretend_limits(const std::string& text) {
    given() = parse_pretended(text, "--limits");
}

bool driver_has(std::string_view extension) {
    if (pretended().minimum) return false;
    if (!glGetStringi) return true;
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (extension == reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i)))) return true;
    return false;
}

} // namespace bounce
