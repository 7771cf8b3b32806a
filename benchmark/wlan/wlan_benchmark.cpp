// Measures the stream over an emulated 802.11b link: pictures a second and their age with each transport, at several
// rates and losses, and the time until the next picture after an outage. Beside it plain TCP over the same link, with
// the same losses: a server that sends every picture, and a reader.
//
//   wlan_benchmark [--rates N...] [--losses N...] [--outages N...] [--rounds N] [--seconds N] [--parallel N]
//                  [--plot-data FILE]
//
// Needs root and /dev/net/tun. Run it at real-time priority (chrt), so that the emulated air keeps its time.
#include <algorithm>
#include <atomic>
#include <boost/program_options.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "figures.h"
#include "radio/network_host.h"
#include "radio/radio_trial.h"
#include "support/program.h"
#include "wlan/plain_stream.h"

namespace wlan_benchmark {
namespace {

namespace po = boost::program_options;
using benchmark_figures::Mark;
using benchmark_figures::Rounds;
using fault_bench::Result;
using fault_bench::Trial;
using std::chrono::milliseconds;

constexpr int kSkipped = 77;

enum class Way { kTcp, kUdp, kPlain };
constexpr Way kWays[] = {Way::kTcp, Way::kUdp, Way::kPlain};

const char* nameOf(Way way) {
  switch (way) {
    case Way::kTcp:
      return "TCP";
    case Way::kUdp:
      return "UDP";
    default:
      return "plain TCP";
  }
}

struct Options {
  std::vector<double> rates;    // Mbit/s
  std::vector<double> losses;   // %
  std::vector<double> outages;  // s
  int rounds = 0;
  int seconds = 0;
  std::size_t parallel = 0;
  std::string plot_data;
};

/// One link, in all ways, in all rounds.
struct Link {
  std::string title;
  double rate = 11;
  double loss = 0;
  double outage = 0;                           // 0: none
  std::map<Way, std::vector<Result>> results;  // in the order of the rounds
};

Trial trialOn(const Link& link, const Options& options, int round) {
  const auto seed = static_cast<std::uint32_t>(round + 1);
  return link.outage > 0
             ? fault_bench::outageTrial(milliseconds(std::lround(1e3 * link.outage)), seed)
             : fault_bench::lossTrial(1e6 * link.rate, link.loss / 100, seed, milliseconds(1000 * options.seconds));
}

Result measure(const Trial& trial, Way way) {
  using aibo_client::PictureTransport;
  const PictureTransport transport = way == Way::kUdp ? PictureTransport::kUdp : PictureTransport::kTcp;
  return way == Way::kPlain ? runPlainStream(trial) : fault_bench::run(by(transport, trial));
}

std::string textOf(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

std::deque<Link> makeLinks(const Options& options) {
  std::deque<Link> links;
  for (const double rate : options.rates) {
    for (const double loss : options.losses) {
      links.push_back({textOf(rate) + " Mbit/s, " + textOf(loss) + " % loss", rate, loss, 0, {}});
    }
  }
  for (const double outage : options.outages) {
    links.push_back({"11 Mbit/s, outage of " + textOf(outage) + " s", 11, 0, outage, {}});
  }
  return links;
}

/// Runs everything, several at a time.
void measureAll(std::deque<Link>& links, const Options& options) {
  std::vector<std::function<void()>> jobs;
  for (auto link = links.rbegin(); link != links.rend(); ++link) {  // outages last longest: begin with them
    for (int round = 0; round < options.rounds; ++round) {
      for (const Way way : kWays) {
        std::vector<Result>& results = link->results[way];
        results.resize(static_cast<std::size_t>(options.rounds));
        Result* const result = &results[static_cast<std::size_t>(round)];
        jobs.emplace_back(
            [&options, link = &*link, round, way, result] { *result = measure(trialOn(*link, options, round), way); });
      }
    }
  }
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> workers;
  std::vector<std::exception_ptr> problems(options.parallel);
  for (std::size_t worker = 0; worker < options.parallel; ++worker) {
    workers.emplace_back([&, worker] {
      try {
        for (std::size_t job; (job = next++) < jobs.size();) {
          jobs[job]();
        }
      } catch (...) {
        problems[worker] = std::current_exception();
      }
    });
  }
  for (std::thread& worker : workers) {
    worker.join();
  }
  for (const std::exception_ptr& problem : problems) {
    if (problem) {
      std::rethrow_exception(problem);
    }
  }
}

/// Prints a figure of all ways, each beside plain TCP.
void print(const Link& link, const std::string& what, const std::string& unit,
           const std::function<double(const Result&)>& figure, const Mark& mark = {}) {
  const auto rounds = [&](Way way) {
    Rounds values;
    for (const Result& result : link.results.at(way)) {
      values.push_back(figure(result));
    }
    return values;
  };
  for (const Way way : {Way::kTcp, Way::kUdp}) {
    benchmark_figures::print(link.title + ", " + nameOf(way) + ": " + what, unit, rounds(way),
                             {nameOf(Way::kPlain), rounds(Way::kPlain)}, mark);
  }
}

/// At 11 Mbit/s, pictures a second that a good stream has at this loss; 0 if there is no mark.
double fewestPictures(const Link& link) {
  const std::map<double, double> marks = {{0, 29.5}, {1, 29}, {5, 28}};
  const auto mark = marks.find(link.loss);
  return link.rate == 11 && mark != marks.end() ? mark->second : 0;
}

void report(const Link& link) {
  if (link.outage > 0) {
    print(
        link, "until the next picture", "ms",
        [](const Result& result) { return result.recovery < 0 ? 1e6 : result.recovery; },
        benchmark_figures::ofValue(benchmark_figures::atMost(500)));  // 300 of them are for the old connection
    return;
  }
  const double fewest = fewestPictures(link);
  const auto age = [](double part) {
    return [part](const Result& result) { return fault_bench::quantile(result.ages, part); };
  };
  print(
      link, "pictures a second", "/s", [](const Result& result) { return result.pictures_per_second; },
      fewest > 0 ? benchmark_figures::ofValue(benchmark_figures::atLeast(fewest)) : Mark{});
  print(link, "age p50", "ms", age(0.5));
  print(link, "age p99", "ms", age(0.99),
        fewest > 0 ? benchmark_figures::ofValue(benchmark_figures::atMost(250)) : Mark{});
  print(link, "age max", "ms", age(1));
}

/// Way, outage in s, time in s, age in ms: a line for each picture of the first round.
void writePlotData(const std::deque<Link>& links, const std::string& path) {
  std::ofstream file(path);
  for (const Link& link : links) {
    if (link.outage == 0) {
      continue;
    }
    for (const Way way : kWays) {
      for (const Result::Delivery& delivery : link.results.at(way).front().deliveries) {
        file << nameOf(way) << ',' << link.outage << ',' << delivery.time << ',' << delivery.age << '\n';
      }
    }
  }
  if (!file.flush()) {
    throw std::runtime_error("cannot write " + path);
  }
}

po::options_description describe(Options* options) {
  po::options_description description("Options", 120);
  // clang-format off
  description.add_options()
    ("rates", po::value(&options->rates)->multitoken()->default_value({11, 5.5, 2, 1}, "11 5.5 2 1"), "Mbit/s")
    ("losses", po::value(&options->losses)->multitoken()->default_value({0, 1, 5, 10}, "0 1 5 10"), "lost packets, in percent")
    ("outages", po::value(&options->outages)->multitoken()->default_value({1, 3, 10}, "1 3 10"), "in seconds, at 11 Mbit/s")
    ("rounds", po::value(&options->rounds)->default_value(3), "each with other losses")
    ("seconds", po::value(&options->seconds)->default_value(5), "how long each link is measured in a round")
    ("parallel", po::value(&options->parallel)->default_value(6), "links at a time")
    ("plot-data", po::value(&options->plot_data), "file for the ages of pictures around the outages");
  // clang-format on
  return description;
}

void run(const Options& options) {
  if (options.rounds < 1 || options.seconds < 1 || options.parallel < 1) {
    throw po::error("rounds, seconds and parallel must be at least 1");
  }
  std::deque<Link> links = makeLinks(options);
  measureAll(links, options);
  for (const Link& link : links) {
    report(link);
  }
  if (!options.plot_data.empty()) {
    writePlotData(links, options.plot_data);
  }
}

}  // namespace
}  // namespace wlan_benchmark

int main(int argc, char** argv) {
  wlan_benchmark::Options options;
  return test_support::runProgram(argc, argv, "Measures the stream over an emulated 802.11b link. Needs root.",
                                  wlan_benchmark::describe(&options), [&] {
                                    try {
                                      wlan_benchmark::run(options);
                                    } catch (const fault_bench::NoNetworkHosts& problem) {
                                      std::cerr << "Skipped: " << problem.what() << "\n";
                                      return wlan_benchmark::kSkipped;
                                    }
                                    return EXIT_SUCCESS;
                                  });
}
