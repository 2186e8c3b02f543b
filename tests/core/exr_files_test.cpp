// OpenEXR files as other programs write them: what of them is radiance, and where its pixels lie.
#include "core/comparison.h"
#include "core/image_exr.h"
#include "support/errors.h"
#include "support/temp_folder.h"

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <gmock/gmock.h>

using namespace bounce;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

using Box = Imath::Box2i;

Box box(int x0, int y0, int x1, int y1) {
    return Box({x0, y0}, {x1, y1});
}

/// A channel that has the value `first + x + 100 y` at pixel (x, y).
struct Made {
    const char* name;
    float first = 1;
    Imf::PixelType type = Imf::FLOAT;
    int sampling = 1;
};

int down(int at, int sampling) {
    return int(std::floor(double(at) / sampling));
}

/// Values of all channels of a window, as the library wants them.
class Frame {
  public:
    Frame(const Box& data, const std::vector<Made>& channels, bool uniform) : planes_(channels.size()) {
        for (size_t i = 0; i < channels.size(); ++i) {
            const Made& made = channels[i];
            int s = made.sampling, x0 = down(data.min.x, s), x1 = down(data.max.x, s), y0 = down(data.min.y, s),
                y1 = down(data.max.y, s);
            int width = x1 - x0 + 1;
            for (int y = y0; y <= y1; ++y)
                for (int x = x0; x <= x1; ++x) {
                    float value = made.first + (uniform ? 0 : float(x * s + 100 * y * s));
                    uint32_t bits = uint32_t(value);
                    half h(value);
                    const void* from = made.type == Imf::FLOAT  ? static_cast<const void*>(&value)
                                       : made.type == Imf::HALF ? static_cast<const void*>(&h)
                                                                : &bits;
                    planes_[i].resize(planes_[i].size() + size_of(made.type));
                    std::memcpy(planes_[i].data() + planes_[i].size() - size_of(made.type), from, size_of(made.type));
                }
            ptrdiff_t x_stride = ptrdiff_t(size_of(made.type)), y_stride = x_stride * width;
            frame.insert(made.name, Imf::Slice(made.type, planes_[i].data() - x0 * x_stride - y0 * y_stride,
                                               size_t(x_stride), size_t(y_stride), s, s));
        }
    }
    Imf::FrameBuffer frame;

  private:
    static size_t size_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }
    std::vector<std::vector<char>> planes_;
};

Imf::Header header_of(const Box& display, const Box& data, const std::vector<Made>& channels) {
    Imf::Header header(display, data);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const Made& made : channels)
        header.channels().insert(made.name, Imf::Channel(made.type, made.sampling, made.sampling));
    return header;
}

class ExrFiles : public testing::Test {
  protected:
    /// `uniform`: the value `first` everywhere.
    std::string lines(const std::string& name, const Box& display, const Box& data, const std::vector<Made>& channels,
                      bool uniform = false) {
        std::string path = (folder / name).string();
        Imf::OutputFile file(path.c_str(), header_of(display, data, channels));
        Frame made(data, channels, uniform);
        file.setFrameBuffer(made.frame);
        file.writePixels(data.max.y - data.min.y + 1);
        return path;
    }
    static LayeredImage radiance(const std::string& path) {
        return read_exr_picture(path, ExrChannels::radiance).image;
    }
    static std::vector<std::string> names(const LayeredImage& image) {
        std::vector<std::string> out;
        for (const auto& [name, layer] : image.layers)
            out.push_back(name + "*" + std::to_string(layer.channels));
        return out;
    }
    static MetricValues compared(const std::string& a, const std::string& b) {
        ComparisonOptions options;
        options.shown = false;
        LayerComparison comparison = compare_layers(radiance(a), radiance(b), options);
        EXPECT_EQ(comparison.parts.size(), 1u);
        return comparison.parts.at(0).figures;
    }
    const Box k_box = box(0, 0, 7, 5);
    TempFolder folder;
};

} // namespace

