#pragma once
// What one graph departs from another in, as the text of a graph file.

#include "graph/graph_overlay.h"

#include <string>

namespace bounce {

/// Members in the order in which graph files have them.
OrderedJson in_file_order(OrderedJson whole);

/// The overlay over the graph `name` that makes `to` of `from`, both whole. Empty: they are the same.
std::string graph_difference(const std::string& name, const OrderedJson& from, const OrderedJson& to);

} // namespace bounce
