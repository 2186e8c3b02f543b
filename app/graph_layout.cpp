#include "app/graph_layout.h"

#include "app/graph_wires.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace bounce {

namespace {

constexpr float k_letter = 0.58f;               // width of a letter, em
constexpr float k_least = 9, k_most = 20;       // width of a box
constexpr float k_column_gap = 4, k_gap = 1.1f; // between columns, and between boxes of one
constexpr float k_wire_height = 0.55f;          // that a wire takes between boxes
constexpr float k_lane = 0.8f;                  // between the wires below all boxes
constexpr int k_order_sweeps = 12, k_height_sweeps = 24;

/// A box, or a wire on its way through a column.
struct Item {
    int box = -1;
    float height = 0;
    float y = 0;                            ///< of its top
    std::vector<int> left, right;           ///< items that wires join it to
    std::vector<float> left_y, right_y;     ///< where, relative to its top
    std::vector<float> left_from, right_to; ///< and relative to theirs
};

/// The closest heights to those that are wanted at which nothing overlaps, in the given order: isotonic regression by
/// pooling neighbours that are too close.
void settle(std::vector<Item>& items, const std::vector<int>& column, const std::vector<float>& wanted) {
    struct Pool {
        double sum, count;
        double mean() const { return sum / count; }
    };
    std::vector<Pool> pools;
    std::vector<double> offset(column.size(), 0);
    for (size_t i = 1; i < column.size(); ++i)
        offset[i] = offset[i - 1] + double(items[size_t(column[i - 1])].height) + double(k_gap);
    for (size_t i = 0; i < column.size(); ++i) {
        pools.push_back({double(wanted[i]) - offset[i], 1});
        while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
            pools[pools.size() - 2].sum += pools.back().sum;
            pools[pools.size() - 2].count += pools.back().count;
            pools.pop_back();
        }
    }
    size_t at = 0;
    for (const Pool& pool : pools)
        for (int k = 0; k < int(pool.count); ++k, ++at)
            items[size_t(column[at])].y = float(pool.mean() + offset[at]);
}

class Layering {
  public:
    explicit Layering(GraphLayout& layout) : layout_(layout) {}

    void run() {
        if (layout_.boxes.empty()) return;
        find_layers();
        make_items();
        order();
        find_heights();
        place();
        draw_wires();
    }

  private:
    LayoutBox& box(int index) { return layout_.boxes[size_t(index)]; }
    Item& item(int index) { return items_[size_t(index)]; }

    /// As far left as what a box reads allows; then as far right as its readers do, so that wires are short.
    void find_layers() {
        for (int i = 0; i < int(layout_.boxes.size()); ++i)
            for (const LayoutWire& wire : layout_.wires)
                if (!wire.back && wire.to == i) box(i).layer = std::max(box(i).layer, box(wire.from).layer + 1);
        for (int i = int(layout_.boxes.size()) - 1; i >= 0; --i) {
            int nearest = -1;
            for (const LayoutWire& wire : layout_.wires)
                if (!wire.back && wire.from == i)
                    nearest = nearest < 0 ? box(wire.to).layer : std::min(nearest, box(wire.to).layer);
            if (nearest > 0) box(i).layer = std::max(box(i).layer, nearest - 1);
        }
    }

    void join(int from, float from_y, int to, float to_y) {
        Item &a = item(from), &b = item(to);
        a.right.push_back(to), a.right_y.push_back(from_y), a.right_to.push_back(to_y);
        b.left.push_back(from), b.left_y.push_back(to_y), b.left_from.push_back(from_y);
    }