TEST_F(ExrFiles, AlphaDepthAndOtherChannelsAreNoRadiance) {
    std::vector<Made> a = {{"R", 2}, {"G", 2}, {"B", 2}, {"A", 1}, {"Z", 1e10f}, {"u", 5}, {"ID", 7, Imf::UINT}},
                      b = {{"R", 1}, {"G", 1}, {"B", 1}, {"A", 1}, {"Z", 3}, {"u", 6}, {"ID", 8, Imf::UINT}};
    MetricValues figures = compared(lines("a.exr", k_box, k_box, a, true), lines("b.exr", k_box, k_box, b, true));
    EXPECT_NEAR(figures["bias"], 1, 1e-6);
    EXPECT_NEAR(figures["relative_rmse"], 1, 1e-6);
    EXPECT_EQ(figures["largest_error"], 1);
    b = {{"R", 1}, {"G", 1}, {"B", 1}};
    figures = compared(lines("a.exr", k_box, k_box, a, true), lines("b.exr", k_box, k_box, b, true));
    EXPECT_NEAR(figures["bias"], 1, 1e-6) << "with alpha against without";
    std::vector<Made> only_others = {{"Z", 1},   {"A", 1}, {"P.X", 1}, {"P.Y", 1},
                                     {"P.Z", 1}, {"uv.X"}, {"uv.Y"},   {"ID"}};
    EXPECT_THAT(error_of([&] { radiance(lines("c.exr", k_box, k_box, only_others)); }),
                HasSubstr("no channel R, G, B or Y"));
}

TEST_F(ExrFiles, NamesOfOtherPrograms) {
    std::vector<Made> pbrt = {{"R", 2}, {"G", 2}, {"B", 2}, {"Albedo.R", 9}, {"Albedo.G", 9}, {"Albedo.B", 9},
                              {"Ns.X"}, {"Ns.Y"}, {"Ns.Z"}, {"u"},           {"dzdx"}};
    std::vector<Made> mitsuba = {{"R", 1},        {"G", 1},        {"B", 1}, {"A"},           {"albedo.R", 3},
                                 {"albedo.G", 3}, {"albedo.B", 3}, {"dd.y"}, {"sh_normal.X"}, {"sh_normal.Y"}};
    std::vector<Made> blender = {{"ViewLayer.Combined.R", 2}, {"ViewLayer.Combined.G", 2}, {"ViewLayer.Combined.B", 2},
                                 {"ViewLayer.Combined.A"},    {"ViewLayer.DiffCol.R"},     {"ViewLayer.DiffCol.G"},
                                 {"ViewLayer.DiffCol.B"},     {"ViewLayer.Depth.Z", 1e10f}};
    std::string p = lines("p.exr", k_box, k_box, pbrt, true), m = lines("m.exr", k_box, k_box, mitsuba, true),
                b = lines("b.exr", k_box, k_box, blender, true);
    EXPECT_THAT(names(radiance(p)), ElementsAre("*3", "Albedo*3"));
    EXPECT_THAT(names(radiance(b)), ElementsAre("ViewLayer.Combined*3", "ViewLayer.DiffCol*3"));
    EXPECT_NEAR(compared(p, m)["bias"], 1, 1e-6);
    EXPECT_EQ(compared(b, b)["rmse"], 0);
    EXPECT_NEAR(compared(b, b)["mean"], 2, 1e-6) << "Combined, not DiffCol";
    EXPECT_NEAR(compared(b, m)["bias"], 1, 1e-6) << "the picture as a whole, by whatever name";
    std::string small = lines("s.exr", k_box, k_box, {{"r", 2}, {"g", 2}, {"b", 2}, {"a"}}, true);
    EXPECT_NEAR(compared(small, m)["bias"], 1, 1e-6) << "in small letters";
}

TEST_F(ExrFiles, TypesOfChannels) {
    std::vector<float> first;
    for (Imf::PixelType type : {Imf::FLOAT, Imf::HALF, Imf::UINT}) {
        Image image =
            radiance(lines("a.exr", k_box, k_box, {{"R", 1, type}, {"G", 2, type}, {"B", 3, type}})).layers.at("");
        EXPECT_EQ(image.at(7, 5)[0], 508);
        EXPECT_EQ(image.at(3, 2)[2], 206);
        EXPECT_EQ(image.at(0, 0)[1], 2);
    }
}

TEST_F(ExrFiles, LuminanceAlone) {
    std::string y = lines("y.exr", k_box, k_box, {{"Y", 2}, {"A", 9}}, true);
    std::string rgb = lines("rgb.exr", k_box, k_box, {{"R", 1}, {"G", 1}, {"B", 1}}, true);
    EXPECT_THAT(names(radiance(y)), ElementsAre("*1"));
    EXPECT_NEAR(compared(y, y)["mean"], 2, 1e-6);
    EXPECT_NEAR(compared(y, rgb)["bias"], 1, 1e-6);
    EXPECT_NEAR(compared(rgb, y)["bias"], -0.5, 1e-6);
    std::string red = lines("red.exr", k_box, k_box, {{"R", 1}, {"G", 0}, {"B", 0}}, true);
    EXPECT_NEAR(compared(red, y)["mean"], 0.2126, 1e-6);
}

