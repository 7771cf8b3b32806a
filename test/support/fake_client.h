/// @file fake_client.h
#ifndef TEST_SUPPORT_FAKE_CLIENT_H
#define TEST_SUPPORT_FAKE_CLIENT_H

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "aibo_driver/rcserver_client.h"

namespace test_support {

/// A client without a robot: writes down what the robot would be told, and answers as a test wants it. Never started.
class FakeClient : public aibo_driver::RcServerClient {
 public:
  using Milliseconds = std::chrono::milliseconds;

  FakeClient() : RcServerClient(aibo_driver::ClientOptions(), Callbacks()) {}

  std::vector<std::string> told;              ///< requests in short, such as "play NOD.MTN 2"
  std::string problem;                        ///< unless empty, every request throws a NetworkException with this text
  std::uint64_t connections = 1;              ///< made so far
  aibo_driver::ConnectionStatus present;      ///< for status()
  aibo_driver::MotorsAndPosture state;        ///< for motorsAndPosture()
  bool can_hold = true;                       ///< false: hold() is refused, as by version 1
  bool motors_work = true;                    ///< false: the motors stay as they are not wanted
  std::vector<std::string> motions;           ///< on the robot's memory stick
  std::string motion_changes;                 ///< what the robot says that it plays differently
  aibo_driver::PicturePtr picture;            ///< for takePicture() and fetchPicture()
  int stream_quality = 0;                     ///< of the stream that the picture is from
  std::vector<aibo_driver::LedCommand> leds;  ///< of the last command

  void setStreaming(bool on) override { tell(on ? "stream" : "no stream"); }
  void setJpegQuality(int quality) override { tell("quality " + std::to_string(quality)); }
  int jpegQuality() const override { return 85; }
  void setStreamFormat(const aibo_driver::StreamFormat& format) override {
    tell("format " + std::to_string(static_cast<int>(format.resolution)) + " " +
         std::to_string(format.every_nth_image));
  }
  void setPictureTransport(aibo_driver::PictureTransport transport) override {
    tell(transport == aibo_driver::PictureTransport::kUdp ? "udp" : "tcp");
  }
  void setCameraSettings(const aibo_driver::CameraSettings& settings) override {
    tell("camera " + std::to_string(settings.white_balance) + " " + std::to_string(settings.gain) + " " +
         std::to_string(settings.shutter_speed) + (settings.auto_exposure ? " exposure" : "") +
         (settings.auto_white_balance ? " balance" : ""));
  }
  void setColorDetection(const aibo_driver::ColorDetection& detection) override {
    tell(detection.on ? "colors " + std::to_string(detection.every_nth_image) + (detection.with_mask ? " mask" : "")
                      : "no colors");
  }
  void setColorTable(int channel, aibo_driver::ColorTablePtr table) override {
    tell("table " + std::to_string(channel) + " " + (table ? table->name : "none"));
  }
  aibo_driver::PicturePtr takePicture(int quality, Milliseconds, int* quality_of_stream,
                                      std::optional<aibo_driver::Resolution> resolution) override {
    tell("picture " + std::to_string(quality) +
         (resolution ? " of resolution " + std::to_string(static_cast<int>(*resolution)) : ""));
    *quality_of_stream = stream_quality;
    return picture;
  }
  void commandJoints(const std::vector<aibo_driver::JointTarget>& targets, Milliseconds duration,
                     const aibo_driver::OrderTerms&) override {
    std::string text = "J";
    for (const aibo_driver::JointTarget& target : targets) {
      text += " " + std::to_string(target.id) + ":" + number(target.position);
    }
    tell(text + " in " + std::to_string(duration.count()));
  }
  void setJointSpeedLimits(const std::vector<aibo_driver::JointSpeedLimit>& limits) override {
    for (const aibo_driver::JointSpeedLimit& limit : limits) {
      tell("V " + std::to_string(limit.id) + ":" + number(limit.speed));
    }
  }
  bool setMotors(bool on, Milliseconds) override {
    tell(on ? "motors on" : "motors off");
    return on == motors_work;
  }
  void hold(const std::vector<int>& joints, Milliseconds) override {
    if (!can_hold) {
      throw aibo_driver::CommandException("it has no request to hold joints");
    }
    std::string text = "hold";
    for (const int joint : joints) {
      text += " " + std::to_string(joint);
    }
    tell(text);
  }
  void steer(const aibo_driver::WalkVelocity& velocity, const aibo_driver::OrderTerms&) override {
    tell("steer " + number(velocity.forward) + " " + number(velocity.left) + " " + number(velocity.turn));
  }
  void takePosture(aibo_driver::Posture posture, Milliseconds, const aibo_driver::OrderTerms&) override {
    constexpr const char* kNames[] = {"stand", "sit", "rest"};
    tell(kNames[static_cast<int>(posture)]);
  }
  void commandLeds(const std::vector<aibo_driver::LedCommand>& commands) override {
    tell("LEDs");
    leds = commands;
  }
  void commandEars(bool left, bool right) override {
    tell(std::string("ears ") + (left ? "1" : "0") + (right ? "1" : "0"));
  }
  std::string playMotion(const std::string& name, int repetitions, Milliseconds,
                         const aibo_driver::OrderTerms&) override {
    tell("play " + name + " " + std::to_string(repetitions));
    return motion_changes;
  }
  void stopMotion(const std::string& name, Milliseconds) override { tell("stop " + name); }
  void uploadMotion(const std::string& name, const std::vector<std::uint8_t>& content, Milliseconds) override {
    tell("upload " + name + " " + std::to_string(content.size()));
  }
  void deleteMotion(const std::string& name, Milliseconds) override { tell("delete " + name); }
  std::vector<std::string> listMotions(Milliseconds) override {
    tell("list");
    return motions;
  }
  std::string takePictureOnRobot(int quality, Milliseconds) override {
    tell("picture on robot " + std::to_string(quality));
    return "AIBO0001.JPG";
  }
  std::vector<std::string> listPictures(Milliseconds) override {
    tell("list pictures");
    return {"AIBO0001.JPG", "MINE.JPG"};
  }
  std::vector<std::uint8_t> fetchPicture(const std::string& name, Milliseconds) override {
    tell("fetch " + name);
    return picture->jpeg;
  }
  void deletePicture(const std::string& name, Milliseconds) override { tell("delete " + name); }
  void shutDownRobot(Milliseconds) override { tell("shut down"); }
  void rebootRobot(Milliseconds) override { tell("reboot"); }
  aibo_driver::MotorsAndPosture motorsAndPosture() const override { return state; }
  aibo_driver::ConnectionStatus status() const override { return present; }
  aibo_driver::ClientStatistics statistics() const override {
    aibo_driver::ClientStatistics statistics;
    statistics.connections = connections;
    return statistics;
  }

 private:
  void tell(const std::string& request) {
    if (!problem.empty()) {
      throw aibo_driver::NetworkException(problem);
    }
    told.push_back(request);
  }

  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.2f", value);
    return text;
  }
};

}  // namespace test_support

#endif  // TEST_SUPPORT_FAKE_CLIENT_H
