/// @file head.h
/// Where the camera of an ERS-7 is, and how neck and head have to turn so that it looks at a place. The only place with
/// the lengths of the head, beside urdf/ers7.urdf, which a test compares with it. Used by both sides; C++98, no I/O.
///
/// Metres and radian. Positions are in the body: x forward, y to the left, z up, with the origin in the middle of the
/// four shoulders.
#ifndef AIBO_RCSERVER_ROBOT_MODEL_HEAD_H
#define AIBO_RCSERVER_ROBOT_MODEL_HEAD_H

#include "robot_model/legs.h"  // Point

namespace robot_model {

// Tekkotsu's kinematic table of the ERS-7.
const double NECK_FORWARD = 0.0675;  ///< from the body's origin to the joint neck_tilt
const double NECK_UP = 0.0195;
const double NECK_LENGTH = 0.080;       ///< from there to the axes of head_pan and head_tilt, which meet
const double CAMERA_FORWARD = 0.08106;  ///< from there to the camera, in the head
const double CAMERA_UP = -0.0146;

/// Angles of the three joints between body and camera. At zero the neck is upright and the head looks ahead.
struct HeadAngles {
  HeadAngles() : neck_tilt(0), head_pan(0), head_tilt(0) {}

  double neck_tilt;  ///< negative leans forward
  double head_pan;   ///< positive to the left
  double head_tilt;  ///< positive looks up
};

/// How far a place is from the middle of the camera's picture: the angle between the camera's axis and the way from the
/// camera to the place. The joints' limits are not looked at.
/// @return 0..pi; pi / 2 and more is behind the camera
double findViewError(const Point& place, const HeadAngles& angles);

/// How neck and head have to turn so that the middle of the camera's picture shows a place, within the limits of the
/// joints and with the mouth closed. Of all ways to do it, this is the one with the neck most upright. It does not
/// depend on where the head is now.
/// @param[out] angles the best that the joints can do
/// @return findViewError() of these angles: below 0.001 if the camera will look at the place. It cannot look at what is
///   behind the robot, at the floor beside it, or at what is nearer to the head than the camera.
double findHeadAngles(const Point& place, HeadAngles* angles);

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_HEAD_H
