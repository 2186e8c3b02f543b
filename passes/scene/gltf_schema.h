#pragma once
// The shape of a glTF 2.0 document, as far as Bounce reads it, and a check against it. After the check every value has
// the type the specification gives it, every index points at something, and what Bounce does not read is gone, so that
// the parser behind it never meets a case it was not written for.

#include "core/error.h"

#include <nlohmann/json.hpp>

namespace bounce {

/// Checks `root` against the schema, adding every violation to `errors`. Changes `root`: members that are not read
/// (extras, other extensions, skins, morph targets) are removed, and whole numbers written as 2.0 become 2.
void check_gltf_shape(nlohmann::json& root, ErrorList& errors);

/// Errors in the node graph: a node with two parents, a cycle, a scene that lists a node that has a parent.
/// Wants a document that passed check_gltf_shape.
void check_gltf_graph(const nlohmann::json& root, ErrorList& errors);

} // namespace bounce
