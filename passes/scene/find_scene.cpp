#include "scene/find_scene.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/paths.h"
#include "core/text.h"
#include "scene/scene_formats.h"
#include "scene/shot.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>

namespace bounce {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
    for (char& c : text)
        c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::vector<fs::path> entries(const fs::path& folder) {
    std::vector<fs::path> out;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        out.push_back(it->path());
    std::sort(out.begin(), out.end()); // the order of a folder is the file system's; ours is fixed
    return out;
}

/// `relative` below `folder`, each part matched without regard to case where the exact name is not there.
fs::path ignoring_case(const fs::path& folder, const fs::path& relative) {
    fs::path at = folder;
    std::error_code ignored;
    for (const fs::path& part : relative) {
        if (fs::exists(at / part, ignored)) {
            at /= part;
            continue;
        }
        std::string wanted = lower(part.string());
        fs::path match;
        for (const fs::path& entry : entries(at))
            if (match.empty() && lower(entry.filename().string()) == wanted) match = entry;
        if (match.empty()) return {};
        at = match;
    }
    return at;
}

/// The one scene of a folder, or the one that is named for it, or the first.
fs::path scene_in(const fs::path& folder) {
    std::vector<fs::path> scenes;
    for (const fs::path& entry : entries(folder))
        if (scene_format_of(entry)) scenes.push_back(entry);
    for (const fs::path& scene : scenes)
        if (lower(scene.stem().string()) == lower(folder.filename().string())) return scene;
    return scenes.empty() ? fs::path() : scenes.front();
}

/// What `name` means below one folder of the search path, or nothing.
fs::path resolve(const fs::path& folder, const std::string& name) {
    std::error_code ignored;
    std::vector<std::string> endings{""};
    for (const SceneFormat& format : scene_formats())
        endings.insert(endings.end(), format.extensions.begin(), format.extensions.end());
    for (const std::string& extension : endings) {
        fs::path found = ignoring_case(folder, name + extension);
        if (found.empty()) continue;
        if (fs::is_regular_file(found, ignored)) return found;
        if (fs::is_directory(found, ignored))
            if (fs::path scene = scene_in(found); !scene.empty()) return scene;
    }
    return {};
}

} // namespace

std::vector<fs::path> scene_search_path() {
    std::vector<fs::path> folders;
    if (const char* set = std::getenv("BOUNCE_SCENES"))
        for (const std::string& folder : split(set, ':'))
            if (!folder.empty()) folders.emplace_back(folder);
    folders.push_back(assets_folder() / "scenes");
    folders.push_back(root_folder() / ".." / "shared" / "scenes");
    return folders;
}

std::vector<std::string> scene_names() {
    std::set<std::string> names;
    for (const fs::path& folder : scene_search_path())
        for (const fs::path& entry : entries(folder)) {
            if (scene_format_of(entry)) names.insert(entry.stem().string());
            std::error_code ignored;
            if (fs::is_directory(entry, ignored) && !scene_in(entry).empty()) names.insert(entry.filename().string());
        }
    return {names.begin(), names.end()};
}

/// Files name others by relative paths only: what is read because of a file stays where a person can see it coming.
static void refuse_reference(const std::string& name, const char* what) {
    if (const std::string refused = refused_uri(name); !refused.empty())
        throw Error(std::string("invalid ") + what + " '" + name + "': " + refused +
                    "; expected a path relative to this file, or a name on the scene search path");
}

static fs::path find_along_path(const std::string& name, const fs::path& base) {
    std::vector<fs::path> folders{base.empty() ? fs::path(".") : base};
    for (const fs::path& folder : scene_search_path())
        folders.push_back(folder);
    std::vector<std::string> tried;
    for (const fs::path& folder : folders) {
        if (fs::path found = resolve(folder, name); !found.empty()) return found.lexically_normal();
        std::error_code ignored;
        tried.push_back(fs::weakly_canonical(folder, ignored).string());
    }
    throw Error("no scene '" + name + "'" + did_you_mean(name, scene_names()) + "; looked in " + join(tried, ", "));
}

fs::path find_scene(const std::string& name, const fs::path& base) {
    if (trim(name).empty()) throw Error("a scene is a path or a name, but this one is empty");
    refuse_reference(name, "scene");
    return find_along_path(name, base);
}

fs::path find_given_scene(const std::string& name) {
    if (trim(name).empty()) throw Error("a scene is a path or a name, but this one is empty");
    if (!fs::path(name).is_absolute()) return find_along_path(name, ".");
    if (fs::path found = resolve(fs::path(name).root_path(), fs::path(name).relative_path().string()); !found.empty())
        return found;
    if (const std::string kind = irregular_kind(name); !kind.empty() && kind != "a folder")
        throw Error("no scene at '" + name + "': it is " + kind + "; expected a regular file");
    throw Error("no scene at '" + name + "'");
}

fs::path find_scene_file(const std::string& name, const fs::path& base) {
    refuse_reference(name, "file");
    std::vector<fs::path> folders{base.empty() ? fs::path(".") : base};
    for (const fs::path& folder : scene_search_path())
        folders.push_back(folder);
    std::vector<std::string> tried;
    for (const fs::path& folder : folders) {
        std::error_code ignored;
        if (fs::is_regular_file(folder / name, ignored)) return (folder / name).lexically_normal();
        if (const std::string kind = irregular_kind(folder / name); !kind.empty())
            throw Error("cannot read '" + (folder / name).lexically_normal().string() + "': it is " + kind +
                        "; expected a regular file");
        tried.push_back(fs::weakly_canonical(folder, ignored).string());
    }
    throw Error("there is no file '" + name + "'; looked in " + join(tried, ", "));
}

} // namespace bounce
