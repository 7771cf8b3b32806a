/// @file robot.h
#ifndef AIBO_DRIVER_COMMAND_LINE_ROBOT_H
#define AIBO_DRIVER_COMMAND_LINE_ROBOT_H

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "command_line/output.h"
#include "robot_model/robot_model.h"
#include "robot_time/robot_clock.h"
#include "system/event.h"

namespace aibo_driver::command_line {

/// Thrown if a command was carried out but did not succeed.
class FailedException : public aibo_client::Exception {
 public:
  using Exception::Exception;
};

/// The address of a robot.
struct RobotAddress {
  std::string host = "127.0.0.1";
  bool host_is_given = false;
  int port = 54321;
  std::chrono::milliseconds timeout{5000};  ///< how long to wait for the connection
};

/// A picture, and when it was complete.
struct ArrivedPicture {
  aibo_client::PicturePtr picture;
  std::chrono::steady_clock::time_point time;
  double age = 0;  ///< s, how much older the picture is than the freshest one; 0 if this is not known
};

/// The data that a robot has sent so far.
struct Received {
  aibo_client::ConnectionStatus status;
  int failures = 0;                                   ///< how many attempts and connections have ended
  std::map<int, aibo_client::JointReading> joints;    ///< the latest readings, by identifier
  std::map<int, double> sensors;                      ///< the latest values, by identifier
  std::map<int, double> accepted_joints;              ///< positions in rad, by the joint's identifier
  std::optional<aibo_client::WalkVelocity> velocity;  ///< the latest velocity of the walk that is not 0
  std::optional<std::string> refusal;                 ///< why an order without a waiting call was refused
  std::optional<aibo_client::ActivityEnd> end;        ///< how the command's order has ended; empty before
  std::deque<ArrivedPicture> pictures;                ///< the newest kMostPictures that nobody has taken yet
  std::deque<aibo_client::HeardSound> sounds;         ///< the newest kMostSounds that nobody has taken yet
  std::uint64_t lost_pictures = 0;                    ///< pictures that nobody took in time
};

/// The robot that a command is for. The class lets a command wait for the client's callbacks and for Ctrl-C.
///
/// Only one thread may use an object of this class.
class Robot {
 public:
  static constexpr std::size_t kMostPictures = 64;
  static constexpr std::size_t kMostSounds = 256;             ///< about 4 s
  static constexpr int kTelemetryPeriod = 4;                  ///< in frames
  static constexpr std::uint64_t kOrder = 1;                  ///< the number of a command's order
  static constexpr std::chrono::seconds kMeasureTimeout{3};   ///< a version 1 server measures one value after the other
  static constexpr std::chrono::milliseconds kTimeout{2000};  ///< for a request that is answered at once

  /// Whether a lost connection ends the waiting. The client reconnects in any case.
  enum class Loss { kFails, kIsTolerated };

  /// @param base all options except for the address
  /// @param on_sound_ended called on the client's thread; may be empty
  Robot(const RobotAddress& address, Output& output, const aibo_client::ClientOptions& base = {},
        std::function<void(const aibo_client::SoundEnd& end)> on_sound_ended = {});
  ~Robot();

  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// Waits for the connection. If the robot turns the client away, it tries again for a second, because the client
  /// before it may be about to leave. Every other fault is reported at once.
  /// @throw NetworkException there is no connection; the message says why and what to check
  /// @throw Interrupted the user pressed Ctrl-C
  void connect();

  aibo_client::RcServerClient& client() { return *client_; }

  /// The robot's design. A version 1 server does not report its design, so we assume an ERS-7.
  const robot_model::RobotModel& model() const;

  /// The terms of a command's orders: the usual time, and kOrder. All velocities of a walk have this number.
  static aibo_client::OrderTerms terms();

  /// True if the robot reports when something has ended.
  bool reportsEnds() const { return received().status.robot.hasCapability("I"); }

  Received received() const;

  /// Returns the pictures that came since the last call.
  std::vector<ArrivedPicture> takePictures();

  /// Returns what was heard since the last call.
  std::deque<aibo_client::HeardSound> takeSounds();

  /// Waits until a condition of the received data is true, but no longer than a certain time.
  /// @return false if the time has passed
  /// @throw NetworkException the connection is lost, and `Loss` does not tolerate that
  /// @throw Interrupted the user pressed Ctrl-C; thrown once, so that a command can still wait for what ends it
  bool waitUntil(const std::function<bool(const Received&)>& done, std::chrono::nanoseconds timeout,
                 Loss loss = Loss::kFails);

  /// Waits like waitUntil() after an order that no call waits for.
  /// @throw CommandException the order was refused
  bool waitUnlessRefused(const std::function<bool(const Received&)>& done, std::chrono::nanoseconds timeout);

  /// Waits until the robot reports the end of the command's order.
  /// @param name the name of what was ordered, for messages
  /// @param seconds the longest time to wait
  /// @return what the robot has said about the end, usually nothing; no value if the order has not ended in this time
  /// @throw FailedException the order ended in another way; the message says so
  /// @throw NetworkException, Interrupted see waitUntil()
  std::optional<std::string> waitForEnd(const std::string& name, double seconds);

  /// Shows the user the client's warnings, and an order's refusal that nobody waited for, since the last call. The
  /// destructor does so, too.
  void showWarnings();

 private:
  aibo_client::Callbacks callbacks();
  template <typename Change>
  void change(const Change& change);
  void noteStatus(const aibo_client::ConnectionStatus& status);
  void notePicture(const aibo_client::PicturePtr& picture);
  void noteTelemetry(const aibo_client::Telemetry& telemetry);
  void noteRefusal(const aibo_client::Refusal& refusal);
  void noteLog(aibo_client::LogLevel level, const std::string& message);
  void checkConnection(const Received& received) const;
  void waitForEvent(std::chrono::steady_clock::time_point deadline);

  const RobotAddress address_;
  Output& output_;
  bool is_interrupted_ = false;
  const std::function<void(const aibo_client::SoundEnd& end)> on_sound_ended_;
  aibo_system::Event changed_;
  mutable std::mutex mutex_;
  Received received_;                                    // guarded by mutex_
  robot_time::RobotClock clock_;                         // guarded by mutex_
  std::deque<std::string> warnings_;                     // the newest kMostWarnings; guarded by mutex_
  std::string last_loss_;                                // why the connection was lost; guarded by mutex_
  std::unique_ptr<aibo_client::RcServerClient> client_;  // last, because its thread uses all members above
};

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_ROBOT_H
