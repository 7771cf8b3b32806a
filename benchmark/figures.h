/// @file figures.h The output of benchmarks: a line of JSON for each figure. report.py turns these lines into a table.
#ifndef BENCHMARK_FIGURES_H
#define BENCHMARK_FIGURES_H

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace benchmark_figures {

/// A value from each round of a run.
using Rounds = std::vector<double>;

/// What a figure is compared with, in the same run.
struct Comparison {
  std::string with;  ///< a limit or a rival; if empty, the figure is not compared, and the mark is a value, not a ratio
  Rounds rounds{};
};

struct Mark {
  enum class Kind { kNone, kAtMost, kAtLeast };
  Kind kind = Kind::kNone;
  double value = 0;       ///< of the ratio to what it is compared with, or of the figure itself
  bool of_value = false;  ///< of the figure itself, even if it is compared with something
};

inline Mark atMost(double value) {
  return {Mark::Kind::kAtMost, value};
}

inline Mark atLeast(double value) {
  return {Mark::Kind::kAtLeast, value};
}

/// The same for the figure itself, even if it is compared with something.
inline Mark ofValue(Mark mark) {
  mark.of_value = true;
  return mark;
}

inline std::string listOf(const Rounds& rounds) {
  std::string text = "[";
  for (const double value : rounds) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.6g", text.size() > 1 ? ", " : "", value);
    text += number;
  }
  return text + "]";
}

/// Prints a figure to stdout.
/// @param name must not contain quotes or backslashes, like the other texts
inline void print(const std::string& name, const std::string& unit, const Rounds& rounds,
                  const Comparison& comparison = {}, const Mark& mark = {}) {
  std::printf("{\"figure\": \"%s\", \"unit\": \"%s\", \"rounds\": %s", name.c_str(), unit.c_str(),
              listOf(rounds).c_str());
  if (!comparison.with.empty()) {
    std::printf(", \"with\": \"%s\", \"with_rounds\": %s", comparison.with.c_str(), listOf(comparison.rounds).c_str());
  }
  if (mark.kind != Mark::Kind::kNone) {
    std::printf(", \"%s\": %g", mark.kind == Mark::Kind::kAtMost ? "at_most" : "at_least", mark.value);
    std::printf("%s", mark.of_value ? ", \"mark_is_of_value\": true" : "");
  }
  std::printf("}\n");
  std::fflush(stdout);
}

/// The value in the sorted list below which this part of it lies, 0..1.
inline double quantile(std::vector<double> values, double part) {
  if (values.empty()) {
    return 0;
  }
  std::sort(values.begin(), values.end());
  return values[std::min(static_cast<std::size_t>(part * static_cast<double>(values.size())), values.size() - 1)];
}

}  // namespace benchmark_figures

#endif  // BENCHMARK_FIGURES_H
