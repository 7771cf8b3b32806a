/// @file campaign.cpp
/// Tries every fault many times, and prints the results.

#include <malloc.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <boost/program_options.hpp>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <sstream>
#include <thread>

#include "campaign/experiment.h"
#include "support/program.h"
#include "support/resources.h"

namespace fault_bench {
namespace {

namespace po = boost::program_options;

// More simulated robots than this cannot answer in time on a busy computer or under a sanitizer.
constexpr unsigned kAtOnceInShort = 4;

struct Options {
  unsigned seed = 1;
  std::vector<std::string> only{};
  int trial = -1;
  double percent = 0;  // 0 = as --help says
  bool short_form = false;
  bool list = false;
};

/// The result of one row.
struct Result {
  unsigned tried = 0;
  unsigned violations = 0;
  unsigned excused = 0;
  std::vector<double> recoveries{};  // ms
};

/// True if the client left out stale pictures more often than it can be held up on an otherwise idle computer.
bool hasTooManyExcuses(const Result& result) {
  return result.excused > std::max(1U, result.tried / 100);
}

double quantile(const std::vector<double>& sorted, double part) {
  const auto index = static_cast<std::size_t>(part * static_cast<double>(sorted.size()));
  return sorted.empty() ? 0 : sorted[std::min(index, sorted.size() - 1)];
}

class RowRun {
 public:
  RowRun(const Row& row, const Options& options) : row_(row), options_(options) {}

  Result run() {
    if (options_.trial >= 0) {
      const auto trial = static_cast<unsigned>(options_.trial);
      const auto experiment = row_.make(trial % row_.at_once);
      tryOne(experiment.get(), trial);
    } else {
      runAll();
    }
    std::sort(result_.recoveries.begin(), result_.recoveries.end());
    return result_;
  }

 private:
  void runAll() {
    const auto part = static_cast<unsigned>(static_cast<double>(row_.trials) * options_.percent / 100);
    const unsigned trials = std::max(1U, part);
    std::vector<std::unique_ptr<Experiment>> experiments;
    const unsigned at_once = options_.short_form ? std::min(row_.at_once, kAtOnceInShort) : row_.at_once;
    for (unsigned i = 0; i < std::min(at_once, trials); ++i) {
      experiments.push_back(row_.make(i));
    }
    // The first trials still fill caches, such as the pools of the allocator. That is not a leak.
    const unsigned warm_up = trials / 5;
    runPart(experiments, 0, warm_up);
    const Resources before = Resources::settled();
    runPart(experiments, warm_up, trials);
    if (const std::string leak = before.growth(options_.short_form); warm_up > 0 && !leak.empty()) {
      complain("all trials together", {"I6: " + leak});
    }
  }

