/// @file radio_trial.h
#ifndef TEST_FAULT_RADIO_RADIO_TRIAL_H
#define TEST_FAULT_RADIO_RADIO_TRIAL_H

#include <chrono>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "radio/radio_link.h"

namespace fault_bench {

/// A stream of pictures over an emulated radio link: the client and the real RCServer, on two hosts.
struct Trial {
  RadioOptions radio;
  std::chrono::milliseconds length{15000};
  aibo_client::PictureTransport transport = aibo_client::PictureTransport::kTcp;
  bool has_rival = false;  ///< another client on the same computer asks for the place all the time
};

/// The result of a trial.
struct Result {
  /// A picture that the client has delivered.
  struct Delivery {
    double time;  ///< s, since the beginning of the link
    double age;   ///< ms, from the camera's image to its delivery
  };

  std::vector<Delivery> deliveries;
  double pictures_per_second = 0;  ///< from the first one to the end
  std::vector<double> ages;        ///< ms, sorted: those of the deliveries
  double recovery = -1;            ///< ms, from the end of the last outage to the next picture; -1 = no outage
  std::uint64_t connections = 0;
  std::set<std::string> violations;
};

/// Runs a trial, in real time. Several may run at a time, on threads of their own.
/// @throw NoNetworkHosts
Result run(const Trial& trial);

/// Computes from the deliveries what the result says about them all: rate, ages and recovery.
void summarize(const Trial& trial, Result& result);

/// Over a link that loses packets.
/// @param loss share of them, 0..1
Trial lossTrial(double bits_per_second, double loss, std::uint32_t seed, std::chrono::milliseconds length);

/// Over a link of 11 Mbit/s that is out once, after 2 s.
Trial outageTrial(std::chrono::milliseconds outage, std::uint32_t seed);

/// The same with this transport.
Trial by(aibo_client::PictureTransport transport, Trial trial);

/// The value in a sorted list below which this part of it lies, 0..1; 0 if it is empty.
double quantile(const std::vector<double>& sorted, double part);

}  // namespace fault_bench

#endif  // TEST_FAULT_RADIO_RADIO_TRIAL_H
