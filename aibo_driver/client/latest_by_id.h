/// @file latest_by_id.h
#ifndef AIBO_DRIVER_CLIENT_LATEST_BY_ID_H
#define AIBO_DRIVER_CLIENT_LATEST_BY_ID_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace aibo_driver {

/// A queue of what the parts of the body were told and has not been sent yet: each part once, with the latest it was
/// told, in the place of what it was told first. So it never grows without end, and nothing waits for ever.
/// @tparam Item has an `id`
template <typename Item>
class LatestById {
 public:
  bool empty() const { return items_.empty(); }

  /// From the oldest on.
  const std::vector<Item>& items() const { return items_; }

  void add(const std::vector<Item>& newer) {
    for (const Item& item : newer) {
      const auto older =
          std::find_if(items_.begin(), items_.end(), [&item](const Item& each) { return each.id == item.id; });
      if (older == items_.end()) {
        items_.push_back(item);
      } else {
        *older = item;
      }
    }
  }

  /// Takes the oldest, at most so many.
  std::vector<Item> take(std::size_t most) {
    const auto end = items_.begin() + static_cast<std::ptrdiff_t>(std::min(most, items_.size()));
    std::vector<Item> taken(items_.begin(), end);
    items_.erase(items_.begin(), end);
    return taken;
  }

 private:
  std::vector<Item> items_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_LATEST_BY_ID_H
