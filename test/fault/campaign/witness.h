/// @file witness.h
#ifndef TEST_FAULT_CAMPAIGN_WITNESS_H
#define TEST_FAULT_CAMPAIGN_WITNESS_H

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "campaign/experiment.h"
#include "support/picture_server.h"

namespace fault_bench {

/// Checks what a client delivers against what a PictureServer has sent. The witness must outlive the client, and the
/// server must outlive the witness.
///
/// It complains if a picture is not, byte for byte, one that the server has sent, if a picture comes twice or after a
/// newer one, and if a picture of a connection is missing. When a connection ends, the status must give reason and
/// advice.
class Witness {
 public:
  struct Sighting {
    test_pictures::Name name;
    TimePoint time;  ///< of its delivery
    TimePoint sent;  ///< according to the server
  };

  explicit Witness(const PictureServer& server) : server_(server) {}

  aibo_client::Callbacks callbacks();

  /// While gaps are allowed, it does not complain about pictures that are left out over one connection.
  void allowGaps(bool allowed);

  /// The last picture; its number is 0 if there was none.
  Sighting last() const;

  /// Waits for a picture that fulfils the condition.
  /// @throw std::runtime_error it did not come
  Sighting waitFor(const std::function<bool(const Sighting&)>& condition);

  /// Waits until the client has noticed that it is not connected.
  /// @throw std::runtime_error it has not
  void waitForDisconnection();

  /// The complaints since the last call.
  std::vector<std::string> takeViolations();

 private:
  void see(const aibo_client::Picture& picture);
  void judge(const aibo_client::Picture& picture, const Sighting& sighting);
  void hear(const aibo_client::ConnectionStatus& status);

  const PictureServer& server_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  Sighting last_;
  bool gaps_allowed_ = false;
  aibo_client::ConnectionStatus status_;
  std::vector<std::string> violations_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_WITNESS_H
