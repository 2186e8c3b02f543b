#include "gpu/context_loss.h"

#include <glad/gl.h>

namespace bounce {

static ResetCause& told() {
    static ResetCause cause = ResetCause::none;
    return cause;
}

const char* to_string(ResetCause cause) {
    switch (cause) {
    case ResetCause::none:
        return "the GPU was not reset";
    case ResetCause::guilty:
        return "the GPU was reset because of what this program did";
    case ResetCause::innocent:
        return "the GPU was reset because of another program";
    case ResetCause::unknown:
        return "the GPU was reset for an unknown reason";
    }
    return "";
}

ResetCause context_reset() {
    if (told() != ResetCause::none || !glGetGraphicsResetStatus) return told();
    switch (glGetGraphicsResetStatus()) {
    case GL_NO_ERROR:
        return ResetCause::none;
    case GL_GUILTY_CONTEXT_RESET:
        return told() = ResetCause::guilty;
    case GL_INNOCENT_CONTEXT_RESET:
        return told() = ResetCause::innocent;
    default:
        return told() = ResetCause::unknown;
    }
}

void pretend_reset(ResetCause cause) {
    told() = cause;
}

void forget_reset() {
    told() = ResetCause::none;
}

} // namespace bounce
