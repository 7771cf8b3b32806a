#include "movement/steering_streams.h"

namespace aibo_driver::movement {

std::string SteeringStreams::receive(const Order& order, bool is_zero) {
  for (auto stream = streams_.begin(); stream != streams_.end();) {
    const bool has_ended = order.received - stream->second.last >= kPause;
    stream = has_ended ? streams_.erase(stream) : std::next(stream);
  }
  if (is_zero) {
    streams_.erase(order.source);
    return "";
  }
  Stream& stream = streams_[order.source];
  stream.last = order.received;
  return stream.overruled_by;
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

bool SteeringStreams::goesOn(const std::string& node, SteadyTime now) const {
  const auto stream = streams_.find(node);
  return stream != streams_.end() && now - stream->second.last < kPause;
}

}  // namespace aibo_driver::movement
