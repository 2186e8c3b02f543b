#include "gpu/program.h"

#include "core/digest.h"
#include "core/log.h"
#include "gpu/call_watch.h"
#include "gpu/objects.h"
#include "gpu/shader_limits.h"
#include "gpu/shader_order.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace bounce {

Program::Program(std::string name, std::vector<std::filesystem::path> stages, std::filesystem::path folder)
    : name_(std::move(name)), stages_(std::move(stages)), folder_(std::move(folder)) {}

Program::~Program() {
    destroy();
}

void Program::destroy() {
    if (!id_) return;
    glDeleteProgram(id_);
    --live_objects().programs;
    id_ = 0;
}

void Program::disable(std::string why) {
    destroy();
    made_of_.clear();
    disabled_ = true;
    up_to_date_ = false;
    why_disabled_ = std::move(why);
}

void Program::release() {
    if (!id_) made_of_.clear(); // nothing to be made again
    destroy();
}

void Program::restore() {
    const std::vector<ShaderSource> sources = made_of_;
    if (!sources.empty()) make(sources, {}); // another driver may refuse it: then it is built as if for the first time
}

void Program::recall(std::vector<ShaderError> errors) {
    errors_ = std::move(errors);
    up_to_date_ = errors_.empty() && usable();
}

void Program::scan(const Defines& defines, const Defines& static_values) {
    if (scanned_ && defines == defines_ && static_values == static_values_) return;
    scanned_ = true;
    defines_ = defines;
    static_values_ = static_values;
    sources_.clear();
    files_.clear();
    auto last_parameters = std::exchange(parameters_, {});
    auto last_slots = std::exchange(slots_, {});
    errors_.clear();
    up_to_date_ = false;
    auto add_once = [](auto& list, const auto& item, auto key) {
        bool known = std::any_of(list.begin(), list.end(), [&](const auto& i) { return key(i) == key(item); });
        if (!known) list.push_back(item);
    };
    for (const auto& stage : stages_) {
        sources_.push_back(expand_shader(stage, folder_, defines, static_values));
        const ShaderSource& source = sources_.back();
        auto same = [](const auto& i) { return i; };
        for (const auto& file : source.files)
            add_once(files_, file, same);
        for (const auto& file : source.missing)
            add_once(files_, file, same);
        for (const auto& parameter : source.parameters)
            add_once(parameters_, parameter, [](auto& p) { return p.name; });
        for (const auto& slot : source.slots)
            add_once(slots_, slot, [](auto& s) { return s.identifier; });
        errors_.insert(errors_.end(), source.errors.begin(), source.errors.end());
    }
    if (errors_.empty()) {
        read_once_ = true;
    } else if (read_once_) {
        parameters_ = std::move(last_parameters);
        slots_ = std::move(last_slots);
    }
}

static GLenum gl_stage(ShaderStage stage) {
    switch (stage) {
    case ShaderStage::vertex:
        return GL_VERTEX_SHADER;
    case ShaderStage::geometry:
        return GL_GEOMETRY_SHADER;
    case ShaderStage::fragment:
        return GL_FRAGMENT_SHADER;
    case ShaderStage::compute:
        return GL_COMPUTE_SHADER;
    }
    return 0;
}

static std::string shader_log(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, length, &length, log.data());
    log.resize(size_t(std::max(length, 0)));
    return log;
}

static std::string program_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, length, &length, log.data());
    log.resize(size_t(std::max(length, 0)));
    return log;
}

static std::string resource_name(GLuint program, GLenum kind, GLuint index) {
    const GLenum wanted = GL_NAME_LENGTH;
    GLint capacity = 1;
    glGetProgramResourceiv(program, kind, index, 1, &wanted, 1, nullptr, &capacity);
    std::string text(size_t(std::max(capacity, 1)), '\0');
    GLsizei length = 0;
    glGetProgramResourceName(program, kind, index, capacity, &length, text.data());
    text.resize(size_t(length));
    if (text.ends_with("[0]")) text.resize(text.size() - 3);
    return text;
}

static bool is_sampler(GLenum t) {
    switch (t) {
    case GL_SAMPLER_1D:
    case GL_SAMPLER_2D:
    case GL_SAMPLER_3D:
    case GL_SAMPLER_CUBE:
    case GL_SAMPLER_2D_ARRAY:
    case GL_SAMPLER_2D_SHADOW:
    case GL_SAMPLER_2D_ARRAY_SHADOW:
    case GL_INT_SAMPLER_2D:
    case GL_INT_SAMPLER_3D:
    case GL_INT_SAMPLER_2D_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_SAMPLER_3D:
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
        return true;
    default:
        return false;
    }
}

static bool is_image(GLenum t) {
    return t >= GL_IMAGE_1D && t <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY;
}

