/// @file client_experiment.h
#ifndef TEST_FAULT_CAMPAIGN_CLIENT_EXPERIMENT_H
#define TEST_FAULT_CAMPAIGN_CLIENT_EXPERIMENT_H

#include <cstdint>

#include "campaign/experiment.h"
#include "campaign/witness.h"
#include "support/picture_server.h"
#include "support/proxy/fault_proxy.h"

namespace fault_bench {

/// A client with the driver's own settings, a server, and a proxy between them.
class ClientExperiment : public Experiment {
 public:
  /// @param remainder even: the server speaks version 1 of the protocol; odd: version 2
  /// @param silence after which the client gives a connection up
  explicit ClientExperiment(unsigned remainder, milliseconds silence = aibo_client::ClientOptions().read_timeout)
      : version_(remainder % 2 == 0 ? 1 : 2),
        server_(version_, std::chrono::microseconds(1500)),
        proxy_(server_.port()),
        witness_(server_),
        client_(clientOptions(silence), witness_.callbacks()) {
    client_.setStreaming(true);
    client_.start();
    awaitPictures(3);
  }

  /// Tries the fault, then collects what the witness complains about.
  Outcome run(unsigned trial, Random& random) final {
    const std::uint64_t stale_before = client_.statistics().stale_pictures;
    Outcome outcome;
    try {
      outcome = attempt(trial, random);
      awaitPictures(3);
    } catch (const std::exception& error) {
      outcome.violations.emplace_back(error.what());
    }
    const bool was_held_up = client_.statistics().stale_pictures > stale_before;
    for (const std::string& each : witness_.takeViolations()) {
      if (!was_held_up || each.find("are lost") == std::string::npos) {  // it rightly left stale pictures out
        outcome.violations.push_back(each);
      }
    }
    return outcome;
  }

 protected:
  virtual Outcome attempt(unsigned trial, Random& random) = 0;

  int version() const { return version_; }

  /// The connection over which the last picture came.
  std::uint32_t connection() const { return witness_.last().name.connection; }

  /// Waits for this many more pictures.
  void awaitPictures(unsigned count) {
    const std::uint64_t number = witness_.last().name.number + count;
    witness_.waitFor([number](const Witness::Sighting& each) { return each.name.number >= number; });
  }

  /// Waits for a picture of a connection that is newer than this one.
  /// @param healthy when the fault was over
  Outcome awaitReconnect(std::uint32_t old_connection, TimePoint healthy) {
    const auto back = witness_.waitFor(
        [old_connection](const Witness::Sighting& each) { return each.name.connection > old_connection; });
    return {back.time - healthy, {}};
  }

 private:
  aibo_client::ClientOptions clientOptions(milliseconds silence) const {
    aibo_client::ClientOptions options;
    options.port = proxy_.port();
    options.read_timeout = silence;
    return options;
  }

  const int version_;

 protected:
  PictureServer server_;
  FaultProxy proxy_;
  Witness witness_;
  aibo_client::RcServerClient client_;
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_CLIENT_EXPERIMENT_H
