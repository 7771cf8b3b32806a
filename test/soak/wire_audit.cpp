#include "wire_audit.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "order_audit.h"
#include "protocol/version2.h"
#include "robot_model/robot_model.h"

namespace soak {

namespace version2 = protocol::version2;

namespace {

constexpr double kMicro = 1e-6;

std::string nameOf(int joint) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel("ERS-7");
  const int index = robot_model::findJointByIdentifier(*model, joint);
  return index == robot_model::NO_JOINT ? std::to_string(joint) : model->joints[index].name;
}

}  // namespace

void WireAudit::hear(std::size_t connection, const std::uint8_t* data, std::size_t size, double time) {
  if (connection > connection_) {
    connection_ = connection;
    negotiation_left_ = protocol::VALUE_REPLY_SIZE;
    frames_.reset();
    orders_.clear();
    measured_.clear();
    done_.clear();
  }
  if (connection < connection_) {
    return;
  }
  const std::size_t skipped = std::min(size, negotiation_left_);
  negotiation_left_ -= skipped;
  for (std::size_t begin = skipped, taken = 0; begin < size; begin += taken) {
    if (frames_.append(data + begin, size - begin, &taken) == version2::FrameReader::FRAME_COMPLETE) {
      takeFrame(time);
    }
  }
}

void WireAudit::takeFrame(double time) {
  const version2::FrameHeader& header = frames_.header();
  const bool is_pushed = header.request_number == 0;
  if (header.kind == version2::replyKind(version2::REQUEST_JOINTS)) {
    takeAcceptedTargets(time);
  } else if (header.kind == version2::TELEMETRY_PUSH && is_pushed) {
    takeMeasurements();
  } else if (header.kind == version2::END_PUSH && is_pushed) {
    takeEnd();
  } else if (!is_pushed && std::string("ieps").find(header.kind) != std::string::npos) {
    orders_.clear();  // a hold, posture, motion or walk may have taken some of their joints
  }
}

void WireAudit::takeAcceptedTargets(double time) {
  version2::JointTargets accepted{};
  version2::decode(frames_.payload(), frames_.header().payload_size, &accepted);
  Positions targets;
  for (int i = 0; i < accepted.count; ++i) {
    const auto& [id, target] = accepted.joints[i];
    targets[id] = target;
    accepted_.push_back({time, nameOf(id), kMicro * target});
    for (auto& order : orders_) {
      order.second.erase(id);
    }
  }
  orders_[frames_.header().request_number] = targets;
}

void WireAudit::takeEnd() {
  version2::EndMessage end{};
  version2::decode(frames_.payload(), frames_.header().payload_size, &end);
  const auto order = orders_.find(end.order);
  if (order != orders_.end() && end.how == version2::END_DONE) {
    done_.push_back({order->second, farthest(order->second)});
  }
  orders_.erase(end.order);
}

// The measurement that the robot has judged by may come just after the end.
void WireAudit::takeMeasurements() {
  version2::Telemetry telemetry{};
  version2::decode(frames_.payload(), frames_.header().payload_size, &telemetry);
  for (int i = 0; i < telemetry.count; ++i) {
    if (telemetry.entries[i].group == version2::GROUP_JOINT) {
      measured_[telemetry.entries[i].id] = telemetry.entries[i].value;
    }
  }
  for (const Done& done : std::exchange(done_, {})) {
    missed_.push_back(kMicro * std::min(done.missed, farthest(done.targets)));
    if (missed_.back() > kMicro * version2::ARRIVED) {
      complain_("joints are done, but one of them is " + std::to_string(missed_.back()) + " rad from its target");
    }
  }
}

int WireAudit::farthest(const Positions& targets) const {
  int farthest = 0;
  for (const auto& [id, target] : targets) {
    const auto found = measured_.find(id);
    const bool is_known = found != measured_.end();
    farthest = std::max(farthest, is_known ? std::abs(found->second - target) : std::numeric_limits<int>::max());
  }
  return farthest;
}

void WireAudit::report() const {
  printFigures("way of a joint that is done to its target, rad", missed_);
}

}  // namespace soak
