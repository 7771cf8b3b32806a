/// @file model_lines.h
/// What the configuration files with sections have in common.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MODEL_LINES_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MODEL_LINES_H

#include <istream>
#include <string>
#include <vector>

namespace openr_host {

/// A line without comment and without space around it; never empty.
struct ModelLine {
  std::string text;
  int number;
  bool is_for_design;
};

/// Reads a file in which `#` begins a comment, and lines after `[ERS-7]` are for that model alone, up to the next such
/// line. The lines that name models are left out.
/// @param design the robot's model
std::vector<ModelLine> readModelLines(std::istream& text, const std::string& design);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MODEL_LINES_H
