#include "gpu/glsl_structure.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace bounce {

void check_calls(const std::vector<GlslFunction>& functions, const ShaderLimits& limits) {
    std::map<std::string_view, double> last;
    for (int sweep = 0; sweep < 64; ++sweep) {
        std::map<std::string_view, double> above;
        for (const GlslFunction& own : functions) {
            double size = own.tokens;
            for (std::string_view call : own.calls) {
                if (auto known = above.find(call); known != above.end())
                    size += known->second;
                else if (auto below = last.find(call); below != last.end() && call != own.name)
                    size += below->second;
            }
            if (size > double(limits.inlined_tokens))
                throw BeyondLimit(
                    own.line, fmt::format("'{}' has {:.4g} tokens with all that it calls in place: expected at most {} "
                                          "(inlined_tokens)",
                                          own.name, size, limits.inlined_tokens));
            double& known = above[own.name];
            known = std::max(known, size);
        }
        if (above == last) return;
        last = std::move(above);
    }
}

} // namespace bounce
