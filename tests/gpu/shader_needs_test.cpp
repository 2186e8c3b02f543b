// What a shader asks of the driver's limits, by its text alone.
#include "gpu/shader_needs.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

static ShaderNeeds needs_of(const std::string& text, ShaderStage stage = ShaderStage::compute) {
    return shader_needs("#version 460 core\n" + text, stage);
}

TEST(ShaderNeeds, CountsWhatMainReaches) {
    const ShaderNeeds needs = needs_of(R"(
layout(local_size_x = 4, local_size_y = 8) in;
uniform sampler2D a_used, a_unused;
uniform usampler3D a_called;
uniform sampler2DArray a_many[3];
layout(r32ui) uniform uimage2D a_image;
layout(rgba16f) writeonly uniform image2D a_other;
vec4 idle() { return texture(a_unused, vec2(0)); }
vec4 deep() { return vec4(texelFetch(a_called, ivec3(0), 0)); }
vec4 called() { return deep() + texture(a_many[1], vec3(0)); }
void main() { imageAtomicAdd(a_image, ivec2(0), uint(called().x + texture(a_used, vec2(0)).x)); }
)");
    EXPECT_THAT(needs.samplers, ElementsAre("a_used", "a_called", "a_many[0]", "a_many[1]", "a_many[2]"));
    EXPECT_THAT(needs.images, ElementsAre("a_image"));
    EXPECT_EQ(needs.local_size, glm::ivec3(4, 8, 1));
}

TEST(ShaderNeeds, BlocksCountWhetherTheyAreUsedOrNot) {
    const ShaderNeeds needs = needs_of(R"(
layout(local_size_x = 1) in;
struct Item { vec4 a; uint b; };
layout(std430) readonly buffer a_items { Item items[]; };
layout(std430) buffer a_named { uint count; } named;
layout(std430) buffer a_idle { uint nothing; };
layout(std430) buffer a_idle_too { uint x; } idle;
layout(std140) uniform a_block { mat4 turn; vec4 rows[10]; };
struct Other { float named_by_nobody; } other;
void main() { named.count = items[0].b + uint(turn[0].x); }
)");
    EXPECT_THAT(needs.storage_blocks, ElementsAre("a_items", "a_named", "a_idle", "a_idle_too"));
    EXPECT_THAT(needs.uniform_blocks, ElementsAre("a_block"));
    EXPECT_EQ(needs.uniform_block_bytes, 64 + 160);
}

/// A member's name behind a point is not the global variable of that name.
TEST(ShaderNeeds, AMemberIsNoSampler) {
    const ShaderNeeds needs = needs_of(R"(
layout(local_size_x = 1) in;
uniform sampler2D a_map;
struct S { float a_map; };
layout(std430) buffer b_out { float result; };
void main() { S s; s.a_map = 1.0; result = s.a_map; }
)");
    EXPECT_THAT(needs.samplers, IsEmpty());
    EXPECT_THAT(needs.storage_blocks, ElementsAre("b_out"));
}

TEST(ShaderNeeds, BranchesThatConstantsRuleOutDoNotCount) {
    const std::string text = R"(
layout(local_size_x = 1) in;
const int way_none = 0;
const int way_maps = 1;
const int way = WAY;
#define walked WALKED
uniform sampler2D a_maps, a_walk, a_else, b_if;
layout(std430) buffer b_out { float result; };
void main() {
    if (way == way_maps) result = texture(a_maps, vec2(0)).x; else result = texture(a_else, vec2(0)).x;
    if (walked) { for (int i = 0; i < 3; ++i) if (i > 1) result += texture(a_walk, vec2(0)).x; }
    if (result > 1.0) result += texture(b_if, vec2(0)).x;
}
)";
    const auto samplers = [&](const std::string& way, const std::string& walked) {
        return needs_of("#define WAY " + way + "\n#define WALKED " + walked + text).samplers;
    };
    EXPECT_THAT(samplers("1", "true"), ElementsAre("a_maps", "a_walk", "b_if"));
    EXPECT_THAT(samplers("0", "false"), ElementsAre("a_else", "b_if"));
}

/// A local variable that has a constant's name is not that constant.
TEST(ShaderNeeds, AHiddenConstantRulesOutNothing) {
    const ShaderNeeds needs = needs_of(R"(
layout(local_size_x = 1) in;
const int way = 0;
uniform sampler2D a_map;
layout(std430) buffer b_out { float result; };
void main() { int way = int(result); if (way == 1) result = texture(a_map, vec2(0)).x; }
)");
    EXPECT_THAT(needs.samplers, SizeIs(1));
}

TEST(ShaderNeeds, SharedMemoryUniformsAndWorkGroups) {
    const ShaderNeeds needs = needs_of(R"(
const int side = 16;
layout(local_size_x = side, local_size_y = side / 2, local_size_z = 2) in;
shared uint counts[side * side];
shared vec3 sums[10];
shared float idle[4096];
uniform vec4 rows[5];
uniform float gain;
uniform mat4 unused;
void main() { counts[0] = uint(gain); sums[0] = rows[0].xyz; }
)");
    EXPECT_EQ(needs.shared_bytes, 4 * 256 + 16 * 10);
    EXPECT_EQ(needs.uniform_components, 21);
    EXPECT_EQ(needs.local_size, glm::ivec3(16, 8, 2));
}

TEST(ShaderNeeds, OtherStages) {
    EXPECT_TRUE(needs_of("void main() { gl_Layer = gl_InstanceID; }", ShaderStage::vertex).layer_from_vertex);
    EXPECT_FALSE(needs_of("void main() { gl_Layer = 1; }", ShaderStage::geometry).layer_from_vertex);
    EXPECT_FALSE(needs_of("void f() { gl_Layer = 1; } void main() {}", ShaderStage::vertex).layer_from_vertex);
    EXPECT_EQ(needs_of("layout(location = 0) out vec4 a; layout(location = 1) out vec4 b[2];\nvoid main() { a = "
                       "vec4(0); b[0] = a; }",
                       ShaderStage::fragment)
                  .outputs,
              3);
    EXPECT_EQ(needs_of("layout(triangles) in; layout(triangle_strip, max_vertices = 3 * 4) out; void main() {}",
                       ShaderStage::geometry)
                  .output_vertices,
              12);
}

TEST(ShaderNeeds, TextThatIsNoGlslNeedsWhatCanBeFollowed) {
    EXPECT_THAT(needs_of("uniform sampler2D a_b; void main( {{ } texture(a_b").samplers, IsEmpty());
    EXPECT_THAT(needs_of("").images, IsEmpty());
}
