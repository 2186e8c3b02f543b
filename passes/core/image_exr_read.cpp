// Reads OpenEXR files of any kind but deep ones. They are decoded from memory.
#include "core/image_exr.h"

#include "core/error.h"
#include "core/exr_check.h"
#include "core/input_file.h"
#include "core/limits.h"
#include "core/scanner.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <mutex>
#include <thread>

namespace bounce {

namespace {

class MemoryInput : public Imf::IStream {
  public:
    explicit MemoryInput(const std::string& bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char data[], int count) override {
        if (count < 0 || position_ > bytes_.size() || uint64_t(count) > bytes_.size() - position_) {
            throw Error("the file ends too early");
        }
        std::memcpy(data, bytes_.data() + position_, size_t(count));
        position_ += uint64_t(count);
        return position_ < bytes_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }

  private:
    const std::string& bytes_;
    uint64_t position_ = 0;
};

/// One channel of a part.
struct Channel {
    std::string name;   ///< in the file
    std::string suffix; ///< behind the last dot
    Imf::Channel info;
};

int order_of(const std::string& suffix) {
    size_t found = std::string_view("RGBAXYZ").find(suffix);
    return suffix.size() == 1 && found != std::string_view::npos ? int(found) : 100;
}

/// "r" is R, too: some programs write it so.
std::string suffix_of(const std::string& name) {
    std::string suffix = name.substr(name.rfind('.') + 1);
    if (suffix.size() == 1 && std::string_view("rgbaxyz").find(suffix) != std::string_view::npos)
        suffix[0] = char(suffix[0] - 'a' + 'A');
    return suffix;
}

std::map<std::string, std::vector<Channel>> layers_of(const Imf::Header& header, const std::string& unnamed) {
    std::map<std::string, std::vector<Channel>> layers;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        std::string name = it.name();
        size_t dot = name.rfind('.');
        layers[dot == std::string::npos ? unnamed : name.substr(0, dot)].push_back(
            {name, suffix_of(name), it.channel()});
    }
    for (auto& [name, channels] : layers) {
        std::stable_sort(channels.begin(), channels.end(),
                         [](auto& a, auto& b) { return order_of(a.suffix) < order_of(b.suffix); });
    }
    return layers;
}

void keep_radiance(std::vector<Channel>& channels) {
    auto has = [&](const char* suffix) {
        return std::any_of(channels.begin(), channels.end(), [&](auto& c) { return c.suffix == suffix; });
    };
    bool coloured = has("R") || has("G") || has("B");
    bool luminance = !coloured && has("Y") && !has("X") && !has("Z"); // else it is a coordinate
    std::erase_if(channels, [&](const Channel& c) {
        if (coloured) return c.suffix != "R" && c.suffix != "G" && c.suffix != "B";
        return !luminance || c.suffix != "Y";
    });
}

/// The pixels of one channel over the data window, a subsampled one repeated.
struct Plane {
    Imath::Box2i window;
    int x_sampling, y_sampling;
    int width; ///< of what is stored
    std::vector<float> values;

    Plane(const Imath::Box2i& data, const Imf::Channel& channel)
        : window(data), x_sampling(channel.xSampling), y_sampling(channel.ySampling),
          width(sample(data.max.x, x_sampling) - sample(data.min.x, x_sampling) + 1),
          values(size_t(width) * size_t(sample(data.max.y, y_sampling) - sample(data.min.y, y_sampling) + 1)) {}

    /// Which sample a coordinate belongs to: coordinates may be negative.
    static int sample(int at, int sampling) { return at >= 0 ? at / sampling : -((-at + sampling - 1) / sampling); }

    Imf::Slice slice() {
        ptrdiff_t x_stride = sizeof(float), y_stride = x_stride * width;
        // OpenEXR addresses samples by the coordinates of their pixels.
        ptrdiff_t first = sample(window.min.x, x_sampling) * x_stride + sample(window.min.y, y_sampling) * y_stride;
        return Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()) - first, size_t(x_stride),
                          size_t(y_stride), x_sampling, y_sampling);
    }
    float at(int x, int y) const {
        int column = sample(x, x_sampling) - sample(window.min.x, x_sampling);
        int row = sample(y, y_sampling) - sample(window.min.y, y_sampling);
        return values[size_t(row) * size_t(width) + size_t(column)];
    }
};

int64_t area(const Imath::Box2i& box) {
    int64_t width = int64_t(box.max.x) - box.min.x + 1, height = int64_t(box.max.y) - box.min.y + 1;
    if (width <= 0 || height <= 0 || width > INT32_MAX || height > INT32_MAX) throw Error("a window of no size");
    return width * height;
}

