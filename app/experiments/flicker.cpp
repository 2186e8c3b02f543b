#include "app/experiments/flicker.h"

#include "app/broken_shaders.h"
#include "core/error.h"
#include "core/flip.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>

namespace bounce {

std::vector<float> luminance_of(Session& session, const std::string& resource) {
    throw_if_broken(session, "nothing was measured");
    const GpuTexture* texture = session.graph().texture(resource);
    if (!texture || texture->desc().kind != TextureKind::texture_2d)
        throw Error("'" + resource + "' is no picture of this graph" +
                    did_you_mean(resource, session.graph().plan().resource_names()));
    std::vector<float> values = texture->read();
    size_t pixels = size_t(texture->desc().size.x) * size_t(texture->desc().size.y), channels = values.size() / pixels;
    std::vector<float> luminance(pixels);
    const float scale = session.value_scale(resource);
    for (size_t i = 0; i < pixels; ++i) {
        const float* v = &values[i * channels];
        luminance[i] = scale * (channels >= 3 ? 0.2126f * v[0] + 0.7152f * v[1] + 0.0722f * v[2] : v[0]);
    }
    return luminance;
}

std::vector<float> luminance_of(const Image& image) {
    std::vector<float> luminance(size_t(image.width) * size_t(image.height));
    const size_t channels = size_t(image.channels);
    for (size_t i = 0; i < luminance.size(); ++i) {
        const float* v = &image.pixels[i * channels];
        luminance[i] = channels >= 3 ? 0.2126f * v[0] + 0.7152f * v[1] + 0.0722f * v[2] : v[0];
    }
    return luminance;
}

static Image grey(const std::vector<float>& luminance, glm::ivec2 size) {
    Image image(size.x, size.y, 3);
    for (size_t i = 0; i < luminance.size(); ++i)
        std::fill_n(&image.pixels[3 * i], 3, luminance[i]);
    return image;
}

/// The mean FLIP of a frame to the mean of its two neighbours in time: light that changes evenly gives none. They are
/// exposed as the middle frame is by itself.
static double flip_in_time(const std::vector<float>& before, const std::vector<float>& now,
                           const std::vector<float>& after, glm::ivec2 size) {
    std::vector<float> even(now.size());
    for (size_t i = 0; i < now.size(); ++i)
        even[i] = (before[i] + after[i]) / 2;
    const Image picture = grey(now, size);
    const Mask all(size.x, size.y);
    const float exposure = automatic_exposure(picture, all);
    return flip_mean(flip(display_values(picture, exposure), display_values(grey(even, size), exposure)), all);
}

static double relative_rms(double squares, size_t count, double mean) {
    return count > 0 && mean > 0 ? std::sqrt(squares / double(count)) / mean : 0;
}

void SecondDifference::add(std::vector<float> now) {
    for (size_t i = 0; i < now.size(); ++i) {
        sum_ += now[i];
        if (frames_ >= 1) first_squares_ += std::pow(double(now[i]) - last_[i], 2);
        if (frames_ < 2) continue;
        const float second = now[i] - 2 * last_[i] + before_[i];
        second_squares_ += double(second) * second;
        magnitudes_.push_back(std::abs(second));
    }
    count_ += now.size();
    firsts_ += frames_ >= 1 ? now.size() : 0;
    ++frames_;
    before_ = std::move(last_);
    last_ = std::move(now);
}

double SecondDifference::change() const {
    return relative_rms(first_squares_, firsts_, mean());
}

double SecondDifference::flicker() const {
    return relative_rms(second_squares_, magnitudes_.size(), mean());
}

double SecondDifference::flicker_p99() const {
    if (magnitudes_.empty() || !(mean() > 0)) return 0;
    std::vector<float> sorted = magnitudes_;
    const auto at = sorted.begin() + std::ptrdiff_t(sorted.size() * 99 / 100);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at / mean();
}

FlickerFigures measure_flicker(Session& session, const std::string& resource, int frames) {
    if (frames < 3) throw Error("stability needs at least 3 frames");
    SecondDifference difference;
    std::vector<float> before, last;
    double flips = 0;
    for (int frame = 0; frame < frames; ++frame) {
        if (frame > 0) session.advance();
        session.render(true);
        std::vector<float> now = luminance_of(session, resource);
        difference.add(now);
        const TextureDesc& desc = session.graph().texture(resource)->desc();
        if (frame >= 2) flips += flip_in_time(before, last, now, glm::ivec2(desc.size.x, desc.size.y));
        before = std::move(last);
        last = std::move(now);
    }
    return {frames,
            difference.mean(),
            difference.change(),
            difference.flicker(),
            difference.flicker_p99(),
            flips / double(frames - 2)};
}

} // namespace bounce
