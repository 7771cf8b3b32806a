/// @file motion_bytes.h
/// Motion files for tests.
#ifndef TEST_UNIT_RCSERVER_MOTION_BYTES_H
#define TEST_UNIT_RCSERVER_MOTION_BYTES_H

#include <fstream>
#include <iterator>
#include <string>

#include "motion_tool/motion_tool.h"

/// A motion file made from its text form (docs/motions.md), for an ERS-7 unless the text names another robot.
inline std::string motionBytes(const std::string& text) {
  return motion_tool::encodeMtn(motion_tool::parseTextForm("robot ERS-7\n" + text));
}

inline std::string fileContent(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

#endif  // TEST_UNIT_RCSERVER_MOTION_BYTES_H
