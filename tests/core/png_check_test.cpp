// What the data of a PNG may unfold to.

#include "core/error.h"
#include "core/image.h"

#include <gmock/gmock.h>
#include <stb_image_write.h>
#include <vector>
#include <zlib.h>

namespace bounce {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

namespace {

std::string number(uint32_t v) {
    return {char(v >> 24), char(v >> 16), char(v >> 8), char(v)};
}

std::string chunk(const std::string& type, const std::string& content) {
    return number(uint32_t(content.size())) + type + content + "sums";
}

std::string folded(const std::string& bytes) {
    uLongf size = compressBound(uLong(bytes.size()));
    std::string out(size, '\0');
    compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
              uLong(bytes.size()), 9);
    return out.substr(0, size);
}

/// Grey, eight bits, interlaced or not.
std::string png(uint32_t width, uint32_t height, const std::string& data, bool interlaced = false) {
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", number(width) + number(height) + std::string({8, 0, 0, 0, char(interlaced)})) + data +
           chunk("IEND", "");
}

std::string told(const std::string& bytes) {
    try {
        decode_image8(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), "x.png");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(PngCheck, WholeOnesPass) {
    for (int channels : {1, 2, 3, 4})
        for (int side : {1, 7, 65}) {
            std::vector<uint8_t> pixels(size_t(side * side * channels), 77);
            std::string bytes;
            stbi_write_png_to_func(
                [](void* to, void* data, int size) {
                    static_cast<std::string*>(to)->append(static_cast<const char*>(data), size_t(size));
                },
                &bytes, side, side, channels, pixels.data(), side * channels);
            EXPECT_EQ(told(bytes), "") << channels << " of " << side;
            EXPECT_EQ(told(bytes + "and more"), "");
            for (size_t length = 0; length < bytes.size() - 12; ++length) // its last chunk is not needed
                EXPECT_NE(told(bytes.substr(0, length)), "") << length;
        }
    const std::string data = folded(std::string(6, '\0'));
    EXPECT_EQ(told(png(2, 2, chunk("IDAT", data))), "");
    EXPECT_EQ(told(png(2, 2, chunk("IDAT", data.substr(0, 3)) + chunk("IDAT", "") + chunk("IDAT", data.substr(3)))),
              "");
    EXPECT_EQ(told(png(1, 1, chunk("IDAT", folded(std::string(2, '\0'))), true)), "");
}

TEST(PngCheck, DataUnfoldToNoMoreThanThePicture) {
    const std::string bomb = folded(std::string(64 << 20, '\0')); // 65 kB
    for (bool interlaced : {false, true})
        EXPECT_THAT(told(png(1, 1, chunk("IDAT", bomb), interlaced)),
                    AllOf(StartsWith("x.png: the PNG is damaged"), HasSubstr("more than its size says")));
    EXPECT_THAT(told(png(1, 1, chunk("IDAT", bomb.substr(0, 9)) + chunk("IDAT", bomb.substr(9)))),
                HasSubstr("more than its size says"));
}

TEST(PngCheck, WhatTheDecoderWouldTakeForSomethingElse) {
    const std::string data = folded(std::string(6, '\0'));
    EXPECT_THAT(told(png(2, 2, chunk("CgBI", "0000") + chunk("IDAT", data))), HasSubstr("not a standard PNG"));
    EXPECT_THAT(told(png(2, 2, number(1u << 30) + "IDAT" + data)), HasSubstr("it ends within a chunk"));
    EXPECT_THAT(told(png(2, 2, chunk("IDAT", data.substr(0, data.size() - 6)))), HasSubstr("cut off"));
    EXPECT_THAT(told(png(2, 2, chunk("IDAT", "no stream"))), HasSubstr("do not unfold"));
}

} // namespace bounce
