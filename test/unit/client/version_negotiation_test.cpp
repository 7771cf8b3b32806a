#include "client/version_negotiation.h"

#include <gmock/gmock.h>

using aibo_client::VersionNegotiation;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

using Bytes = VersionNegotiation::Bytes;
using Result = VersionNegotiation::Result;

class VersionNegotiationTest : public testing::Test {
 protected:
  void receive(const Bytes& bytes) { negotiation_.bytesArrived(bytes.data(), bytes.size()); }

  const VersionNegotiation::TimePoint asked_ = VersionNegotiation::TimePoint() + milliseconds(1000);
  VersionNegotiation negotiation_{asked_};
};

TEST_F(VersionNegotiationTest, ItAsksForVersion2) {
  EXPECT_THAT(VersionNegotiation::request(), ElementsAre('X', 2));
  EXPECT_EQ(Result::kOpen, negotiation_.result());
}

TEST_F(VersionNegotiationTest, AServerThatAgreesSpeaksVersion2AndWhatFollowsIsForTheSession) {
  receive({'x', 2, 0, 0, 'h', 0});
  EXPECT_EQ(Result::kVersion2, negotiation_.result());
  EXPECT_THAT(negotiation_.rest(), ElementsAre('h', 0));
}

TEST_F(VersionNegotiationTest, TheAnswerMayComeByteByByte) {
  for (const std::uint8_t byte : Bytes{'x', 2, 0}) {
    receive({byte});
    EXPECT_EQ(Result::kOpen, negotiation_.result());
  }
  receive({0});
  EXPECT_EQ(Result::kVersion2, negotiation_.result());
  EXPECT_THAT(negotiation_.rest(), IsEmpty());
}

TEST_F(VersionNegotiationTest, AServerThatRefusesSpeaksVersion1) {
  receive({'e', 0, 0, 0});
  EXPECT_EQ(Result::kVersion1, negotiation_.result());
  EXPECT_THAT(negotiation_.rest(), IsEmpty());
}

TEST_F(VersionNegotiationTest, AServerThatOffersAnotherVersionSpeaksVersion1) {
  receive({'x', 1, 0, 0});
  EXPECT_EQ(Result::kVersion1, negotiation_.result());
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

TEST_F(VersionNegotiationTest, OtherBytesAreLeftToTheSession) {
  receive({'H', 'T', 'T', 'P'});
  EXPECT_EQ(Result::kVersion1Unanswered, negotiation_.result());
  EXPECT_THAT(negotiation_.rest(), ElementsAre('H', 'T', 'T', 'P'));
}

TEST_F(VersionNegotiationTest, AnAnswerInTimeIsNotUndoneByTheDeadline) {
  receive({'x', 2, 0, 0});
  negotiation_.checkDeadline(asked_ + milliseconds(600));
  EXPECT_EQ(Result::kVersion2, negotiation_.result());
}

}  // namespace
