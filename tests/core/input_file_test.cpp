// What may be read: regular files of a limited size, and nothing that waits or never ends.

#include "core/input_file.h"

#include "core/image.h"
#include "core/output_file.h"
#include "core/paths.h"
#include "core/printable.h"
#include "support/errors.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <set>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace bounce {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(InputFile, WhatIsNoRegularFileIsRefusedAtOnce) {
    TempFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder / "zero");
    fs::create_directory(folder / "sub");
    const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = (folder / "socket").string();
    ASSERT_LT(path.size(), sizeof address.sun_path);
    path.copy(address.sun_path, path.size());
    ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);

    auto refusal = [&](const char* name) { return error_of([&] { read_file(folder / name, 1000); }); };
    EXPECT_THAT(refusal("pipe"), HasSubstr("it is a pipe; expected a regular file"));
    EXPECT_THAT(refusal("zero"), HasSubstr("it is a device; expected a regular file"));
    EXPECT_THAT(refusal("sub"), HasSubstr("it is a folder; expected a regular file"));
    EXPECT_THAT(refusal("socket"), HasSubstr("it is a socket; expected a regular file"));
    EXPECT_THAT(refusal("none"), HasSubstr("No such file"));
    EXPECT_EQ(irregular_kind(folder / "pipe"), "a pipe");
    EXPECT_EQ(irregular_kind(folder / "none"), "");
    ::close(listener);
}

TEST(InputFile, ALinkToAFileIsRead) {
    TempFolder folder;
    folder.write("real", "text");
    fs::create_symlink(folder / "real", folder / "link");
    EXPECT_EQ(read_file(folder / "link", 4), "text");
}

TEST(InputFile, SizesAreBoundedBeforeAnythingIsRead) {
    TempFolder folder;
    folder.write("a", "12345");
    EXPECT_EQ(read_file(folder / "a", 5), "12345");
    EXPECT_THAT(error_of([&] { read_file(folder / "a", 4); }), HasSubstr("it has 5 bytes; expected at most 4"));
    // A hole of a tebibyte costs nothing to make, and must cost nothing to refuse.
    fs::resize_file(folder / "a", uintmax_t(1) << 40);
    EXPECT_THAT(error_of([&] { read_file(folder / "a", 1 << 20); }), HasSubstr("1,099,511,627,776 bytes"));
    // Files that the kernel makes up say that they are empty, and are not read past that.
    EXPECT_EQ(read_file("/proc/self/maps", 1 << 20), "");
}

TEST(InputFile, FilesNameOthersByRelativePaths) {
    for (const char* good : {"a.png", "../textures/a b.png", "./x/../a.bin", "9:9.png", "a/b:c.png"})
        EXPECT_EQ(refused_uri(good), "") << good;
    for (const char* bad :
         {"", "/etc/hostname", "//host/x", "\\\\host\\x", "file:///etc/hostname", "http://x/y", "c:x"})
        EXPECT_NE(refused_uri(bad), "") << bad;
    EXPECT_NE(refused_uri(std::string("a\0b", 3)), "");
    EXPECT_EQ(refused_path("a:b"), "") << "a colon is no scheme in a path";
}

TEST(OutputFile, WhatCannotBeWrittenIsKnownBefore) {
    TempFolder folder;
    fs::create_directory(folder / "taken.png");
    folder.write("file", "");
    auto refusal = [&](const fs::path& name) { return error_of([&] { check_writable(folder.path() / name); }); };
    EXPECT_EQ(refusal("new.png"), "");
    EXPECT_EQ(refusal("file"), "");
    EXPECT_THAT(refusal("taken.png"), HasSubstr("it is a folder"));
    EXPECT_THAT(refusal("none/x.png"), HasSubstr("there is no folder"));
    EXPECT_THAT(refusal("file/x.png"), HasSubstr("there is no folder"));
    EXPECT_THAT(refusal("x.png/"), HasSubstr("a file name is needed"));
    EXPECT_THAT(refusal(std::string(300, 'x') + ".png"), HasSubstr("File name too long"));
    EXPECT_THAT(error_of([] { check_writable("/proc/self/x.png"); }), HasSubstr("x.png"));
    std::set<std::string> left;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        left.insert(entry.path().filename().string());
    EXPECT_THAT(left, testing::ElementsAre("file", "taken.png"));
}

TEST(OutputFile, APipeThatNobodyReadsDoesNotHoldTheProgram) {
    TempFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(error_of([&] { write_file_atomically(folder / "pipe", "x"); }), HasSubstr("nobody reads from it"));
}

TEST(Paths, WithoutAHomeNothingIsKeptInAFolderThatOthersShare) {
    ScopedVariable home("HOME", ""), cache("XDG_CACHE_HOME", ""), state("XDG_STATE_HOME", "relative");
    EXPECT_THAT(error_of([] { cache_folder(); }), HasSubstr("neither XDG_CACHE_HOME nor HOME is set"));
    EXPECT_THAT(error_of([] { state_folder(); }), HasSubstr("neither XDG_STATE_HOME nor HOME is set"));
    TempFolder folder;
    ScopedVariable own("HOME", folder.path().string());
    EXPECT_EQ(cache_folder(), folder / ".cache/bounce");
}

TEST(Printable, KeepsTextAndNothingThatATerminalObeys) {
    EXPECT_EQ(printable("plain\n\ttext · α 𝄞"), "plain\n\ttext · α 𝄞");
    EXPECT_EQ(printable("\x1b[2J\r\x7f"), "\uFFFD[2J\uFFFD\uFFFD");
    EXPECT_EQ(printable("\xc2\x9b\xff\xc3"), "\uFFFD\uFFFD\uFFFD") << "a control character of two bytes, and no UTF-8";
    EXPECT_EQ(printable("\xc0\xaf\xed\xa0\x80\xf4\x90\x80\x80"), [] {
        std::string each;
        for (int i = 0; i < 9; ++i)
            each += "\uFFFD";
        return each;
    }()) << "overlong, a surrogate, and beyond Unicode";
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a\uFFFD"
                                                 "b");
}

} // namespace bounce
