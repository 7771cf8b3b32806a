#include "client/reply_parser.h"

#include <gmock/gmock.h>

#include "client/fault.h"
#include "support/refusal.h"
#include "support/test_pictures.h"

using aibo_client::ReplyParser;
using test_pictures::Bytes;

namespace {

using TimePoint = ReplyParser::TimePoint;

class ReplyParserTest : public testing::Test {
 protected:
  /// What is found in these bytes is added to found_: a picture, or a value as letter, identifier and value.
  void feed(const Bytes& bytes, int milliseconds = 0) {
    const TimePoint arrival = TimePoint() + std::chrono::milliseconds(milliseconds);
    std::size_t taken = 0;
    for (std::size_t at = 0; at < bytes.size(); at += taken) {
      const ReplyParser::Result result = parser_.append(bytes.data() + at, bytes.size() - at, arrival, &taken);
      if (result == ReplyParser::Result::kPicture) {
        found_.push_back(parser_.takeJpeg());
      } else if (result == ReplyParser::Result::kValue) {
        const protocol::ValueReply value = parser_.value();
        EXPECT_EQ(-1000, value.value);
        found_.push_back({static_cast<std::uint8_t>(value.letter), static_cast<std::uint8_t>(value.identifier)});
      } else {
        continue;
      }
      first_byte_time_ = parser_.firstByteTime();
    }
  }

  std::string complaintAbout(const Bytes& bytes) {
    return test_support::refusalOf<aibo_client::ProtocolException>([&] { feed(bytes); });
  }

  ReplyParser parser_;
  std::vector<Bytes> found_;
  TimePoint first_byte_time_;
};

TEST_F(ReplyParserTest, RepliesAreFoundWhereverTheyAreCutInTwo) {
  const Bytes payload = {1, 2, 3, 'f', 0, 0, 0, 1, 'e'};
  const Bytes value = {'j', 3, 0x18, 0xFC};
  const Bytes largest(protocol::MAX_PICTURE_SIZE, 7);
  Bytes replies = test_pictures::makeReply(payload);
  for (std::size_t cut = 1; cut < replies.size(); ++cut) {
    const auto middle = replies.begin() + static_cast<std::ptrdiff_t>(cut);
    feed(Bytes(replies.begin(), middle), 10);
    EXPECT_FALSE(parser_.betweenReplies());
    feed(Bytes(middle, replies.end()), 20);
    EXPECT_TRUE(parser_.betweenReplies());
    EXPECT_EQ(TimePoint() + std::chrono::milliseconds(10), first_byte_time_);
    EXPECT_THAT(std::exchange(found_, {}), testing::ElementsAre(payload));
  }
  replies.insert(replies.end(), value.begin(), value.end());
  const Bytes last = test_pictures::makeReply(largest);
  replies.insert(replies.end(), last.begin(), last.end());
  for (const std::uint8_t byte : replies) {
    feed({byte});
  }
  feed(replies);
  EXPECT_THAT(found_, testing::ElementsAre(payload, Bytes{'j', 3}, largest, payload, Bytes{'j', 3}, largest));
}

TEST_F(ReplyParserTest, APictureOfImpossibleSizeIsAProtocolError) {
  const std::pair<Bytes, std::string> rows[] = {
      {{'f', 0, 0, 0, 0}, "a picture of 0 bytes; 1 to 262144 are possible"},
      {{'f', 0, 4, 0, 1}, "262145 bytes"},
      {{'f', 0x80, 0, 0, 0}, "2147483648 bytes"},
      {{'f', 0xFF, 0xFF, 0xFF, 0xFF}, "4294967295 bytes"},
  };
  for (const auto& [header, complaint] : rows) {
    parser_ = ReplyParser();
    EXPECT_THAT(complaintAbout(header), testing::HasSubstr(complaint));
  }
}

TEST_F(ReplyParserTest, AReplyOfNoKnownKindIsAProtocolErrorAtItsFirstByte) {
  for (const int letter : std::initializer_list<int>{'F', 'W', 'w', 'z', '\0', 0xFF, 0x80, '<', 'H'}) {
    parser_ = ReplyParser();
    EXPECT_THAT(complaintAbout({static_cast<std::uint8_t>(letter)}),
                testing::HasSubstr("begins with byte " + std::to_string(letter)));
  }
}

}  // namespace
