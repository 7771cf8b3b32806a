#include "client/picture_requests.h"

#include <algorithm>

namespace aibo_driver {

PictureRequests::TimePoint PictureRequests::nextDeadline() const {
  TimePoint earliest = TimePoint::max();
  for (const PictureRequest& request : requests_) {
    earliest = std::min(earliest, request.deadline);
  }
  return earliest;
}

void PictureRequests::answerFront(const PicturePtr& picture) {
  requests_.front().answer(picture, 0);
  requests_.pop_front();
}

void PictureRequests::answerFromStream(const PicturePtr& picture, int quality) {
  while (!requests_.empty() && requests_.front().since < picture->first_byte_time) {
    requests_.front().answer(picture, quality);
    requests_.pop_front();
  }
}

void PictureRequests::failFront(CallOutcome outcome, const std::string& problem) {
  requests_.front().fail(outcome, problem);
  requests_.pop_front();
}

void PictureRequests::failAll(CallOutcome outcome, const std::string& problem) {
  while (!requests_.empty()) {
    failFront(outcome, problem);
  }
}

void PictureRequests::expire(TimePoint now, const std::string& remark) {
  const auto first_expired = std::stable_partition(requests_.begin(), requests_.end(),
                                                   [now](const PictureRequest& each) { return each.deadline > now; });
  for (auto request = first_expired; request != requests_.end(); ++request) {
    request->fail(CallOutcome::kTimeout,
                  "no picture within " + std::to_string(request->timeout.count()) + " ms" + remark);
  }
  requests_.erase(first_expired, requests_.end());
}

}  // namespace aibo_driver
