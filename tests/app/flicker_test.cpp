// Changes of luminance from frame to frame, against sums by hand.
#include "app/experiments/flicker.h"

#include <gtest/gtest.h>

using namespace bounce;

TEST(SecondDifference, LightThatChangesEvenlyDoesNotFlicker) {
    SecondDifference even;
    for (float level : {1.0f, 2.0f, 3.0f, 4.0f})
        even.add({level, 10 * level});
    EXPECT_DOUBLE_EQ(even.flicker(), 0);
    EXPECT_DOUBLE_EQ(even.flicker_p99(), 0);
    EXPECT_EQ(even.frames(), 4);
    EXPECT_NEAR(even.mean(), 13.75, 1e-12);
    // Of steps of 1 and of 10, each three times.
    EXPECT_NEAR(even.change(), std::sqrt((1.0 + 100.0) / 2) / 13.75, 1e-12);
}

TEST(SecondDifference, ABlinkIsTwiceItsHeight) {
    SecondDifference blink;
    for (float level : {1.0f, 3.0f, 1.0f, 3.0f})
        blink.add({level});
    // Second differences −4 and +4, mean 2.
    EXPECT_DOUBLE_EQ(blink.flicker(), 2);
    EXPECT_DOUBLE_EQ(blink.flicker_p99(), 2);
    EXPECT_DOUBLE_EQ(blink.change(), 1);
}

TEST(SecondDifference, FewFramesAndBlackOnesHaveNone) {
    SecondDifference two, black;
    two.add({1.0f});
    two.add({5.0f});
    EXPECT_EQ(two.flicker(), 0);
    EXPECT_EQ(two.flicker_p99(), 0);
    for (int i = 0; i < 3; ++i)
        black.add({0.0f, 0.0f});
    EXPECT_EQ(black.flicker(), 0);
    EXPECT_EQ(black.change(), 0);
}
