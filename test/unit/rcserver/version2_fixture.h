/// @file version2_fixture.h
/// A robot with an RCServer, and a client of version 2.
#ifndef TEST_UNIT_RCSERVER_VERSION2_FIXTURE_H
#define TEST_UNIT_RCSERVER_VERSION2_FIXTURE_H

#include <gmock/gmock.h>

#include <memory>
#include <optional>
#include <string>

#include "protocol/version2.h"
#include "rcserver_fixture.h"

inline std::string frame(char kind, int id, int request_number, const std::string& payload = {}) {
  const protocol::version2::FrameHeader header = {kind, static_cast<unsigned char>(id),
                                                  static_cast<unsigned short>(request_number),
                                                  static_cast<unsigned>(payload.size())};
  std::string bytes(protocol::version2::FRAME_HEADER_SIZE, '\0');
  encodeFrameHeader(header, reinterpret_cast<unsigned char*>(bytes.data()));
  return bytes + payload;
}

// The payload that `encode` makes of a value.
template <typename Encode, typename Value>
std::string payloadOf(Encode encode, const Value& value, size_t room) {
  std::string bytes(room, '\0');
  bytes.resize(encode(value, reinterpret_cast<unsigned char*>(bytes.data())));
  return bytes;
}

class Version2Fixture : public RCServerFixture {
 protected:
  void connectVersion2() {
    client_ = connect();
    client_->send(request('X', 2));
    const std::optional<Reply> reply = await(*client_);
    ASSERT_TRUE(reply && protocol::version2::agreesToVersion2(reply->value));
    machine_->runPending();
  }

  void reconnect() {
    client_->close();
    machine_->runPending();
    connectVersion2();
  }

  void send(const std::string& bytes) {
    client_->send(bytes);
    machine_->runPending();
  }

  std::optional<Frame> nextFrame() {
    std::optional<Frame> next;
    EXPECT_TRUE(machine_->runUntil([&] { return (next = client_->nextFrame()).has_value() || client_->ended(); }));
    machine_->runPending();
    return next;
  }

  // Sends a request whose answer comes at once. What is pushed meanwhile is passed over.
  Frame answerTo(char kind, int id, const std::string& payload = {}) {
    const int number = ++last_number_;
    send(frame(kind, id, number, payload));
    for (;;) {
      const std::optional<Frame> answer = nextFrame();
      if (!answer) {
        ADD_FAILURE() << "no answer to " << kind;
        return {};
      }
      if (answer->header.request_number != 0) {
        EXPECT_EQ(answer->header.request_number, number);
        return *answer;
      }
    }
  }

  void expectRefusal(const Frame& answer, int code, const std::string& text_in_it) {
    protocol::version2::ErrorMessage message = {};
    EXPECT_EQ(answer.header.kind, protocol::version2::ERROR_MESSAGE);
    ASSERT_EQ(decodeErrorMessage(answer.payload.data(), answer.payload.size(), &message), nullptr);
    EXPECT_EQ(message.code, code);
    EXPECT_THAT(std::string(message.text, message.text_size), ::testing::HasSubstr(text_in_it));
  }

  std::unique_ptr<TestClient> client_;
  int last_number_ = 0;
};

#endif  // TEST_UNIT_RCSERVER_VERSION2_FIXTURE_H
