#pragma once
// The text of the Error that an action throws, or "" when it throws none.

#include "core/error.h"

#include <string>

namespace bounce {

template <class Action>
std::string error_of(Action&& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace bounce
