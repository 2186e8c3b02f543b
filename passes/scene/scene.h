#pragma once
// Plain scene data: what a glTF file (or several, placed by a shot) holds. No OpenGL.
// World: metres, right-handed, Y up. Angles in radians. Colours and factors linear unless said otherwise.
//
// A scene far from its origin, or of an extreme size, is loaded relative to its own centre and in a unit of its own
// (LoadedSpace), because floats hold seven digits. What a file says stays in the file's coordinates, in double
// precision: nodes, paths, lights' intensities and radii. Whatever is evaluated is loaded: instances, lights, cameras,
// bounds.

#include "core/image.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace bounce {

/// One vertex, as it lies in the GPU's vertex buffer (std430: four vec4). Mesh space.
struct Vertex {
    glm::vec3 position{0};
    float u0 = 0; ///< TEXCOORD_0.x
    glm::vec3 normal{0, 1, 0};
    float v0 = 0;                  ///< TEXCOORD_0.y
    glm::vec4 tangent{1, 0, 0, 1}; ///< bitangent = cross(normal, tangent)·w, where a mapped green points: along −v
    float u1 = 0, v1 = 0;          ///< TEXCOORD_1
    uint32_t colour_rg = 0xffffffffu; ///< COLOR_0 as unorm16 pairs (packUnorm2x16), linear; white where absent
    uint32_t colour_ba = 0xffffffffu;
};
static_assert(sizeof(Vertex) == 64);

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };

/// An 8-bit image with its sampler. `srgb` is set when any colour slot (base colour, emission) uses it.
struct Texture {
    std::string name;
    Image8 image;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool nearest = false; ///< magnification filter NEAREST
    bool srgb = false;
};

/// A use of a texture by a material slot: uv' = offset + R·(scale·uv) with R = [cos r, sin r; −sin r, cos r], a turn
/// counter-clockwise as seen with v pointing down (KHR_texture_transform). `slot_uv` in shading_frame.h does it.
struct TextureSlot {
    int texture = -1; ///< index into Scene::textures; -1 = none
    int uv_set = 0;   ///< 0 or 1
    glm::vec2 offset{0};
    glm::vec2 scale{1};
    float rotation = 0;
};

/// How alpha (base colour · texture · vertex colour) is read.
enum class AlphaMode {
    opaque, ///< not at all
    mask,   ///< the surface is where alpha reaches the cutoff
    blend   ///< the surface covers that share of each point: what is behind is seen through the rest
};

struct Material {
    std::string name;
    glm::vec4 base_colour{1};
    float metallic = 1;
    float roughness = 1;   ///< perceptual; α = roughness²
    glm::vec3 emission{0}; ///< radiance, W/(sr·m²): emissiveFactor · emissiveStrength
    float normal_scale = 1;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;              ///< of mask; at 0 all is there, above 1 nothing
    bool double_sided = false;              ///< only feeds the optional back-face cull of the camera pass
    TextureSlot base_colour_texture;        ///< sRGB, a = alpha
    TextureSlot metallic_roughness_texture; ///< g = roughness, b = metallic
    TextureSlot normal_texture;
    TextureSlot emission_texture; ///< sRGB

    bool is_emissive() const { return emission.r > 0 || emission.g > 0 || emission.b > 0; }
};

/// A run of triangles with one material: indices [first_index, first_index + index_count) of Scene::indices, each an
/// absolute index into Scene::vertices.
struct Primitive {
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    int material = 0; ///< index into Scene::materials (a default material is appended where glTF names none)
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

enum class LightType : uint32_t { point = 0, spot = 1, directional = 2 };

/// KHR_lights_punctual with its photometric units read one to one as radiometric ones.
struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 position{0};         ///< world (as evaluated); unused for directional
    glm::vec3 direction{0, -1, 0}; ///< unit, the way light travels
    glm::vec3 intensity{1};        ///< point, spot: W/sr; directional: W/m² at normal incidence
    float inner_cone = 0;          ///< half-angle, radians
    float outer_cone = 0.7853982f; ///< half-angle, radians
    float radius = 0;              ///< metres, point and spot; only the reference and soft shadows use it
    float angular_radius = 0;      ///< radians, directional
    bool enabled = true;
};

struct Camera {
    std::string name;
    glm::vec3 position{0, 0, 5};
    glm::vec3 target{0, 0, 0};
    glm::vec3 up{0, 1, 0};
    float vfov = 0.8f;    ///< vertical field of view, radians
    float near_plane = 0; ///< metres along the view: what lies nearer is not seen; 0: everything ahead is
};

/// A piecewise linear path through keys (position and, where given, a target to look at); frames before the first and
/// after the last key hold still. In the file's coordinates.
struct PathKey {
    float t = 0; ///< seconds
    glm::dvec3 position{0};
    glm::dvec3 target{0};
    bool has_target = false;
};
struct Path {
    std::vector<PathKey> keys; ///< increasing t
    bool empty() const { return keys.empty(); }
    PathKey at(float t) const;
};

