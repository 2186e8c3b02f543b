#include "graph/shader_log.h"

#include <atomic>

namespace bounce {

static std::atomic<bool> g_logged{true};

void set_shader_errors_logged(bool logged) {
    g_logged = logged;
}

bool shader_errors_logged() {
    return g_logged;
}

} // namespace bounce