static ProgramInterface reflect(GLuint program, bool compute) {
    ProgramInterface out;
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    GLint sampler_unit = 0, image_unit = 0;
    for (GLuint i = 0; i < GLuint(count); ++i) {
        const GLenum wanted[] = {GL_TYPE, GL_LOCATION, GL_BLOCK_INDEX, GL_ARRAY_SIZE};
        GLint values[4] = {};
        glGetProgramResourceiv(program, GL_UNIFORM, i, 4, wanted, 4, nullptr, values);
        if (values[2] != -1) continue; // inside a uniform block
        std::string name = resource_name(program, GL_UNIFORM, i);
        GLenum type = GLenum(values[0]);
        GLint array_size = std::max(1, values[3]);
        if (is_sampler(type) || is_image(type)) {
            GLint& unit = is_sampler(type) ? sampler_unit : image_unit;
            (is_sampler(type) ? out.samplers : out.images).push_back({name, type, unit, array_size});
            for (GLint element = 0; element < array_size; ++element) {
                glProgramUniform1i(program, values[1] + element, unit++);
            }
        } else {
            out.uniforms.push_back({name, type, values[1], array_size});
        }
    }
    glGetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < GLuint(count); ++i) {
        glShaderStorageBlockBinding(program, i, i);
        out.storage_blocks.push_back({resource_name(program, GL_SHADER_STORAGE_BLOCK, i), i});
    }
    glGetProgramInterfaceiv(program, GL_UNIFORM_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < GLuint(count); ++i) {
        glUniformBlockBinding(program, i, i);
        out.uniform_blocks.push_back({resource_name(program, GL_UNIFORM_BLOCK, i), i});
    }
    if (compute) glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, &out.local_size.x);
    return out;
}

bool Program::build(const std::function<std::vector<std::string>(const ProgramInterface&)>& check) {
    if (!errors_.empty()) return false;
    for (const ShaderSource& source : sources_) {
        errors_ = check_shader_limits(source, folder_); // before the driver sees it
        if (!errors_.empty()) return false;
    }
    errors_ = make(sources_, check);
    if (!errors_.empty()) return false;
    up_to_date_ = true;
    disabled_ = false;
    return true;
}

std::vector<ShaderError> Program::make(const std::vector<ShaderSource>& sources,
                                       const std::function<std::vector<std::string>(const ProgramInterface&)>& check) {
    std::vector<ShaderError> errors;
    GLuint program = glCreateProgram();
    std::vector<GLuint> shaders;
    bool compute = false;
    for (const ShaderSource& source : sources) {
        ShaderStage stage = stage_of(source.files.front());
        compute = compute || stage == ShaderStage::compute;
        GLuint shader = glCreateShader(gl_stage(stage));
        const char* text = source.text.c_str();
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        GLint good = 0;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
        if (!good) {
            std::vector<ShaderError> found = translate_log(shader_log(shader), source, folder_);
            if (found.empty())
                found.push_back({stages_[shaders.size()], 0, "", "does not compile (the driver does not say why)"});
            errors.insert(errors.end(), found.begin(), found.end());
        }
        glAttachShader(program, shader);
        shaders.push_back(shader);
    }
    if (errors.empty()) {
        glLinkProgram(program);
        GLint good = 0;
        glGetProgramiv(program, GL_LINK_STATUS, &good);
        if (!good) errors = translate_link_log(program_log(program), sources, folder_);
    }
    for (GLuint shader : shaders) {
        glDetachShader(program, shader);
        glDeleteShader(shader);
    }
    ProgramInterface found;
    if (errors.empty()) {
        found = reflect(program, compute);
        if (check) {
            for (const std::string& problem : check(found))
                errors.push_back({stages_.front(), 0, "", problem});
        }
    }
    if (!errors.empty()) {
        glDeleteProgram(program);
        return errors;
    }
    destroy();
    id_ = program;
    ++live_objects().programs;
    glObjectLabel(GL_PROGRAM, id_, -1, name_.c_str());
    interface_ = std::move(found);
    Digest text;
    for (const ShaderSource& source : sources)
        text.add(source.text);
    text_digest_ = text.value();
    order_problems_.clear();
    if (calls_are_watched()) {
        for (const ShaderSource& source : sources)
            for (std::string& problem : bounce::order_problems(source))
                order_problems_.push_back(std::move(problem));
        for (const std::string& problem : order_problems_)
            spdlog::warn("order: {}", problem);
    }
    made_of_ = sources;
    return {};
}

static bool scalar_type(GLenum type) {
    return type == GL_FLOAT || type == GL_INT || type == GL_UNSIGNED_INT || type == GL_BOOL;
}

bool uniform_takes(GLenum type, const ParameterValue& value) {
    switch (value.index()) {
    case 0:
        return type == GL_BOOL || type == GL_INT || type == GL_UNSIGNED_INT;
    case 1:
        return scalar_type(type);
    case 2:
        return type == GL_FLOAT;
    case 3:
        return type == GL_FLOAT_VEC2;
    case 4:
        return type == GL_FLOAT_VEC3;
    case 5:
        return type == GL_FLOAT_VEC4;
    }
    return false;
}

bool set_uniform(GLuint program, const UniformInfo& uniform, const ParameterValue& value) {
    if (!uniform_takes(uniform.type, value)) return false;
    GLint at = uniform.location;
    if (const auto* v = std::get_if<glm::vec2>(&value))
        glProgramUniform2fv(program, at, 1, &v->x);
    else if (const auto* v3 = std::get_if<glm::vec3>(&value))
        glProgramUniform3fv(program, at, 1, &v3->x);
    else if (const auto* v4 = std::get_if<glm::vec4>(&value))
        glProgramUniform4fv(program, at, 1, &v4->x);
    else if (const auto* f = std::get_if<float>(&value))
        glProgramUniform1f(program, at, *f);
    else {
        int i = std::holds_alternative<bool>(value) ? int(std::get<bool>(value)) : std::get<int>(value);
        if (uniform.type == GL_FLOAT)
            glProgramUniform1f(program, at, float(i));
        else if (uniform.type == GL_UNSIGNED_INT)
            glProgramUniform1ui(program, at, GLuint(i));
        else
            glProgramUniform1i(program, at, i);
    }
    return true;
}

} // namespace bounce
