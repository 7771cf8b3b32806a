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

#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "support/picture_server.h"

namespace fault_bench {

/// Checks what a client delivers against what a PictureServer has sent. The witness must outlive the client, and the
/// server must outlive the witness.
///
/// It complains unless every picture is, byte for byte, one that the server has sent; comes once, and not after a newer
/// one; has a time of arrival that is not before that of the last one, nor before it was sent; and unless all pictures
/// of a connection come. When a connection ends, the status and the log must give a reason, and the log must not repeat
/// it at each attempt.
///
/// Unlike soak::PictureAudit, it knows the name and the time of each picture, because the server is the bench's own.
class Witness {
 public:
  struct Sighting {
    test_pictures::Name name;
    TimePoint time;     ///< of its delivery
    TimePoint arrival;  ///< of its first byte, according to the client
    TimePoint sent;     ///< according to the server
  };

  explicit Witness(const PictureServer& server) : server_(server) {}

  aibo_client::Callbacks callbacks();

  /// While gaps are allowed, it does not complain about pictures that are left out over one connection.
  void allowGaps(bool allowed);

  /// The last picture; its number is 0 if there was none.
  Sighting last() const;

  /// Pictures delivered so far.
  std::uint64_t count() const;

  /// Waits for a picture that fulfils the condition.
  std::optional<Sighting> waitFor(const std::function<bool(const Sighting&)>& condition,
                                  std::chrono::milliseconds timeout);

  /// Waits until the client is in this state.
  /// @return when it entered the state; nothing if it did not in time
  std::optional<TimePoint> waitForState(aibo_client::ConnectionState state, std::chrono::milliseconds timeout);

  /// The last warning in the log.
  std::string lastWarning() const;

  /// True if the last picture that the server spoilt was delivered as it was sent.
  bool hasSeenSpoilt() const;

  /// The complaints since the last call.
  std::vector<std::string> takeViolations();

 private:
  void see(const aibo_client::Picture& picture);
  void judge(const aibo_client::Picture& picture, const Sighting& sighting);
  void judgeEnd(const aibo_client::ConnectionStatus& status);
  void hear(aibo_client::LogLevel level, const std::string& line);
  void complain(const std::string& problem) { violations_.push_back(problem); }

  const PictureServer& server_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  Sighting last_;
  std::uint64_t count_ = 0;
  std::uint64_t spoilt_ = 0;  // number of the last spoilt picture that was delivered
  std::string last_warning_;
  int warnings_ = 0;  // about missing connections, since the last one that worked
  bool gaps_allowed_ = false;
  aibo_client::ConnectionState state_ = aibo_client::ConnectionState::kDisconnected;
  TimePoint state_since_;
  std::vector<std::string> violations_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_WITNESS_H
