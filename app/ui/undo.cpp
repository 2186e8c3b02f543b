// What was done, and can be taken back.
#include "app/ui/undo.h"

namespace bounce {

void UndoStack::push(UndoStep step) {
    constexpr size_t k_kept = 500;
    done_.push_back(std::move(step));
    undone_.clear();
    if (done_.size() > k_kept) done_.erase(done_.begin());
}

bool UndoStack::undo() {
    if (done_.empty()) return false;
    UndoStep step = std::move(done_.back());
    done_.pop_back();
    step.undo();
    undone_.push_back(std::move(step));
    return true;
}

bool UndoStack::redo() {
    if (undone_.empty()) return false;
    UndoStep step = std::move(undone_.back());
    undone_.pop_back();
    step.redo();
    done_.push_back(std::move(step));
    return true;
}

std::string UndoStack::next_undo() const {
    return done_.empty() ? "" : done_.back().what;
}

std::string UndoStack::next_redo() const {
    return undone_.empty() ? "" : undone_.back().what;
}

} // namespace bounce
