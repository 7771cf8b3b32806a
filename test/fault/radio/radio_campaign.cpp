/// @file radio_campaign.cpp
/// The client and the real RCServer on two hosts, with an emulated 802.11b link between them: loss, outages, low rates.

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

using aibo_client::PictureTransport;
using std::chrono::milliseconds;

constexpr int kSkipped = 77;  // SKIP_RETURN_CODE of the CTest test

std::vector<Trial> allTrials(std::uint32_t seed) {
  std::vector<Trial> trials;
  for (const double loss : {0.0, 0.01, 0.05}) {
    trials.push_back(lossTrial(11e6, loss, seed, milliseconds(15000)));
  }
  // After a short outage the robot still serves the old connection, over which it gets no answer.
  // After a longer one it has given up the old connection.
  for (const int outage : {1000, 3000, 10000}) {
    trials.push_back(outageTrial(milliseconds(outage), seed));
  }
  for (const double rate : {5.5e6, 2e6, 1e6}) {
    trials.push_back(lossTrial(rate, 0, seed, milliseconds(15000)));
  }
  trials.push_back(trials.back());
  trials.back().has_rival = true;
  return trials;
}

std::vector<Trial> shortTrials(std::uint32_t seed) {
  const Trial lossy = lossTrial(11e6, 0.05, seed, milliseconds(3000));
  return {lossTrial(11e6, 0, seed, milliseconds(2000)), lossy, outageTrial(milliseconds(1000), seed),
          by(PictureTransport::kUdp, lossy)};
}

std::string titleOf(const Trial& trial) {
  const char* const transports[] = {"TCP", "UDP"};
  const auto outage = trial.radio.outages.empty() ? milliseconds(0) : trial.radio.outages[0].length;
  char title[100];
  std::snprintf(title, sizeof title, "%g Mbit/s, loss %g %%, out %g s, %s%s", trial.radio.bits_per_second / 1e6,
                trial.radio.loss * 100, static_cast<double>(outage.count()) / 1e3,
                transports[static_cast<int>(trial.transport)], trial.has_rival ? ", rival" : "");
  return title;
}

bool print(const Trial& trial, const Result& result) {
  std::printf("%-44s %5.1f %7.1f %7.1f %7.1f %9.1f %6llu %10zu\n", titleOf(trial).c_str(), result.pictures_per_second,
              quantile(result.ages, 0.5), quantile(result.ages, 0.99), quantile(result.ages, 1), result.recovery,
              static_cast<unsigned long long>(result.connections), result.violations.size());
  for (const std::string& violation : result.violations) {
    std::printf("  VIOLATION: %s\n", violation.c_str());
  }
  std::fflush(stdout);
  return result.violations.empty();
}

int runAll(const std::vector<Trial>& trials) {
  std::printf("%-44s %5s %7s %7s %7s %9s %6s %10s\n", "", "fps", "p50 ms", "p99 ms", "max ms", "back ms", "conns",
              "violations");
  bool all_well = true;
  for (const Trial& trial : trials) {
    all_well = print(trial, run(trial)) && all_well;
  }
  return all_well ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace fault_bench

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  std::uint32_t seed = 1;
  bool is_short = false;
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("seed", po::value(&seed)->default_value(1), "seed of loss and jitter")
    ("short", po::bool_switch(&is_short), "a few seconds only, for the test run");
  // clang-format on
  return test_support::runProgram(
      argc, argv,
      "Driver and robot over an emulated 802.11b link: how many pictures come, how old they are (from the camera's\n"
      "image to their delivery), and when they come again after an outage. Needs root.",
      description, [&] {
        try {
          return fault_bench::runAll(is_short ? fault_bench::shortTrials(seed) : fault_bench::allTrials(seed));
        } catch (const fault_bench::NoNetworkHosts& problem) {
          std::cout << "Skipped: " << problem.what() << "\n";
          return fault_bench::kSkipped;
        }
      });
}
