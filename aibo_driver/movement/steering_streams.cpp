#include "movement/steering_streams.h"

#include <utility>

namespace aibo_driver::movement {

std::string SteeringStreams::receive(const Order& order, bool is_zero) {
  for (auto stream = streams_.begin(); stream != streams_.end();) {
    const bool has_ended = order.received - stream->second.last >= kPause;
    stream = has_ended ? streams_.erase(stream) : std::next(stream);
  }
  if (is_zero) {
    streams_.erase(order.source);
    interruptOthers(order.source);
    return "";
  }
  Stream& stream = streams_[order.source];
  stream.last = order.received;
  if (!stream.interrupted_by.empty()) {
    stream.rival = std::exchange(stream.interrupted_by, "");
    stream.rivalled = order.received;
  }
  if (stream.overruled_by.empty()) {
    interruptOthers(order.source);
  }
  return stream.overruled_by;
}

void SteeringStreams::interruptOthers(const std::string& node) {
  for (auto& [other, stream] : streams_) {
    if (other != node) {
      stream.interrupted_by = node;
    }
  }
}

void SteeringStreams::overrule(const std::string& what) {
  for (auto& [node, stream] : streams_) {
    stream.overruled_by = what;
  }
}

void SteeringStreams::overrule(const std::string& node, const std::string& what) {
  const auto stream = streams_.find(node);
  if (stream != streams_.end()) {
    stream->second.overruled_by = what;
  }
}

std::string SteeringStreams::rivalOf(const std::string& node, SteadyTime now) const {
  const auto stream = streams_.find(node);
  return stream != streams_.end() && now - stream->second.rivalled < kPause ? stream->second.rival : "";
}

bool SteeringStreams::goesOn(const std::string& node, SteadyTime now) const {
  const auto stream = streams_.find(node);
  return stream != streams_.end() && now - stream->second.last < kPause;
}

}  // namespace aibo_driver::movement
