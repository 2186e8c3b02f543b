#include "core/error.h"

#include "core/printable.h"

namespace bounce {

void ErrorList::throw_if_any(const std::string& where) const {
    if (messages_.empty()) return;
    if (messages_.size() == 1) throw Error(printable(where + ": " + messages_.front()));
    std::string text = where + ": " + std::to_string(messages_.size()) + " errors";
    for (const std::string& message : messages_)
        text += "\n  " + message;
    throw Error(printable(text)); // a zero byte would end it
}

} // namespace bounce
