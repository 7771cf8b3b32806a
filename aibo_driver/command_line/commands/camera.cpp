#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "camera/camera_options.h"
#include "command_line/commands/commands.h"
#include "command_line/interruption.h"
#include "command_line/quantities.h"
#include "files/files.h"

namespace aibo_driver::command_line {

using aibo_client::CameraSettings;
using aibo_client::PicturePtr;
using aibo_client::Resolution;

namespace {

using camera::LinkMeter;
using std::chrono::steady_clock;

constexpr double kLongestWatch = 7 * 24 * 3600;  // s
constexpr std::chrono::milliseconds kPictureTimeout{5000};

/// The options of a command, and those of both. No command sets the camera for good, because the robot resets its
/// camera when its client disconnects.
std::vector<Option> withCameraOptions(std::vector<Option> options) {
  const std::vector<Option> common = {{"quality,q", "N", "85", "of the JPEG, 1 to 100"},
                                      {"resolution", "WxH", "208x160", camera::kResolutionNames},
                                      {"white-balance", "NAME", "", "indoor, outdoor, fluorescent or auto"},
                                      {"gain", "NAME", "", "low, mid or high"},
                                      {"shutter", "NAME", "", "slow, mid or fast"},
                                      {"auto-exposure", "", "", "lets the camera choose gain and shutter speed"}};
  options.insert(options.end(), common.begin(), common.end());
  return options;
}

int qualityIn(const Arguments& arguments) {
  return arguments.wholeNumber("quality", 1, 100);
}

Resolution resolutionIn(const Arguments& arguments) {
  const std::string name = arguments.get("resolution");
  const std::optional<Resolution> resolution = camera::resolutionOf(name);
  if (!resolution) {
    throw aibo_client::InvalidArgumentException("--resolution can be " + std::string(camera::kResolutionNames) +
                                                ", not '" + name + "'");
  }
  return *resolution;
}

/// @param names the names of the values 1, 2, ...
int numberOf(const std::string& option, const std::string& name, const std::vector<std::string>& names) {
  std::string allowed;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) {
      return static_cast<int>(i) + 1;
    }
    allowed += (i == 0 ? "" : ", ") + names[i];
  }
  throw aibo_client::InvalidArgumentException("--" + option + " can be one of " + allowed + ", not '" + name + "'");
}

/// @return the settings; no value if the camera should stay as it is
std::optional<CameraSettings> cameraSettingsIn(const Arguments& arguments) {
  CameraSettings settings;
  if (arguments.has("white-balance")) {
    const std::string name = arguments.get("white-balance");
    settings.auto_white_balance = name == "auto";
    if (!settings.auto_white_balance) {
      settings.white_balance = numberOf("white-balance", name, {"indoor", "outdoor", "fluorescent", "auto"});
    }
  }
  if (arguments.has("gain")) {
    settings.gain = numberOf("gain", arguments.get("gain"), {"low", "mid", "high"});
  }
  if (arguments.has("shutter")) {
    settings.shutter_speed = numberOf("shutter", arguments.get("shutter"), {"slow", "mid", "fast"});
  }
  settings.auto_exposure = arguments.has("auto-exposure");
  return settings == CameraSettings() ? std::nullopt : std::make_optional(settings);
}

aibo_client::ClientOptions clientOptionsIn(const Arguments& arguments) {
  aibo_client::ClientOptions options;
  options.jpeg_quality = qualityIn(arguments);
  return options;
}

/// Takes a picture. If it needs settings of the camera, it is the first picture of a stream that has them.
PicturePtr takePicture(Robot& robot, const Arguments& arguments) {
  const int quality = qualityIn(arguments);
  const Resolution resolution = resolutionIn(arguments);
  const std::optional<CameraSettings> settings = cameraSettingsIn(arguments);
  if (!settings) {
    return robot.client().takePicture(quality, kPictureTimeout, resolution);
  }
  if (!robot.received().status.robot.hasCapability("G")) {
    throw aibo_client::CommandException(
        "this server has no request to set its camera; leave --white-balance, --gain, --shutter and --auto-exposure "
        "out");
  }
  robot.client().setCameraSettings(*settings);
  const steady_clock::time_point end = steady_clock::now() + kPictureTimeout;
  while (steady_clock::now() < end) {
    PicturePtr picture = robot.client().takePicture(quality, kPictureTimeout, resolution);
    if (picture->settings == settings) {
      return picture;
    }
  }
  throw FailedException("no picture with these settings of the camera came in time");
}

ExitStatus picture(const Arguments& arguments, Output& output) {
  const std::string file = arguments.has("output") ? arguments.get("output") : files::nameForPicture();
  resolutionIn(arguments);
  cameraSettingsIn(arguments);
  Robot robot(arguments.robot, output, clientOptionsIn(arguments));
  robot.connect();
  const PicturePtr picture = takePicture(robot, arguments);
  const std::string path = output.picture(file, picture->jpeg);
  char words[96];
  std::snprintf(words, sizeof words, "%dx%d pixels, %zu bytes: ", picture->width, picture->height,
                picture->jpeg.size());
  output.result(
      words + path,
      Json::object(
          {{"file", path}, {"width", picture->width}, {"height", picture->height}, {"bytes", picture->jpeg.size()}}));
  return kDone;
}

