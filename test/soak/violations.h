/// @file violations.h
#ifndef TEST_SOAK_VIOLATIONS_H
#define TEST_SOAK_VIOLATIONS_H

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace soak {

/// What was not as it has to be. Prints each at once. Any thread.
class Violations {
 public:
  /// What goes on from now on; printed with what is wrong meanwhile.
  void setScene(const std::string& scene);

  void add(const std::string& violation);

  std::size_t count() const;

  /// Violations in such a scene.
  std::size_t countIn(const std::string& scene) const;

 private:
  mutable std::mutex mutex_;
  std::string scene_;
  std::map<std::string, std::size_t> by_scene_;
  std::size_t count_ = 0;
};

}  // namespace soak

#endif  // TEST_SOAK_VIOLATIONS_H
