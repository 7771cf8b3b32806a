/// @file plain_stream.h
#ifndef BENCHMARK_WLAN_PLAIN_STREAM_H
#define BENCHMARK_WLAN_PLAIN_STREAM_H

#include "radio/radio_trial.h"

namespace wlan_benchmark {

/// What a stream of JPEGs over TCP is without this project's limits: a server that sends each picture, 30 a second,
/// with sockets as the kernel makes them, and a reader. No picture is left out, and nobody connects again.
/// @param trial its radio and its length count
/// @throw fault_bench::NoNetworkHosts, std::system_error
fault_bench::Result runPlainStream(const fault_bench::Trial& trial);

}  // namespace wlan_benchmark

#endif  // BENCHMARK_WLAN_PLAIN_STREAM_H