/// Local transform = translation · rotation · scale, or `matrix` when has_matrix. In the file's coordinates, and in
/// double precision: a node may lie far away, and its child may lead back.
struct Node {
    std::string name;
    int parent = -1; ///< index of the parent; parents come before children
    glm::dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};
    glm::dvec3 scale{1};
    bool has_matrix = false;
    glm::dmat4 matrix{1};
    int mesh = -1;
    int camera = -1;
    int light = -1;
    Path path;            ///< of a placed object: replaces `translation` (and, with targets, the rotation)
    bool dynamic = false; ///< an animation or path moves it (or an ancestor)
};

enum class AnimationTarget { translation, rotation, scale };
enum class Interpolation { step, linear, cubic_spline };

struct AnimationChannel {
    int node = -1;
    AnimationTarget target = AnimationTarget::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;      ///< seconds, never decreasing
    std::vector<glm::vec4> values; ///< one per key (three per key for cubic_spline: in-tangent, value, out-tangent)
};

struct Animation {
    std::string name;
    float duration = 0; ///< seconds; played in a loop
    std::vector<AnimationChannel> channels;
};

/// What surrounds the scene: constant radiance or an equirectangular map (whose texels multiply `radiance`).
struct Environment {
    glm::vec3 radiance{0}; ///< W/(sr·m²)
    Image map;             ///< 3 channels, empty when constant; direction → uv as `environment_uv`
    bool present() const { return radiance.r > 0 || radiance.g > 0 || radiance.b > 0; }
};

/// Equirectangular convention: u = atan2(d.z, d.x)/(2π) + ½, v = acos(d.y)/π (v = 0 is up).
glm::vec2 environment_uv(const glm::vec3& direction);

struct Bounds {
    glm::vec3 min{1e30f};
    glm::vec3 max{-1e30f};
    void add(const glm::vec3& p);
    void add(const Bounds& b);
    bool empty() const { return min.x > max.x; }
    glm::vec3 size() const { return max - min; }
    glm::vec3 centre() const { return 0.5f * (min + max); }
    float diagonal() const { return empty() ? 0.0f : glm::length(size()); }
};

/// Where the loaded scene lies in its file: file = origin + unit · loaded. The identity for ordinary scenes.
struct LoadedSpace {
    glm::dvec3 origin{0};
    double unit = 1; ///< a power of two, metres of the file per loaded metre
    glm::vec3 to_loaded(const glm::dvec3& file) const { return glm::vec3((file - origin) / unit); }
    glm::dvec3 to_file(const glm::vec3& loaded) const { return origin + unit * glm::dvec3(loaded); }
    bool operator==(const LoadedSpace&) const = default;
};

struct Scene {
    std::string name;
    LoadedSpace space;
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Node> nodes;
    std::vector<Light> lights;   ///< as authored; the node gives position and direction (light looks along −Z)
    std::vector<Camera> cameras; ///< likewise
    std::vector<Animation> animations;
    std::vector<std::string> notes; ///< everything the loader skipped or read differently, one line each
};

/// One drawn primitive of one node at one time. The order is fixed (nodes in order, primitives in order), so index i
/// is the same thing at every time.
struct Instance {
    glm::mat4 world{1};
    glm::mat4 previous_world{1}; ///< one frame earlier
    Primitive primitive;
    int node = -1;
    bool dynamic = false;
};

/// The scene at one time: what passes and the reference consume.
struct SceneState {
    std::vector<Instance> instances;
    std::vector<Light> lights;   ///< enabled lights only, in world space
    std::vector<Camera> cameras; ///< the file's cameras in world space
};

/// World matrices of all nodes at `time` seconds (every animation of the file plays at once, looped), in the file's
/// coordinates.
std::vector<glm::dmat4> file_matrices(const Scene& scene, float time);
/// The same to the loaded world.
std::vector<glm::mat4> world_matrices(const Scene& scene, float time);
SceneState evaluate_scene(const Scene& scene, float time, float previous_time);

/// World bounds of all geometry at `time`, whatever strays in it. For lengths and grids see scene/extent.h.
Bounds scene_bounds(const Scene& scene, float time);
/// World bounds over the whole animation (all keys and points between them).
Bounds scene_bounds_over_animation(const Scene& scene);

/// What a scene holds, and so what it needs. Passes are skipped by these (“no emissive material”).
struct SceneFacts {
    size_t triangles = 0; ///< drawn: a mesh used twice counts twice
    size_t vertices = 0;
    size_t materials = 0;
    size_t textures = 0;
    size_t texture_bytes = 0;
    size_t glossy_materials = 0;   ///< used materials with roughness < 0.9 or metallic > 0 somewhere (not diffuse_only)
    size_t emissive_materials = 0; ///< used materials
    size_t alpha_tested_materials = 0;                                ///< alpha mode mask
    size_t blended_materials = 0;                                     ///< alpha mode blend
    size_t point_lights = 0, spot_lights = 0, directional_lights = 0; ///< enabled
    size_t lights() const { return point_lights + spot_lights + directional_lights; }
    size_t dynamic_instances = 0;
    size_t instances = 0;
    bool animated_lights = false;
    bool environment = false; ///< radiance above zero
    float animation_duration = 0;
    Bounds bounds;                ///< at time 0, without strays (scene/extent.h)
    Bounds bounds_over_animation; ///< without strays: voxel grids, fitted views and lengths in diagonals go by it
    Bounds whole_bounds;          ///< over the animation, strays included
    size_t stray_triangles = 0;   ///< that bounds leave out
};

} // namespace bounce
