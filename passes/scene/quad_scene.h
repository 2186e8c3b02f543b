#pragma once
// Small scenes of quads, built in a few lines and written as glTF: what stability cases and tests measure methods on.

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

class QuadScene {
  public:
    struct Look {
        glm::vec3 colour{0.5f};
        glm::vec3 emission{0};
        float roughness = 1, metallic = 0;
    };

    /// Corners in order around; the normal is (b − a) × (c − a).
    QuadScene& quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec3 colour = glm::vec3(0.5f));
    /// All six sides, facing outward.
    QuadScene& box(glm::vec3 low, glm::vec3 high, glm::vec3 colour = glm::vec3(0.5f));
    /// Of the quad that was added last.
    QuadScene& emission(glm::vec3 radiance);
    /// Of all quads from the one with this number on.
    QuadScene& look(size_t first, const Look& look);
    /// `count` quads from `first` on once more, by nodes that share their meshes.
    QuadScene& instance(size_t first, size_t count, const glm::mat4& to_world);
    /// The same as quads of their own. A mirrored quad still faces where its original faces in the mirror.
    QuadScene& copy(size_t first, size_t count, const glm::mat4& to_world);

    size_t size() const { return quads_.size(); }
    /// Every quad times `s`; instances stay.
    QuadScene scaled(float s) const;
    /// The same quads in the reverse order; instances stay.
    QuadScene reversed() const;

    /// Writes NAME.gltf and NAME.bin; returns the .gltf. Throws Error.
    std::filesystem::path write(const std::filesystem::path& folder, const std::string& name) const;

  private:
    struct Quad {
        glm::vec3 corners[4];
        Look look;
    };
    struct Instance {
        size_t quad;
        glm::mat4 to_world;
    };
    std::vector<Quad> quads_;
    std::vector<Instance> instances_;
};

} // namespace bounce
