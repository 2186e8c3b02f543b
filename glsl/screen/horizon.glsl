#ifndef SCREEN_HORIZON_GLSL
#define SCREEN_HORIZON_GLSL
// Horizon-based ambient occlusion (Bavoil, Sainz, Dimitrov: "Image-space horizon-based ambient occlusion", 2008). The depth
// buffer is marched from pixel P along directions φ of the image; of the surface points S within R of P, the elevation
//   h(φ) = max asin(D·z),  D = (S − P)/|S − P|,
// over the plane across the zenith z is the horizon, and t(φ) is that of P's tangent plane. Below t is the surface itself,
// from t to h is occluded:
//   uniform (as published):  A = 1 − 1/(2π)·∫ Σ W·(sin h_i − sin h_(i−1)) dφ,  h_0 = t(φ) + bias, i over samples that rise,
// each step of the horizon attenuated by W of the sample that raised it. z is the camera's axis, as published, or the ray to
// the viewer: then the line marched lies in the plane of φ and z exactly, also away from the middle of the picture.
//   cosine:  A = 1 − (1/π)·∫ |n_φ|·Σ W·(F(θ_(i−1)) − F(θ_i)) dφ,  F(θ) = ¼(cos γ − cos(2θ − γ) + 2θ·sin γ) = ∫ cos(θ' − γ) sin θ' dθ',
// the same arc under ⟨n·ω⟩ (the inner integral of Jiménez et al. 2016): θ from z = the ray to the viewer, n_φ the normal's
// part in the plane of φ, γ its angle. This is the AO that the reference has. n is the shading normal there; what of its
// hemisphere lies below the geometric surface counts as occluded.
#include "lib/frame.glsl"
#include "lib/interleave.glsl"

uniform int directions = 8;             //! [1, 64] image directions marched around a pixel
uniform int steps = 8;                  //! [1, 512] samples along each; never more than texels
uniform float step_power = 1.0;         //! [1, 4] samples lie at (i/steps)^step_power; 1: evenly, as published
uniform float angle_bias = 10.0;        //! [0, 60] (degrees) occluders that rise less above the tangent plane do not count
uniform bool bias_lifts_tangent = true; //! the angle below the bias counts as open; off: it only rejects samples
uniform int zenith = 0;                 //! {camera_axis, view_ray} what elevations are measured from (weighting cosine: always the view ray)
uniform int weighting = 0;              //! {uniform, cosine} of the hemisphere: uniform as published
uniform int interleave = 4;             //! [1, 8] (texels) blocks of n × n turn and shift their directions differently; 1: all the same

const float k_half_pi = 1.57079632679;

uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_depth;

struct Pixel {
    ivec2 at;
    vec3 position;
    vec3 to_viewer; // unit
    float distance;
    vec3 n, face;   // shading and geometric normal
};

// Where a direction of the world at P points in the image: unit, in pixels.
vec2 image_direction(Pixel p, vec3 world) {
    vec3 x = p.position - camera_position;
    vec3 at = vec3(dot(x, camera_right), -dot(x, camera_up), dot(x, camera_forward));
    vec3 to = vec3(dot(world, camera_right), -dot(world, camera_up), dot(world, camera_forward));
    return normalize(to.xy * at.z - at.xy * to.z);
}

// Texels along `d` until the image ends or, earlier, the ball of radius R around P does.
float reach_of(Pixel p, vec2 d, vec3 aside, float radius) {
    vec2 middle = vec2(p.at) + 0.5, border = mix(vec2(0.0), vec2(resolution), greaterThan(d, vec2(0.0)));
    vec2 until = mix((border - middle) / d, vec2(1.0e9), lessThan(abs(d), vec2(1.0e-6)));
    float reach = min(until.x, until.y), sine = radius / p.distance;
    if (sine < 0.999) {
        vec3 edge = sine * aside - sqrt(1.0 - sine * sine) * p.to_viewer;
        float forward = dot(edge, camera_forward);
        if (forward > 1.0e-3) {
            vec2 plane = vec2(dot(edge, camera_right) / aspect, -dot(edge, camera_up)) / (forward * tan_half_vfov);
            reach = min(reach, length((0.5 * plane + 0.5) * vec2(resolution) - middle));
        }
    }
    return reach;
}

// ∫ cos(θ' − γ) sin θ' dθ' from 0 to θ.
float cosine_arc(float theta, float gamma) {
    return 0.25 * (cos(gamma) - cos(2.0 * theta - gamma) + 2.0 * theta * sin(gamma));
}

// W of a sample at a distance of r·R.
float attenuation(float r, bool fades) {
    return r >= 1.0 ? 0.0 : (fades ? 1.0 - r * r : 1.0);
}

