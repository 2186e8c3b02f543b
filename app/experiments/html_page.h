#pragma once
// Every page that a command writes: the template assets/pages/page.html with the shared style and script in it. One
// file, no network; its policy allows no other script and style than these, so what a name holds can only be shown.

#include <string>
#include <vector>

namespace bounce {

struct HtmlPage {
    std::string title;                ///< plain text
    std::string body;                 ///< markup
    std::string data = "null";        ///< JSON, which the scripts read; it may hold anything
    std::vector<std::string> scripts; ///< of assets/pages besides the shared one, in order: "plot"
};

/// Throws Error when an asset cannot be read.
std::string html_page(const HtmlPage& page);

/// `<img>` of a PNG in base64; `alt` is plain text.
std::string png_markup(const std::string& base64_png, const std::string& alt);
/// The colours of error maps from 0 to `top` (of the reference's mean), with its ends as text.
std::string heat_scale_markup(double top);

} // namespace bounce
