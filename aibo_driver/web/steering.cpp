#include "web/steering.h"

#include <utility>

namespace aibo_driver::web {

bool Steering::hold(Page page, bool walks, TimePoint now) {
  if (page_.value_or(page) != page) {
    return false;
  }
  page_ = page;
  last_ = now;
  walks_ = walks_ || walks;
  return true;
}

bool Steering::letGo(Page page) {
  if (page_ != page) {
    return false;
  }
  page_.reset();
  return std::exchange(walks_, false);
}

bool Steering::expire(TimePoint now) {
  return page_ && now >= end() && letGo(*page_);
}

}  // namespace aibo_driver::web
