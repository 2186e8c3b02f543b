#ifndef DVS_VOXEL_VOLUMES_GLSL
#define DVS_VOXEL_VOLUMES_GLSL
uniform usampler3D voxels_flags; // 0 empty; bits 0–1 static, dynamic; then six leaves: the ways that surfaces face
uniform sampler3D voxels_normal; // averaged: short where normals disagree
#endif
