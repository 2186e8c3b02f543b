#pragma once
// Settings of a graph for an error, a time or a memory on one or several shots, found by measuring.

#include "app/experiments/tune_search.h"

#include <filesystem>
#include <glm/glm.hpp>
#include <map>

namespace bounce {

struct TuneSettings {
    std::vector<std::string> shots;
    SessionOptions session; ///< of every point: the graph, what else holds; the size is that of the last stage
    TuneGoal goal;
    std::vector<std::string> over; ///< "gather.interleave", "gather.*"; empty: all that matter
    int budget = 200;              ///< variants of each search
    double seconds = 1200;         ///< after which no further variant is begun
    int samples = 256, frames = 2;
    int survivors = 4;        ///< that are measured at full size
    double first_scale = 0.5; ///< size of the search's pictures, share of the full size
};

struct TuneOutcome {
    TuneResult search;                      ///< at the size of the first stage
    std::vector<TunePoint> finals;          ///< at full size: the start, then the survivors, the best of those first
    std::vector<std::string> over;          ///< what was searched
    std::map<std::string, std::string> own; ///< of these, the graph's values
};

/// Points that were measured before, by stage: a run that was interrupted goes on from them.
class TuneMemory {
  public:
    /// Of a file that may be there. Points that were measured for something else (`key`) are left out.
    TuneMemory(std::filesystem::path file, std::string key);
    /// Null when the variant was not measured; nothing in it when it did not work.
    const std::optional<TuneFigures>* find(int stage, const Variant& variant) const;
    /// Writes the file. Throws Error.
    void add(int stage, const Variant& variant, const std::optional<TuneFigures>& figures);
    size_t size() const { return points_.size(); }

  private:
    std::filesystem::path file_;
    std::string key_;
    std::map<std::pair<int, Variant>, std::optional<TuneFigures>> points_;
};

/// The parameters of the passes that what is compared stands on, as far as `over` names them. Throws Error for a name
/// that is none.
std::vector<TuneParameter> tunable_parameters(const GraphModel& model, const Plan& plan,
                                              const std::vector<std::string>& over);

/// The size of the first stage.
glm::ivec2 tune_first_size(const TuneSettings& settings);

/// What names a run: points of another are of no use to it.
std::string tune_key(const TuneSettings& settings);

/// `finals.size() > 1 ? finals[1] : finals[0]` are the settings found. Needs a current OpenGL context. Throws Error.
TuneOutcome tune(const TuneSettings& settings, TuneMemory& memory, const std::function<void(const std::string&)>& say);

/// Front, start and settings found, as Markdown without a head.
std::string tune_markdown(const TuneSettings& settings, const TuneOutcome& outcome);

} // namespace bounce
