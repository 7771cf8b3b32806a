/// @file plain_stream.h
#ifndef BENCHMARK_WLAN_PLAIN_STREAM_H
#define BENCHMARK_WLAN_PLAIN_STREAM_H

#include "radio/radio_trial.h"

namespace wlan_benchmark {

/// A stream of JPEGs over TCP without this project's limits: a server that sends 30 pictures a second, with the
/// kernel's default sockets, and a reader. No picture is left out, and the reader never reconnects.
/// @param trial its radio and its length count
/// @throw fault_bench::NoNetworkHosts, std::system_error
fault_bench::Result runPlainStream(const fault_bench::Trial& trial);

}  // namespace wlan_benchmark

#endif  // BENCHMARK_WLAN_PLAIN_STREAM_H
