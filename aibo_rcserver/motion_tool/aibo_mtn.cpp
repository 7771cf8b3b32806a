// Makes motion files from text, and prints motion files as text (docs/motions.md).
#include <algorithm>
#include <exception>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_files/gzip.h"
#include "host_files/regular_file.h"
#include "host_files/replace_file.h"
#include "motion_tool/archive.h"
#include "motion_tool/motion_tool.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr std::size_t kLongestFile = 64U << 20U;  // bytes

const char kUsage[] =
    "usage: aibo_mtn TEXT MOTION.MTN                      make a motion file from its text form\n"
    "       aibo_mtn MOTION.MTN                           print the text form of a motion file\n"
    "       aibo_mtn ARCHIVE.ODA                          list the files in an archive of motions\n"
    "       aibo_mtn [--force] --unpack ARCHIVE.ODA DIR   write them to a folder; --force overwrites files there\n";

std::string readFile(const std::string& name) {
  try {
    return host_files::readUnpacked(name, kLongestFile);
  } catch (const host_files::Unreadable& why) {
    throw std::runtime_error(name + " cannot be read: " + why.what());
  }
}

void writeFile(const std::string& name, const std::string& content) {
  try {
    host_files::replaceFile(name, content);
  } catch (const host_files::Unwritable& why) {
    throw std::runtime_error(name + " cannot be written: " + why.what());
  }
}

void read(const std::string& bytes, const std::string& file, mtn::Motion& motion) {
  if (!motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) {
    throw std::runtime_error(file + " is not a motion file: " + motion.problem());
  }
}

// Prints what a robot does differently. This may be intended, so nothing is stopped.
void warnOfChanges(const mtn::Motion& motion) {
  const robot_model::RobotModel* robot = motion_tool::robotOf(motion);
  const std::string remark = robot == nullptr ? "neither an ERS-7 nor an ERS-210 has any of its joints"
                                              : motion_tool::describeChanges(motion, *robot);
  if (!remark.empty()) {
    std::cerr << "aibo_mtn: " << motion_tool::forTerminal(remark) << '\n';
  }
}

// Puts `prefix` before each line, and makes the text safe for a terminal.
std::string eachLineAfter(const std::string& prefix, const std::string& text) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    result += prefix + motion_tool::forTerminal(line) + '\n';
  }
  return result;
}

void make(const std::string& source, const std::string& target) {
  const std::string text = readFile(source);
  std::string bytes;
  try {
    bytes = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(eachLineAfter(source + ": ", error.what()));
  }
  mtn::Motion motion;
  read(bytes, target, motion);
  warnOfChanges(motion);
  writeFile(target, bytes);
}

void list(const std::vector<motion_tool::ArchivedFile>& files) {
  for (const motion_tool::ArchivedFile& file : files) {
    std::cout << std::setw(8) << file.content.size() << "  " << motion_tool::fileNameOf(file) << "  ("
              << motion_tool::forTerminal(file.name) << ")\n";
  }
}

std::vector<motion_tool::ArchivedFile> filesIn(const std::string& bytes, const std::string& source) {
  try {
    return motion_tool::readArchive(bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(source + ": " + error.what());
  }
}

void unpack(const std::string& archive, const std::string& folder, bool overwrite) {
  const std::vector<motion_tool::ArchivedFile> files = filesIn(readFile(archive), archive);
  motion_tool::unpack(files, folder, overwrite);
  list(files);
}

void print(const std::string& source) {
  const std::string bytes = readFile(source);
  if (motion_tool::isArchive(bytes)) {
    list(filesIn(bytes, source));
    return;
  }
  mtn::Motion motion;
  read(bytes, source, motion);
  std::cout << motion_tool::printTextForm(motion);
  warnOfChanges(motion);
}

// Removes an option from the arguments, wherever it is.
bool takeOption(const std::string& option, std::vector<std::string>& arguments) {
  const auto end = std::remove(arguments.begin(), arguments.end(), option);
  const bool is_there = end != arguments.end();
  arguments.erase(end, arguments.end());
  return is_there;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (takeOption("--help", arguments)) {
    std::cout << kUsage;
    return 0;
  }
  const bool overwrites = takeOption("--force", arguments);
  const bool unpacks = takeOption("--unpack", arguments);
  if (arguments.empty() || arguments.size() > 2 || (unpacks && arguments.size() != 2) || (overwrites && !unpacks)) {
    std::cerr << kUsage;
    return kWrongUsage;
  }
  try {
    if (unpacks) {
      unpack(arguments[0], arguments[1], overwrites);
    } else if (arguments.size() == 2) {
      make(arguments[0], arguments[1]);
    } else {
      print(arguments[0]);
    }
  } catch (const std::exception& error) {
    std::cerr << eachLineAfter("aibo_mtn: ", error.what());
    return kFailed;
  }
  return 0;
}
