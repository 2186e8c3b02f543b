// What an image says of its size is judged before it is decoded.

#include "core/image_budget.h"

#include "core/image.h"
#include "core/limits.h"
#include "support/errors.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

namespace bounce {

using testing::HasSubstr;

namespace {

std::string big_endian(uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

/// The start of a PNG of RGBA bytes; `more` stands for its pixels. (Checksums are not looked at.)
std::string png_of(uint32_t width, uint32_t height, const std::string& more = "") {
    return "\x89PNG\r\n\x1a\n" + big_endian(13) + "IHDR" + big_endian(width) + big_endian(height) +
           std::string("\x08\x06\0\0\0", 5) + "sum!" + more;
}

/// The start of a JPEG: its frame header.
std::string jpeg_of(int width, int height, const std::string& more = "") {
    std::string text("\xff\xd8\xff\xc0\0\x0b\x08", 7);
    for (int side : {height, width})
        text += {char(side >> 8), char(side)};
    return text + std::string("\x01\x01\x11\0", 4) + more;
}

DeclaredSize declared(const std::string& bytes) {
    return declared_size(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), "x");
}

std::string hdr_of(const std::string& size, const std::string& pixels) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + pixels;
}

std::string hdr_error(const std::string& bytes) {
    return error_of([&] { check_hdr(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), "x"); });
}

/// Four channels of one run each.
const std::string k_row_of_8 = std::string("\x02\x02\0\x08\x88\x01\x88\x02\x88\x03\x88\x04", 12);

} // namespace

TEST(DeclaredSize, IsThatOfTheHeader) {
    EXPECT_EQ(declared(png_of(640, 480, std::string(100, 'x'))).pixels(), 640u * 480);
    EXPECT_EQ(declared(jpeg_of(64, 48)).width, 64);
    EXPECT_EQ(declared(jpeg_of(64, 48)).height, 48);
}

TEST(DeclaredSize, IsRefusedWhereTheBytesCannotHoldIt) {
    EXPECT_THAT(error_of([] { declared(png_of(16384, 16384)); }),
                HasSubstr("x: invalid size 16384x16384: so many pixels do not fit in 33 bytes"));
    EXPECT_EQ(error_of([] { declared(png_of(16384, 16384, std::string(40000, 'x'))); }), "");
    EXPECT_THAT(error_of([] { declared(jpeg_of(16384, 16384)); }), HasSubstr("so many pixels do not fit"));
    EXPECT_THAT(error_of([] { declared(png_of(16385, 1)); }), HasSubstr("expected sides of 1 … 16384 pixels"));
    EXPECT_THROW(declared(png_of(16384, 16384)), DeclaredSizeError);
}

TEST(DeclaredSize, OnlyKnownFormats) {
    for (const std::string& other : {std::string("GIF89a\x01\0\x01\0\0\0\0", 13), std::string("P6 1 1 255\nabc"),
                                     std::string("8BPS\0\x01", 6), std::string("#?RADIANCE\n"), std::string("text")})
        EXPECT_THAT(error_of([&] { declared(other); }), HasSubstr("expected a PNG or JPEG")) << other;
}

TEST(TextureBudget, IsAskedBeforeDecoding) {
    EXPECT_EQ(error_of([] { check_texture_budget(k_max_texture_pixels, "x"); }), "");
    EXPECT_THAT(error_of([] { check_texture_budget(k_max_texture_pixels + 1, "x.gltf"); }),
                testing::AllOf(HasSubstr("x.gltf: 268,435,457 pixels: expected at most 268,435,456"),
                               HasSubstr("--max-texture")));
    set_max_texture_pixels(100);
    const std::string large = png_of(20, 20);
    EXPECT_THAT(error_of([&] { decode_image8(reinterpret_cast<const uint8_t*>(large.data()), large.size(), "x"); }),
                HasSubstr("400 pixels: expected at most 100"));
    set_max_texture_pixels(k_max_texture_pixels);
}

TEST(Hdr, GoodFilesPass) {
    EXPECT_EQ(hdr_error(hdr_of("-Y 1 +X 2", std::string(8, 'x'))), "");
    EXPECT_EQ(hdr_error(hdr_of("-Y 2 +X 8", k_row_of_8 + k_row_of_8)), "");
    EXPECT_EQ(hdr_error(hdr_of("-Y 2 +X 8", k_row_of_8 + k_row_of_8 + "more")), "");
    EXPECT_EQ(hdr_error(hdr_of("-Y 2 +X 8", std::string(64, 'x'))), "") << "flat, though it could be encoded";
}

