#pragma once
// Finds commands that may see memory as it was before a shader's stores, or overwrite what a shader still reads: where
// the memory barrier is missing that the later access needs. Software drivers run one dispatch after another and show
// none of it; a GPU shows it as wrong pictures. No OpenGL calls.
//
// The rules (OpenGL 4.6, §7.13.2): stores of shaders (images, storage blocks) are not ordered with anything. Whatever
// touches that memory later needs a glMemoryBarrier between the two with the bit of its own route. A store to what a
// shader read before needs a barrier with the store's own bit, which makes it wait for those reads. All else (draws
// into framebuffers, copies, clears, uploads) OpenGL orders by itself. Within one command nothing is ordered: memory
// that it writes by one binding must not be touched by another (feedback).

#include "gpu/memory_use.h"

#include <functional>
#include <map>
#include <set>

namespace bounce {

class HazardCheck {
  public:
    /// "'voxels.radiance' (mip 2)", for messages; the object's number where nothing is set.
    std::function<std::string(const MemoryRange&)> describe;

    void command(const MemoryCommand& command);
    void barrier(GLbitfield bits, const std::string& place);
    /// The object is gone, or new.
    void forget(GLuint object, bool is_buffer);

    /// One line each, in the order of their first occurrence; each once.
    const std::vector<std::string>& hazards() const { return hazards_; }
    /// A hazard that was found otherwise (an image bound with another format). Told once.
    void report(const std::string& hazard);
    std::function<void(const std::string&)> on_hazard; ///< called for each when it is found

    /// What was told, for telling it to another check without one of its barriers.
    struct Event {
        MemoryCommand command; ///< unless a barrier
        GLbitfield barrier = 0;
        std::string place; ///< of the barrier
    };
    std::vector<Event>* trace = nullptr; ///< is added to while it is set

    struct Barrier {
        GLbitfield bits = 0;
        std::string place;
        GLbitfield needed = 0; ///< bits that some command needed, and that no other barrier gave it
        GLbitfield used = 0;   ///< bits that some command needed, and that this barrier gave it first
    };
    const std::vector<Barrier>& barriers() const { return barriers_; }
    /// Their number by place, and the places whose barriers no command has needed so far, which only cost time.
    std::string barrier_report() const;
    /// Begins their list anew: what they ordered stays ordered.
    void forget_barriers();

  private:
    /// Bits that barriers gave since an access, at most twice each: index of the barrier, bits.
    using Since = std::vector<std::pair<int, GLbitfield>>;
    struct Access {
        MemoryRange range;
        std::string by; ///< "pass …, by image 'voxels_coarser'"
        Since since;
    };
    using Accesses = std::vector<Access>;
    struct Memory {
        Accesses stores, reads;
    };

    static void record(Accesses& accesses, const MemoryRange& range, std::string by);
    static void give(Accesses& accesses, int barrier, GLbitfield bits);
    bool ordered(const Access& access, GLbitfield bit);
    void check(const MemoryCommand& command, const MemoryUse& use);
    void check_feedback(const MemoryCommand& command);
    std::string text_of(const MemoryRange& range) const;

    std::map<std::pair<bool, GLuint>, Memory> memory_;
    std::vector<Barrier> barriers_;
    int first_barrier_ = 0; ///< number of the first in the list
    std::vector<std::string> hazards_;
    std::set<std::string> told_;
};

} // namespace bounce
