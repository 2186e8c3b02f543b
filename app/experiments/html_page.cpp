#include "app/experiments/html_page.h"

#include "app/experiments/svg_scatter.h"
#include "core/base64.h"
#include "core/error.h"
#include "core/heat_map.h"
#include "core/input_file.h"
#include "core/json_text.h"
#include "core/paths.h"
#include "core/sha256.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace bounce {

namespace {

std::string asset(const std::string& name) {
    return read_file(assets_folder() / "pages" / name, k_max_json_text);
}

/// "sha256-…", as a content security policy names text that stands in the page.
std::string source_of(const std::string& text) {
    return "'sha256-" + base64(sha256(text)) + "'";
}

/// As text of a data block: no end of the block can be in it.
std::string as_data_block(const std::string& json) {
    std::string out;
    for (char c : json)
        out += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return out;
}

/// Puts each value in the place of {{its name}}, in one go, so that no value is searched for names.
std::string filled(const std::string& text, const std::map<std::string, std::string>& values) {
    std::string out;
    size_t from = 0;
    for (size_t at = text.find("{{"); at != std::string::npos; at = text.find("{{", from)) {
        const size_t end = text.find("}}", at);
        const auto value = end == std::string::npos ? values.end() : values.find(text.substr(at + 2, end - at - 2));
        if (value == values.end())
            throw Error("assets/pages/page.html: unknown {{name}}: '" + text.substr(at, 20) + "'");
        out += text.substr(from, at - from) + value->second;
        from = end + 2;
    }
    return out + text.substr(from);
}

} // namespace

std::string html_page(const HtmlPage& page) {
    const std::string style = asset("page.css");
    std::string script = asset("page.js");
    for (const std::string& name : page.scripts)
        script += asset(name + ".js");
    return filled(asset("page.html"), {{"title", escape_markup(page.title)},
                                       {"style", style},
                                       {"style_source", source_of(style)},
                                       {"body", page.body},
                                       {"data", as_data_block(page.data)},
                                       {"script", script},
                                       {"script_source", source_of(script)}});
}

std::string png_markup(const std::string& base64_png, const std::string& alt) {
    return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escape_markup(alt),
                       escape_markup(base64_png));
}

std::string heat_scale_markup(double top) {
    constexpr int steps = 32, width = 4;
    std::string out = fmt::format("<span class=\"scale\">0 <svg width=\"{}\" height=\"10\">", steps * width);
    for (int i = 0; i < steps; ++i) {
        const glm::vec3 colour = magma((float(i) + 0.5f) / steps);
        out += fmt::format("<rect x=\"{}\" width=\"{}\" height=\"10\" fill=\"#{:02x}{:02x}{:02x}\"/>", i * width, width,
                           int(std::lround(255 * colour.r)), int(std::lround(255 * colour.g)),
                           int(std::lround(255 * colour.b)));
    }
    return out + fmt::format("</svg> {:g} %</span>", 100 * top);
}

} // namespace bounce
