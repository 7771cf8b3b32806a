/// @file campaign.cpp
/// Tries every fault many times, and prints the results.

#include <signal.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "campaign/experiment.h"
#include "support/program.h"
#include "support/resources.h"

namespace fault_bench {
namespace {

namespace po = boost::program_options;

struct Options {
  unsigned seed = 1;
  std::vector<std::string> only{};
  int trial = -1;
  double percent = 100;
  bool list = false;
};

/// Tries one row.
class RowRun {
 public:
  RowRun(const Row& row, const Options& options) : row_(row), options_(options) {}

  /// @return the number of violations
  unsigned run() {
    if (options_.trial >= 0) {
      const auto trial = static_cast<unsigned>(options_.trial);
      tryOne(row_.make(trial % row_.at_once).get(), trial);
    } else {
      runAll();
    }
    std::sort(recoveries_.begin(), recoveries_.end());
    std::printf("%-14s %-52s %6u %10u %9.1f %9.1f %9.1f\n", row_.id.c_str(), row_.title.c_str(), tried_, violations_,
                quantile(0.5), quantile(0.99), quantile(1));
    std::fflush(stdout);
    return violations_;
  }

 private:
  void runAll() {
    const unsigned trials = std::max(1U, static_cast<unsigned>(row_.trials * options_.percent / 100));
    std::vector<std::unique_ptr<Experiment>> experiments;
    for (unsigned i = 0; i < row_.at_once; ++i) {
      experiments.push_back(row_.make(i));
    }
    // The first trials still fill caches. That is not a leak.
    const unsigned warm_up = trials / 5;
    runPart(experiments, 0, warm_up);
    const Resources before = Resources::of();
    runPart(experiments, warm_up, trials);
    if (const std::string leak = before.growth(); warm_up > 0 && !leak.empty()) {
      complain("all trials together", {leak});
    }
  }

  void runPart(const std::vector<std::unique_ptr<Experiment>>& experiments, unsigned begin, unsigned end) {
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < experiments.size(); ++i) {
      threads.emplace_back([&, i] {
        for (unsigned trial = begin; trial < end; ++trial) {
          if (trial % experiments.size() == i) {
            tryOne(experiments[i].get(), trial);
          }
        }
      });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
  }

  void tryOne(Experiment* experiment, unsigned trial) {
    std::seed_seq seeds{options_.seed, static_cast<unsigned>(std::hash<std::string>()(row_.id)), trial};
    Random random(seeds);
    Outcome outcome;
    try {
      outcome = experiment->run(trial, random);
    } catch (const std::exception& error) {
      outcome.violations.emplace_back(error.what());
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    ++tried_;
    if (outcome.recovery) {
      recoveries_.push_back(outcome.recovery->count());
    }
    if (!outcome.violations.empty()) {
      complain("to repeat: --seed " + std::to_string(options_.seed) + " --only " + row_.id + " --trial " +
                   std::to_string(trial),
               outcome.violations);
    }
  }

  void complain(const std::string& where, const std::vector<std::string>& violations) {
    ++violations_;
    for (const std::string& each : violations) {
      std::printf("  %s: %s (%s)\n", row_.id.c_str(), each.c_str(), where.c_str());
    }
  }

  /// Of the recovery times; 0 if there are none.
  double quantile(double part) const {
    const auto index = static_cast<std::size_t>(part * static_cast<double>(recoveries_.size()));
    return recoveries_.empty() ? 0 : recoveries_[std::min(index, recoveries_.size() - 1)];
  }

  const Row row_;
  const Options options_;
  std::mutex mutex_;
  unsigned tried_ = 0;
  unsigned violations_ = 0;
  std::vector<double> recoveries_;  // ms
};

std::vector<Row> allRows() {
  std::vector<Row> rows;
  for (const auto& some : {clientRows(), serverRows(), hostileRows()}) {
    rows.insert(rows.end(), some.begin(), some.end());
  }
  return rows;
}

/// @throw po::error an option has an impossible value
std::vector<Row> chosenRows(const Options& options) {
  std::vector<Row> chosen;
  for (const Row& row : allRows()) {
    if (options.only.empty() || std::count(options.only.begin(), options.only.end(), row.id) > 0) {
      chosen.push_back(row);
    }
  }
  if (chosen.size() < options.only.size()) {
    throw po::error("there is no such fault; --list prints all");
  }
  if (options.trial >= 0 && options.only.size() != 1) {
    throw po::error("'--trial' needs '--only' with one fault");
  }
  return chosen;
}

int run(const Options& options) {
  const std::vector<Row> rows = chosenRows(options);
  if (options.list) {
    for (const Row& row : rows) {
      std::printf("%-14s %-60s %6u\n", row.id.c_str(), row.title.c_str(), row.trials);
    }
    return EXIT_SUCCESS;
  }
  std::printf("%-14s %-52s %6s %10s %9s %9s %9s\n", "fault", "", "tried", "violations", "p50 ms", "p99 ms", "worst ms");
  unsigned violations = 0;
  for (const Row& row : rows) {
    violations += RowRun(row, options).run();
  }
  std::printf("\n%u violations with seed %u\n", violations, options.seed);
  return violations == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

po::options_description describe(Options* options) {
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("list", po::bool_switch(&options->list), "list all faults")
    ("seed", po::value(&options->seed)->default_value(1), "seed of all random choices")
    ("only", po::value(&options->only)->composing(), "try only this row of the table, such as picture; may be repeated")
    ("trial", po::value(&options->trial), "try only the fault with this number; needs --only with one row")
    ("percent", po::value(&options->percent)->default_value(100), "share of all faults to try");
  // clang-format on
  return description;
}

}  // namespace
}  // namespace fault_bench

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_IGN);
  fault_bench::Options options;
  return test_support::runProgram(
      argc, argv,
      "Tries every fault between driver and RCServer, and prints the results with the times\n"
      "that recovery took. The exit status is 1 after a violation.",
      describe(&options), [&] { return fault_bench::run(options); });
}
