#include "app/experiments/point_check.h"

#include "core/error.h"
#include "core/limits.h"
#include "core/printable.h"

#include <cmath>
#include <fmt/format.h>

namespace bounce {

namespace {

constexpr const char* k_hexadecimal = "0123456789abcdef";
constexpr const char* k_base64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=";

class PointCheck {
  public:
    PointCheck(const ChartPoint& point, const std::string& where) : point_(point), where_(where) {}

    void run() const {
        const std::string& key = point_.key;
        if (key.size() < 16 || key.size() > 64 || key.find_first_not_of(k_hexadecimal) != std::string::npos)
            fail("key", key, "16 to 64 hexadecimal digits");
        for (int side : {point_.task.size().x, point_.task.size().y})
            whole("size", side, 1, k_max_picture_side);
        whole("warm_up", point_.task.warm_up, 0, k_max_frames);
        whole("frames", point_.task.frames, 1, k_max_frames);
        not_negative("total_ms", point_.total_ms);
        not_negative("kept_share", point_.kept_share);
        for (const PassCost& pass : point_.passes)
            for (double ms : {pass.median_ms, pass.low_ms, pass.high_ms})
                not_negative("passes", ms);
        picture("thumbnail_png", point_.thumbnail_png);
        picture("error_png", point_.error_png);
        picture("reference_png", point_.reference_png);
        if (!point_.figures) return;
        for (const FigureColumn& column : figure_columns())
            if (const double value = *point_.figures.*column.value; !std::isnan(value))
                not_negative(column.name, value);
    }

  private:
    [[noreturn]] void fail(const char* what, const std::string& value, const std::string& expected) const {
        const std::string shown = printable(value.size() > 80 ? value.substr(0, 80) + "…" : value);
        throw Error(fmt::format("{}: invalid {} '{}': expected {}", where_, what, shown, expected));
    }
    void whole(const char* what, int value, int least, int most) const {
        if (value < least || value > most)
            fail(what, std::to_string(value), fmt::format("a whole number from {} to {}", least, most));
    }
    void not_negative(const char* what, double value) const {
        if (!(value >= 0) || std::isinf(value)) fail(what, fmt::format("{}", value), "a number of 0 or more");
    }
    void picture(const char* what, const std::string& text) const {
        const bool png = text.starts_with("iVBORw0KGgo") && text.find_first_not_of(k_base64) == std::string::npos;
        if (!text.empty() && !png) fail(what, text, "a PNG in base64");
    }

    const ChartPoint& point_;
    const std::string& where_;
};

} // namespace

void check_point(const ChartPoint& point, const std::string& where) {
    PointCheck(point, where).run();
}

} // namespace bounce
