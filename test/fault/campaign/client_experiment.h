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

// Bytes. Longer than any picture of the server.
constexpr unsigned kPictureSize = 5200;

/// A client with the driver's own settings, a server, and the proxy between them.
class ClientExperiment : public Experiment {
 public:
  /// @param remainder even: the server speaks version 1 of the protocol; odd: version 2
  /// @param period of the server's pictures
  explicit ClientExperiment(unsigned remainder, std::chrono::microseconds period = std::chrono::microseconds(1500));

  /// Tries the fault, then looks at what the witness says.
  Outcome run(unsigned trial, Random& random) final;

 protected:
  static constexpr std::chrono::milliseconds kPatience{20000};

  virtual Outcome attempt(unsigned trial, Random& random) = 0;

  int version() const { return version_; }

  /// Of the client's thread, for system calls that fail.
  int mark() const { return mark_; }

  /// Has the proxy do this, and waits for it.
  FaultReport carryOut(const Fault& fault);

  /// Waits for a picture of a connection that is newer than this one.
  /// @param healthy since when nothing is wrong any more
  Outcome awaitReconnect(std::uint32_t old_connection, TimePoint healthy);

  /// What there is to say if the connection is not this one any more.
  Outcome expectConnection(std::uint32_t expected) const;

  /// What there is to say of a connection that should not have ended. A matter of time if nothing came for too long: a
  /// busy computer holds up server or client.
  std::string lossOfConnection() const;

  /// Waits for so many pictures more.
  void awaitPictures(unsigned count);

  /// The connection over which the last picture came.
  std::uint32_t connection() const { return witness_.last().name.connection; }

  aibo_driver::RcServerClient::Callbacks callbacks();

  static std::string robotName() { return "robot.example"; }

  const int version_;
  const int mark_;
  PictureServer server_;
  FaultProxy proxy_;
  Witness witness_;
  std::atomic<bool> name_known_{true};  ///< whether the robot's name can be looked up
  std::atomic<int> address_{1};         ///< it leads to 127.0.0.N
  aibo_driver::RcServerClient client_;

 private:
  std::uint64_t stalls_before_ = 0;  // before the trial
};

/// For what concerns the whole process, so that nothing may run beside it: each trial has a client and a server of its
/// own, of version 1 and 2 in turn.
template <typename SomeExperiment>
class InTurn : public Experiment {
 public:
  explicit InTurn(unsigned) {}

  Outcome run(unsigned trial, Random& random) override { return SomeExperiment(trial % 2).run(trial, random); }
};

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_CLIENT_EXPERIMENT_H
