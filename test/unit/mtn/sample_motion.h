/// @file sample_motion.h
/// A small motion for tests.
#ifndef TEST_UNIT_MTN_SAMPLE_MOTION_H
#define TEST_UNIT_MTN_SAMPLE_MOTION_H

#include "motion_tool/motion_tool.h"

/// Two joints of an ERS-7's head, three key frames: at 0, 160 and 480 ms.
inline motion_tool::KeyFrameMotion sampleMotion() {
  motion_tool::KeyFrameMotion motion;
  motion.name = "SAMPLE";
  motion.creator = "test";
  motion.design = "DRX-1000";
  motion.locators = {"PRM:/r1/c1/c2-Joint2:12", "PRM:/r1/c1/c2/c3-Joint2:13"};
  motion.key_frames = {{0, {0, 0}}, {160, {100000, -50000}}, {480, {-200000, 300000}}};
  return motion;
}

#endif  // TEST_UNIT_MTN_SAMPLE_MOTION_H
