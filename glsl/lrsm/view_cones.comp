// The recorded cones of one pixel, drawn over the picture: each cone's axis, and its spheres as circles. Blue: nothing in
// it; red: it takes a share of the cone; towards the colour of its light where it brings some. What lies behind the
// picture's surfaces is fainter. Each group of invocations first finds the spheres that reach its tile, as bits of a list
// in shared memory, so that they are drawn in their order.
#include "lib/view_segment.glsl"
#include "lrsm/cone_record.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D out_display;
uniform sampler2D gbuffer_depth;
layout(std430) readonly buffer debug_cones {
    InspectedPixel inspected;
    RecordedCone cones[k_max_recorded_cones];
    RecordedSphere spheres[];
};
layout(FORMAT_debug_cones_view) writeonly uniform image2D debug_cones_view;

uniform int show = 1;            //! {axes, occupied, all} which spheres are drawn with the axes: those with occlusion, or all
uniform int only_cone = -1;      //! [-1, 127] draws this one alone; -1: all
uniform float line_width = 1.2;  //! [0.5, 8] (pixels) of circles and axes
uniform float picture = 0.5;     //! [0, 1] brightness of the picture behind

const int k_words = k_max_recorded_spheres / 32; // a cone
shared uint reaching[k_max_recorded_cones * k_words];
shared ViewSegment axes[k_max_recorded_cones];

// Centre in pixels, radius in pixels, distance along the view; radius 0: not in view.
vec4 circle_of(RecordedSphere sphere) {
    vec3 at = project_to_pixel(sphere.centre);
    float radius = 0.5 * sphere.diameter;
    if (at.z <= max(near_plane, radius)) return vec4(0.0);
    return vec4(at.xy, radius * 0.5 * float(resolution.y) / (tan_half_vfov * at.z), at.z);
}

bool is_drawn(RecordedSphere sphere) {
    return show == show_all || (show == show_occupied && sphere.alpha > 1.0e-3);
}

vec3 sphere_colour(RecordedSphere sphere) {
    vec3 colour = mix(vec3(0.1, 0.35, 1.0), vec3(1.0, 0.08, 0.04), sqrt(clamp(sphere.share, 0.0, 1.0)));
    float brightest = max(sphere.radiance.r, max(sphere.radiance.g, sphere.radiance.b));
    return brightest > 0.0 ? mix(colour, sphere.radiance / brightest, 0.85) : colour;
}

void find_axis(int i) {
    axes[i] = view_segment(inspected.apex, inspected.apex + cones[i].end * cones[i].direction);
    if (only_cone >= 0 && only_cone != i) axes[i].nearness = vec2(-1.0);
}

void main() {
    int lane = int(gl_LocalInvocationIndex);
    int cone_total = clamp(inspected.cones, 0, k_max_recorded_cones);
    for (int word = lane; word < cone_total * k_words; word += 256)
        reaching[word] = 0u;
    barrier();
    vec2 low = vec2(gl_WorkGroupID.xy * 16u), high = low + 16.0;
    for (int i = 0; i < cone_total; ++i) {
        if (i % 256 == lane) find_axis(i);
        if (lane >= cones[i].kept || (only_cone >= 0 && only_cone != i)) continue;
        RecordedSphere sphere = spheres[cones[i].first + lane];
        vec4 circle = circle_of(sphere);
        vec2 nearest = clamp(circle.xy, low, high);
        if (is_drawn(sphere) && circle.z > 0.0 && distance(nearest, circle.xy) <= circle.z + line_width)
            atomicOr(reaching[i * k_words + lane / 32], 1u << uint(lane % 32));
    }
    barrier();

    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(debug_cones_view)))) return;
    vec2 at = vec2(pixel) + 0.5;
    vec3 colour = picture * decoded(texelFetch(out_display, pixel, 0).rgb);
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    float surface = depth > 0.0 ? near_plane / depth : 1.0e30;
    for (int i = 0; i < cone_total; ++i) {
        bool behind;
        float cover = segment_cover(axes[i], at, line_width, surface, behind);
        if (cover <= 0.0) continue;
        colour = mix(colour, mix(vec3(0.7), vec3(1.0, 0.6, 0.1), cones[i].occlusion), cover * (behind ? 0.15 : 0.6));
    }
    for (int word = 0; word < cone_total * k_words; ++word) {
        for (uint bits = reaching[word]; bits != 0u; bits &= bits - 1u) {
            RecordedSphere sphere = spheres[word / k_words * k_max_recorded_spheres + word % k_words * 32 + findLSB(bits)];
            vec4 circle = circle_of(sphere);
            float from_rim = distance(at, circle.xy) - circle.z;
            float rim = clamp(line_width - abs(from_rim), 0.0, 1.0), inside = from_rim < 0.0 ? 0.12 * sphere.share : 0.0;
            float cover = max(rim * (0.25 + 0.75 * sqrt(clamp(sphere.share, 0.0, 1.0))), inside);
            if (circle.w - 0.5 * sphere.diameter > surface) cover *= 0.3;
            colour = mix(colour, sphere_colour(sphere), cover);
        }
    }
    if (on_pixel_cross(at, inspected.pixel)) colour = vec3(1.0, 1.0, 0.2);
    imageStore(debug_cones_view, pixel, vec4(colour, 1.0));
}
