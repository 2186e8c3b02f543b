#include "core/error.h"
#include "core/input_file.h"
#include "scene/gltf_file.h"

#include <array>

namespace bounce {

namespace fs = std::filesystem;

static int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

static std::string percent_decode(std::string_view text) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        bool escape =
            text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
        if (escape) {
            out += char(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

/// For messages: a URI may be megabytes long.
static std::string shortened(const std::string& text) {
    return text.size() > 200 ? text.substr(0, 200) + "…" : text;
}

std::optional<std::vector<unsigned char>> decode_base64(std::string_view text) {
    static const std::array<int8_t, 256> values = [] {
        std::array<int8_t, 256> table;
        table.fill(-1);
        std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (size_t i = 0; i < alphabet.size(); ++i)
            table[static_cast<unsigned char>(alphabet[i])] = int8_t(i);
        return table;
    }();
    for (int padding = 0; padding < 2 && !text.empty() && text.back() == '='; ++padding)
        text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;

    std::vector<unsigned char> out;
    out.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int held = 0;
    for (char c : text) {
        int value = values[static_cast<unsigned char>(c)];
        if (value < 0) return std::nullopt;
        bits = (bits << 6) | uint32_t(value);
        held += 6;
        if (held >= 8) {
            held -= 8;
            out.push_back(static_cast<unsigned char>(bits >> held));
        }
    }
    return out;
}

bool is_data_uri(const std::string& uri) {
    return uri.rfind("data:", 0) == 0;
}

static std::vector<unsigned char> decode_data_uri(const std::string& uri, const std::string& what) {
    size_t comma = uri.find(',');
    if (comma == std::string::npos) throw Error(what + ": a data: URI without a comma before its data");
    std::string_view head = std::string_view(uri).substr(0, comma);
    std::string_view body = std::string_view(uri).substr(comma + 1);
    if (!head.ends_with(";base64")) {
        std::string bytes = percent_decode(body);
        return {bytes.begin(), bytes.end()};
    }
    auto bytes = decode_base64(body);
    if (!bytes) throw Error(what + ": damaged base64 in its data: URI");
    return std::move(*bytes);
}

fs::path uri_path(const std::string& uri, const fs::path& base, const std::string& what) {
    const std::string decoded = percent_decode(uri);
    std::string refused = refused_uri(uri);
    if (refused.empty()) refused = refused_path(decoded);
    if (!refused.empty())
        throw Error(what + ": invalid uri '" + shortened(uri) + "': " + refused +
                    "; expected a path relative to the scene's file, or a data: URI");
    std::error_code ignored;
    // Some exporters write file names unescaped.
    return !fs::exists(base / decoded, ignored) && fs::exists(base / uri, ignored) ? base / uri : base / decoded;
}

std::vector<unsigned char> read_uri(const std::string& uri, const fs::path& base, const std::string& what,
                                    uint64_t max_bytes) {
    if (is_data_uri(uri)) return decode_data_uri(uri, what);
    fs::path path = uri_path(uri, base, what);
    std::error_code ignored;
    if (!fs::exists(path, ignored)) throw Error(what + ": there is no file '" + shortened(path.string()) + "'");
    try {
        std::string bytes = read_file(path, max_bytes);
        return {bytes.begin(), bytes.end()};
    } catch (const Error& error) {
        throw Error(what + ": " + error.what());
    }
}

} // namespace bounce
