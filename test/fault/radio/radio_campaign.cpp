/// @file radio_campaign.cpp
/// The client and the real RCServer on two hosts, with an emulated 802.11b link between them: loss, outages, low rates.

#include <algorithm>

#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "radio/network_host.h"
#include "radio/radio_trial.h"
#include "support/program.h"

namespace fault_bench {
namespace {

namespace po = boost::program_options;
using aibo_client::PictureTransport;
using std::chrono::milliseconds;

constexpr int kSkipped = 77;  // SKIP_RETURN_CODE of the CTest test

std::vector<Trial> allTrials(std::uint32_t first_seed) {
  std::vector<Trial> trials;
  for (std::uint32_t seed = first_seed; seed < first_seed + 3; ++seed) {
    for (const double loss : {0.0, 0.01, 0.05}) {
      trials.push_back(lossTrial(11e6, loss, seed, milliseconds(15000)));
    }
    // After a short outage the robot still serves the old connection, over which it has heard nothing for long enough.
    // After a longer one it has given up the old connection.
    trials.push_back(outageTrial(milliseconds(1000), seed, milliseconds(400)));
    trials.push_back(outageTrial(milliseconds(3000), seed, milliseconds(400)));
    trials.push_back(outageTrial(milliseconds(10000), seed, milliseconds(400)));
  }
  for (const double rate : {5.5e6, 2e6, 1e6}) {
    trials.push_back(lossTrial(rate, 0, first_seed, milliseconds(15000)));
  }
  return trials;
}

/// The same links with and without adaptive quality and rate.
std::vector<Trial> adaptiveTrials(std::uint32_t first_seed) {
  std::vector<Trial> trials;
  for (const double rate : {1e6, 2e6, 11e6}) {
    for (const double loss : {0.0, 0.01}) {
      for (const bool is_adaptive : {true, false}) {
        Trial trial = lossTrial(rate, loss, first_seed, milliseconds(rate < 2e6 ? 120000 : 30000));
        trial.title += is_adaptive ? ", adaptive" : "";
        trial.max_age = milliseconds(150);
        trial.is_adaptive = is_adaptive;
        trials.push_back(trial);
      }
    }
  }
  return trials;
}

/// On a computer that may be busy.
std::vector<Trial> shortTrials(std::uint32_t seed) {
  std::vector<Trial> trials = {lossTrial(11e6, 0, seed, milliseconds(2000)),
                               lossTrial(11e6, 0.05, seed, milliseconds(3000)),
                               outageTrial(milliseconds(1000), seed, milliseconds(0)),
                               by(PictureTransport::kUdp, lossTrial(11e6, 0.05, seed, milliseconds(3000))),
                               by(PictureTransport::kAuto, lossTrial(11e6, 0.05, seed, milliseconds(3000)))};
  for (Trial& trial : trials) {
    trial.on_busy_computer = true;
  }
  return trials;
}

bool print(const Trial& trial, const Result& result) {
  std::printf("%-40s %5.1f %7.1f %7.1f %7.1f %8.1f ", trial.title.c_str(), result.pictures_per_second,
              quantile(result.ages, 0.5), quantile(result.ages, 0.99), quantile(result.ages, 1), result.longest_gap);
  result.recovery < 0 ? std::printf("%9s", "-") : std::printf("%9.1f", result.recovery);
  std::printf(" %6llu %10zu\n", static_cast<unsigned long long>(result.connections), result.violations.size());
  if (!result.transport_problem.empty()) {
    std::printf("  by TCP in the end: %s\n", result.transport_problem.c_str());
  }
  if (trial.max_age.count() > 0) {
    std::printf("  older than %lld ms for at most %.0f ms; changes:", static_cast<long long>(trial.max_age.count()),
                result.longest_late);
    for (const std::string& change : result.changes) {
      std::printf(" %s", change.c_str());
    }
    std::printf("\n");
  }
  for (const std::string& violation : result.violations) {
    std::printf("  VIOLATION: %s\n", violation.c_str());
  }
  std::fflush(stdout);
  return result.violations.empty();
}

int runAll(const std::vector<Trial>& trials) {
  std::printf("%-40s %5s %7s %7s %7s %8s %9s %6s %10s\n", "", "fps", "p50 ms", "p99 ms", "max ms", "gap ms", "back ms",
              "conns", "violations");
  bool all_well = true;
  for (const Trial& trial : trials) {
    all_well = print(trial, run(trial)) && all_well;
  }
  return all_well ? EXIT_SUCCESS : EXIT_FAILURE;
}

/// Which trials to run. Without a choice, all but the adaptive ones.
struct Choice {
  bool short_form = false;
  bool adaptive = false;
};

std::vector<Trial> chosenTrials(const Choice& choice, std::uint32_t seed) {
  return choice.adaptive ? adaptiveTrials(seed) : choice.short_form ? shortTrials(seed) : allTrials(seed);
}

po::options_description describe(std::uint32_t* seed, Choice* choice) {
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("seed", po::value(seed)->default_value(1), "seed of loss and jitter; the campaign tries this one and the next two")
    ("adaptive", po::bool_switch(&choice->adaptive), "only weak links with and without adaptive quality and rate")
    ("short", po::bool_switch(&choice->short_form), "a few seconds only, for the test run");
  // clang-format on
  return description;
}

}  // namespace
}  // namespace fault_bench

int main(int argc, char** argv) {
  std::uint32_t seed = 1;
  fault_bench::Choice choice;
  return test_support::runProgram(
      argc, argv,
      "Driver and robot over an emulated 802.11b link: how many pictures come, how old they are (from the camera's\n"
      "image to their delivery), and when they come again after an outage. Needs root.",
      fault_bench::describe(&seed, &choice), [&] {
        try {
          return fault_bench::runAll(fault_bench::chosenTrials(choice, seed));
        } catch (const fault_bench::NoNetworkHosts& problem) {
          std::cout << "Skipped: " << problem.what() << "\n";
          return fault_bench::kSkipped;
        }
      });
}
