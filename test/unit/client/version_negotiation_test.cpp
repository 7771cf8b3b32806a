#include "client/version_negotiation.h"

#include <gtest/gtest.h>

using aibo_client::VersionNegotiation;
using std::chrono::milliseconds;

namespace {

using Bytes = VersionNegotiation::Bytes;
using Result = VersionNegotiation::Result;

const VersionNegotiation::TimePoint kAsked = VersionNegotiation::TimePoint() + milliseconds(1000);

TEST(VersionNegotiationTest, TheFirstFourBytesDecideAndTheRestIsForTheSession) {
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
    VersionNegotiation negotiation(kAsked);
    negotiation.bytesArrived(row.bytes.data(), 1);
    negotiation.bytesArrived(row.bytes.data() + 1, row.bytes.size() - 1);
    EXPECT_EQ(row.result, negotiation.result()) << row.bytes[0] << row.bytes[1];
    EXPECT_EQ(row.rest, row.result == Result::kOpen ? Bytes() : negotiation.rest());
  }
}

TEST(VersionNegotiationTest, AServerThatIsSilentForHalfASecondSpeaksVersion1) {
  for (const Bytes& half : {Bytes(), Bytes{'x', 2}}) {
    VersionNegotiation negotiation(kAsked);
    negotiation.bytesArrived(half.data(), half.size());
    EXPECT_EQ(kAsked + milliseconds(500), negotiation.deadline());
    negotiation.checkDeadline(kAsked + milliseconds(499));
    EXPECT_EQ(Result::kOpen, negotiation.result());
    negotiation.checkDeadline(kAsked + milliseconds(500));
    EXPECT_EQ(Result::kVersion1Unanswered, negotiation.result());
    EXPECT_EQ(half, negotiation.rest()) << "for the session";
  }
}

}  // namespace
