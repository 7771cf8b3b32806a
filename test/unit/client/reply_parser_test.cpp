#include "client/reply_parser.h"

#include <gmock/gmock.h>

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "client/fault.h"
#include "support/test_pictures.h"

using aibo_client::ProtocolException;
using aibo_client::ReplyParser;
using test_pictures::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

using TimePoint = ReplyParser::TimePoint;

TimePoint timeAt(int milliseconds) {
  return TimePoint() + std::chrono::milliseconds(milliseconds);
}

class ReplyParserTest : public testing::Test {
 protected:
  void feed(const Bytes& bytes, TimePoint arrival = TimePoint()) {
    std::size_t taken = 0;
    for (std::size_t at = 0; at < bytes.size(); at += taken) {
      const ReplyParser::Result result = parser_.append(bytes.data() + at, bytes.size() - at, arrival, &taken);
      if (result == ReplyParser::Result::kPicture) {
        pictures_.push_back(parser_.takeJpeg());
      } else if (result == ReplyParser::Result::kValue) {
        values_.push_back(parser_.value());
      } else {
        continue;
      }
      times_.push_back(parser_.firstByteTime());
    }
  }

  std::string complaintAbout(const Bytes& bytes) {
    try {
      feed(bytes);
    } catch (const ProtocolException& error) {
      return error.what();
    }
    return "";
  }

  ReplyParser parser_;
  std::vector<Bytes> pictures_;
  std::vector<TimePoint> times_;
  std::vector<protocol::ValueReply> values_;
};

const Bytes kPayload = {1, 2, 3, 'f', 0, 0, 0, 1, 'e'};

TEST_F(ReplyParserTest, APictureIsFoundWhereverItIsCutInTwo) {
  const Bytes reply = test_pictures::makeReply(kPayload);
  for (std::size_t cut = 1; cut < reply.size(); ++cut) {
    pictures_.clear();
    times_.clear();
    const auto middle = reply.begin() + static_cast<std::ptrdiff_t>(cut);
    feed(Bytes(reply.begin(), middle), timeAt(10));
    EXPECT_FALSE(parser_.betweenReplies());
    feed(Bytes(middle, reply.end()), timeAt(20));
    EXPECT_TRUE(parser_.betweenReplies());
    EXPECT_THAT(pictures_, ElementsAre(kPayload));
    EXPECT_THAT(times_, ElementsAre(timeAt(10))) << "the time is that of the first byte";
  }
}

TEST_F(ReplyParserTest, RepliesAreFoundByteByByteOrTogether) {
  Bytes stream = test_pictures::makeReply(kPayload);
  stream.insert(stream.end(), {'j', 3, 0x18, 0xFC});
  const Bytes more = test_pictures::makeReply(Bytes(protocol::MAX_PICTURE_SIZE, 7));
  stream.insert(stream.end(), more.begin(), more.end());
  for (const std::uint8_t byte : stream) {
    feed({byte});
  }
  feed(stream);
  EXPECT_THAT(pictures_, ElementsAre(kPayload, Bytes(protocol::MAX_PICTURE_SIZE, 7), kPayload,
                                     Bytes(protocol::MAX_PICTURE_SIZE, 7)));
  ASSERT_EQ(2u, values_.size());
  EXPECT_EQ('j', values_[1].letter);
  EXPECT_EQ(3, values_[1].identifier);
  EXPECT_EQ(-1000, values_[1].value);
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
    EXPECT_THAT(complaintAbout(header), HasSubstr(complaint));
  }
}

TEST_F(ReplyParserTest, AReplyOfNoKnownKindIsAProtocolErrorAtItsFirstByte) {
  for (const int letter : std::initializer_list<int>{'F', 'W', 'w', 'z', '\0', 0xFF, 0x80, '<', 'H'}) {
    parser_ = ReplyParser();
    EXPECT_THAT(complaintAbout({static_cast<std::uint8_t>(letter)}),
                HasSubstr("begins with byte " + std::to_string(letter)));
  }
}

}  // namespace
