// What the dialog lists, and the files that were opened last.
#include "app/ui/open_dialog.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace bounce;

namespace {

struct Folder {
    Folder() : path(fs::temp_directory_path() / ("bounce_open_test_" + std::to_string(getpid()))) {
        fs::create_directories(path);
    }
    ~Folder() { fs::remove_all(path); }
    fs::path file(const std::string& name) const {
        std::ofstream(path / name) << "{}";
        return path / name;
    }
    fs::path path;
};

std::vector<std::string> names_of(const std::vector<FolderEntry>& entries) {
    std::vector<std::string> names;
    for (const FolderEntry& entry : entries)
        names.push_back(entry.name);
    return names;
}

} // namespace

TEST(OpenDialog, FoldersComeFirstAndOnlyWhatCanBeOpenedIsListed) {
    Folder folder;
    for (const char* name :
         {"b.gltf", "a.glb", "z.json", "sky.hdr", "notes.txt", "picture.png", ".hidden.json", "noext"})
        folder.file(name);
    fs::create_directory(folder.path / "textures");
    fs::create_directory(folder.path / ".git");
    fs::create_symlink("nowhere.json", folder.path / "broken.json");
    EXPECT_THAT(names_of(openable_entries(folder.path)),
                testing::ElementsAre("textures/", "a.glb", "b.gltf", "sky.hdr", "z.json"));
    EXPECT_TRUE(openable_entries(folder.path / "none").empty());
    EXPECT_TRUE(openable_entries(folder.path / "z.json").empty());
}

TEST(OpenDialog, TheNewestIsFirstAndEachIsThereOnce) {
    Folder folder;
    WindowState window;
    const fs::path a = folder.file("a.json"), b = folder.file("b.json");
    note_recent_file(window, a.string());
    note_recent_file(window, b.string());
    note_recent_file(window, (folder.path / "." / "a.json").string());
    EXPECT_THAT(window.recent_files, testing::ElementsAre(a.string(), b.string()));
    note_recent_file(window, "cornell"); // a name of the assets
    note_recent_file(window, folder.path.string());
    EXPECT_EQ(window.recent_files.size(), 2u);
    for (int i = 0; i < 30; ++i)
        note_recent_file(window, folder.file("f" + std::to_string(i) + ".json").string());
    EXPECT_EQ(window.recent_files.size(), k_recent_files);
    EXPECT_EQ(window.recent_files.front(), (folder.path / "f29.json").string());
}
