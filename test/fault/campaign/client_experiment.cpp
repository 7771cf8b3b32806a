#include "campaign/client_experiment.h"

#include <algorithm>
#include <stdexcept>

#include "campaign/interposers.h"
#include "client/tcp_transport.h"
#include "protocol/version1.h"
#include "protocol/version2.h"

using aibo_client::ClientOptions;
using aibo_client::NameLookupResult;
using aibo_client::TcpTransport;

namespace fault_bench {
namespace {

// Four times the largest possible picture.
constexpr std::size_t kMostAtOnce = 1024 * 1024;

ClientOptions clientOptions(int port, const std::string& name) {
  ClientOptions options;
  options.host = name;
  options.port = port;
  return options;
}

}  // namespace

ClientExperiment::Client::Client(ClientExperiment& experiment)
    : RcServerClient(clientOptions(experiment.proxy_.port(), robotName()), experiment.callbacks(),
                     std::make_unique<TcpTransport>([&experiment](const std::string&, int port) {
                       if (!experiment.name_known_) {
                         return NameLookupResult{{}, "the name is not known"};
                       }
                       return aibo_client::resolveNumeric("127.0.0." + std::to_string(experiment.address_), port);
                     })) {}

ClientExperiment::ClientExperiment(unsigned remainder, std::chrono::microseconds period)
    : version_(remainder % 2 == 0 ? 1 : 2),
      mark_(static_cast<int>(remainder) + 1),
      server_(version_, period),
      proxy_(proxyTo(server_.port(), remainder)),
      witness_(server_),
      client_(*this) {
  client_.setStreaming(true);
  client_.start();
  awaitPictures(3);
}

aibo_client::Callbacks ClientExperiment::callbacks() {
  aibo_client::Callbacks callbacks = witness_.callbacks();
  callbacks.on_status = [this, tell = callbacks.on_status](const aibo_client::ConnectionStatus& status) {
    interposers::markThisThread(mark_);
    tell(status);
  };
  return callbacks;
}

Outcome ClientExperiment::run(unsigned trial, Random& random) {
  const std::uint64_t stale_before = client_.statistics().stale_pictures;
  stalls_before_ = client_.statistics().stalls;
  Outcome outcome;
  try {
    outcome = attempt(trial, random);
    awaitPictures(3);
  } catch (const std::exception& error) {
    outcome.violations.emplace_back(error.what());
  }
  std::vector<std::string> seen = witness_.takeViolations();
  if (client_.statistics().stale_pictures > stale_before) {
    // This process was held up, and the client rightly left out the pictures that grew stale.
    const auto kept =
        std::remove_if(seen.begin(), seen.end(), [](const std::string& each) { return each.rfind("I5", 0) == 0; });
    outcome.excused = kept != seen.end();
    seen.erase(kept, seen.end());
  }
  outcome.violations.insert(outcome.violations.end(), seen.begin(), seen.end());
  if (const std::size_t size = interposers::takeLargestAllocation(mark_); size > kMostAtOnce) {
    outcome.violations.push_back("the client has allocated " + std::to_string(size) + " bytes at once");
  }
  return outcome;
}

FaultReport ClientExperiment::carryOut(const Fault& fault) {
  const std::size_t done = proxy_.faultsDone();
  proxy_.add(fault);
  const auto report = proxy_.waitForFaults(done + 1, kPatience);
  if (!report) {
    throw std::runtime_error("the fault could not be made, because no picture came");
  }
  return *report;
}

Outcome ClientExperiment::awaitReconnect(std::uint32_t old_connection, TimePoint healthy) {
  const auto back = witness_.waitFor(
      [old_connection](const Witness::Sighting& each) { return each.name.connection > old_connection; }, kPatience);
  if (!back) {
    throw std::runtime_error(noPicture());
  }
  return {back->time - healthy, {}};
}

Outcome ClientExperiment::damageAndReconnect(const Fault& fault) {
  const std::uint32_t before = connection();
  witness_.allowGaps(true);
  Outcome outcome = awaitReconnect(before, carryOut(fault).time);
  witness_.allowGaps(false);
  return outcome;
}

Outcome ClientExperiment::awaitPictureAfter(const FaultReport& report) {
  const auto back = witness_.waitFor([&](const Witness::Sighting& each) { return each.sent > report.time; }, kPatience);
  if (!back) {
    throw std::runtime_error(noPicture());
  }
  proxy_.heal();  // a connection that fell silent would last for ever
  return {back->time - report.time, {}};
}

int ClientExperiment::headerSize() const {
  return static_cast<int>(version_ == 1 ? protocol::PICTURE_HEADER_SIZE : protocol::version2::FRAME_HEADER_SIZE);
}

std::string ClientExperiment::noPicture() const {
  return "no picture came any more: " + client_.status().reason;
}

Outcome ClientExperiment::expectConnection(std::uint32_t expected) const {
  return connection() == expected ? Outcome() : Outcome{{}, {lossOfConnection()}};
}

std::string ClientExperiment::lossOfConnection() const {
  const bool was_silent = client_.statistics().stalls > stalls_before_;
  return (was_silent ? "M: " : "") + std::string("the connection was given up: ") + witness_.lastWarning();
}

void ClientExperiment::awaitPictures(unsigned count) {
  const std::uint64_t number = witness_.last().name.number + count;
  if (!witness_.waitFor([number](const Witness::Sighting& each) { return each.name.number >= number; }, kPatience)) {
    throw std::runtime_error(noPicture());
  }
}

}  // namespace fault_bench
