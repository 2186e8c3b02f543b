#pragma once
// The names that commands take, by kind: for `bounce list`, and for the completion of command lines.

#include <string>
#include <vector>

namespace bounce {

struct NameKind {
    std::string name; ///< "shots"
    std::vector<std::string> (*names)();
};

const std::vector<NameKind>& name_kinds();
/// Sorted, except metrics, which come in the order of their table. Throws Error naming the nearest kind.
std::vector<std::string> names_of(const std::string& kind);

} // namespace bounce
