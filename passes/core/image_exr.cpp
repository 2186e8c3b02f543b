// Writes OpenEXR files of named layers. They are encoded in memory, so that a file is written whole or not at all.

#include "core/image_exr.h"
#include "core/error.h"
#include "core/exr_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
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
        if (!default_layer.empty()) header.insert(k_exr_default_layer, Imf::StringAttribute(default_layer));
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

} // namespace bounce