Imath::Box2i intersection(const Imath::Box2i& a, const Imath::Box2i& b) {
    return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
            {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

/// Gives the layer that is stored under plain names its own.
void name_default_layer(LayeredImage& image, const std::string& default_layer) {
    auto plain = image.layers.find("");
    if (default_layer.empty() || plain == image.layers.end()) return;
    image.layers.emplace(default_layer, std::move(plain->second)); // unless it is there under its own name too
    image.layers.erase("");
}

class Reader {
  public:
    Reader(const std::string& bytes, ExrChannels wanted)
        : stream_(bytes), file_(stream_), wanted_(wanted),
          floats_left_(std::min(k_max_exr_floats, k_max_exr_floats_per_byte * bytes.size())) {}

    ExrPicture read() {
        display_ = file_.header(0).displayWindow();
        size_ = area(display_);
        picture_.x = display_.min.x, picture_.y = display_.min.y;
        for (int part = 0; part < file_.parts(); ++part) {
            const Imf::Header& header = file_.header(part);
            if (header.hasType() && Imf::isDeepData(header.type()))
                throw Error("it is a deep image, whose pixels hold lists of samples: expected a flat one");
            if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>("bounce"))
                picture_.image.metadata = text->value();
            read_part(part, header);
            if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(k_exr_default_layer))
                name_default_layer(picture_.image, text->value());
        }
        if (picture_.image.layers.empty())
            throw Error(wanted_ == ExrChannels::all ? "it has no channels" : "it has no channel R, G, B or Y");
        return std::move(picture_);
    }

  private:
    void count(int64_t pixels, size_t channels) {
        if (size_t(pixels) > floats_left_ / std::max<size_t>(channels, 1))
            throw Error(fmt::format("{} channels of {} pixels are more than 2 GiB or than the file can hold", channels,
                                    pixels));
        floats_left_ -= size_t(pixels) * channels;
    }

    void read_part(int part, const Imf::Header& header) {
        std::string unnamed = file_.parts() > 1 && header.hasName() ? header.name() : "";
        auto layers = layers_of(header, unnamed);
        const Imath::Box2i data = header.dataWindow();
        const int64_t data_size = area(data);
        std::vector<Plane> planes;
        Imf::FrameBuffer frame;
        for (auto& [name, channels] : layers) {
            if (wanted_ == ExrChannels::radiance) keep_radiance(channels);
            count(data_size, channels.size());
            for (const Channel& channel : channels) {
                planes.emplace_back(data, channel.info);
                frame.insert(channel.name, planes.back().slice());
            }
        }
        if (planes.empty()) return;
        Imf::InputPart input(file_, part);
        input.setFrameBuffer(frame);
        input.readPixels(data.min.y, data.max.y);
        const Imath::Box2i seen = intersection(display_, data);
        size_t plane = 0;
        for (auto& [name, channels] : layers) {
            if (channels.empty()) continue;
            count(size_, channels.size());
            Image image(display_.max.x - display_.min.x + 1, display_.max.y - display_.min.y + 1, int(channels.size()));
            for (size_t c = 0; c < channels.size(); ++c, ++plane) {
                for (int y = seen.min.y; y <= seen.max.y; ++y)
                    for (int x = seen.min.x; x <= seen.max.x; ++x)
                        image.at(x - display_.min.x, y - display_.min.y)[c] = planes[plane].at(x, y);
            }
            if (!picture_.image.layers.emplace(name, std::move(image)).second)
                throw Error(fmt::format("two of its parts have the layer '{}'", shortened(name)));
        }
        int64_t inside = seen.isEmpty() ? 0 : area(seen);
        picture_.outside = std::max(picture_.outside, 1 - double(inside) / double(size_));
    }

    MemoryInput stream_;
    Imf::MultiPartInputFile file_;
    ExrChannels wanted_;
    size_t floats_left_;
    Imath::Box2i display_;
    int64_t size_ = 0;
    ExrPicture picture_;
};

} // namespace

ExrPicture read_exr_picture(const std::filesystem::path& path, ExrChannels channels) {
    std::string bytes = read_file(path, k_max_exr_bytes);
    static std::once_flag once;
    std::call_once(once, [] {
        Imf::setGlobalThreadCount(int(std::max(1u, std::thread::hardware_concurrency())));
        // The library makes tables of a file's rows before anybody can look at its header.
        Imf::Header::setMaxImageSize(k_max_picture_side, k_max_picture_side);
        Imf::Header::setMaxTileSize(k_max_picture_side, k_max_picture_side);
    });
    try {
        check_exr(bytes);
        return Reader(bytes, channels).read();
    } catch (const std::exception& error) {
        throw Error("cannot read '" + path.string() + "' as an OpenEXR image: " + error.what());
    }
}

LayeredImage read_exr(const std::filesystem::path& path) {
    return read_exr_picture(path, ExrChannels::all).image;
}

} // namespace bounce