TEST(Hdr, EveryCutIsRefused) {
    const std::string whole = hdr_of("-Y 2 +X 8", k_row_of_8 + k_row_of_8);
    for (size_t length = 0; length < whole.size(); ++length)
        EXPECT_THAT(hdr_error(whole.substr(0, length)), testing::StartsWith("x: ")) << length;
    const std::string flat = hdr_of("-Y 2 +X 2", std::string(16, 'x'));
    for (size_t length = 0; length < flat.size(); ++length)
        EXPECT_THAT(hdr_error(flat.substr(0, length)), testing::StartsWith("x: ")) << length;
}

TEST(Hdr, RunsFillTheirRowsExactly) {
    const std::string head("\x02\x02\0\x08", 4);
    EXPECT_THAT(hdr_error(hdr_of("-Y 1 +X 8", head)), HasSubstr("it ends in row 0 of 1")) << "this once never ended";
    EXPECT_THAT(hdr_error(hdr_of("-Y 1 +X 8", head + std::string(40, '\0'))), HasSubstr("a run in row 0 has 0 pixels"));
    EXPECT_THAT(hdr_error(hdr_of("-Y 1 +X 8", head + "\x89\x01")), HasSubstr("has 9 pixels; expected 1 … 8"));
    EXPECT_THAT(hdr_error(hdr_of("-Y 1 +X 8", head + "\x09" + std::string(9, 'x'))), HasSubstr("has 9 pixels"));
    EXPECT_THAT(hdr_error(hdr_of("-Y 2 +X 8", k_row_of_8 + std::string(64, 'x'))),
                HasSubstr("row 1 does not begin as a row of 8 pixels does"));
    EXPECT_THAT(hdr_error(hdr_of("-Y 1 +X 8", std::string("\x02\x02\0\x09", 4) + std::string(64, 'x'))),
                HasSubstr("row 0 does not begin"));
}

TEST(Hdr, HeadersAreWhatTheDecoderWants) {
    EXPECT_THAT(hdr_error(hdr_of("+Y 1 +X 2", "xxxxxxxx")), HasSubstr("'-Y height +X width'"));
    EXPECT_THAT(hdr_error(hdr_of("-Y 0 +X 2", "xxxxxxxx")), HasSubstr("expected sides of 1 … 16384"));
    EXPECT_THAT(hdr_error(hdr_of("-Y 99999 +X 99999", "xxxxxxxx")), HasSubstr("expected sides of 1 … 16384"));
    EXPECT_THAT(hdr_error(hdr_of("-Y 16384 +X 16384", "xxxxxxxx")), HasSubstr("expected 1,073,741,824 bytes"));
    EXPECT_THAT(hdr_error("#?RADIANCE\n\n-Y 1 +X 2\nxxxxxxxx"), HasSubstr("FORMAT=32-bit_rle_rgbe"));
    EXPECT_THAT(hdr_error("#?RADIANCE\n" + std::string(5000, 'x')), HasSubstr("its header does not end"));
}

TEST(Exr, AWindowThatTheFileCannotHoldIsRefusedAtOnce) {
    TempFolder folder;
    LayeredImage image;
    image.layers["out.direct"] = Image(2, 2, 1);
    write_exr(folder / "a.exr", image);
    std::string bytes = folder.read("a.exr");
    const size_t at = bytes.find("dataWindow") + std::string("dataWindow\0box2i\0", 17).size() + 4;
    for (int32_t side : {1 << 14, 1 << 20, 1 << 30}) {
        const int32_t window[4] = {0, 0, side - 1, side - 1};
        bytes.replace(at, sizeof window, reinterpret_cast<const char*>(window), sizeof window);
        folder.write("b.exr", bytes);
        EXPECT_THAT(error_of([&] { read_exr(folder / "b.exr"); }), HasSubstr("b.exr")) << side;
    }
}

TEST(Limits, TheTableHasARowForEach) {
    const std::string table = limits_markdown();
    for (const char* part :
         {"268,435,456", "16,384 pixels", "33,554,432", "| levels of nested JSON | 64 |", "--max-texture"})
        EXPECT_THAT(table, HasSubstr(part));
    for (const LimitRow& row : limit_rows()) {
        EXPECT_FALSE(row.what.empty() || row.limit.empty() || row.beyond.empty()) << row.what;
        EXPECT_EQ((row.what + row.limit + row.beyond).find('|'), std::string::npos) << "would break the table";
    }
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(1234567), "1,234,567");
}

} // namespace bounce