    /// A box each, and for each row whose readers are further away one item in each column between.
    void make_items() {
        for (int i = 0; i < int(layout_.boxes.size()); ++i) {
            LayoutBox& b = box(i);
            size_t letters = b.id.size() + 5;
            for (const std::string& output : b.outputs)
                letters = std::max(letters, output.size() + 2);
            b.size = {std::clamp(k_letter * float(letters), k_least, k_most),
                      k_layout_head + k_layout_row * float(b.outputs.size()) + (b.outputs.empty() ? 0.0f : 0.3f)};
            columns_.resize(std::max(columns_.size(), size_t(b.layer) + 1));
            Item made;
            made.box = i, made.height = b.size.y;
            items_.push_back(made);
            columns_[size_t(b.layer)].push_back(i);
        }
        for (const LayoutWire& wire : layout_.wires) {
            if (wire.back) continue;
            int at = wire.from;
            float y = k_layout_head + (float(wire.output) + 0.5f) * k_layout_row;
            for (int layer = box(wire.from).layer + 1; layer < box(wire.to).layer; ++layer) {
                auto [found, fresh] = ways_.try_emplace({wire.from, wire.output, layer}, int(items_.size()));
                if (fresh) {
                    Item way;
                    way.height = k_wire_height;
                    items_.push_back(way);
                    columns_[size_t(layer)].push_back(found->second);
                    join(at, y, found->second, 0.5f * k_wire_height);
                }
                at = found->second;
                y = 0.5f * k_wire_height;
            }
            join(at, y, wire.to, 0.5f * box(wire.to).size.y);
        }
    }

    /// Each column is sorted by the mean place of its neighbours, from left to right and back; the order with the
    /// fewest crossings stays.
    void order() {
        std::vector<std::vector<int>> best = columns_;
        size_t fewest = crossings();
        for (int sweep = 0; sweep < k_order_sweeps && fewest > 0; ++sweep) {
            const bool rightward = sweep % 2 == 0;
            for (size_t k = 1; k < columns_.size(); ++k)
                sort_column(rightward ? k : columns_.size() - 1 - k, rightward);
            if (const size_t now = crossings(); now < fewest) fewest = now, best = columns_;
        }
        columns_ = best;
    }

    std::vector<double> places() const {
        std::vector<double> place(items_.size(), 0);
        for (const auto& column : columns_)
            for (size_t i = 0; i < column.size(); ++i)
                place[size_t(column[i])] = (double(i) + 0.5) / double(column.size());
        return place;
    }

    void sort_column(size_t layer, bool rightward) {
        const std::vector<double> place = places();
        std::map<int, double> key;
        for (int i : columns_[layer]) {
            const auto& neighbours = rightward ? item(i).left : item(i).right;
            double sum = 0;
            for (int n : neighbours)
                sum += place[size_t(n)];
            key[i] = neighbours.empty() ? place[size_t(i)] : sum / double(neighbours.size());
        }
        std::stable_sort(columns_[layer].begin(), columns_[layer].end(), [&](int a, int b) { return key[a] < key[b]; });
    }

    size_t crossings() const {
        size_t count = 0;
        const std::vector<double> place = places();
        for (const auto& column : columns_) {
            std::vector<std::pair<double, double>> joints;
            for (int i : column)
                for (int n : items_[size_t(i)].right)
                    joints.emplace_back(place[size_t(i)], place[size_t(n)]);
            for (size_t a = 0; a < joints.size(); ++a)
                for (size_t b = a + 1; b < joints.size(); ++b)
                    count += (joints[a].first - joints[b].first) * (joints[a].second - joints[b].second) < 0;
        }
        return count;
    }

    void find_heights() {
        for (const auto& column : columns_)
            settle(items_, column, std::vector<float>(column.size(), 0));
        for (int sweep = 0; sweep < k_height_sweeps; ++sweep) {
            const bool rightward = sweep % 2 == 0;
            for (size_t k = 0; k < columns_.size(); ++k) {
                const auto& column = columns_[rightward ? k : columns_.size() - 1 - k];
                std::vector<float> wanted;
                for (int i : column)
                    wanted.push_back(wanted_height(item(i), rightward));
                settle(items_, column, wanted);
            }
        }
        // What no wire pulls anywhere keeps close to its neighbours.
        for (const auto& column : columns_) {
            for (size_t i = 1; i < column.size(); ++i) {
                const Item& above = item(column[i - 1]);
                if (item(column[i]).left.empty() && item(column[i]).right.empty())
                    item(column[i]).y = above.y + above.height + k_gap;
            }
            size_t first = 0; // of those that wires do pull
            while (first < column.size() && item(column[first]).left.empty() && item(column[first]).right.empty())
                ++first;
            for (size_t i = first; first < column.size() && i-- > 0;)
                item(column[i]).y = item(column[i + 1]).y - item(column[i]).height - k_gap;
        }
        float top = 1e30f;
        for (const Item& i : items_)
            top = std::min(top, i.y);
        for (Item& i : items_)
            i.y -= top;
    }

