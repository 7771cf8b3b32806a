#include "client/argument_checks.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "aibo_client/exceptions.h"
#include "protocol/version2.h"

namespace aibo_client {
namespace {

constexpr double kFullTurn = 2 * 3.14159265358979323846;  // rad
constexpr double kGreatestSpeed = 100;                    // rad/s
constexpr double kGreatestWalkVelocity = 32.767;          // m/s or rad/s; version 2 cannot express more

int idOf(int id) {
  return id;
}

template <typename Part>
int idOf(const Part& part) {
  return part.id;
}

/// @param parts identifiers, or structs that have one
/// @param kind the kind of part: "joint" or "LED"
template <typename Part>
void checkIds(const std::vector<Part>& parts, std::size_t fewest, std::size_t most, const std::string& kind) {
  checkRange("the number of " + kind + "s", static_cast<long long>(parts.size()), static_cast<long long>(fewest),
             static_cast<long long>(most));
  std::set<int> ids;
  for (const Part& part : parts) {
    const int id = idOf(part);
    checkRange("the id of a " + kind, id, 1, 255);
    if (!ids.insert(id).second) {
      throw InvalidArgumentException("the " + kind + " " + std::to_string(id) + " is given twice");
    }
  }
}

void require(bool good, int id, const std::string& problem) {
  if (!good) {
    throw InvalidArgumentException("joint " + std::to_string(id) + ": " + problem);
  }
}

void checkSpeedLimit(int joint, double speed) {
  require(speed > 0 && speed <= kGreatestSpeed, joint,
          "its speed limit is " + std::to_string(speed) + " rad/s, but has to be above 0 and at most 100");
}

}  // namespace

void checkRange(const std::string& name, long long value, long long lowest, long long highest, const char* unit) {
  if (value < lowest || value > highest) {
    throw InvalidArgumentException(name + " is " + std::to_string(value) + unit + ", but has to be " +
                                   std::to_string(lowest) + ".." + std::to_string(highest) + unit);
  }
}

std::string addressText(const std::string& host, int port) {
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return (is_ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

void checkHost(const std::string& host) {
  const bool has_port = std::count(host.begin(), host.end(), ':') == 1;
  in6_addr address;
  const bool is_wrong_ipv6 = host.find(':') != std::string::npos &&
                             ::inet_pton(AF_INET6, host.substr(0, host.find('%')).c_str(), &address) != 1;
  if (host.empty() || has_port || is_wrong_ipv6 || host.find_first_of("/[] \t\n") != std::string::npos) {
    throw InvalidArgumentException("host is '" + host +
                                   "', but has to be the robot's name or address alone, such as 192.168.1.5 or ::1, "
                                   "without a port, scheme, path, bracket or blank");
  }
}

void checkClientOptions(const ClientOptions& options) {
  checkHost(options.host);
  constexpr long long kMinute = 60000;  // ms
  checkRange("port", options.port, 1, 65535);
  checkRange("jpeg_quality", options.jpeg_quality, 1, 100);
  checkRange("protocol_version", options.protocol_version, 0, 1);
  checkRange("connect_timeout", options.connect_timeout.count(), 50, kMinute, " ms");
  checkRange("read_timeout", options.read_timeout.count(), 50, kMinute, " ms");
  checkRange("reconnect_wait_max", options.reconnect_wait_max.count(), 10, kMinute, " ms");
  checkRange("reconnect_wait_min", options.reconnect_wait_min.count(), 10, options.reconnect_wait_max.count(), " ms");
}

void checkJointTargets(const std::vector<JointTarget>& targets, std::chrono::milliseconds duration) {
  checkIds(targets, 1, protocol::version2::MAX_JOINTS, "joint");
  checkRange("duration", duration.count(), 0, 65535, " ms");
  for (const JointTarget& target : targets) {
    if (target.speed != 0) {
      checkSpeedLimit(target.id, target.speed);
    }
    require(std::abs(target.position) <= kFullTurn, target.id,
            "its position is " + std::to_string(target.position) + " rad, but has to be -2 pi..2 pi");
  }
}

void checkJointsToHold(const std::vector<int>& joints) {
  checkIds(joints, 0, protocol::version2::MAX_JOINTS, "joint");
}

void checkJointSpeedLimits(const std::vector<JointSpeedLimit>& limits) {
  checkIds(limits, 1, protocol::version2::MAX_JOINTS, "joint");
  for (const JointSpeedLimit& limit : limits) {
    checkSpeedLimit(limit.id, limit.speed);
  }
}

void checkWalkVelocity(const WalkVelocity& velocity) {
  for (const double value : {velocity.forward, velocity.left, velocity.turn}) {
    if (!(std::abs(value) <= kGreatestWalkVelocity)) {
      throw InvalidArgumentException("the velocity to walk with has a value of " + std::to_string(value) +
                                     ", but each has to be -32.767..32.767 m/s or rad/s");
    }
  }
}

void checkColorTable(const ColorTable& table) {
  for (std::size_t i = 0; i < table.segments.size(); ++i) {
    if (const std::optional<ColorRange>& range = table.segments[i]) {
      const std::string of_segment = " of segment " + std::to_string(i) + " of the colour table";
      checkRange("the highest Cr" + of_segment, range->cr_max, 0, 255);
      checkRange("the highest Cb" + of_segment, range->cb_max, 0, 255);
      checkRange("the lowest Cr" + of_segment, range->cr_min, 0, range->cr_max);
      checkRange("the lowest Cb" + of_segment, range->cb_min, 0, range->cb_max);
    }
  }
}

void checkLedCommands(const std::vector<LedCommand>& leds) {
  checkIds(leds, 1, protocol::version2::MAX_LEDS, "LED");
  for (const LedCommand& led : leds) {
    checkRange("the intensity of LED " + std::to_string(led.id), led.intensity, 0, 255);
  }
}

}  // namespace aibo_client
