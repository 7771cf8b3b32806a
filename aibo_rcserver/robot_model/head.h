/// @file head.h
/// Where an ERS-7's camera is, and how neck and head turn to look at a place. Only this file and urdf/ers7.urdf have
/// the lengths of the head; a test compares them. C++98, no I/O.
///
/// Lengths are in metres, angles in radians. Positions are relative to the middle of the four shoulders: x forward, y
/// to the left, z up.
#ifndef AIBO_RCSERVER_ROBOT_MODEL_HEAD_H
#define AIBO_RCSERVER_ROBOT_MODEL_HEAD_H

#include "robot_model/legs.h"  // Point

namespace robot_model {

// Lengths are from Tekkotsu's kinematic table of the ERS-7.
const double NECK_FORWARD = 0.0675;  ///< from the body's origin to the joint neck_tilt
const double NECK_UP = 0.0195;
const double NECK_LENGTH = 0.080;       ///< from neck_tilt to the point where the axes of head_pan and head_tilt meet
const double CAMERA_FORWARD = 0.08106;  ///< from that point to the camera, in the head
const double CAMERA_UP = -0.0146;

/// The joints between body and camera. At zero the neck is upright and the head looks ahead.
struct HeadAngles {
  HeadAngles() : neck_tilt(0), head_pan(0), head_tilt(0) {}

  double neck_tilt;  ///< negative leans forward
  double head_pan;   ///< positive to the left
  double head_tilt;  ///< positive looks up
};

/// The place in the body of a point of the head. In the head, x is ahead, y to the left and z up, from the point where
/// the axes of head_pan and head_tilt meet.
Point findInBody(const Point& in_head, const HeadAngles& angles);

/// The angle between the camera's axis and the line from the camera to the place. Joint limits are ignored.
/// @return 0..pi; a place at pi / 2 or more is behind the camera
double findViewError(const Point& place, const HeadAngles& angles);

/// How neck and head turn to show a place in the middle of the picture, within joint limits and with a closed mouth. Of
/// several solutions, the one with the most upright neck is taken. The head's current position has no influence.
/// @return findViewError() of these angles: below 0.001 if the place is in the middle of the picture. The camera cannot
///   look behind the robot, at the floor beside it, or at places nearer to the head than the camera
double findHeadAngles(const Point& place, HeadAngles* angles);

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_HEAD_H
