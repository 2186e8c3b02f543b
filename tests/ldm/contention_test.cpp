// Sorted insertion under contention: many invocations insert into few lists at once. (Fragments of a rasterizer in
// software hardly ever do.) BOUNCE_INSERTS sets how many: 10000000 for a GPU.
#include "ldm/lists_fixture.h"

using namespace bounce;

namespace {

constexpr int k_row = 65536; // of invocations: a dispatch is limited to so many groups along each side

int insert_count() {
    const char* text = std::getenv("BOUNCE_INSERTS");
    const int count = text ? std::atoi(text) : 200000;
    return std::clamp(count, 1000, 10'000'000); // whose lists fit the smallest storage block that OpenGL allows
}

uint32_t hashed(uint32_t x) {
    x ^= x >> 16, x *= 0x7feb352du, x ^= x >> 15, x *= 0x846ca68bu, x ^= x >> 16;
    return x;
}

} // namespace

TEST_F(LdmTest, ListsStaySortedAndWholeWhenManyInsertAtOnce) {
    // Lists stay as long (780 fragments), so that work grows with the inserts and not with their square.
    const int inserts = insert_count(), lists = std::max(256, inserts / 781);
    RecordProperty("inserts", inserts);
    shader("test/info.comp", fmt::format("layout(local_size_x = 1) in;\n"
                                         "layout(std430) writeonly buffer ldm_info {{ int info[8]; }};\n"
                                         "layout(std430) writeonly buffer ldm_views {{ vec4 view[5]; }};\n"
                                         "void main() {{\n    info = int[8](1, 16, 1, 1, {}, 3, {}, 0);\n"
                                         "    view[0] = vec4(0.0);\n}}\n",
                                         lists, inserts));
    // Depths of 10 bits: some two hundred fragments share each, and are told apart by the word after it.
    shader("test/insert.comp",
           fmt::format("#include \"ldm/insert.glsl\"\nlayout(local_size_x = 64) in;\n"
                       "uint hashed(uint x) {{\n"
                       "    x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15; x *= 0x846ca68bu; x ^= x >> 16;\n"
                       "    return x;\n}}\n"
                       "void main() {{\n    uint i = gl_GlobalInvocationID.y * {2}u + gl_GlobalInvocationID.x;\n"
                       "    if (i >= {0}u) return;\n"
                       "    float depth = float(hashed(i) & 1023u) / 1024.0;\n"
                       "    insert_fragment(hashed(i + {0}u) % {1}u, uvec3(floatBitsToUint(depth), i, 0u));\n}}\n",
                       inserts, lists, k_row));
    SceneRunner run(blocks(), {},
                    graph_file(fmt::format(
                        R"("resources":{{"ldm.info":{{"kind":"buffer","count":8,"stride":4}},
            "ldm.views":{{"kind":"buffer","count":1,"stride":80}},"ldm.counts":{{"kind":"buffer","count":8,"stride":4}},
            "ldm.lists":{{"kind":"buffer","count":{},"stride":4}}}},
            "passes":[{{"id":"info","type":"compute","shader":"test/info.comp","dispatch":[1]}},
                      {{"id":"insert","type":"compute","shader":"test/insert.comp","dispatch":[{},{}]}}])",
                        lists + 3 * inserts, k_row, (inserts + k_row - 1) / k_row)));
    std::vector<std::vector<std::pair<uint32_t, uint32_t>>> wanted(size_t(lists),
                                                                   std::vector<std::pair<uint32_t, uint32_t>>{});
    for (uint32_t i = 0; i < uint32_t(inserts); ++i) {
        float depth = float(hashed(i) & 1023u) / 1024.0f;
        uint32_t bits;
        std::memcpy(&bits, &depth, 4);
        wanted[hashed(i + uint32_t(inserts)) % uint32_t(lists)].emplace_back(bits, i);
    }
    for (auto& list : wanted)
        std::sort(list.begin(), list.end());
    for (int round = 0; round < 3; ++round) {
        run.frame();
        EXPECT_EQ(run.read_buffer<uint32_t>("ldm.counts")[0], uint32_t(inserts));
        std::vector<uint32_t> words = run.read_buffer<uint32_t>("ldm.lists");
        int out_of_order = 0, different = 0;
        for (size_t head = 0; head < size_t(lists); ++head) {
            std::vector<std::pair<uint32_t, uint32_t>> got;
            for (uint32_t node = words[head]; node != 0 && got.size() <= size_t(inserts);) {
                size_t at = size_t(lists) + 3 * size_t(node - 1);
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