/// Takes the stream's pictures until a point in time.
/// @param player gets the pictures to play; may be null
void takeUntil(Robot& robot, LinkMeter& meter, int every, Output* player, steady_clock::time_point end) {
  const auto has_pictures = [](const Received& received) { return !received.pictures.empty(); };
  while (robot.waitUntil(has_pictures, end - steady_clock::now(), Robot::Loss::kIsTolerated)) {
    for (const ArrivedPicture& arrived : robot.takePictures()) {
      meter.add(*arrived.picture, arrived.age, every, arrived.time);
      if (player != nullptr) {
        player->bytes(arrived.picture->jpeg);
      }
    }
  }
}

void reportSecond(const Robot& robot, LinkMeter& meter, Output& output) {
  const LinkMeter::Reading reading = meter.read(steady_clock::now());
  const aibo_client::ConnectionStatus status = robot.received().status;
  const bool lost = status.state != aibo_client::ConnectionState::kConnected;
  const std::string why = lost ? status.reason + ". " + status.advice : "";
  output.result(lost && reading.pictures == 0 ? "no pictures: " + why : wordsOf(reading),
                Json::object({{"connected", !lost}, {"problem", why}, {"stream", jsonOf(reading)}}));
}

ExitStatus watch(const Arguments& arguments, Output& output) {
  const double seconds = arguments.number("seconds", 0, kLongestWatch);
  const int every = arguments.wholeNumber("every", 1, 65535);
  const aibo_client::StreamFormat format{resolutionIn(arguments), every};
  const std::optional<CameraSettings> settings = cameraSettingsIn(arguments);
  const bool plays = arguments.has("play");
  if (plays) {
    output.leaveStandardOutputToBytes();
  }
  Robot robot(arguments.robot, output, clientOptionsIn(arguments));
  robot.client().setStreamFormat(format);
  if (settings) {
    robot.client().setCameraSettings(*settings);
  }
  robot.connect();
  robot.client().setStreaming(true);
  LinkMeter meter(steady_clock::now());
  try {
    const steady_clock::time_point begin = steady_clock::now();
    for (double second = 0; seconds == 0 || second < seconds;) {
      second = seconds == 0 ? second + 1 : std::min(second + 1, seconds);
      takeUntil(robot, meter, every, plays ? &output : nullptr, begin + nanosecondsOf(second));
      robot.showWarnings();
      reportSecond(robot, meter, output);
    }
  } catch (const Interrupted&) {
    // The time is over, which is the normal end.
  }
  const std::uint64_t lost = robot.received().lost_pictures;
  if (lost > 0) {
    output.note("This computer was too slow for " + counted(lost, "picture") + ".");
  }
  return kDone;
}

}  // namespace

std::string wordsOf(const LinkMeter::Reading& reading) {
  char text[160];
  std::snprintf(text, sizeof text, "%5.1f pictures/s %6.1f KB/s", reading.picturesPerSecond(),
                reading.kilobytesPerSecond());
  std::string words = text;
  if (reading.mean_age) {
    std::snprintf(text, sizeof text, "   age %3.0f ms (worst %3.0f)", 1000 * *reading.mean_age,
                  1000 * *reading.worst_age);
    words += text;
  }
  if (reading.loss) {
    std::snprintf(text, sizeof text, "   loss %.1f %%", 100 * *reading.loss);
    words += text;
  }
  return words;
}

Json jsonOf(const LinkMeter::Reading& reading) {
  return Json::object({{"seconds", reading.seconds},
                       {"pictures", reading.pictures},
                       {"bytes", reading.bytes},
                       {"pictures_per_second", reading.picturesPerSecond()},
                       {"age", reading.mean_age},
                       {"worst_age", reading.worst_age},
                       {"loss", reading.loss},
                       {"longest_gap", reading.longest_gap}});
}

std::vector<Command> cameraCommands() {
  return {
      {"picture",
       "",
       "takes a picture with the robot's camera",
       "Without -o, the file gets a name with the time. It replaces nothing but JPEGs. `-o -` writes the picture to "
       "the standard output. A server of version 1 has only pictures of 208x160, and no settings of the camera.",
       {{"picture -o aibo.jpg", "saves aibo.jpg"},
        {"picture -q 95 --white-balance indoor", "a better picture in the light of lamps"},
        {"picture -o - | feh -", "shows it"}},
       picture,
       withCameraOptions({{"output,o", "FILE", "", "file to write; - is the standard output"}})},
      {"watch",
       "",
       "streams pictures and shows the link's quality once a second",
       "It ends at Ctrl-C, or after --seconds. The age of a picture is the time since the camera's image, "
       "minus the shortest time that any picture took; loss is the share of the camera's images that did not come. A "
       "server of version 1 reports neither. After a lost connection, it connects again. With --json, each second is a "
       "document in a line of "
       "its own.",
       {{"watch", "pictures a second, data rate, age, loss"},
        {"watch --play | ffplay -f mjpeg -i -", "shows the stream; or: | mpv -"},
        {"watch --play | ffmpeg -f mjpeg -i - -c copy %06d.jpg", "saves each picture in a file"}},
       watch,
       withCameraOptions(
           {{"seconds", "S", "0", "how long to watch; 0: until Ctrl-C"},
            {"play", "", "",
             "writes the pictures (MJPEG) to the standard output, and the figures to the standard error output"},
            {"every", "N", "1", "every n-th image of the camera"}})}};
}

}  // namespace aibo_driver::command_line