TEST_F(ExrFiles, SubsampledChannels) {
    std::string chroma = lines("c.exr", k_box, k_box, {{"Y", 1}, {"RY", 0, Imf::HALF, 2}, {"BY", 0, Imf::HALF, 2}});
    EXPECT_THAT(names(radiance(chroma)), ElementsAre("*1"));
    EXPECT_EQ(radiance(chroma).layers.at("").at(7, 5)[0], 508);
    // Windows with negative origins keep their samples.
    Box odd = box(-4, -2, 3, 3);
    Image image =
        radiance(lines("r.exr", odd, odd, {{"R", 1000, Imf::FLOAT, 2}, {"G", 1000}, {"B", 1000, Imf::FLOAT, 2}}))
            .layers.at("");
    for (int y = -2; y <= 3; ++y)
        for (int x = -4; x <= 3; ++x) {
            EXPECT_EQ(image.at(x + 4, y + 2)[1], float(1000 + x + 100 * y));
            EXPECT_EQ(image.at(x + 4, y + 2)[0], float(1000 + down(x, 2) * 2 + 100 * down(y, 2) * 2)) << x << " " << y;
        }
}

TEST_F(ExrFiles, DataWindowsArePlacedByTheirCoordinates) {
    Box display = box(0, 0, 7, 5);
    std::vector<Made> rgb = {{"R", 1}, {"G", 1}, {"B", 1}};
    std::string whole = lines("whole.exr", display, display, rgb);
    // A crop: black around it.
    ExrPicture crop = read_exr_picture(lines("crop.exr", display, box(2, 1, 4, 3), rgb), ExrChannels::radiance);
    const Image& image = crop.image.layers.at("");
    EXPECT_EQ(image.width, 8);
    EXPECT_EQ(image.height, 6);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) {
            bool inside = x >= 2 && x <= 4 && y >= 1 && y <= 3;
            EXPECT_EQ(image.at(x, y)[0], inside ? float(1 + x + 100 * y) : 0.0f) << x << " " << y;
        }
    EXPECT_NEAR(crop.outside, 1 - 9.0 / 48, 1e-9);
    // More than is shown: cut off.
    std::string over = lines("over.exr", display, box(-3, -2, 9, 8), rgb);
    EXPECT_EQ(compared(over, whole)["rmse"], 0);
    EXPECT_EQ(read_exr_picture(over, ExrChannels::radiance).outside, 0);
    // Beside it altogether: black.
    ExrPicture beside =
        read_exr_picture(lines("beside.exr", display, box(100, 100, 103, 103), rgb), ExrChannels::radiance);
    EXPECT_THAT(beside.image.layers.at("").pixels, Each(0.0f));
    EXPECT_EQ(beside.outside, 1);
    // A display window that begins elsewhere.
    Box moved = box(-5, 10, 2, 15);
    ExrPicture far = read_exr_picture(lines("moved.exr", moved, box(-4, 9, 0, 11), {{"R", 2000}, {"G"}, {"B"}}),
                                      ExrChannels::radiance);
    EXPECT_EQ(far.x, -5);
    EXPECT_EQ(far.y, 10);
    EXPECT_EQ(far.image.layers.at("").at(1, 0)[0], float(2000 - 4 + 1000));
    EXPECT_EQ(far.image.layers.at("").at(0, 0)[0], 0);
}

TEST_F(ExrFiles, TilesAndMipLevels) {
    std::vector<Made> rgb = {{"R", 1}, {"G", 2}, {"B", 3}};
    for (Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
        std::string path = (folder / "t.exr").string();
        Imf::Header header = header_of(k_box, k_box, rgb);
        header.setTileDescription(Imf::TileDescription(4, 4, mode));
        {
            Imf::TiledOutputFile file(path.c_str(), header);
            for (int ly = 0; ly < file.numYLevels(); ++ly)
                for (int lx = 0; lx < file.numXLevels(); ++lx) {
                    if (!file.isValidLevel(lx, ly)) continue;
                    Frame made(file.dataWindowForLevel(lx, ly), {{"R", lx + ly ? 9000.0f : 1}, {"G", 2}, {"B", 3}},
                               false);
                    file.setFrameBuffer(made.frame);
                    file.writeTiles(0, file.numXTiles(lx) - 1, 0, file.numYTiles(ly) - 1, lx, ly);
                }
        }
        Image image = radiance(path).layers.at("");
        EXPECT_EQ(image.width, 8) << "the full level";
        EXPECT_EQ(image.at(7, 5)[0], 508);
        EXPECT_EQ(image.at(5, 4)[2], 408);
    }
}

