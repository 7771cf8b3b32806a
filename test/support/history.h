/// @file history.h
/// Compares a used object with a new one.
#ifndef TEST_SUPPORT_HISTORY_H
#define TEST_SUPPORT_HISTORY_H

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <string>

namespace test_support {

/// Random choices that are the same with every library.
class Choices {
 public:
  explicit Choices(unsigned seed) : random_(seed) {}

  /// 0..count - 1
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  bool once(int in) { return below(in) == 0; }
  double between(double lowest, double highest) { return lowest + (highest - lowest) * below(1000) / 999; }
  template <typename List>
  auto of(const List& list) {
    return list[static_cast<std::size_t>(below(static_cast<int>(list.size())))];
  }

 private:
  std::mt19937 random_;
};

/// Whatever a Session has been through: when it has become as new, it emits what a new one emits.
///
/// A Session has these members:
///   std::string live(Choices&)  does anything, and says what
///   void renew(int way)         brings it to where it should be as new, in one of several ways
///   std::string perform()       uses everything, and returns all that comes out of it
/// @param ways the number of ways to become as new
template <typename Session>
void expectAsNewAfterAnyHistory(int ways, int histories, int steps) {
  for (int way = 0; way < ways; ++way) {
    Session unused;
    unused.renew(way);
    const std::string expected = unused.perform();
    for (int history = 0; history < histories; ++history) {
      Choices choices(static_cast<unsigned>(1000 * way + history));
      Session used;
      std::string lived;
      for (int i = choices.below(steps) + 1; i > 0; --i) {
        lived += used.live(choices) + "\n";
      }
      used.renew(way);
      ASSERT_EQ(expected, used.perform()) << "after renewal " << way << " and this history:\n" << lived;
    }
  }
}

}  // namespace test_support

#endif  // TEST_SUPPORT_HISTORY_H
