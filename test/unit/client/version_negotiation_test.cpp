#include "client/version_negotiation.h"

#include <gmock/gmock.h>

using aibo_client::VersionNegotiation;
using std::chrono::milliseconds;
using testing::ElementsAre;

namespace {

using Bytes = VersionNegotiation::Bytes;
using Result = VersionNegotiation::Result;

class VersionNegotiationTest : public testing::Test {
 protected:
  void receive(const Bytes& bytes) { negotiation_.bytesArrived(bytes.data(), bytes.size()); }

  const VersionNegotiation::TimePoint asked_ = VersionNegotiation::TimePoint() + milliseconds(1000);
  VersionNegotiation negotiation_{asked_};
};

TEST_F(VersionNegotiationTest, TheFirstFourBytesDecideAndTheRestIsForTheSession) {
  const struct {
    Bytes bytes;
    Result result;
    Bytes rest;
  } rows[] = {
      {{'x', 2, 0}, Result::kOpen, {}},
      {{'x', 2, 0, 0, 'h', 0}, Result::kVersion2, {'h', 0}},
      {{'x', 1, 0, 0}, Result::kVersion1, {}},
      {{'e', 0, 0, 0}, Result::kVersion1, {}},
      {{'H', 'T', 'T', 'P'}, Result::kVersion1Unanswered, {'H', 'T', 'T', 'P'}},
  };
  for (const auto& row : rows) {
    VersionNegotiation negotiation(asked_);
    negotiation.bytesArrived(row.bytes.data(), 1);
    negotiation.bytesArrived(row.bytes.data() + 1, row.bytes.size() - 1);
    EXPECT_EQ(row.result, negotiation.result()) << row.bytes[0] << row.bytes[1];
    EXPECT_EQ(row.rest, row.result == Result::kOpen ? Bytes() : negotiation.rest());
  }
}

TEST_F(VersionNegotiationTest, AServerThatIsSilentForHalfASecondSpeaksVersion1) {
  EXPECT_EQ(asked_ + milliseconds(500), negotiation_.deadline());
  negotiation_.checkDeadline(asked_ + milliseconds(499));
  EXPECT_EQ(Result::kOpen, negotiation_.result());
  negotiation_.checkDeadline(asked_ + milliseconds(500));
  EXPECT_EQ(Result::kVersion1Unanswered, negotiation_.result());
}

TEST_F(VersionNegotiationTest, AHalfAnswerAtTheDeadlineIsForTheSession) {
  receive({'x', 2});
  negotiation_.checkDeadline(asked_ + milliseconds(500));
  EXPECT_EQ(Result::kVersion1Unanswered, negotiation_.result());
  EXPECT_THAT(negotiation_.rest(), ElementsAre('x', 2));
}

}  // namespace