TEST_F(ExrFiles, FilesOfSeveralParts) {
    std::string path = (folder / "parts.exr").string();
    std::vector<Made> beauty = {{"R", 2}, {"G", 2}, {"B", 2}, {"A"}}, albedo = {{"R", 7}, {"G", 7}, {"B", 7}},
                      depth = {{"Z", 1e10f}};
    std::vector<Imf::Header> headers = {header_of(k_box, k_box, depth), header_of(k_box, box(1, 1, 3, 3), albedo),
                                        header_of(k_box, k_box, beauty)};
    const char* names_of[] = {"depth", "albedo", "beauty"};
    for (size_t i = 0; i < 3; ++i) {
        headers[i].setName(names_of[i]);
        headers[i].setType(Imf::SCANLINEIMAGE);
    }
    {
        Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 3);
        const std::vector<Made>* made[] = {&depth, &albedo, &beauty};
        for (int i = 0; i < 3; ++i) {
            Box data = headers[size_t(i)].dataWindow();
            Frame frame(data, *made[i], true);
            Imf::OutputPart part(file, i);
            part.setFrameBuffer(frame.frame);
            part.writePixels(data.max.y - data.min.y + 1);
        }
    }
    LayeredImage image = radiance(path);
    EXPECT_THAT(names(image), ElementsAre("albedo*3", "beauty*3"));
    EXPECT_EQ(image.layers.at("albedo").at(3, 3)[0], 7);
    EXPECT_EQ(image.layers.at("albedo").at(4, 3)[0], 0);
    std::string plain = lines("plain.exr", k_box, k_box, {{"R", 1}, {"G", 1}, {"B", 1}}, true);
    EXPECT_NEAR(compared(path, path)["mean"], 2, 1e-6);
    EXPECT_NEAR(compared(path, plain)["bias"], 1, 1e-6);
}

TEST_F(ExrFiles, DeepImagesAreRefused) {
    std::string path = (folder / "deep.exr").string();
    Imf::Header header(box(0, 0, 1, 0), box(0, 0, 1, 0));
    for (const char* name : {"R", "G", "B", "A", "Z"})
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    {
        unsigned counts[2] = {1, 1};
        float value = 1;
        float* pointers[2] = {&value, &value};
        Imf::DeepScanLineOutputFile file(path.c_str(), header);
        Imf::DeepFrameBuffer frame;
        frame.insertSampleCountSlice(
            Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts), sizeof(unsigned), 2 * sizeof(unsigned)));
        for (const char* name : {"R", "G", "B", "A", "Z"})
            frame.insert(name, Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers), sizeof(float*),
                                              2 * sizeof(float*), sizeof(float)));
        file.setFrameBuffer(frame);
        file.writePixels(1);
    }
    EXPECT_THAT(error_of([&] { radiance(path); }),
                testing::AllOf(HasSubstr("deep.exr"), HasSubstr("deep image"), HasSubstr("expected a flat one")));
}

TEST_F(ExrFiles, RelativeFiguresDivideByTheSizeOfTheMean) {
    std::string a = lines("a.exr", k_box, k_box, {{"R", 1}, {"G", 1}, {"B", 1}}, true);
    std::string b = lines("b.exr", k_box, k_box, {{"R", -0.5}, {"G", -0.5}, {"B", -0.5}}, true);
    MetricValues figures = compared(a, b);
    EXPECT_NEAR(figures["relative_rmse"], 3, 1e-6);
    EXPECT_NEAR(figures["relative_rmse_denoised"], 3, 1e-6);
    EXPECT_NEAR(figures["rmse_denoised"], 1.5, 1e-6);
    EXPECT_NEAR(figures["bias"], 3, 1e-6) << "brighter than the reference";
    EXPECT_GT(figures["relative_error_p99"], 0);
}
