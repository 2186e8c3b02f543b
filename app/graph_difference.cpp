#include "app/graph_difference.h"

namespace bounce {

OrderedJson in_file_order(OrderedJson whole) {
    OrderedJson ordered = OrderedJson::object();
    for (const char* key : {"version", "about", "transport", "parameters", "resources", "passes"})
        if (whole.contains(key)) ordered[key] = std::move(whole[key]);
    return ordered;
}

std::string graph_difference(const std::string& name, const OrderedJson& from, const OrderedJson& to) {
    const OrderedJson departures = graph_departures(from, to);
    if (departures.empty()) return {};
    OrderedJson overlay = {{"version", 1}, {"extends", name}};
    overlay.update(departures);
    return graph_text(overlay);
}

} // namespace bounce
