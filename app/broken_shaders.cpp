#include "app/broken_shaders.h"

#include "core/error.h"

#include <set>

namespace bounce {

void throw_if_broken(const Session& session, const std::string& where) {
    std::set<std::string> told; // a shader that several passes share is broken once
    ErrorList errors;
    for (const GraphProblem& problem : session.graph().problems())
        if (told.insert(problem.error.text()).second) errors.add(problem.error.text());
    errors.throw_if_any(where);
}

} // namespace bounce
