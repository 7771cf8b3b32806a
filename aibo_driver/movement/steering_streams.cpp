#include "movement/steering_streams.h"

namespace aibo_driver::movement {

std::string SteeringStreams::receive(const Order& order, bool is_zero, SteadyTime now) {
  for (auto stream = streams_.begin(); stream != streams_.end();) {
    const bool has_ended = order.received - stream->second.last >= kPause;
    stream = has_ended ? streams_.erase(stream) : std::next(stream);
  }
  if (is_zero) {
    streams_.erase(order.source);
    return "";
  }
  Stream& stream = streams_.try_emplace(order.source, Stream{order.received, {}}).first->second;
  stream.last = now;  // the node has not paused if its velocity waited while this process stalled
  return stream.began <= overruled_ ? overruled_by_ : "";
}

void SteeringStreams::overrule(SteadyTime now, const std::string& what) {
  overruled_ = now;
  overruled_by_ = what;
}

bool SteeringStreams::goesOn(const std::string& node, SteadyTime now) const {
  const auto stream = streams_.find(node);
  return stream != streams_.end() && now - stream->second.last < kPause;
}

}  // namespace aibo_driver::movement
