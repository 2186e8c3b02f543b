#include "app/ui/viewed.h"

namespace bounce {

Viewed& viewed() {
    static Viewed last;
    return last;
}

glm::vec3 heat_colour(float share) {
    static const glm::vec3 stops[6] = {{0, 0, 0},         {0.05f, 0.05f, 0.6f}, {0.6f, 0.05f, 0.55f},
                                       {1, 0.35f, 0.05f}, {1, 0.9f, 0.1f},      {1, 1, 1}};
    const float x = glm::clamp(share, 0.0f, 1.0f) * 5;
    const int i = glm::min(int(x), 4);
    return glm::mix(stops[i], stops[i + 1], x - float(i));
}

} // namespace bounce
