// The rays of one texel of the low resolution, by the march's own code, kept for a view.
#include "vf/fan.glsl"
#include "vf/ray_record.glsl"

layout(local_size_x = 64) in; // k_max_recorded_rays

layout(std430) readonly buffer vf_sizes { ivec2 march_size; int list_capacity, filtered_capacity; };
layout(std430) writeonly buffer debug_fan { RecordedFan record; };

uniform vec2 pixel = vec2(0.5); //! [0, 1] the inspected pixel, as shares of width and height from the top left

void main() {
    int i = int(gl_LocalInvocationIndex);
    ivec2 texel = clamp(ivec2(pixel * vec2(march_size)), ivec2(0), march_size - 1);
    Fan fan;
    bool there = fan_at(texel, march_size, fan);
    if (i == 0) record.fan = InspectedFan(there ? texel : ivec2(-1), there ? rays : 0, 0, vec4(there ? fan.origin : vec3(0.0), 0.0));
    vec3 direction;
    float t = -1.0;
    if (!there || i >= rays || !fan_direction(fan, i, direction)) {
        record.ray[i] = vec4(0.0);
        return;
    }
    if (first_disc(fan.origin, direction, 0.0, t) < 0) t = -1.0;
    record.ray[i] = vec4(direction, t);
}
