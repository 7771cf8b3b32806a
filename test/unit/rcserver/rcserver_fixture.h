/// @file rcserver_fixture.h
/// A robot with an RCServer, the time of which a test passes itself.
#ifndef TEST_UNIT_RCSERVER_RCSERVER_FIXTURE_H
#define TEST_UNIT_RCSERVER_RCSERVER_FIXTURE_H

#include <gmock/gmock.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "objects/HostSettings.h"
#include "protocol/version1.h"
#include "simulator/object_catalog.h"
#include "simulator/openr_host/clock.h"
#include "simulator/openr_host/machine.h"
#include "simulator/openr_host/virtual_robot.h"
#include "simulator/sent_pictures.h"
#include "slow_object.h"
#include "support/test_client.h"

using test_support::Frame;
using test_support::Reply;
using test_support::TestClient;

inline std::string request(char letter, int identifier) {
  return {letter, static_cast<char>(identifier)};
}

inline std::string request(char letter, int identifier, int value) {
  return request(letter, identifier) + static_cast<char>(value & 0xff) + static_cast<char>((value >> 8) & 0xff);
}

class RCServerFixture : public ::testing::Test {
 protected:
  RCServerFixture() { host_.memory_stick = MEMORY_STICK; }

  // The machine speaks to the robot until its end.
  void TearDown() override { machine_.reset(); }

  void boot(openr_host::VirtualRobot& robot) {
    openr_host::MachineOptions options;
    options.ports = {{protocol::RCSERVER_PORT, 0}, {openr_host::kConsolePort, 0}};
    options.memory_stick = host_.memory_stick;
    options.catalog = objectCatalog();
    if (refused_entry_) {
      options.catalog.at("RCSERVER.BIN").extra_entries.at(*refused_entry_) = nullptr;
    }
    encoder_.standBefore(options.catalog.at("ENCODER.BIN"));
    file_keeper_.standBefore(options.catalog.at("FILES.BIN"));
    options.on_camera_image = [this] {
      encoder_.obey();
      file_keeper_.obey();
    };
    options.on_send = [this](const void* data, size_t size) {
      sends_.push_back(size);
      begun_pictures_ += sent_pictures_.add(data, size) ? 1 : 0;
    };
    options.console = &console_;
    options.handler_time = handler_time_;
    setHostSettings(host_);
    machine_ = std::make_unique<openr_host::Machine>(options, clock_, robot);
    machine_->boot();
    machine_->runPending();
  }

  std::unique_ptr<TestClient> connect(int receive_buffer = 0) {
    auto client = std::make_unique<TestClient>(machine_->hostPort(protocol::RCSERVER_PORT), receive_buffer);
    machine_->runPending();
    return client;
  }

  /// Connects a client and waits until the server answers it.
  std::unique_ptr<TestClient> connectServed() {
    auto client = connect();
    ask(*client, "");
    return client;
  }

  /// Sends requests and waits until all of them are handled: an unknown one at the end is answered at once.
  void ask(TestClient& client, const std::string& requests) {
    client.send(requests + "??");
    const std::optional<Reply> reply = await(client);
    ASSERT_TRUE(reply) << "no answer to the unknown request";
    ASSERT_EQ(reply->letter, protocol::REPLY_ERROR);
    machine_->runPending();
  }

  /// The next reply, whenever it comes; empty if the server closes instead.
  std::optional<Reply> await(TestClient& client) {
    std::optional<Reply> reply;
    EXPECT_TRUE(machine_->runUntil([&] { return (reply = client.next()).has_value() || client.ended(); }))
        << "neither a reply nor an end";
    return reply;
  }

  bool awaitEnd(TestClient& client) {
    return machine_->runUntil([&] { return client.ended(); });
  }

  void passFrames(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      clock_.step();
      machine_->runPending();
    }
  }

  HostSettings host_;
  openr_host::HandlerTime handler_time_;
  std::optional<size_t> refused_entry_;  ///< of stub.cfg: the IPStack refuses what it is to be answered by
  SlowObject encoder_;
  SlowObject file_keeper_;
  std::vector<size_t> sends_;  ///< bytes that the server has given to the IPStack each time
  SentPictures sent_pictures_;
  int begun_pictures_ = 0;
  std::ostringstream console_;
  openr_host::SteppedClock clock_;
  std::unique_ptr<openr_host::Machine> machine_;
};

#endif  // TEST_UNIT_RCSERVER_RCSERVER_FIXTURE_H
