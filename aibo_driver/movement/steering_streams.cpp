#include "movement/steering_streams.h"

#include <utility>

namespace aibo_driver::movement {

std::string SteeringStreams::receive(const Order& order, bool is_zero, SteadyTime now) {
  for (auto stream = streams_.begin(); stream != streams_.end();) {
    const bool has_ended = order.received - stream->second.last >= kPause;
    stream = has_ended ? streams_.erase(stream) : std::next(stream);
  }
  if (is_zero) {
    streams_.erase(order.source);
    interruptOthers(order.source);
    return "";
  }
  Stream& stream = streams_.try_emplace(order.source, Stream{order.received, {}, "", "", {}}).first->second;
  stream.last = now;  // of what waits while this process is held up, only the receipt is long ago
  if (!stream.interrupted_by.empty()) {
    stream.rival = std::exchange(stream.interrupted_by, "");
    stream.rivalled = order.received;
  }
  if (stream.began <= overruled_) {
    return overruled_by_;
  }
  interruptOthers(order.source);
  return "";
}

void SteeringStreams::interruptOthers(const std::string& node) {
  for (auto& [other, stream] : streams_) {
    if (other != node) {
      stream.interrupted_by = node;
    }
  }
}

void SteeringStreams::overrule(SteadyTime now, const std::string& what) {
  overruled_ = now;
  overruled_by_ = what;
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
