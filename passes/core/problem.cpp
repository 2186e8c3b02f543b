#include "core/problem.h"

#include "core/json_text.h"

#include <filesystem>
#include <new>

namespace bounce {

std::string problem_text(const std::exception& problem) {
    if (dynamic_cast<const std::bad_alloc*>(&problem)) return "out of memory";
    if (const auto* json = dynamic_cast<const nlohmann::json::exception*>(&problem)) return json_problem(*json);
    if (const auto* files = dynamic_cast<const std::filesystem::filesystem_error*>(&problem)) {
        std::string text;
        for (const std::filesystem::path& path : {files->path1(), files->path2()})
            if (!path.empty()) text += "'" + path.string() + "': ";
        return text + files->code().message();
    }
    return problem.what();
}

} // namespace bounce
