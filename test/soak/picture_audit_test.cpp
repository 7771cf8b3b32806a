#include "picture_audit.h"

#include <gmock/gmock.h>

#include <boost/crc.hpp>

namespace {

using soak::PictureAudit;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Jpeg = std::vector<std::uint8_t>;

// A robot sends pictures 1 to 5. The test decides which of them are published.
class PictureAuditTest : public ::testing::Test {
 protected:
  PictureAuditTest() {
    for (std::uint8_t number = 1; number <= 5; ++number) {
      boost::crc_32_type crc;
      crc.process_bytes(jpeg(number).data(), jpeg(number).size());
      audit_.sent("1000000000 2 " + std::to_string(crc.checksum()));
    }
  }

  static Jpeg jpeg(std::uint8_t number) { return {number, 7}; }

  std::vector<std::string> publish(std::uint8_t number) { return audit_.published(jpeg(number), ++stamp_); }

  PictureAudit audit_;
  std::uint64_t stamp_ = 0;
};

TEST_F(PictureAuditTest, FindsNothingWrongWithEveryPictureInTurn) {
  audit_.setCalm(true);
  for (std::uint8_t number = 1; number <= 5; ++number) {
    EXPECT_THAT(publish(number), IsEmpty());
  }
  EXPECT_EQ(audit_.lastPublished(), audit_.lastSent());
  EXPECT_EQ(audit_.calmCount(), 5U);
}

TEST_F(PictureAuditTest, CountsPicturesThatAreLeftOutInACalmPeriod) {
  publish(2);
  EXPECT_EQ(audit_.lostInCalm(), 0U);
  audit_.setCalm(true);
  publish(5);
  EXPECT_EQ(audit_.lostInCalm(), 2U);
}

TEST_F(PictureAuditTest, FindsPicturesThatComeTwiceOrAfterANewerOne) {
  publish(2);
  EXPECT_THAT(publish(2), ElementsAre("picture 2 after picture 2"));
  EXPECT_THAT(publish(1), ElementsAre("picture 1 after picture 2"));
  EXPECT_THAT(publish(3), IsEmpty());
}

TEST_F(PictureAuditTest, AcceptsUnknownPicturesOnlyWhileBytesAreDamaged) {
  EXPECT_THAT(publish(99), ElementsAre(HasSubstr("has not sent")));
  audit_.setDamaging(true);
  EXPECT_THAT(publish(99), IsEmpty());
  EXPECT_EQ(audit_.damagedCount(), 1U);
}

TEST_F(PictureAuditTest, FindsStampsThatDoNotIncrease) {
  EXPECT_THAT(audit_.published(jpeg(1), 10), IsEmpty());
  EXPECT_THAT(audit_.published(jpeg(2), 10), ElementsAre(HasSubstr("stamp")));
}

}  // namespace
