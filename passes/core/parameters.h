#pragma once
// Parameters: declared once, where they are used; from there they reach the panel, --set, graph files, sweeps, image
// metadata and `bounce params`. A pass has one ParameterSet; C++ members are bound to it, shader ones live in it.

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace bounce {

enum class ParameterKind { boolean, integer, enumeration, real, vec2, vec3, vec4, colour };

/// boolean → bool; integer, enumeration → int; real → float; colour → vec3.
using ParameterValue = std::variant<bool, int, float, glm::vec2, glm::vec3, glm::vec4>;

/// Who set a value. Later ones win over earlier ones when a file is reloaded.
enum class ParameterOrigin { default_value, graph, command_line, panel };
const char* to_string(ParameterOrigin origin);

struct ParameterInfo {
    std::string name;
    ParameterKind kind = ParameterKind::real;
    ParameterValue default_value;
    double min = -std::numeric_limits<double>::infinity(); ///< each component, inclusive
    double max = std::numeric_limits<double>::infinity();
    std::vector<std::string> choices; ///< enumeration: names of 0, 1, …
    std::string unit;
    std::string help;
    bool is_static = false; ///< becomes a #define of the shader: a change compiles it again
    bool in_shader = false;
    std::string where;     ///< "glsl/x.comp:12" for shader parameters
    std::string automatic; ///< the need of the scene that the value "auto" follows (scene/needs.h); "": takes no "auto"
    bool auto_by_default = false; ///< the default is "auto"; default_value holds until a scene is there
    /// The default as --set takes it.
    std::string default_text() const;
};

/// The text that stands for a value by the scene's needs.
inline constexpr const char* k_auto = "auto";

/// The value as --set takes it and as graph files may hold it ("0.5", "1,0,0", "true", an enumeration's name).
std::string to_text(const ParameterInfo& info, const ParameterValue& value);
nlohmann::json to_json(const ParameterInfo& info, const ParameterValue& value);
/// Throws Error (what is wrong, what would be right) for a wrong type, a value out of range or not finite, an unknown
/// choice.
ParameterValue parse_value(const ParameterInfo& info, std::string_view text);
ParameterValue parse_value(const ParameterInfo& info, const nlohmann::json& json);
void check_range(const ParameterInfo& info, const ParameterValue& value);
/// The value of the parameter that comes nearest to a need: inside its range, and the first of its steps that is not
/// below.
ParameterValue value_for(const ParameterInfo& info, double need);
/// "[0.1, 2]", "{hard, soft}" or "".
std::string range_text(const ParameterInfo& info);

struct Parameter {
    ParameterInfo info;
    ParameterValue value;
    ParameterOrigin origin = ParameterOrigin::default_value;
    std::function<void(const ParameterValue&)> write_through; ///< sets the bound C++ member; may be empty
    bool is_auto = false; ///< `value` follows a need of the scene, or will once a scene is there
    std::string reason{}; ///< why it has that value; "" until a scene is there

    /// What --set takes to make it as it is: the value, or "auto".
    std::string text() const;
};

struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
};

class ParameterSet {
  public:
    /// Binds a member of a pass; its present value is the default. Members must outlive the set.
    template <typename T>
    void add(const std::string& name, T& member, Range range, const std::string& unit, const std::string& help) {
        ParameterInfo info;
        info.name = name;
        info.min = range.min;
        info.max = range.max;
        info.unit = unit;
        info.help = help;
        info.kind = kind_of<T>();
        bind(std::move(info), member);
    }
    void add(const std::string& name, bool& member, const std::string& help) { add(name, member, {}, "", help); }
    /// An enumeration: `member` is an int or an enum class whose values are 0, 1, … in the order of `choices`.
    template <typename T>
    void add_choice(const std::string& name, T& member, std::vector<std::string> choices, const std::string& help) {
        ParameterInfo info;
        info.name = name;
        info.kind = ParameterKind::enumeration;
        info.choices = std::move(choices);
        info.help = help;
        info.default_value = static_cast<int>(member);
        insert({info, info.default_value, ParameterOrigin::default_value,
                [&member](const ParameterValue& v) { member = static_cast<T>(std::get<int>(v)); }});
    }
    /// The parameter takes "auto", which follows this need of the scene.
    void follow_need(std::string_view name, const std::string& need);
    /// A shader parameter (//! line). Replaces one of the same name, keeping its value when the kind is the same, the
    /// value still lies in range and somebody set it.
    void declare_shader_parameter(const ParameterInfo& info);
    /// Forgets shader parameters that are not in `names` (their lines are gone).
    void keep_shader_parameters(const std::vector<std::string>& names);

    Parameter* find(std::string_view name);
    const Parameter* find(std::string_view name) const;
    /// Throws Error for an unknown name (with the nearest) or a bad value.
    void set(std::string_view name, const ParameterValue& value, ParameterOrigin origin);
    void set_text(std::string_view name, std::string_view text, ParameterOrigin origin);
    void set_json(std::string_view name, const nlohmann::json& json, ParameterOrigin origin);
    void reset(std::string_view name);
    /// "auto" takes this value from now on; the parameter must have been set to "auto".
    void resolve(std::string_view name, double need, const std::string& reason);

    std::vector<Parameter>& all() { return parameters_; }
    const std::vector<Parameter>& all() const { return parameters_; }
    std::vector<std::string> names() const;

  private:
    template <typename T>
    static constexpr ParameterKind kind_of() {
        if constexpr (std::is_same_v<T, bool>)
            return ParameterKind::boolean;
        else if constexpr (std::is_same_v<T, int>)
            return ParameterKind::integer;
        else if constexpr (std::is_same_v<T, float>)
            return ParameterKind::real;
        else if constexpr (std::is_same_v<T, glm::vec2>)
            return ParameterKind::vec2;
        else if constexpr (std::is_same_v<T, glm::vec3>)
            return ParameterKind::vec3;
        else {
            static_assert(std::is_same_v<T, glm::vec4>, "a parameter is a bool, int, float, vec2, vec3 or vec4");
            return ParameterKind::vec4;
        }
    }
    template <typename T>
    void bind(ParameterInfo info, T& member) {
        info.default_value = member;
        insert({info, info.default_value, ParameterOrigin::default_value,
                [&member](const ParameterValue& v) { member = std::get<T>(v); }});
    }
    void insert(Parameter parameter);

    std::vector<Parameter> parameters_;
};

/// Reads one shader line. Returns false when it is no parameter line. Throws Error when a //! uniform line is
/// malformed.
///   uniform float step_scale = 0.5;  //! [0.1, 2] step length as a share of the cone's diameter
///   uniform int occlusion = 0;       //! {shadow_map, ray_hard, ray_soft} how the light is blocked
///   uniform int cones = 6;           //! static [1, 32] diffuse cones
///   uniform int rays = 16;           //! [1, 64] auto(cones) rays; "auto" takes what the scene needs
bool parse_parameter_line(std::string_view line, ParameterInfo& info);

} // namespace bounce
