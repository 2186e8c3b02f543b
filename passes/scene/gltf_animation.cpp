#include "core/error.h"
#include "core/limits.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_parts.h"

#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

class AnimationReader {
  public:
    AnimationReader(const GltfSource& source, const std::vector<int>& node_index, Scene& scene)
        : source_(source), node_index_(node_index), scene_(scene) {}

    void read_all() {
        for (size_t a = 0; a < source_.model.animations.size(); ++a) {
            const tinygltf::Animation& from = source_.model.animations[a];
            Animation animation;
            animation.name = from.name.empty() ? fmt::format("animation {}", a) : from.name;
            for (size_t c = 0; c < from.channels.size(); ++c)
                read(from, from.channels[c], fmt::format("animations[{}].channels[{}]", a, c), animation);
            if (!animation.channels.empty()) scene_.animations.push_back(std::move(animation));
        }
        if (skipped_)
            scene_.notes.push_back(fmt::format(
                "{} animation channel{} that drive{} morph weights or something else than "
                "translation, rotation and scale {} left out",
                skipped_, skipped_ == 1 ? "" : "s", skipped_ == 1 ? "s" : "", skipped_ == 1 ? "is" : "are"));
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { throw Error(source_.where() + ": " + message); }

    Interpolation interpolation(const std::string& name, const std::string& at) const {
        if (name == "LINEAR") return Interpolation::linear;
        if (name == "STEP") return Interpolation::step;
        if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
        fail(fmt::format("{}: interpolation '{}' is none of LINEAR, STEP, CUBICSPLINE", at, name.substr(0, 40)));
    }

    void read(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& from, const std::string& at,
              Animation& to) {
        AnimationChannel channel;
        if (from.target_path == "translation")
            channel.target = AnimationTarget::translation;
        else if (from.target_path == "rotation")
            channel.target = AnimationTarget::rotation;
        else if (from.target_path == "scale")
            channel.target = AnimationTarget::scale;
        else
            return void(++skipped_);
        if (size_t(from.sampler) >= animation.samplers.size())
            fail(fmt::format("{}.sampler is {}, but there are {} samplers", at, from.sampler,
                             animation.samplers.size()));
        const tinygltf::AnimationSampler& sampler = animation.samplers[size_t(from.sampler)];
        channel.interpolation = interpolation(sampler.interpolation, at);
        read_keys(sampler, channel, at);

        channel.node = node_index_[size_t(from.target_node)];
        if (channel.node < 0) return; // outside the file's scene
        if (scene_.nodes[size_t(channel.node)].has_matrix)
            fail(fmt::format("{} animates nodes[{}], which has a matrix; it may only have translation, rotation, scale",
                             at, from.target_node));
        to.duration = std::max(to.duration, channel.times.back());
        to.channels.push_back(std::move(channel));
    }

    void read_keys(const tinygltf::AnimationSampler& sampler, AnimationChannel& channel, const std::string& at) {
        const tinygltf::Accessor& input = source_.model.accessors[size_t(sampler.input)];
        const tinygltf::Accessor& output = source_.model.accessors[size_t(sampler.output)];
        if (input.type != TINYGLTF_TYPE_SCALAR || input.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
            fail(fmt::format("{}: key times (accessors[{}]) must be SCALAR floats", at, sampler.input));
        int components = channel.target == AnimationTarget::rotation ? 4 : 3;
        if (component_count(output) != components)
            fail(fmt::format("{}: key values (accessors[{}]) must be VEC{}", at, sampler.output, components));
        size_t per_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
        if (output.count != input.count * per_key)
            fail(fmt::format("{}: {} key times want {} values, but there are {}", at, input.count,
                             input.count * per_key, output.count));
        keys_ += output.count;
        if (keys_ > k_max_animation_keys)
            fail(fmt::format("{}: the animations unfold to more than {} keys", at, k_max_animation_keys));

        for (const glm::vec4& time : read_vectors(source_, sampler.input)) {
            bool increasing = channel.times.empty() || time.x >= channel.times.back();
            if (!std::isfinite(time.x) || time.x < 0 || !increasing)
                fail(fmt::format("{}: key time {} ({}) must be finite, not negative and not before the last one", at,
                                 channel.times.size(), time.x));
            channel.times.push_back(time.x);
        }
        channel.values = read_vectors(source_, sampler.output);
        for (size_t i = 0; i < channel.values.size(); ++i)
            if (!std::isfinite(glm::dot(channel.values[i], channel.values[i])))
                fail(fmt::format("{}: key value {} is not finite", at, i));
    }

    const GltfSource& source_;
    const std::vector<int>& node_index_;
    Scene& scene_;
    size_t keys_ = 0;
    int skipped_ = 0;
};

} // namespace

void read_animations(const GltfSource& source, const std::vector<int>& node_index, Scene& scene) {
    AnimationReader(source, node_index, scene).read_all();
}

} // namespace bounce
