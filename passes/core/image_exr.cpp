// OpenEXR files of named layers. Encoded and decoded in memory, so that a file is written whole or not at all.

#include "core/error.h"
#include "core/exr_file.h"
#include "core/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <algorithm>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

namespace bounce {

namespace {

class MemoryOutput : public Imf::OStream {
  public:
    explicit MemoryOutput(std::string& bytes) : OStream("memory"), bytes_(bytes) {}
    void write(const char data[], int count) override {
        if (position_ + count > bytes_.size()) bytes_.resize(position_ + count);
        std::memcpy(bytes_.data() + position_, data, size_t(count));
        position_ += size_t(count);
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

  private:
    std::string& bytes_;
    uint64_t position_ = 0;
};

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

/// Floats that a file may ask for (2 GiB), and for each of its bytes, beyond what any of the format's compressions
/// reaches: a damaged header must not take all memory.
constexpr size_t k_most_floats = size_t(1) << 29;
constexpr size_t k_most_floats_a_byte = 10000;

constexpr const char* k_default_layer = "bounceDefaultLayer"; ///< the attribute that names it

} // namespace

static void use_all_threads() {
    static std::once_flag once;
    std::call_once(once, [] { Imf::setGlobalThreadCount(int(std::max(1u, std::thread::hardware_concurrency()))); });
}

static std::string channel_name(const std::string& layer, int channels, int channel) {
    static const char* const k_suffixes[4][4] = {{"Y"}, {"X", "Y"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
    if (layer.empty()) return channels == 2 ? k_suffixes[2][channel] : k_suffixes[channels - 1][channel];
    return layer + "." + k_suffixes[channels - 1][channel];
}

static int suffix_order(const std::string& suffix) {
    size_t found = std::string("RGBAXYZ").find(suffix);
    return suffix.size() == 1 && found != std::string::npos ? int(found) : 100;
}

/// The layers as they are stored: the default one under plain names, beside others under its own too.
static std::vector<std::pair<std::string, const Image*>> stored_layers(const LayeredImage& image,
                                                                       const std::string& default_layer) {
    std::vector<std::pair<std::string, const Image*>> stored;
    for (const auto& [name, layer] : image.layers) {
        if (image.layers.size() > 1 || name != default_layer) stored.emplace_back(name, &layer);
        if (!name.empty() && name == default_layer) stored.emplace_back("", &layer);
    }
    return stored;
}

/// What stored_layers made of the default layer, undone.
static void name_default_layer(LayeredImage& image, const std::string& default_layer) {
    auto plain = image.layers.find("");
    if (default_layer.empty() || plain == image.layers.end()) return;
    image.layers.emplace(default_layer, std::move(plain->second)); // unless it is there under its own name too
    image.layers.erase("");
}

void write_exr(const std::filesystem::path& path, const LayeredImage& image) {
    write_exr(path, image, "");
}

void write_exr(const std::filesystem::path& path, const LayeredImage& image, const std::string& default_layer) {
    std::string where = "cannot write '" + path.string() + "': ";
    if (image.layers.empty()) throw Error(where + "the image has no layers");
    if (!default_layer.empty() && !image.layers.contains(default_layer))
        throw Error(where + "there is no layer '" + default_layer + "'");
    const Image& first = image.layers.begin()->second;
    for (const auto& [name, layer] : image.layers) {
        if (layer.empty() || layer.pixels.size() != size_t(layer.width) * layer.height * layer.channels) {
            throw Error(where + "the layer '" + name + "' is empty or its pixels do not match its size");
        }
        if (layer.width != first.width || layer.height != first.height) {
            throw Error(where + "the layer '" + name + "' differs in size from the others");
        }
        if (layer.channels < 1 || layer.channels > 4) {
            throw Error(where + "the layer '" + name + "' needs 1 to 4 channels");
        }
    }
    std::string bytes;
    try {
        use_all_threads();
        Imf::Header header(first.width, first.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        if (!image.metadata.empty()) header.insert("bounce", Imf::StringAttribute(image.metadata));
        if (!default_layer.empty()) header.insert(k_default_layer, Imf::StringAttribute(default_layer));
        Imf::FrameBuffer frame;
        for (const auto& [name, stored] : stored_layers(image, default_layer)) {
            const Image& layer = *stored;
            for (int c = 0; c < layer.channels; ++c) {
                std::string channel = channel_name(name, layer.channels, c);
                if (header.channels().findChannel(channel)) {
                    throw Error("two layers would both be stored as the channel '" + channel + "'");
                }
                header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
                auto* base = reinterpret_cast<char*>(const_cast<float*>(layer.pixels.data()) + c);
                frame.insert(channel, Imf::Slice(Imf::FLOAT, base, sizeof(float) * layer.channels,
                                                 sizeof(float) * layer.channels * layer.width));
            }
        }
        MemoryOutput stream(bytes);
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(frame);
        file.writePixels(first.height);
    } catch (const std::exception& error) {
        throw Error(where + error.what());
    }
    write_file_atomically(path, bytes);
}

LayeredImage read_exr(const std::filesystem::path& path) {
    std::string bytes = read_file(path);
    LayeredImage image;
    std::string default_layer;
    try {
        use_all_threads();
        MemoryInput stream(bytes);
        Imf::InputFile file(stream);
        const Imf::Header& header = file.header();
        const Imath::Box2i window = header.dataWindow();
        int64_t width = int64_t(window.max.x) - window.min.x + 1;
        int64_t height = int64_t(window.max.y) - window.min.y + 1;
        if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>("bounce"))
            image.metadata = text->value();
        if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(k_default_layer))
            default_layer = text->value();

        std::map<std::string, std::vector<std::string>> layers; // the channel suffixes of each
        for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
            std::string name = it.name();
            if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
                throw Error("the channel '" + name + "' is subsampled, which is not supported");
            }
            size_t dot = name.rfind('.');
            std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
            layers[layer].push_back(dot == std::string::npos ? name : name.substr(dot + 1));
        }
        size_t channel_count = 0;
        for (const auto& [name, suffixes] : layers)
            channel_count += suffixes.size();
        if (channel_count == 0) throw Error("it has no channels");
        const size_t most_floats = std::min(k_most_floats, k_most_floats_a_byte * bytes.size());
        if (width <= 0 || height <= 0 || size_t(width) > most_floats / size_t(height) / channel_count) {
            throw Error("its size, " + std::to_string(width) + "x" + std::to_string(height) + " with " +
                        std::to_string(channel_count) + " channels, is more than 2 GiB or than the file can hold");
        }
        Imf::FrameBuffer frame;
        for (auto& [name, suffixes] : layers) {
            std::stable_sort(suffixes.begin(), suffixes.end(),
                             [](const auto& a, const auto& b) { return suffix_order(a) < suffix_order(b); });
            int channels = int(suffixes.size());
            Image& target = image.layers[name] = Image(int(width), int(height), channels);
            for (int c = 0; c < channels; ++c) {
                std::string channel = name.empty() ? suffixes[c] : name + "." + suffixes[c];
                ptrdiff_t x_stride = ptrdiff_t(sizeof(float)) * channels;
                ptrdiff_t y_stride = x_stride * width;
                // OpenEXR addresses pixels by their data window coordinates.
                char* base = reinterpret_cast<char*>(target.pixels.data() + c) - window.min.x * x_stride -
                             window.min.y * y_stride;
                frame.insert(channel, Imf::Slice(Imf::FLOAT, base, size_t(x_stride), size_t(y_stride)));
            }
        }
        file.setFrameBuffer(frame);
        file.readPixels(window.min.y, window.max.y);
        name_default_layer(image, default_layer);
    } catch (const std::exception& error) {
        throw Error("cannot read '" + path.string() + "' as an OpenEXR image: " + error.what());
    }
    return image;
}

} // namespace bounce
