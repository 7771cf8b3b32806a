/// @file scene_layout.h
/// Where things are in the scene. Metres and seconds, in the frame of scene.h. A scene of our own: nothing here
/// is measured, but the ball and the bone are about as large as those that came with the robot.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_LAYOUT_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_LAYOUT_H

namespace simulated_ers7 {

/// The two opposite corners of the room, between walls, floor and ceiling.
constexpr double kLowestCorner[] = {-1.6, -1.9, 0};
constexpr double kHighestCorner[] = {3.2, 2.1, 2.5};

/// The soccer carpet: its middle, half its size, its lines.
constexpr double kCarpetX = 0.85;
constexpr double kCarpetHalfLength = 1.6;
constexpr double kCarpetHalfWidth = 1.25;
constexpr double kLineInset = 0.12;
constexpr double kLineHalfWidth = 0.0125;
constexpr double kCenterCircleRadius = 0.28;
constexpr double kPenaltyAreaDepth = 0.40;
constexpr double kPenaltyAreaHalfWidth = 0.55;

/// The ball on the halfway line.
constexpr double kBallRadius = 0.0425;
constexpr double kBallX = kCarpetX;
constexpr double kBallSwing = 0.16;
constexpr double kBallPeriod = 6.0;

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_LAYOUT_H
