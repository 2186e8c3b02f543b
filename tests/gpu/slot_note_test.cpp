// What a slot's line says of it behind "//!".
#include "gpu/slot_note.h"
#include "support/errors.h"

#include <gmock/gmock.h>

using namespace bounce;
using testing::HasSubstr;

static ShaderSlot read(const std::string& note) {
    ShaderSlot slot;
    slot.name = "a.b";
    read_slot_note(note, slot);
    return slot;
}

TEST(SlotNote, OptionalNeutralAndSource) {
    EXPECT_TRUE(read(" optional").optional);
    EXPECT_EQ(read("optional, neutral 1").neutral, glm::vec4(1));
    EXPECT_FALSE(read("neutral 0.5  // half").optional);
    EXPECT_EQ(read("neutral 0 0.5 1 1").neutral, glm::vec4(0, 0.5f, 1, 1));
    EXPECT_FALSE(read("optional").neutral.has_value());
    ShaderSlot slot = read("from dvs.directional, optional");
    EXPECT_EQ(slot.from, "dvs.directional");
    EXPECT_EQ(slot.from_mip, "");
    EXPECT_TRUE(slot.optional);
    slot = read("from voxels.occlusion mip max(iteration - 1, 0), neutral 1");
    EXPECT_EQ(slot.from, "voxels.occlusion");
    EXPECT_EQ(slot.from_mip, "max(iteration - 1, 0)");
    EXPECT_EQ(slot.neutral, glm::vec4(1));
    EXPECT_EQ(read("from a.layers layer 2").from_layer, "2");
    slot = read("optional unless kind == hard, neutral 1");
    EXPECT_TRUE(slot.optional);
    EXPECT_EQ(slot.required_if, "kind == hard");
}

TEST(SlotNote, OtherWordsAreAnError) {
    EXPECT_THAT(error_of([] { read("optinal"); }), HasSubstr("invalid note 'optinal' of slot 'a.b': expected optional, "
                                                             "neutral VALUE, from NAME or ordered: REASON (did you "
                                                             "mean 'optional'?)"));
    EXPECT_THAT(error_of([] { read("optional maybe"); }), HasSubstr("invalid note 'optional maybe'"));
    EXPECT_THAT(error_of([] { read("neutral"); }), HasSubstr("'neutral' takes one number, or four"));
    EXPECT_THAT(error_of([] { read("neutral white"); }), HasSubstr("neutral"));
    EXPECT_THAT(error_of([] { read("from directional"); }), HasSubstr("'from' is written: from group.name"));
    EXPECT_THAT(error_of([] { read("from a.b mip"); }), HasSubstr("'from' is written"));
    EXPECT_THAT(error_of([] { read("from a.b level 2"); }), HasSubstr("'from' is written"));
    EXPECT_THAT(error_of([] { read(""); }), HasSubstr("invalid note"));
}
