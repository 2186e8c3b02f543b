// What a JPEG's tables may be before the decoder sees them.

#include "core/error.h"
#include "core/image.h"
#include "core/jpeg_check.h"

#include <gmock/gmock.h>
#include <stb_image_write.h>

namespace bounce {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

namespace {

std::string jpeg(int width, int height, int channels) {
    std::vector<uint8_t> pixels(size_t(width * height * channels));
    for (size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = uint8_t(i * 7);
    std::string out;
    stbi_write_jpg_to_func(
        [](void* to, void* data, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(data), size_t(size));
        },
        &out, width, height, channels, pixels.data(), 90);
    return out;
}

/// A marker with its content.
std::string segment(int marker, const std::string& content) {
    const size_t length = content.size() + 2;
    return std::string{char(0xFF), char(marker), char(length >> 8), char(length & 255)} + content;
}

std::string told(const std::string& bytes) {
    try {
        decode_image8(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), "x.jpg");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// A Huffman table with so many codes of each length from 8 on.
std::string table(int type, const std::vector<int>& codes) {
    std::string text(1, char(type));
    text += std::string(7, '\0');
    size_t sum = 0;
    for (size_t i = 0; i < 9; ++i) {
        text += char(i < codes.size() ? codes[i] : 0);
        sum += i < codes.size() ? size_t(codes[i]) : 0;
    }
    return text + std::string(sum, '\1');
}

/// The same picture with `bytes` behind its first marker, or before its scan.
std::string with(const std::string& picture, const std::string& bytes, bool before_scan = false) {
    const size_t at = before_scan ? picture.find("\xFF\xDA") : 2;
    return picture.substr(0, at) + bytes + picture.substr(at);
}

} // namespace

TEST(JpegCheck, WholeOnesPass) {
    for (int channels : {1, 3})
        for (int side : {1, 8, 33})
            EXPECT_EQ(told(jpeg(side, side, channels)), "");
    const std::string picture = jpeg(16, 16, 3);
    EXPECT_EQ(told(with(picture, segment(0xC4, table(0x13, {200, 55})))), "") << "no scan uses it";
    EXPECT_EQ(told(with(picture, segment(0xE1, "\xFF\xC4\x01\x02" + std::string(40, '\xFF')))), "") << "a note's bytes";
    EXPECT_EQ(told(with(picture, "\xFF\xFF")), "") << "fill bytes";
    EXPECT_EQ(told(picture + segment(0xC4, table(0x13, {255, 255}))), "") << "behind its end";
}

TEST(JpegCheck, TablesHaveNoMoreCodesThanTheDecoderHasPlacesFor) {
    const std::string picture = jpeg(16, 16, 3);
    for (int type : {0x00, 0x03, 0x10, 0x13})
        for (bool before_scan : {false, true}) {
            EXPECT_THAT(told(with(picture, segment(0xC4, table(type, {200, 56})), before_scan)),
                        AllOf(StartsWith("x.jpg: the JPEG is damaged"), HasSubstr("256 codes; expected at most 255")));
            EXPECT_THAT(
                told(with(picture, segment(0xC4, table(0x13, {1}) + table(type, std::vector(9, 255))), before_scan)),
                HasSubstr("2295 codes"));
        }
    // Between scans, and behind bytes that the decoder passes over.
    const size_t end = picture.rfind("\xFF\xD9");
    const std::string bad = segment(0xC4, table(0, {255, 255}));
    for (const std::string& before : {std::string(), std::string("\xFF\xFF"), std::string("\xFF\0", 2),
                                      std::string("\xFF\xD0"), segment(0xFE, "\xFF\xD9")})
        EXPECT_THAT(told(picture.substr(0, end) + before + bad + picture.substr(end)), HasSubstr("510 codes"));
    EXPECT_THAT(told("\xFF" + with(picture, bad)), HasSubstr("510 codes")) << "a fill byte before its start";
}

TEST(JpegCheck, ScansUseTablesThatAreThere) {
    const std::string picture = jpeg(16, 16, 3);
    for (int marker : {0xC4, 0xDB}) {
        const size_t at = picture.find(std::string{char(0xFF), char(marker)});
        ASSERT_NE(at, std::string::npos);
        const size_t length = 2 + size_t(uint8_t(picture[at + 2]) << 8 | uint8_t(picture[at + 3]));
        EXPECT_THAT(told(picture.substr(0, at) + picture.substr(at + length)), HasSubstr("which is not there"));
    }
    std::string other = picture;
    const size_t scan = other.find("\xFF\xDA");
    other[scan + 6] = char(0x22); // of the first component
    EXPECT_THAT(told(other), HasSubstr("Huffman table 2 of class 0, which is not there"));
}

TEST(JpegCheck, CutOffAnywhere) {
    const std::string picture = jpeg(16, 16, 3);
    for (size_t length = 0; length < picture.size(); ++length)
        told(picture.substr(0, length)); // refused, or decoded as far as it goes; never read beyond
    EXPECT_THAT(told(with(picture, segment(0xC4, table(0, {9}).substr(0, 20)))), HasSubstr("cut off"));
    EXPECT_THAT(told(with(picture, segment(0xDB, "\1abc"))), HasSubstr("cut off"));
    // The decoder builds tables of what is there.
    const std::string large = segment(0xC4, table(0x10, {255, 255}));
    EXPECT_THAT(told(with(picture, large, true).substr(0, picture.find("\xFF\xDA") + 60)), HasSubstr("it ends within"));
}

} // namespace bounce
