// Events in the order in which they happened, as many a frame as it can tell apart.
#include "app/hosts/input_queue.h"

#include <cfloat>
#include <gmock/gmock.h>
#include <imgui.h>

namespace bounce {
namespace {

using Kind = InputEvent::Kind;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr int k_key_a = 65, k_key_x = 88, k_key_ctrl = 341, k_key_shift = 340;

class Queue : public testing::Test {
  protected:
    void SetUp() override { ImGui::CreateContext(); }
    void TearDown() override { ImGui::DestroyContext(); }

    void motion(float x, float y) { queue.push({Kind::motion, {x, y}, 0, false, -1, ""}); }
    void button(int which, bool down, int modifiers = 0) { queue.push({Kind::button, {}, which, down, modifiers, ""}); }
    void wheel(float notches) { queue.push({Kind::wheel, {0, notches}, 0, false, -1, ""}); }
    void key(int code, bool down, int modifiers = 0, const char* chord = "") {
        queue.push({Kind::key, {}, code, down, modifiers, chord});
    }
    void modifier(int code, bool down, int modifiers) { queue.push({Kind::modifier, {}, code, down, modifiers, ""}); }
    void text(char character) { queue.push({Kind::text, {}, character, false, -1, ""}); }
    ImGuiIO& frame() {
        ImGuiIO& io = ImGui::GetIO();
        io.MouseWheel = 0;
        io.InputQueueCharacters.resize(0);
        queue.feed(io);
        return io;
    }
    /// Frames until nothing waits.
    int frames() {
        int count = 0;
        for (; !queue.empty() && count < 1000; ++count)
            frame();
        return count;
    }

    InputQueue queue;
};

TEST_F(Queue, APressIsSeenAtItsPlaceAndBeforeItsRelease) {
    motion(10, 20);
    button(0, true);
    button(0, false);
    motion(300, 400);
    EXPECT_EQ(frame().MousePos.x, 10);
    EXPECT_FALSE(frame().MouseDown[0] && ImGui::GetIO().MousePos.x != 10);
    EXPECT_TRUE(ImGui::GetIO().MouseDown[0]);
    EXPECT_EQ(frame().MousePos.x, 10);
    EXPECT_FALSE(ImGui::GetIO().MouseDown[0]);
    EXPECT_EQ(frame().MousePos.x, 300);
    EXPECT_TRUE(queue.empty());
}

TEST_F(Queue, ADragIsOneFrameHoweverManyPlacesItPasses) {
    button(0, true);
    for (int i = 0; i < 500; ++i)
        motion(float(i), 0);
    button(0, false);
    EXPECT_EQ(frames(), 3);
    EXPECT_EQ(ImGui::GetIO().MousePos.x, 499);
}

TEST_F(Queue, ModifiersAreThoseOfTheKey) {
    // Ctrl+A and then x, all while one frame was rendered.
    modifier(k_key_ctrl, true, k_control);
    key(k_key_a, true, k_control, "Ctrl+A");
    key(k_key_a, false, k_control);
    modifier(k_key_ctrl, false, 0);
    key(k_key_x, true, 0, "X");
    text('x');
    EXPECT_TRUE(frame().KeysDown[k_key_a]);
    EXPECT_TRUE(ImGui::GetIO().KeyCtrl);
    EXPECT_THAT(queue.take_chords(), ElementsAre("Ctrl+A"));
    EXPECT_FALSE(frame().KeysDown[k_key_a]);
    while (!queue.empty() && ImGui::GetIO().InputQueueCharacters.empty())
        frame();
    ASSERT_EQ(ImGui::GetIO().InputQueueCharacters.Size, 1);
    EXPECT_TRUE(ImGui::GetIO().KeysDown[k_key_x]);
    EXPECT_FALSE(ImGui::GetIO().KeyCtrl);
    EXPECT_THAT(queue.take_chords(), ElementsAre("X"));
}

TEST_F(Queue, AModifierThatIsLetGoOfDoesNotReachBack) {
    modifier(k_key_shift, true, k_shift);
    button(0, true, k_shift);
    modifier(k_key_shift, false, 0);
    EXPECT_TRUE(frame().KeyShift);
    EXPECT_TRUE(ImGui::GetIO().MouseDown[0]);
    EXPECT_FALSE(frame().KeyShift);
}

TEST_F(Queue, NoPressIsLost) {
    // Two presses of one key, and of two keys, are two frames; a letter comes with its key.
    for (int i = 0; i < 3; ++i) {
        key(k_key_a, true, 0, "A");
        text('a');
        key(k_key_a, false);
    }
    int presses = 0;
    bool before = false;
    std::string typed;
    while (!queue.empty()) {
        ImGuiIO& io = frame();
        presses += io.KeysDown[k_key_a] && !before;
        before = io.KeysDown[k_key_a];
        for (ImWchar character : io.InputQueueCharacters)
            typed += char(character);
    }
    EXPECT_EQ(presses, 3);
    EXPECT_EQ(typed, "aaa");
    EXPECT_THAT(queue.take_chords(), ElementsAre("A", "A", "A"));
    EXPECT_THAT(queue.take_chords(), IsEmpty());
}

TEST_F(Queue, TheWheelTurnsWhereThePointerWas) {
    motion(10, 10);
    wheel(1);
    wheel(1);
    motion(200, 10);
    EXPECT_EQ(frame().MouseWheel, 2);
    EXPECT_EQ(ImGui::GetIO().MousePos.x, 10);
    EXPECT_EQ(frame().MouseWheel, 0);
    EXPECT_EQ(ImGui::GetIO().MousePos.x, 200);
}

TEST_F(Queue, APointerThatLeavesIsNowhereUnlessItDrags) {
    motion(10, 10);
    queue.push({Kind::leave, {}, 0, false, -1, ""});
    frames();
    EXPECT_EQ(ImGui::GetIO().MousePos.x, -FLT_MAX);
    motion(10, 10);
    button(0, true);
    queue.push({Kind::leave, {}, 0, false, -1, ""});
    frames();
    EXPECT_EQ(ImGui::GetIO().MousePos.x, 10);
    queue.forget();
    EXPECT_FALSE(frame().MouseDown[0]);
}

} // namespace
} // namespace bounce
