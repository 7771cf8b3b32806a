/// @file motion_bytes.h
/// Motion files, and what a folder has.
#ifndef TEST_UNIT_RCSERVER_MOTION_BYTES_H
#define TEST_UNIT_RCSERVER_MOTION_BYTES_H

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "motion_tool/motion_tool.h"
#include "support/temporary_folder.h"

using test_support::contentOf;

/// A motion file made from its text form (docs/motions.md), for an ERS-7 unless the text names another robot.
inline std::string motionBytes(const std::string& text) {
  return motion_tool::encodeMtn(motion_tool::parseTextForm("robot ERS-7\n" + text));
}

inline std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

#endif  // TEST_UNIT_RCSERVER_MOTION_BYTES_H
