#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "command_line/commands/commands.h"
#include "command_line/quantities.h"
#include "files/files.h"

namespace aibo_driver::command_line {
namespace {

constexpr std::chrono::milliseconds kTimeout{15000};  // a stick may be slow, and a picture may be large
constexpr const char* kPictureEnding = ".JPG";

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

ExitStatus snap(const Arguments& arguments, Output& output) {
  const int quality = arguments.wholeNumber("quality", 1, 100);
  Robot robot(arguments.robot, output);
  robot.connect();
  const std::string name = robot.client().takePictureOnRobot(quality, kTimeout);
  output.result(name + " is on the robot's memory stick.", Json::object({{"picture", name}}));
  return kDone;
}

ExitStatus pictures(const Arguments& arguments, Output& output) {
  Robot robot(arguments.robot, output);
  robot.connect();
  output.names("pictures", robot.client().listPictures(kTimeout));
  return kDone;
}

ExitStatus fetch(const Arguments& arguments, Output& output) {
  const std::string name = files::pictureFileName(arguments.words.front());
  Robot robot(arguments.robot, output);
  robot.connect();
  const std::vector<std::uint8_t> jpeg = robot.client().fetchPicture(name, kTimeout);
  const std::string path = output.picture(arguments.has("output") ? arguments.get("output") : name, jpeg);
  output.result(name + ", " + std::to_string(jpeg.size()) + " bytes: " + path,
                Json::object({{"picture", name}, {"file", path}, {"bytes", jpeg.size()}}));
  return kDone;
}

ExitStatus deleteFile(const Arguments& arguments, Output& output) {
  const std::string name = files::motionFileName(arguments.words.front());
  const bool is_picture = endsWith(name, kPictureEnding);
  Robot robot(arguments.robot, output);
  robot.connect();
  if (is_picture) {
    robot.client().deletePicture(name, kTimeout);
  } else {
    robot.client().deleteMotion(name, kTimeout);
  }
  output.result(name + " was deleted from the robot.", Json::object({{is_picture ? "picture" : "motion", name}}));
  return kDone;
}

}  // namespace

std::vector<Command> memoryStickCommands() {
  return {
      {"snap",
       "",
       "takes a picture and keeps it on the robot's memory stick",
       "It is taken with 208x160 pixels and stored under a new name. RCSERVER.CFG on the robot has to allow it "
       "(ALLOW_PICTURES). `fetch` gets it.",
       {{"snap", "says its name, such as AIBO0001.JPG"}, {"snap -q 95", "at a high quality"}},
       snap,
       {{"quality,q", "N", "85", "of the JPEG, 1 to 100"}}},
      {"pictures",
       "",
       "lists the pictures on the robot's memory stick",
       "RCSERVER.CFG on the robot has to allow it (ALLOW_PICTURES).",
       {{"pictures", "one name a line"}},
       pictures},
      {"fetch",
       "PICTURE",
       "gets a picture from the robot's memory stick, where it stays",
       "Without -o, the file gets the picture's name. It replaces nothing but JPEGs. `-o -` writes the picture to the "
       "standard output. RCSERVER.CFG on the robot has to allow it (ALLOW_PICTURES).",
       {{"fetch aibo0001", "saves AIBO0001.JPG"}, {"fetch aibo0001 -o me.jpg", "saves me.jpg"}},
       fetch,
       {{"output,o", "FILE", "", "file to write; - is the standard output"}}},
      {"delete",
       "FILE",
       "deletes a motion or a picture from the robot's memory stick",
       "A name without an ending is that of a motion. RCSERVER.CFG on the robot has to allow it (ALLOW_DELETE, and "
       "ALLOW_PICTURES for pictures).",
       {{"delete wave", "WAVE.MTN is gone"}, {"delete aibo0001.jpg", "AIBO0001.JPG is gone"}},
       deleteFile}};
}

}  // namespace aibo_driver::command_line
