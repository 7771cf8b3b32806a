/// @file robot.h
#ifndef AIBO_DRIVER_COMMAND_LINE_ROBOT_H
#define AIBO_DRIVER_COMMAND_LINE_ROBOT_H

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "client/event.h"
#include "command_line/output.h"
#include "robot_model/robot_model.h"

namespace aibo_driver::command_line {

/// How to reach a robot.
struct RobotAddress {
  std::string host = "127.0.0.1";
  bool host_is_given = false;
  int port = 54321;
  std::chrono::milliseconds timeout{5000};  ///< until it is connected
};

/// A picture, and when it was complete.
struct ArrivedPicture {
  PicturePtr picture;
  std::chrono::steady_clock::time_point time;
};

/// What a robot has sent so far.
struct Received {
  ConnectionStatus status;
  int failures = 0;                       ///< attempts and connections that ended, since the beginning
  std::map<int, JointReading> joints;     ///< the latest, by identifier
  std::map<int, double> sensors;          ///< the latest, by identifier
  std::map<int, double> accepted_joints;  ///< rad, by identifier
  std::deque<MotionEnd> ends;             ///< the newest kMostEnds
  std::deque<ArrivedPicture> pictures;    ///< that nobody has taken yet; the newest kMostPictures
  std::uint64_t lost_pictures = 0;        ///< that nobody took in time
};

/// The robot that a command is for. Lets a command wait for what the client calls back, and for Ctrl-C.
///
/// From one thread.
class Robot {
 public:
  static constexpr std::size_t kMostPictures = 64;
  static constexpr std::size_t kMostEnds = 64;
  static constexpr int kTelemetryPeriod = 4;                  ///< frames
  static constexpr std::chrono::seconds kMeasureTimeout{3};   ///< a version 1 server measures one value after the other
  static constexpr std::chrono::milliseconds kTimeout{2000};  ///< of a request that is answered at once

  /// Whether a lost connection ends waiting. It is made again in any case.
  enum class Loss { kFails, kIsTolerated };

  /// @param base options other than the address
  Robot(const RobotAddress& address, Output& output, const ClientOptions& base = {});
  ~Robot();

  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// Waits for the connection. One that is turned away tries for a second, because the client before it may be about to
  /// go; every other fault is reported at once.
  /// @throw NetworkException there is none; the message says why and what to check
  /// @throw Interrupted
  void connect();

  RcServerClient& client() { return *client_; }

  /// The robot's design. A version 1 server does not say it: an ERS-7.
  const robot_model::RobotModel& model() const;

  /// True if it says when something has ended.
  bool reportsEnds() const { return received().status.robot.hasCapability("I"); }

  Received received() const;

  /// The pictures that came since the last call.
  std::vector<ArrivedPicture> takePictures();

  /// Waits until something is true of what was received, or for a time.
  /// @return false if the time has passed
  /// @throw NetworkException the connection is lost, unless that is tolerated
  /// @throw Interrupted
  bool waitUntil(const std::function<bool(const Received&)>& done, std::chrono::nanoseconds timeout,
                 Loss loss = Loss::kFails);

  /// To be called before a request is sent that has no answer of its own. What was refused before, such as a sensor
  /// that an older robot does not have, is not meant by waitUnlessRefused().
  void beginRequest();

  /// waitUntil() after such a request.
  /// @throw CommandException the robot has refused a request
  bool waitUnlessRefused(const std::function<bool(const Received&)>& done, std::chrono::nanoseconds timeout);

  /// Tells the user what the client has warned of since the last call. The destructor does so, too.
  void showWarnings();

 private:
  RcServerClient::Callbacks callbacks();
  template <typename Change>
  void change(const Change& change);
  void noteStatus(const ConnectionStatus& status);
  void notePicture(const PicturePtr& picture);
  void noteTelemetry(const Telemetry& telemetry);
  void noteLog(LogLevel level, const std::string& message);
  void checkConnection(const Received& received) const;
  void waitForEvent(std::chrono::steady_clock::time_point deadline);

  const RobotAddress address_;
  Output& output_;
  Event changed_;
  mutable std::mutex mutex_;
  Received received_;                 // guarded by mutex_
  std::deque<std::string> warnings_;  // the same; the newest kMostWarnings
  std::uint64_t refusals_before_ = 0;
  std::unique_ptr<RcServerClient> client_;  // last: its thread uses all of the above
};

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_ROBOT_H