    /// At which its wires run straight.
    float wanted_height(const Item& i, bool rightward) const {
        const auto& neighbours = rightward || i.right.empty() ? i.left : i.right;
        const bool left = &neighbours == &i.left;
        if (neighbours.empty()) return i.y;
        float sum = 0;
        for (size_t n = 0; n < neighbours.size(); ++n) {
            const float there = items_[size_t(neighbours[n])].y + (left ? i.left_from[n] : i.right_to[n]);
            sum += there - (left ? i.left_y[n] : i.right_y[n]);
        }
        return sum / float(neighbours.size());
    }

    void place() {
        float x = 0;
        for (const auto& column : columns_) {
            float width = 0;
            for (int i : column)
                if (item(i).box >= 0) width = std::max(width, box(item(i).box).size.x);
            column_x_.push_back({x, x + width});
            for (int i : column) {
                if (item(i).box < 0) continue;
                box(item(i).box).min = {x, item(i).y};
                box(item(i).box).size.x = width;
            }
            for (int i : column)
                layout_.size.y = std::max(layout_.size.y, item(i).y + item(i).height);
            layout_.size.x = x + width;
            x += width + k_column_gap;
        }
    }

    /// Wires that end at a box share its left edge, in the order in which they come.
    void draw_wires() {
        std::map<int, std::vector<size_t>> arriving;
        for (size_t w = 0; w < layout_.wires.size(); ++w) {
            LayoutWire& wire = layout_.wires[w];
            const LayoutBox& from = box(wire.from);
            wire.points = {{from.min.x + from.size.x, layout_row_y(from, wire.output)}};
            for (int layer = from.layer + 1; !wire.back && layer < box(wire.to).layer; ++layer) {
                const float y = item(ways_.at({wire.from, wire.output, layer})).y + 0.5f * k_wire_height;
                wire.points.push_back({column_x_[size_t(layer)].x, y});
                wire.points.push_back({column_x_[size_t(layer)].y, y});
            }
            arriving[wire.to].push_back(w);
        }
        float lane = layout_.size.y + k_gap;
        for (auto& [to, wires] : arriving) {
            // Those that come from below end below the others.
            std::stable_sort(wires.begin(), wires.end(), [&](size_t a, size_t b) {
                const LayoutWire &first = layout_.wires[a], &second = layout_.wires[b];
                if (first.back != second.back) return second.back;
                return first.points.back().y < second.points.back().y;
            });
            for (size_t i = 0; i < wires.size(); ++i) {
                LayoutWire& wire = layout_.wires[wires[i]];
                const glm::vec2 end(box(to).min.x,
                                    box(to).min.y + box(to).size.y * float(i + 1) / float(wires.size() + 1));
                if (wire.back) {
                    const float out = wire.points.back().x + 0.25f * k_column_gap, in = end.x - 0.25f * k_column_gap;
                    wire.points.insert(wire.points.end(),
                                       {{out, wire.points.back().y}, {out, lane}, {in, lane}, {in, end.y}});
                    layout_.size.y = lane + k_lane;
                    lane += k_lane;
                }
                wire.points.push_back(end);
            }
        }
    }

    GraphLayout& layout_;
    std::vector<Item> items_; ///< boxes first, by their index
    std::vector<std::vector<int>> columns_;
    std::map<std::tuple<int, int, int>, int> ways_; ///< box, row, layer → item
    std::vector<glm::vec2> column_x_;               ///< from, to
};

} // namespace

GraphLayout lay_out_graph(const GraphModel& model, const Plan& plan, const SceneFacts& facts, bool with_skipped) {
    GraphLayout layout = connect_graph(model, plan, facts, with_skipped);
    Layering(layout).run();
    return layout;
}

} // namespace bounce
