/// @file counters.h
#ifndef AIBO_DRIVER_CLIENT_COUNTERS_H
#define AIBO_DRIVER_CLIENT_COUNTERS_H

#include <atomic>
#include <cstdint>

#include "aibo_client/status.h"

namespace aibo_client {

/// ClientStatistics that one thread counts while other threads read them.
struct Counters {
  std::atomic<std::uint64_t> connections{0};
  std::atomic<std::uint64_t> failed_attempts{0};
  std::atomic<std::uint64_t> stalls{0};
  std::atomic<std::uint64_t> protocol_errors{0};
  std::atomic<std::uint64_t> pictures{0};
  std::atomic<std::uint64_t> corrupt_pictures{0};
  std::atomic<std::uint64_t> unexpected_pictures{0};
  std::atomic<std::uint64_t> stale_pictures{0};
  std::atomic<std::uint64_t> bytes_received{0};
  std::atomic<std::uint64_t> telemetry{0};
  std::atomic<std::uint64_t> dropped_telemetry{0};
  std::atomic<std::uint64_t> thinned_telemetry{0};
  std::atomic<std::uint64_t> thinned_colors{0};
  std::atomic<std::uint64_t> sounds{0};
  std::atomic<std::uint64_t> sound_gaps{0};
  std::atomic<std::uint64_t> thinned_sounds{0};
  std::atomic<std::uint64_t> impossible_values{0};
  std::atomic<std::uint64_t> refusals{0};
  std::atomic<std::uint64_t> datagrams{0};
  std::atomic<std::uint64_t> lost_datagrams{0};
  std::atomic<std::uint64_t> reordered_datagrams{0};
  std::atomic<std::uint64_t> duplicate_datagrams{0};
  std::atomic<std::uint64_t> bad_datagrams{0};
  std::atomic<std::uint64_t> foreign_datagrams{0};
  std::atomic<std::uint64_t> repaired_datagrams{0};
  std::atomic<std::uint64_t> lost_pictures{0};

  ClientStatistics snapshot() const {
    ClientStatistics result;
    result.connections = connections;
    result.failed_attempts = failed_attempts;
    result.stalls = stalls;
    result.protocol_errors = protocol_errors;
    result.pictures = pictures;
    result.corrupt_pictures = corrupt_pictures;
    result.unexpected_pictures = unexpected_pictures;
    result.stale_pictures = stale_pictures;
    result.bytes_received = bytes_received;
    result.telemetry = telemetry;
    result.dropped_telemetry = dropped_telemetry;
    result.thinned_telemetry = thinned_telemetry;
    result.thinned_colors = thinned_colors;
    result.sounds = sounds;
    result.sound_gaps = sound_gaps;
    result.thinned_sounds = thinned_sounds;
    result.impossible_values = impossible_values;
    result.refusals = refusals;
    result.datagrams = datagrams;
    result.lost_datagrams = lost_datagrams;
    result.reordered_datagrams = reordered_datagrams;
    result.duplicate_datagrams = duplicate_datagrams;
    result.bad_datagrams = bad_datagrams;
    result.foreign_datagrams = foreign_datagrams;
    result.repaired_datagrams = repaired_datagrams;
    result.lost_pictures = lost_pictures;
    return result;
  }
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_COUNTERS_H
