#pragma once
// Where the objects of a shot are placed, in the file's coordinates. All steps can be undone.

#include "app/ui/panel_context.h"

#include <string>

namespace bounce {

struct ObjectPlace {
    glm::dvec3 position{0};
    glm::dquat rotation{1, 0, 0, 0};
    glm::dvec3 scale{1};
};

/// What of its place a person may change: the object's path has the rest.
struct ObjectFreedom {
    bool move = true, turn = true;
};

/// `object`: one of Shot::object_nodes.
ObjectPlace place_of_object(const Session& session, size_t object);
ObjectFreedom freedom_of_object(const Shot& shot, size_t object);

/// The name in the shot's file, or its scene's; numbered where several have the same.
std::string name_of_object(const Shot& shot, size_t object);

/// Places it there, as far as its path leaves that free. From press to release is one step of undo. What cannot be
/// loaded (too far away, a scale of 0) is refused, and told.
void move_object(PanelContext& context, size_t object, const ObjectPlace& place);

} // namespace bounce
