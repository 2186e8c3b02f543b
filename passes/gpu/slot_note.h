#pragma once
// What stands behind "//!" on the line of a slot, comma-separated:
//
//   uniform sampler2DArray voxels_light_visibility;  //! optional, neutral 1
//   uniform sampler3D dvs_finer;                     //! from dvs.directional
//   uniform sampler3D voxels_finer;                  //! from voxels.occlusion mip iteration - 1
//
//   optional        the slot may have no source; it then reads the neutral value
//   optional unless EXPRESSION    the same, unless the pass's parameters say so: visibility == cones
//   neutral V       what a reader gets when nothing makes the resource, and what a writer's resource holds when it is
//                   cleared: one number for all channels, or four (default 0)
//   ordered: REASON  invocations read and write it, and why none meets another ("each has its own texel"), or why that
//                   does not matter; comes last. See shader_order.h
//   from NAME       the resource that the slot is bound to unless the graph file binds another: that of the pass's slot
//                   NAME if it has one, else the resource NAME. One mip or layer of it: "mip EXPRESSION", "layer
//                   EXPRESSION"

#include "gpu/shader_source.h"

#include <string_view>

namespace bounce {

/// Reads the text behind "//!" into the slot. Throws Error that says how it is written.
void read_slot_note(std::string_view note, ShaderSlot& slot);

} // namespace bounce