  void runPart(const std::vector<std::unique_ptr<Experiment>>& experiments, unsigned begin, unsigned end) {
    std::vector<std::thread> threads;
    const auto count = static_cast<unsigned>(experiments.size());
    for (unsigned i = 0; i < count; ++i) {
      threads.emplace_back([&, i] {
        for (unsigned trial = begin + (i + count - begin % count) % count; trial < end; trial += count) {
          tryOne(experiments[i].get(), trial);
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
    Outcome outcome = experiment->run(trial, random);
    if (options_.short_form) {
      // Times mean nothing on a busy computer.
      outcome.violations.erase(std::remove_if(outcome.violations.begin(), outcome.violations.end(),
                                              [](const std::string& each) { return each[0] == 'M'; }),
                               outcome.violations.end());
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    ++result_.tried;
    result_.excused += outcome.excused ? 1 : 0;
    if (outcome.recovery) {
      result_.recoveries.push_back(outcome.recovery->count());
    }
    if (!outcome.violations.empty()) {
      complain("to repeat: --seed " + std::to_string(options_.seed) + " --only " + row_.id + " --trial " +
                   std::to_string(trial),
               outcome.violations);
    }
  }

  void complain(const std::string& where, const std::vector<std::string>& violations) {
    ++result_.violations;
    for (const std::string& each : violations) {
      std::printf("  %s: %s (%s)\n", row_.id.c_str(), each.c_str(), where.c_str());
    }
    std::fflush(stdout);
  }

  const Row row_;
  const Options options_;
  std::mutex mutex_;
  Result result_;
};

void printHead() {
  std::printf("%-14s %-52s %7s %10s %7s %9s %9s %9s %9s\n", "fault", "", "tried", "violations", "excused", "p50 ms",
              "p99 ms", "worst ms", "mark ms");
}

/// @return the row's violations, with missed marks
unsigned print(const Row& row, const Result& result, bool short_form) {
  const double p99 = quantile(result.recoveries, 0.99);
  const bool late = !short_form && row.recovery_mark.count() > 0 && p99 > row.recovery_mark.count();
  const bool excuses = !short_form && hasTooManyExcuses(result);
  std::printf("%-14s %-52s %7u %10u %7u ", row.id.c_str(), row.title.c_str(), result.tried, result.violations,
              result.excused);
  if (result.recoveries.empty()) {
    std::printf("%9s %9s %9s ", "-", "-", "-");
  } else {
    std::printf("%9.1f %9.1f %9.1f ", quantile(result.recoveries, 0.5), p99, result.recoveries.back());
  }
  if (row.recovery_mark.count() > 0) {
    std::printf("%9.0f", row.recovery_mark.count());
  } else {
    std::printf("%9s", "-");
  }
  std::printf("%s%s\n", late ? "  TOO LATE" : "", excuses ? "  TOO MANY EXCUSED" : "");
  std::fflush(stdout);
  return result.violations + (late ? 1 : 0) + (excuses ? 1 : 0);
}

po::options_description describe(Options* options) {
  po::options_description description("Options", 110);
  // clang-format off
  description.add_options()
    ("list", po::bool_switch(&options->list), "list all faults")
    ("seed", po::value(&options->seed)->default_value(1), "seed of all random choices")
    ("only", po::value(&options->only)->composing(), "try only this row of the table, such as F2; may be repeated")
    ("trial", po::value(&options->trial), "try only the fault with this number; needs --only with one row")
    ("percent", po::value(&options->percent), "share of all faults to try (default: 100, with --short 1)")
    ("short", po::bool_switch(&options->short_form), "without time limits: for a busy computer");
  // clang-format on
  return description;
}

bool isWanted(const Row& row, const Options& options) {
  return options.only.empty() || std::find(options.only.begin(), options.only.end(), row.id) != options.only.end();
}

/// @throw po::error an option has an impossible value
void checkOptions(const Options& options) {
  std::set<std::string> known;
  for (const Row& row : allRows()) {
    known.insert(row.id);
  }
  for (const std::string& id : options.only) {
    if (known.count(id) == 0) {
      throw po::error("there is no fault '" + id + "'; --list prints all");
    }
  }
  if (options.trial >= 0 && options.only.size() != 1) {
    throw po::error("'--trial' needs '--only' with one fault");
  }
}

int runCampaign(const Options& options) {
  unsigned tried = 0;
  unsigned violations = 0;
  printHead();
  for (const Row& row : allRows()) {
    if (isWanted(row, options)) {
      const Result result = RowRun(row, options).run();
      tried += result.tried;
      violations += print(row, result, options.short_form);
    }
  }
  std::printf("\n%u faults tried with seed %u, %u violations\n", tried, options.seed, violations);
  return violations == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

int listRows() {
  for (const Row& row : allRows()) {
    std::printf("%-14s %-60s %6u\n", row.id.c_str(), row.title.c_str(), row.trials);
  }
  return EXIT_SUCCESS;
}

int run(Options* options) {
  checkOptions(*options);
  if (options->percent == 0) {
    options->percent = options->short_form ? 1 : 100;
  }
  return options->list ? listRows() : runCampaign(*options);
}

}  // namespace

std::vector<Row> allRows() {
  std::vector<Row> rows;
  for (auto& some :
       {clientRows(), pictureRows(), systemRows(), serverRows(), wayRows(), datagramRows(), hostileRows()}) {
    rows.insert(rows.end(), some.begin(), some.end());
  }
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    const auto key = [](const Row& row) { return std::make_pair(std::atoi(row.id.c_str() + 1), row.id); };
    return (a.id[0] == b.id[0]) ? key(a) < key(b) : a.id[0] < b.id[0];
  });
  return rows;
}

}  // namespace fault_bench

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_IGN);
  ::mallopt(M_ARENA_MAX, 1);  // with an arena for each thread, I6 would see memory grow
  fault_bench::Options options;
  return test_support::runProgram(argc, argv,
                                  "Tries every fault between driver and RCServer, and prints the results.\n"
                                  "The exit status is 1 after a violation.",
                                  describe(&options), [&] { return run(&options); });
}
