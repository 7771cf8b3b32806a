/// @file witness.h
#ifndef TEST_FAULT_CAMPAIGN_WITNESS_H
#define TEST_FAULT_CAMPAIGN_WITNESS_H

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "campaign/experiment.h"
#include "support/picture_server.h"

namespace fault_bench {

/// Sees what a client delivers, and knows what it should have been. Must outlive the client, and the server it.
///
/// Of every picture: that it is, byte for byte, one that the server has sent; that it comes once, and none comes after
/// a newer one; that its time of arrival is not before the last one's, nor before it was sent; and that over one
/// connection none is left out. Of every connection that ends: that the status says why and what to check, and the log,
/// too, but not attempt by attempt.
class Witness {
 public:
  struct Sighting {
    PictureName name;
    TimePoint time;     ///< when it was delivered
    TimePoint arrival;  ///< what the client says
    TimePoint sent;     ///< what the server says
  };

  explicit Witness(const PictureServer& server) : server_(server) {}

  aibo_driver::RcServerClient::Callbacks callbacks();

  /// Pictures that are left out over one connection are no violation, until this is called again.
  void allowGaps(bool allowed);

  /// The picture seen last; its number is 0 if there was none.
  Sighting last() const;

  /// Pictures delivered so far.
  std::uint64_t count() const;

  /// Waits for a picture that this holds for.
  std::optional<Sighting> waitFor(const std::function<bool(const Sighting&)>& condition,
                                  std::chrono::milliseconds timeout);

  /// Waits for the client to be in this state, and returns since when it was; nothing if the time has passed.
  std::optional<TimePoint> waitForState(aibo_driver::ConnectionState state, std::chrono::milliseconds timeout);

  /// The line that was logged last as a warning.
  std::string lastWarning() const;

  /// True if the picture that the server has spoilt last was delivered as it was sent.
  bool hasSeenSpoilt() const;

  /// What was not as it has to be, since this was called last.
  std::vector<std::string> takeViolations();

 private:
  void see(const aibo_driver::Picture& picture);
  void judge(const aibo_driver::Picture& picture, const Sighting& sighting);
  void judgeEnd(const aibo_driver::ConnectionStatus& status);
  void hear(aibo_driver::LogLevel level, const std::string& line);
  void complain(const std::string& problem) { violations_.push_back(problem); }

  const PictureServer& server_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  Sighting last_;
  std::uint64_t count_ = 0;
  std::uint64_t spoilt_ = 0;  // number of the last spoilt picture that was delivered
  std::string last_warning_;
  int warnings_ = 0;  // that there is no connection, since one has worked
  bool gaps_allowed_ = false;
  aibo_driver::ConnectionState state_ = aibo_driver::ConnectionState::kDisconnected;
  TimePoint state_since_;
  std::vector<std::string> violations_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_WITNESS_H
