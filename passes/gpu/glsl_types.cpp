#include "gpu/glsl_types.h"

#include <algorithm>

namespace bounce {

GlslTypes::GlslTypes() {
    for (const char* name : {"float", "int", "uint", "bool"})
        define(name, {4, 1});
    define("double", {8, 1});
    define("void", {0, 1});
    define("atomic_uint", {4, 1});
    static const char* const vectors[] = {"vec", "ivec", "uvec", "bvec", "dvec"};
    static std::deque<std::string> names;
    static const auto* sizes = [] {
        auto* all = new std::vector<std::pair<std::string_view, GlslSize>>;
        for (const char* vector : vectors)
            for (int n = 2; n <= 4; ++n)
                all->push_back(
                    {names.emplace_back(vector + std::to_string(n)), {(vector[0] == 'd' ? 8.0 : 4.0) * n, 1}});
        for (const char* matrix : {"mat", "dmat"}) {
            double scalar = matrix[0] == 'd' ? 8 : 4;
            for (int n = 2; n <= 4; ++n) {
                all->push_back({names.emplace_back(matrix + std::to_string(n)), {scalar * n * n, 1}});
                for (int m = 2; m <= 4; ++m)
                    all->push_back({names.emplace_back(matrix + std::to_string(n) + "x" + std::to_string(m)),
                                    {scalar * n * m, 1}});
            }
        }
        return all;
    }();
    for (const auto& [name, size] : *sizes)
        define(name, size);
}

const GlslSize* GlslTypes::find(std::string_view type) const {
    auto found = sizes_.find(type);
    if (found != sizes_.end()) return &found->second;
    // Samplers and images: a handle each.
    static const GlslSize handle{8, 1};
    std::string_view name = type;
    if (name.starts_with("u") || (name.starts_with("i") && !name.starts_with("image"))) name.remove_prefix(1);
    bool opaque = (name.starts_with("sampler") || name.starts_with("image")) && name.size() <= 22 && name.size() > 6 &&
                  (name.find('D') != std::string_view::npos || name.ends_with("Cube") || name.ends_with("Buffer"));
    return opaque ? &handle : nullptr;
}

GlslSize array_of(const GlslSize& element, double count) {
    GlslSize size = element;
    size.bytes *= count;
    if (element.aggregate) size.names *= count;
    return size;
}

} // namespace bounce
