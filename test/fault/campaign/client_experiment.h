/// @file client_experiment.h
#ifndef TEST_FAULT_CAMPAIGN_CLIENT_EXPERIMENT_H
#define TEST_FAULT_CAMPAIGN_CLIENT_EXPERIMENT_H

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include "campaign/experiment.h"
#include "campaign/witness.h"
#include "support/picture_server.h"
#include "support/proxy/fault_proxy.h"

namespace fault_bench {

// More bytes than any picture of the server has.
constexpr unsigned kPictureSize = 5200;

/// A client with the driver's own settings, a server, and a proxy between them.
class ClientExperiment : public Experiment {
 public:
  /// @param remainder even: the server speaks version 1 of the protocol; odd: version 2
  /// @param period of the server's pictures
  explicit ClientExperiment(unsigned remainder, std::chrono::microseconds period = std::chrono::microseconds(1500));

  /// Tries the fault, then collects what the witness complains about.
  Outcome run(unsigned trial, Random& random) final;

 protected:
  virtual Outcome attempt(unsigned trial, Random& random) = 0;

  int version() const { return version_; }

  /// Of the client's thread (interposers.h).
  int mark() const { return mark_; }

  /// Has the proxy make this fault, and waits for it.
  FaultReport carryOut(const Fault& fault);

  /// Waits for a picture of a connection that is newer than this one.
  /// @param healthy when the fault was over
  Outcome awaitReconnect(std::uint32_t old_connection, TimePoint healthy);

  /// Makes a fault that changes bytes, and waits for a picture of the next connection.
  Outcome damageAndReconnect(const Fault& fault);

  /// Waits for a picture that was sent after the fault, over any connection.
  Outcome awaitPictureAfter(const FaultReport& report);

  /// A violation if the connection is not this one any more.
  Outcome expectConnection(std::uint32_t expected) const;

  /// The violation for a connection that should not have ended. It is about time if nothing came for too long, because
  /// a busy computer may have held up server or client.
  std::string lossOfConnection() const;

  /// Waits for this many more pictures.
  void awaitPictures(unsigned count);

  /// Bytes of the header in front of a picture, in this version of the protocol.
  int headerSize() const;

  /// The connection over which the last picture came.
  std::uint32_t connection() const { return witness_.last().name.connection; }

  aibo_client::Callbacks callbacks();

  /// Looks the robot's name up here, not in the system.
  struct Client : public aibo_client::RcServerClient {
    explicit Client(ClientExperiment& experiment);
  };

  static std::string robotName() { return "robot.example"; }

  const int version_;
  const int mark_;
  PictureServer server_;
  FaultProxy proxy_;
  Witness witness_;
  std::atomic<bool> name_known_{true};  ///< whether the robot's name can be resolved
  std::atomic<int> address_{1};         ///< the name resolves to 127.0.0.N
  Client client_;

 private:
  std::string noPicture() const;

  std::uint64_t stalls_before_ = 0;  // before the trial
};

/// For measurements of the whole process, during which nothing else may run: each trial has a client and a server of
/// its own, of version 1 and 2 in turn.
template <typename SomeExperiment>
class InTurn : public Experiment {
 public:
  explicit InTurn(unsigned) {}

  Outcome run(unsigned trial, Random& random) override { return SomeExperiment(trial % 2).run(trial, random); }
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_CLIENT_EXPERIMENT_H
