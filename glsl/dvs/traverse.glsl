#ifndef DVS_TRAVERSE_GLSL
#define DVS_TRAVERSE_GLSL
// The first voxel that blocks a ray, exactly: from voxel to voxel, and over empty bricks of 4³ voxels at once. A voxel
// blocks what its surface faces, so that a surface does not block what leaves it; where normals cancel it blocks all, and
// two-sided surfaces block from behind too, past the first voxels. Where voxels know their mean plane, it is the plane that
// blocks: who leaves the voxel in front of it goes on, and who starts behind it is not blocked near by.
#include "dvs/voxel_surface.glsl"
#include "voxel/cone_steps.glsl"

uniform usampler3D voxels_bricks; // 0: all 4³ voxels are empty

uniform float facing_threshold = 0.05; //! [0, 0.9] exact hits: a voxel blocks rays whose cosine to its normal is above this

uniform float plane_depth = 0.0; //! [-1, 1] (voxels) exact hits, planes: how far behind a voxel's plane a ray must come to be blocked there
uniform float plane_slack = 2.0; //! [0, 2] (voxels) exact hits, planes: who enters a voxel farther behind its plane is not blocked there

struct VoxelHit {
    ivec3 voxel;
    float t;    // metres; below 0: none
    bool front; // the side that its normal faces
};

// `surface`: the averaged normal, and in a the plane's offset from the voxel's centre along it (1: the whole voxel blocks).
// Where the ray starts, enters and leaves the voxel: from the voxel's centre, voxel units.
bool voxel_blocks(uint flags, vec4 surface, vec3 direction, float t, vec3 start, vec3 enters_at, vec3 leaves_at, out bool front) {
    vec3 n = surface.xyz;
    float size = length(n), facing = -dot(n, direction);
    uint leaves = flags >> 2;
    front = dot(front_of(n, leaves), direction) <= 0.0;
    bool faces = facing > facing_threshold * size;
    if (!faces) {
        if (t < 2.0) return false;
        faces = size < 0.3 || ((leaves & (leaves >> 1) & 21u) != 0u && facing < -facing_threshold * size);
    }
    if (!faces || surface.a > 0.99) return faces;
    float side = front ? 1.0 : -1.0, plane = surface.a * size;
    if (side * (dot(n, leaves_at) - plane) > -plane_depth * size) return false;
    if (t > 0.0 && side * (dot(n, enters_at) - plane) < -plane_slack * size) return false;
    return t >= 2.0 || side * (dot(n, start) - plane) > 0.0;
}

VoxelHit traverse(VoxelGrid grid, vec3 apex, vec3 direction) {
    vec3 origin = (apex - grid.origin) / grid.voxel; // voxel units
    vec3 safe = mix(direction, vec3(1.0e-6), lessThan(abs(direction), vec3(1.0e-6)));
    vec3 inverse = 1.0 / safe, ahead = step(vec3(0.0), safe);
    float t = 0.0, end = reach * scene_diagonal / grid.voxel;
    VoxelHit hit = VoxelHit(ivec3(0), -1.0, true);
    for (int i = 0; i < 1024 && t < end; ++i) {
        ivec3 voxel = ivec3(floor(origin + t * safe));
        if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, ivec3(grid.resolution)))) break;
        vec3 low = vec3(voxel);
        float width = 1.0;
        if (texelFetch(voxels_bricks, voxel >> 2, 0).r == 0u) {
            low = vec3(voxel & ~3);
            width = 4.0;
        } else {
            uint flags = texelFetch(voxels_flags, voxel, 0).r;
            if (flags != 0u) {
                vec3 exits = (low + ahead - origin) * inverse, start = origin - low - 0.5;
                vec3 leaves_at = start + min(exits.x, min(exits.y, exits.z)) * safe;
                if (voxel_blocks(flags, texelFetch(voxels_normal, voxel, 0), direction, t, start, start + t * safe, leaves_at, hit.front)) {
                    hit.voxel = voxel;
                    hit.t = t * grid.voxel;
                    return hit;
                }
            }
        }
        vec3 exits = (low + width * ahead - origin) * inverse;
        t = max(min(exits.x, min(exits.y, exits.z)), t) + 1.0e-3;
    }
    return hit;
}

#endif
