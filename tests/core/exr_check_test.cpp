// What the headers of an OpenEXR file may say of sizes.

#include "core/error.h"
#include "core/exr_check.h"
#include "core/image_exr.h"
#include "core/input_file.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

namespace bounce {

using testing::AllOf;
using testing::HasSubstr;

namespace {

std::string number(uint32_t v) {
    return {char(v), char(v >> 8), char(v >> 16), char(v >> 24)};
}

std::string attribute(const std::string& name, const std::string& type, uint32_t size, const std::string& value) {
    return name + '\0' + type + '\0' + number(size) + value;
}

std::string file(const std::string& headers, uint32_t flags = 0) {
    return number(20000630) + number(2 | flags) + headers;
}

std::string told(const std::string& bytes) {
    try {
        check_exr(bytes);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

const std::string k_end(1, '\0');
constexpr uint32_t k_multipart = 0x1000;

} // namespace

TEST(ExrCheck, TakesWhatTheLibraryWrites) {
    TempFolder folder;
    LayeredImage image;
    for (const char* name : {"", "out.direct", "gbuffer.normal"})
        image.layers[name] = Image(5, 3, 3);
    image.metadata = "{}";
    write_exr(folder / "a.exr", image);
    const std::string bytes = read_file(folder / "a.exr");
    EXPECT_EQ(told(bytes), "");
    for (size_t length = 8; length < 200; ++length)
        EXPECT_THAT(told(bytes.substr(0, length)), HasSubstr("the file")) << length;
}

TEST(ExrCheck, AttributesLieWithinTheFile) {
    EXPECT_EQ(told(file(attribute("a", "string", 3, "xyz") + k_end)), "");
    EXPECT_THAT(told(file(attribute("a", "unknown", 1634692198, "xyz") + k_end)),
                AllOf(HasSubstr("'a'"), HasSubstr("1634692198 bytes"), HasSubstr("holds 4")));
    EXPECT_THAT(told(file(attribute("a", "string", 0xffffffff, "xyz") + k_end)), HasSubstr("4294967295"));
    EXPECT_THAT(told(file("name without an end")), HasSubstr("ends within a header"));
}

/// The library goes by the type and would take what follows for something else.
TEST(ExrCheck, AttributesHaveTheSizeOfTheirType) {
    EXPECT_EQ(told(file(attribute("w", "box2i", 16, std::string(16, 'x')) + k_end)), "");
    EXPECT_THAT(told(file(attribute("w", "box2i", 12, std::string(12, 'x')) + k_end)), HasSubstr("expected 16"));
    const std::string channel = std::string("R") + '\0' + std::string(16, 'x');
    EXPECT_EQ(told(file(attribute("channels", "chlist", 19, channel + '\0') + k_end)), "");
    EXPECT_THAT(told(file(attribute("channels", "chlist", 18, channel) + k_end)), HasSubstr("header"));
    EXPECT_THAT(told(file(attribute("channels", "chlist", 21, channel + std::string("\0xy", 3)) + k_end)),
                HasSubstr("channels"));
    EXPECT_EQ(told(file(attribute("views", "stringvector", 10, number(2) + "ab" + number(0)) + k_end)), "");
    EXPECT_THAT(told(file(attribute("views", "stringvector", 6, number(200) + "ab") + k_end)), HasSubstr("longer"));
    EXPECT_THAT(told(file(attribute(std::string(256, 'n'), "int", 4, number(1)) + k_end)), HasSubstr("256 bytes"));
}

TEST(ExrCheck, EveryHeaderOfSeveralPartsIsGoneThrough) {
    const std::string good = attribute("a", "int", 4, number(1)) + k_end, bad = attribute("b", "int", 99, "") + k_end;
    EXPECT_EQ(told(file(good + good + k_end, k_multipart)), "");
    EXPECT_THAT(told(file(good + bad + k_end, k_multipart)), HasSubstr("'b'"));
    EXPECT_EQ(told(file(good + bad)), ""); // of one part: pixels follow
}

TEST(ExrCheck, APreviewHasTheSizeOfItsPixels) {
    const auto preview = [](uint32_t width, uint32_t height, size_t bytes) {
        return file(attribute("preview", "preview", uint32_t(8 + bytes),
                              number(width) + number(height) + std::string(bytes, 'x')) +
                    k_end);
    };
    EXPECT_EQ(told(preview(3, 2, 24)), "");
    EXPECT_THAT(told(preview(65535, 65535, 24)), HasSubstr("65535×65535"));
    EXPECT_THAT(told(preview(0x80000000, 2, 0)), HasSubstr("preview"));
}

TEST(ExrCheck, WhatIsNoOpenExrIsLeftToTheLibrary) {
    EXPECT_EQ(told(""), "");
    EXPECT_EQ(told("v/1"), "");
    EXPECT_EQ(told("nothing of the kind"), "");
}

} // namespace bounce
