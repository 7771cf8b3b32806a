/// @file fake_client.h
#ifndef TEST_SUPPORT_FAKE_CLIENT_H
#define TEST_SUPPORT_FAKE_CLIENT_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aibo_client/rcserver_client.h"

namespace test_support {

/// A client without a robot. It records requests to the robot, and answers as a test demands. It is never started.
/// In a program with fake_client.cpp, every RcServerClient has to be one of these.
struct FakeClient : public aibo_client::RcServerClient {
  FakeClient() : RcServerClient(aibo_client::ClientOptions(), {}) {}

  std::uint64_t order() const { return terms.number; }  ///< the number of the last order to move

  aibo_client::OrderTerms terms;  ///< of the last order to move; those of zeros do not count
  std::vector<std::string> told;  ///< requests in short, such as "play NOD.MTN 2"
  std::string problem;            ///< unless empty, every request throws a NetworkException with this text
  std::uint64_t connections = 7;  ///< made so far
  std::map<std::pair<std::uint64_t, int>, double> speed_limits;  ///< by connection and joint; told if they change
  aibo_client::ConnectionStatus present;                         ///< for status()
  aibo_client::MotorsAndPosture state;                           ///< for motorsAndPosture()
  std::function<void()> meanwhile;               ///< called once, when a caller waits for the answer to a request
  bool can_hold = true;                          ///< false: hold() is refused, as by version 1
  bool motors_work = true;                       ///< false: the motors stay as they are not wanted
  std::vector<std::string> motions;              ///< on the robot's memory stick
  std::string motion_changes;                    ///< what the robot says that it plays differently
  aibo_client::PicturePtr picture;               ///< for takePicture() and fetchPicture()
  std::optional<int> stream_quality;             ///< of the stream that the picture is from
  std::chrono::milliseconds timeout{0};          ///< of the last request; 0 if it does not wait for an answer
  std::uint64_t sounds = 40;                     ///< begun so far
  std::size_t room_for_samples = 16384;          ///< that the robot says
  std::vector<std::int16_t> played;              ///< samples that were sent
  std::function<void(bool is_last)> on_samples;  ///< called when samples were sent
};

}  // namespace test_support

#endif  // TEST_SUPPORT_FAKE_CLIENT_H
