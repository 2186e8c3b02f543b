#include "reference/environment_light.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace bounce {

EnvironmentLight::EnvironmentLight(const Environment& environment)
    : present_(environment.present()), radiance_(environment.radiance) {
    if (!present_ || environment.map.empty()) return;
    map_ = environment.map;
    if (map_.channels != 3) throw Error("an environment map needs three channels");
    const int width = map_.width, height = map_.height;
    // Bilinear reading spreads a texel over its neighbours, so a texel's weight is the largest of the 3×3 around it:
    // whatever is bright can be drawn.
    std::vector<float> weights(size_t(width) * size_t(height));
    auto value = [&](int x, int y) {
        const float* p = map_.at((x + width) % width, std::clamp(y, 0, height - 1));
        return luminance({p[0], p[1], p[2]});
    };
    for (int y = 0; y < height; ++y) {
        const float solid_angle =
            std::cos(k_pi * float(y) / float(height)) - std::cos(k_pi * float(y + 1) / float(height));
        for (int x = 0; x < width; ++x) {
            float most = 0;
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i)
                    most = std::max(most, value(x + i, y + j));
            }
            // Half by the texel itself keeps bright points from drawing all around them alike.
            weights[size_t(y) * size_t(width) + size_t(x)] = solid_angle * 0.5f * (most + value(x, y));
        }
    }
    table_ = WeightedTable(weights);
}

glm::vec3 EnvironmentLight::radiance(const glm::vec3& direction) const {
    if (map_.empty()) return radiance_;
    const glm::vec2 uv = environment_uv(direction);
    const float x = uv.x * float(map_.width) - 0.5f, y = uv.y * float(map_.height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    auto texel = [&](int i, int j) {
        const float* p = map_.at((i + map_.width) % map_.width, std::clamp(j, 0, map_.height - 1));
        return glm::vec3(p[0], p[1], p[2]);
    };
    const int i = int(left), j = int(top);
    return radiance_ * glm::mix(glm::mix(texel(i, j), texel(i + 1, j), x - left),
                                glm::mix(texel(i, j + 1), texel(i + 1, j + 1), x - left), y - top);
}

/// Within a texel directions are uniform over its solid angle: cosine of the polar angle and azimuth are.
glm::vec3 EnvironmentLight::sample(float choice, const glm::vec2& u, float& density) const {
    const size_t texel = table_.draw(choice);
    const int x = int(texel % size_t(map_.width)), y = int(texel / size_t(map_.width));
    const float upper = std::cos(k_pi * float(y) / float(map_.height));
    const float lower = std::cos(k_pi * float(y + 1) / float(map_.height));
    const float cosine = upper + u.y * (lower - upper);
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    const float azimuth = ((float(x) + u.x) / float(map_.width) - 0.5f) * 2 * k_pi;
    density = table_.probability(texel) * float(map_.width) / (2 * k_pi * (upper - lower));
    return {std::cos(azimuth) * sine, cosine, std::sin(azimuth) * sine};
}

float EnvironmentLight::density(const glm::vec3& direction) const {
    if (!sampled()) return 0;
    const glm::vec2 uv = environment_uv(direction);
    const int x = std::clamp(int(uv.x * float(map_.width)), 0, map_.width - 1);
    const int y = std::clamp(int(uv.y * float(map_.height)), 0, map_.height - 1);
    const float upper = std::cos(k_pi * float(y) / float(map_.height));
    const float lower = std::cos(k_pi * float(y + 1) / float(map_.height));
    return table_.probability(size_t(y) * size_t(map_.width) + size_t(x)) * float(map_.width) /
           (2 * k_pi * (upper - lower));
}

} // namespace bounce
