#include "gpu/glsl_constants.h"

#include <charconv>
#include <cmath>

namespace bounce {

namespace {

/// Recursive descent with precedence climbing; the nesting of the text is bounded before.
class Evaluator {
  public:
    Evaluator(std::span<const GlslToken> tokens, const std::function<std::optional<double>(std::string_view)>& named)
        : tokens_(tokens), named_(named) {}

    std::optional<double> run() {
        double value = conditional();
        if (!good_ || at_ != tokens_.size() || std::isnan(value)) return std::nullopt;
        return value;
    }

  private:
    struct Depth { ///< long rows of prefix operators and conditionals nest, too
        explicit Depth(int& depth) : depth_(depth) { ++depth_; }
        ~Depth() { --depth_; }
        int& depth_;
    };
    static constexpr int k_max_depth = 1000;

    std::string_view peek() const { return at_ < tokens_.size() ? tokens_[at_].text : std::string_view(); }
    bool take(std::string_view text) {
        if (at_ == tokens_.size() || peek() != text) return false;
        ++at_;
        return true;
    }
    double fail() {
        good_ = false;
        at_ = tokens_.size();
        return 0;
    }

    double conditional() {
        Depth deeper(depth_);
        if (depth_ > k_max_depth) return fail();
        double value = binary(0);
        if (!take("?")) return value;
        double yes = conditional();
        if (!take(":")) return fail();
        double no = conditional();
        return value != 0 ? yes : no;
    }

    static int precedence(std::string_view op) {
        static const std::vector<std::vector<std::string_view>> levels = {
            {"||"},       {"^^"},     {"&&"},         {"|"}, {"^"}, {"&"}, {"==", "!="}, {"<", ">", "<=", ">="},
            {"<<", ">>"}, {"+", "-"}, {"*", "/", "%"}};
        for (size_t level = 0; level < levels.size(); ++level)
            for (std::string_view known : levels[level])
                if (op == known) return int(level);
        return -1;
    }

    double binary(int least) {
        double left = unary();
        while (true) {
            std::string_view op = peek();
            int level = precedence(op);
            if (level < least) return left;
            ++at_;
            double right = binary(level + 1);
            left = apply(op, left, right);
            if (!good_) return 0;
        }
    }

    double apply(std::string_view op, double a, double b) {
        if (!std::isfinite(a) || !std::isfinite(b)) return fail();
        bool whole = a == std::floor(a) && b == std::floor(b);
        auto bits = [](double x) { return int64_t(std::fmod(x, 9.0e15)); };
        if (op == "||") return a != 0 || b != 0;
        if (op == "&&") return a != 0 && b != 0;
        if (op == "^^") return (a != 0) != (b != 0);
        if (op == "|") return double(bits(a) | bits(b));
        if (op == "&") return double(bits(a) & bits(b));
        if (op == "^") return double(bits(a) ^ bits(b));
        if (op == "==") return a == b;
        if (op == "!=") return a != b;
        if (op == "<") return a < b;
        if (op == ">") return a > b;
        if (op == "<=") return a <= b;
        if (op == ">=") return a >= b;
        if (op == "<<") return a * std::exp2(b);
        if (op == ">>") return std::floor(a / std::exp2(b));
        if (op == "+") return a + b;
        if (op == "-") return a - b;
        if (op == "*") return a * b;
        if (b == 0) return fail();
        if (op == "%") return std::fmod(a, b);
        return whole ? std::trunc(a / b) : a / b;
    }

    double unary() {
        Depth deeper(depth_);
        if (depth_ > k_max_depth) return fail();
        if (take("-")) return -unary();
        if (take("+")) return unary();
        if (take("!")) return unary() == 0;
        if (take("~")) return -unary() - 1;
        if (take("(")) {
            double value = conditional();
            return take(")") ? value : fail();
        }
        if (at_ == tokens_.size()) return fail();
        const GlslToken& token = tokens_[at_++];
        if (token.is_number()) return number(token.text);
        if (!token.is_word()) return fail();
        return word(token.text);
    }

    double word(std::string_view name) {
        if (name == "true") return 1;
        if (name == "false") return 0;
        bool whole = name == "int" || name == "uint";
        if (peek() == "(" && (whole || name == "float" || name == "min" || name == "max")) {
            ++at_;
            double value = conditional();
            while (take(",")) {
                double other = conditional();
                value = name == "min" ? std::min(value, other) : std::max(value, other);
            }
            if (!take(")")) return fail();
            return whole ? std::trunc(value) : value;
        }
        auto value = named_(name);
        return value ? *value : fail();
    }

    double number(std::string_view text) {
        bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
        while (!text.empty() && (text.back() == 'u' || text.back() == 'U' ||
                                 (!hexadecimal && (text.back() == 'f' || text.back() == 'F' || text.back() == 'l' ||
                                                   text.back() == 'L'))))
            text.remove_suffix(1);
        const char* end = text.data() + text.size();
        double value = 0;
        std::from_chars_result result{};
        if (hexadecimal) {
            result = std::from_chars(text.data() + 2, end, value, std::chars_format::hex);
        } else if (text.size() > 1 && text[0] == '0' && text.find_first_not_of("01234567") == std::string_view::npos) {
            int64_t octal = 0;
            result = std::from_chars(text.data(), end, octal, 8);
            value = double(octal);
        } else {
            result = std::from_chars(text.data(), end, value);
        }
        if (result.ec == std::errc::result_out_of_range) return 1e300; // large, whatever it is
        return result.ec == std::errc() && result.ptr == end ? value : fail();
    }

    std::span<const GlslToken> tokens_;
    const std::function<std::optional<double>(std::string_view)>& named_;
    size_t at_ = 0;
    int depth_ = 0;
    bool good_ = true;
};

} // namespace

std::optional<double> constant_value(std::span<const GlslToken> tokens,
                                     const std::function<std::optional<double>(std::string_view)>& named) {
    return Evaluator(tokens, named).run();
}

} // namespace bounce
