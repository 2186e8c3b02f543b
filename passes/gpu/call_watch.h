#pragma once
// Watches the program's calls of OpenGL, whoever makes them, and holds them to the rules of hazard_check.h. It knows
// what is bound where, which textures are views of others, and what each program declares.

#include "gpu/hazard_check.h"

namespace bounce {

/// Puts itself between the program and the driver: after a context has become current and its functions are loaded, and
/// again for each later context (what was known is forgotten then). It stays until the program ends.
void watch_calls();
bool calls_are_watched();
/// Takes itself away again; what was found is forgotten.
void stop_call_watch();
/// Whether start_context() watches from now on, as it does with BOUNCE_CHECK_HAZARDS in the environment.
void want_call_watch(bool wanted = true);
bool call_watch_is_wanted();

/// What has been found since watch_calls(). Hazards are logged as errors when they are found.
HazardCheck& hazard_check();

/// For tests: the n-th barrier from now on (0: the next) is not counted, as if the program had not called it.
void overlook_barrier(int n);

} // namespace bounce
