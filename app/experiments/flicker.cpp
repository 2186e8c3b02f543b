#include "app/experiments/flicker.h"

#include "app/broken_shaders.h"
#include "core/error.h"
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

FlickerFigures measure_flicker(Session& session, const std::string& resource, int frames) {
    if (frames < 3) throw Error("stability needs at least 3 frames");
    std::vector<float> before, last, magnitudes;
    double sum = 0, first_squares = 0, second_squares = 0;
    size_t count = 0, firsts = 0;
    for (int frame = 0; frame < frames; ++frame) {
        if (frame > 0) session.advance();
        session.render(true);
        std::vector<float> now = luminance_of(session, resource);
        for (size_t i = 0; i < now.size(); ++i) {
            sum += now[i];
            ++count;
            if (frame >= 1) {
                first_squares += std::pow(double(now[i]) - last[i], 2);
                ++firsts;
            }
            if (frame >= 2) {
                float second = now[i] - 2 * last[i] + before[i];
                second_squares += double(second) * second;
                magnitudes.push_back(std::abs(second));
            }
        }
        before = std::move(last);
        last = std::move(now);
    }
    FlickerFigures figures;
    figures.frames = frames;
    figures.mean = sum / double(count);
    double scale = figures.mean > 0 ? 1 / figures.mean : 0;
    figures.change = std::sqrt(first_squares / double(firsts)) * scale;
    figures.flicker = std::sqrt(second_squares / double(magnitudes.size())) * scale;
    size_t at = magnitudes.size() * 99 / 100;
    std::nth_element(magnitudes.begin(), magnitudes.begin() + std::ptrdiff_t(at), magnitudes.end());
    figures.flicker_p99 = magnitudes[at] * scale;
    return figures;
}

} // namespace bounce
