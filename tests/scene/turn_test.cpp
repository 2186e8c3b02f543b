// Rotations as angles and back.
#include "scene/turn.h"

#include <gtest/gtest.h>

using namespace bounce;

static double apart(const glm::dquat& a, const glm::dquat& b) {
    return 1 - std::abs(glm::dot(a, b));
}

TEST(Turn, AnglesAreAboutTheWorldsAxesInOrder) {
    // X first: the front goes down by 90°, and the turn about Y leaves it there.
    const glm::dvec3 front = rotation_of({90, 45, 0}) * glm::dvec3(0, 0, 1);
    EXPECT_NEAR(glm::distance(front, glm::dvec3(0, -1, 0)), 0, 1e-12);
    const glm::dvec3 side = rotation_of({0, 90, 90}) * glm::dvec3(1, 0, 0);
    EXPECT_NEAR(glm::distance(side, glm::dvec3(0, 0, -1)), 0, 1e-12);
}

TEST(Turn, AnglesMakeTheRotationAgain) {
    for (double x : {-180.0, -91.0, -30.0, 0.0, 17.5, 90.0, 179.0})
        for (double y : {-90.0, -89.9999, -45.0, 0.0, 12.0, 90.0, 91.0, 180.0})
            for (double z : {-120.0, 0.0, 33.3, 90.0, 180.0}) {
                const glm::dquat rotation = rotation_of({x, y, z});
                const glm::dvec3 angles = angles_of(rotation);
                EXPECT_LT(apart(rotation_of(angles), rotation), 1e-10) << x << " " << y << " " << z;
                EXPECT_LE(std::abs(angles.y), 90);
            }
    EXPECT_NEAR(glm::distance(angles_of(rotation_of({20, 30, -40})), glm::dvec3(20, 30, -40)), 0, 1e-9);
}

TEST(Turn, WhatHasLengthOneIsReadAsItIs) {
    int changed = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dquat rotation = rotation_of({i * 0.37, i * 1.13 - 90, i * 2.71});
        EXPECT_EQ(of_length_1(rotation), rotation);
        EXPECT_LT(std::abs(glm::length(of_length_1(rotation * 3.0)) - 1), 1e-15);
        changed += glm::normalize(rotation) != rotation;
    }
    EXPECT_GT(changed, 0) << "normalizing changes none: nothing was tested";
}

TEST(Turn, TheShortestTurnBetweenDirections) {
    const std::vector<glm::dvec3> all = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},     {-1, 0, 0},
                                         {0, -1, 0}, {0, 0, -1}, {0.6, 0, 0.8}, {-0.6, 0, -0.8}};
    for (const glm::dvec3& from : all)
        for (const glm::dvec3& to : all) {
            const glm::dquat turn = turn_between(from, to);
            EXPECT_NEAR(glm::distance(turn * from, to), 0, 1e-12);
            EXPECT_NEAR(std::abs(turn.w), std::sqrt((1 + glm::dot(from, to)) / 2), 1e-7)
                << "it is no longer than needed";
        }
}