// What one direction occludes, times the number of directions: of 1 (uniform) or of ½ (cosine).
float occluded_along(Pixel p, vec2 d, float shift, float radius, bool fades) {
    vec3 ray = pixel_ray(vec2(p.at) + d);
    vec3 aside = normalize(ray - dot(ray, p.to_viewer) * p.to_viewer); // in the plane marched, toward d
    vec3 tangent = normalize(aside * dot(p.to_viewer, p.face) - p.to_viewer * dot(aside, p.face));
    bool by_cosine = weighting == weighting_cosine;
    vec3 axis = by_cosine || zenith == zenith_view_ray ? p.to_viewer : -camera_forward;
    float bias = radians(angle_bias), least_rise = sin(bias);
    float lift = bias_lifts_tangent ? bias : 0.0;
    float occluded = 0.0;

    // A sample's texel lies beside the line by up to half a texel, where the tangent plane is at another elevation: whether it
    // rises above the plane is asked of where it is, or grazing planes would occlude themselves.
    // The horizon as an angle from the axis (cosine) or as the sine of its elevation (uniform).
    float gamma = 0.0, share = 1.0, horizon;
    if (by_cosine) {
        vec2 inside = vec2(dot(p.n, p.to_viewer), dot(p.n, aside));
        share = length(inside);
        gamma = clamp(atan(inside.y, inside.x), -k_half_pi, k_half_pi);
        float shading = gamma + k_half_pi, surface = acos(clamp(dot(tangent, axis), -1.0, 1.0));
        horizon = min(shading, surface);
        occluded = cosine_arc(shading, gamma) - cosine_arc(horizon, gamma);
        horizon = max(horizon - lift, 0.0);
    } else {
        horizon = sin(min(asin(clamp(dot(tangent, axis), -1.0, 1.0)) + lift, k_half_pi));
    }

    float reach = reach_of(p, d, aside, radius);
    int count = min(steps, int(ceil(reach)));
    for (int i = 0; i < count; ++i) {
        float along = reach * pow((float(i) + shift) / float(count), step_power);
        ivec2 at = ivec2(floor(vec2(p.at) + 0.5 + d * max(along, 1.0)));
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, resolution))) break;
        float depth = texelFetch(gbuffer_depth, at, 0).r;
        if (depth <= 0.0) continue;
        vec3 to = world_position(at, depth) - p.position;
        float r = length(to);
        float w = attenuation(r / radius, fades);
        to /= max(r, 1.0e-12 * scene_diagonal);
        if (w <= 0.0 || dot(to, p.face) <= least_rise) continue;
        float rise = clamp(dot(to, axis), -1.0, 1.0);
        if (by_cosine) {
            float theta = acos(rise);
            if (theta >= horizon) continue;
            occluded += w * (cosine_arc(horizon, gamma) - cosine_arc(theta, gamma));
            horizon = theta;
        } else if (rise > horizon) {
            occluded += w * (rise - horizon);
            horizon = rise;
        }
    }
    return share * occluded;
}

// A of the pixel, 1 = open; the background is open.
float horizon_visibility(ivec2 at, float radius, bool fades) {
    float depth = texelFetch(gbuffer_depth, at, 0).r;
    if (depth <= 0.0) return 1.0;
    Pixel p;
    p.at = at;
    p.position = world_position(at, depth);
    vec3 back = camera_position - p.position;
    p.distance = length(back);
    p.to_viewer = back / p.distance;
    p.n = normalize(texelFetch(gbuffer_normal, at, 0).xyz);
    p.face = normalize(texelFetch(gbuffer_geometric_normal, at, 0).xyz);

    bool around_ray = weighting == weighting_cosine || zenith == zenith_view_ray;
    vec3 a = normalize(camera_right - dot(camera_right, p.to_viewer) * p.to_viewer), b = cross(a, p.to_viewer);
    float part = interleaved_part(at, interleave);
    // Shifts go through the block in another order than turns do.
    float shift = interleave > 1 ? fract(part * float(interleave * interleave) * 0.618034) : 0.5;
    float sum = 0.0;
    for (int i = 0; i < directions; ++i) {
        float phi = 4.0 * k_half_pi * (float(i) + part) / float(directions);
        vec2 d = vec2(cos(phi), sin(phi));
        if (around_ray) d = image_direction(p, d.x * a + d.y * b);
        sum += occluded_along(p, d, shift, radius, fades);
    }
    return 1.0 - (weighting == weighting_cosine ? 2.0 : 1.0) * sum / float(directions);
}

#endif
