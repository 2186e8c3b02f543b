// Sorted insertion under contention: many invocations insert into few lists at once. (Fragments of a rasterizer in
// software hardly ever do.)
#include "ldm/lists_fixture.h"

using namespace bounce;

namespace {

constexpr int k_inserts = 200000, k_lists = 256;

uint32_t hashed(uint32_t x) {
    x ^= x >> 16, x *= 0x7feb352du, x ^= x >> 15, x *= 0x846ca68bu, x ^= x >> 16;
    return x;
}

} // namespace

TEST_F(LdmTest, ListsStaySortedAndWholeWhenManyInsertAtOnce) {
    shader("test/info.comp", fmt::format("layout(local_size_x = 1) in;\n"
                                         "layout(std430) writeonly buffer ldm_info {{ int info[8]; }};\n"
                                         "layout(std430) writeonly buffer ldm_views {{ vec4 view[5]; }};\n"
                                         "void main() {{\n    info = int[8](1, 16, 1, 1, {}, 3, {}, 0);\n"
                                         "    view[0] = vec4(0.0);\n}}\n",
                                         k_lists, k_inserts));
    // Depths of 10 bits: some two hundred fragments share each, and are told apart by the word after it.
    shader("test/insert.comp",
           fmt::format("#include \"ldm/insert.glsl\"\nlayout(local_size_x = 64) in;\n"
                       "uint hashed(uint x) {{\n"
                       "    x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15; x *= 0x846ca68bu; x ^= x >> 16;\n"
                       "    return x;\n}}\n"
                       "void main() {{\n    uint i = gl_GlobalInvocationID.x;\n    if (i >= {0}u) return;\n"
                       "    float depth = float(hashed(i) & 1023u) / 1024.0;\n"
                       "    insert_fragment(hashed(i + {0}u) % {1}u, uvec3(floatBitsToUint(depth), i, 0u));\n}}\n",
                       k_inserts, k_lists));
    SceneRunner run(blocks(), {},
                    graph_file(fmt::format(
                        R"("resources":{{"ldm.info":{{"kind":"buffer","count":8,"stride":4}},
            "ldm.views":{{"kind":"buffer","count":1,"stride":80}},"ldm.counts":{{"kind":"buffer","count":8,"stride":4}},
            "ldm.lists":{{"kind":"buffer","count":{},"stride":4}}}},
            "passes":[{{"id":"info","type":"compute","shader":"test/info.comp","dispatch":[1]}},
                      {{"id":"insert","type":"compute","shader":"test/insert.comp","dispatch":[{}]}}])",
                        k_lists + 3 * k_inserts, k_inserts)));
    std::vector<std::vector<std::pair<uint32_t, uint32_t>>> wanted(k_lists);
    for (uint32_t i = 0; i < k_inserts; ++i) {
        float depth = float(hashed(i) & 1023u) / 1024.0f;
        uint32_t bits;
        std::memcpy(&bits, &depth, 4);
        wanted[hashed(i + k_inserts) % k_lists].emplace_back(bits, i);
    }
    for (auto& list : wanted)
        std::sort(list.begin(), list.end());
    for (int round = 0; round < 3; ++round) {
        run.frame();
        EXPECT_EQ(run.read_buffer<uint32_t>("ldm.counts")[0], uint32_t(k_inserts));
        std::vector<uint32_t> words = run.read_buffer<uint32_t>("ldm.lists");
        int out_of_order = 0, different = 0;
        for (size_t head = 0; head < k_lists; ++head) {
            std::vector<std::pair<uint32_t, uint32_t>> got;
            for (uint32_t node = words[head]; node != 0 && got.size() <= k_inserts;) {
                size_t at = k_lists + 3 * size_t(node - 1);
                ASSERT_LT(at + 2, words.size());
                got.emplace_back(words[at], words[at + 2]);
                node = words[at + 1];
            }
            out_of_order += !std::is_sorted(got.begin(), got.end());
            different += got != wanted[head];
        }
        EXPECT_EQ(out_of_order, 0) << "round " << round;
        EXPECT_EQ(different, 0) << "round " << round << ": lists that lost, doubled or mixed fragments";
    }
}
