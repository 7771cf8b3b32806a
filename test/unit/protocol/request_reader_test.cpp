#include "protocol/request_reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace protocol {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// "F1" = letter and identifier; then ":" and the payload if there is one; "error" for an invalid request.
std::vector<std::string> takeAll(RequestReader& reader) {
  std::vector<std::string> found;
  Request request;
  while (reader.next(&request)) {
    if (!request.valid) {
      found.push_back("error");
      continue;
    }
    std::string text{request.basic.command, static_cast<char>(request.basic.identifier)};
    if (request.payload_size > 0) {
      text += ":" + std::string(request.payload, request.payload + request.payload_size);
    }
    found.push_back(text);
  }
  return found;
}

void append(RequestReader& reader, const std::string& bytes) {
  EXPECT_EQ(reader.append(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()), bytes.size());
}

std::vector<std::string> receive(RequestReader& reader, const std::string& bytes) {
  append(reader, bytes);
  return takeAll(reader);
}

// A request with a file name that announces `size` bytes of content, without the content.
std::string fileRequest(char letter, size_t size) {
  FileRequest file{"WALK.MTN", 0, 0};
  announceContent(size, &file);
  unsigned char payload[FILE_PAYLOAD_SIZE];
  encodeFileRequest(file, payload);
  return std::string{letter} + "1" + std::string(payload, payload + sizeof(payload));
}

// The result of one takeContent() of at most `size` bytes.
std::string takeContent(RequestReader& reader, size_t size) {
  std::string content(size, '?');
  content.resize(reader.takeContent(reinterpret_cast<unsigned char*>(&content[0]), content.size()));
  return content;
}

TEST(RequestReader, TakesTwoBytesForPictureAndStream) {
  RequestReader reader;
  EXPECT_THAT(receive(reader, "F1W2X3"), ElementsAre("F1", "W2", "X3"));
}

TEST(RequestReader, WaitsForTheRestOfASplitRequest) {
  RequestReader reader;
  EXPECT_THAT(receive(reader, "F"), IsEmpty());
  EXPECT_THAT(receive(reader, "1W"), ElementsAre("F1"));
  EXPECT_THAT(receive(reader, "2"), ElementsAre("W2"));
}

TEST(RequestReader, TakesFourBytesForRequestsWithAValue) {
  for (const char letter : std::string("LYKQR")) {
    RequestReader reader;
    EXPECT_THAT(receive(reader, std::string{letter} + "1ab" + "F2"), ElementsAre(std::string{letter} + "1:ab", "F2"));
  }
}

TEST(RequestReader, TakesEighteenBytesForRequestsWithAName) {
  for (const char letter : std::string("DP")) {
    RequestReader reader;
    const std::string request = fileRequest(letter, 700);
    EXPECT_THAT(receive(reader, request + "F2"),
                ElementsAre(std::string{letter} + "1:" + request.substr(BASIC_COMMAND_SIZE), "F2"));
  }
}

TEST(RequestReader, RefusesUnknownLettersTwoBytesAtATime) {
  RequestReader reader;
  EXPECT_THAT(receive(reader, "f1?2F3\r\n"), ElementsAre("error", "error", "F3", "error"));
}

class RequestOfTwoSizes : public ::testing::TestWithParam<char> {
 protected:
  const std::string letter_{GetParam()};
  RequestReader reader_;
};

TEST_P(RequestOfTwoSizes, TwoBytesAtOnceAreARead) {
  EXPECT_THAT(receive(reader_, letter_ + "1"), ElementsAre(letter_ + "1"));
}

TEST_P(RequestOfTwoSizes, FourBytesAtOnceAreAWrite) {
  EXPECT_THAT(receive(reader_, letter_ + "1ab"), ElementsAre(letter_ + "1:ab"));
}

TEST_P(RequestOfTwoSizes, ThreeBytesWaitForTheFourth) {
  EXPECT_THAT(receive(reader_, letter_ + "1a"), IsEmpty());
  EXPECT_THAT(receive(reader_, "b"), ElementsAre(letter_ + "1:ab"));
}

TEST_P(RequestOfTwoSizes, OneByteWaitsForTheRest) {
  EXPECT_THAT(receive(reader_, letter_), IsEmpty());
  EXPECT_THAT(receive(reader_, "1ab"), ElementsAre(letter_ + "1:ab"));
}

TEST_P(RequestOfTwoSizes, MoreThanFourBytesAtOnceAreOneErrorAndAllGone) {
  for (size_t size = 5; size <= RequestReader::MAX_APPENDED; size += 7) {
    EXPECT_THAT(receive(reader_, letter_ + std::string(size - 1, 'F')), ElementsAre("error"));
  }
  EXPECT_THAT(receive(reader_, "F1"), ElementsAre("F1"));
}

TEST_P(RequestOfTwoSizes, TheBytesBeforeItDoNotCount) {
  EXPECT_THAT(receive(reader_, "F1" + letter_ + "2"), ElementsAre("F1", letter_ + "2"));
}

INSTANTIATE_TEST_SUITE_P(JointSensorVelocityAcceleration, RequestOfTwoSizes, ::testing::Values('J', 'S', 'V', 'A'));

TEST(RequestReader, SkipsTheContentThatAnUploadAnnounces) {
  for (const char letter : std::string("UC")) {
    for (const size_t size : {0, 1, 511, 512, 513, 5000}) {
      RequestReader reader;
      std::vector<std::string> found = receive(reader, fileRequest(letter, size));
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0][0], letter);
      const std::string content(size, 'W');
      for (size_t begin = 0; begin < size; begin += RequestReader::MAX_APPENDED) {
        EXPECT_THAT(receive(reader, content.substr(begin, RequestReader::MAX_APPENDED)), IsEmpty());
      }
      EXPECT_THAT(receive(reader, "F1"), ElementsAre("F1")) << size << " bytes announced";
    }
  }
}

TEST(RequestReader, SkipsTheLargestContentThatCanBeAnnounced) {
  RequestReader reader;
  ASSERT_EQ(receive(reader, fileRequest('U', MAX_CONTENT_SIZE)).size(), 1U);
  const std::string content(1024, 'W');
  size_t left = MAX_CONTENT_SIZE;
  for (; left > content.size(); left -= content.size()) {
    ASSERT_THAT(receive(reader, content), IsEmpty());
  }
  EXPECT_THAT(receive(reader, content.substr(0, left)), IsEmpty());
  EXPECT_THAT(receive(reader, "F1"), ElementsAre("F1"));
}

TEST(RequestReader, GivesTheContentToACallerThatTakesIt) {
  const std::string content = "F1W2J3 are no requests here";
  const std::string bytes = fileRequest('U', content.size()) + content + "F4";
  for (size_t first = FILE_REQUEST_SIZE; first <= bytes.size(); ++first) {
    RequestReader reader;
    append(reader, bytes.substr(0, first));
    Request request;
    ASSERT_TRUE(reader.next(&request));
    EXPECT_EQ(reader.contentLeft(), content.size());
    std::string taken = takeContent(reader, 4) + takeContent(reader, 1000);
    append(reader, bytes.substr(first));
    taken += takeContent(reader, 1000);
    EXPECT_EQ(taken, content) << first << " bytes first";
    EXPECT_EQ(reader.contentLeft(), 0U);
    EXPECT_EQ(takeContent(reader, 1000), "");
    EXPECT_THAT(takeAll(reader), ElementsAre("F4"));
  }
}

TEST(RequestReader, SkipsContentThatIsNotTaken) {
  RequestReader reader;
  append(reader, fileRequest('U', 6) + "F1W2");
  Request request;
  ASSERT_TRUE(reader.next(&request));
  EXPECT_EQ(takeContent(reader, 2), "F1");
  EXPECT_EQ(reader.contentLeft(), 4U);
  EXPECT_FALSE(reader.next(&request));
  EXPECT_EQ(reader.contentLeft(), 2U);
  EXPECT_THAT(receive(reader, "J3F4"), ElementsAre("F4"));
}

TEST(RequestReader, ExpectsContentAfterUploadsOnly) {
  for (const char letter : std::string("DP")) {
    RequestReader reader;
    EXPECT_EQ(receive(reader, fileRequest(letter, 700)).size(), 1U);
    EXPECT_EQ(reader.contentLeft(), 0U) << letter;
  }
}

TEST(RequestReader, ResetForgetsHalfARequestAndTheContentToSkip) {
  RequestReader reader;
  receive(reader, fileRequest('U', 5000));
  reader.reset();
  EXPECT_THAT(receive(reader, "F1W"), ElementsAre("F1"));
  reader.reset();
  EXPECT_THAT(receive(reader, "F2"), ElementsAre("F2"));
}

TEST(RequestReader, TakesNoMoreThanItHasRoomFor) {
  RequestReader reader;
  const std::string flood(4 * RequestReader::MAX_APPENDED, 'F');
  const size_t taken = reader.append(reinterpret_cast<const unsigned char*>(flood.data()), flood.size());
  EXPECT_GE(taken, RequestReader::MAX_APPENDED);
  EXPECT_LT(taken, flood.size());
  EXPECT_EQ(takeAll(reader).size(), taken / 2);
}

TEST(RequestReader, FindsTheSameRequestsHoweverTheBytesAreSplit) {
  std::string bytes;
  for (int i = 0; i < 200; ++i) {
    bytes += "F1W2L3abK4cdX5?6" + fileRequest('P', 3) + fileRequest('U', 40) + std::string(40, 'J');
  }
  std::vector<std::string> expected;
  {
    RequestReader reader;
    for (const char byte : bytes) {
      for (const std::string& request : receive(reader, std::string{byte})) {
        expected.push_back(request);
      }
    }
  }
  ASSERT_EQ(expected.size(), 200U * 8U);
  std::mt19937 random(2006);
  for (int round = 0; round < 50; ++round) {
    RequestReader reader;
    std::vector<std::string> found;
    std::uniform_int_distribution<size_t> piece(1, round % 2 == 0 ? 9 : RequestReader::MAX_APPENDED);
    for (size_t begin = 0; begin < bytes.size();) {
      const size_t size = std::min(piece(random), bytes.size() - begin);
      for (const std::string& request : receive(reader, bytes.substr(begin, size))) {
        found.push_back(request);
      }
      begin += size;
    }
    ASSERT_EQ(found, expected) << "round " << round;
  }
}

// Decodes a request in every way that a server might.
void decodeAsEverything(const Request& request) {
  decodeValue(request.payload);
  const FileRequest file = decodeFileRequest(request.payload);
  ASSERT_LE(std::strlen(file.name), MAX_MOTION_NAME_SIZE);
  MotionName name;
  readMotionName(file.name, std::strlen(file.name), name);
}

TEST(RequestReader, SurvivesAMillionRandomBytesAndServesTheNextClient) {
  std::mt19937 random(2026);
  const auto upTo = [&random](size_t limit) { return std::uniform_int_distribution<size_t>(0, limit)(random); };
  RequestReader reader;
  Request request{};
  for (int round = 0; round < 2000; ++round) {
    std::string bytes(upTo(RequestReader::MAX_APPENDED), '\0');
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random() >> 24); });
    append(reader, bytes);
    size_t requests = 0;
    while (reader.next(&request)) {
      ++requests;
      decodeAsEverything(request);
      takeContent(reader, upTo(30));
    }
    EXPECT_LE(requests, RequestReader::MAX_REQUESTS);
    if (round % 10 == 0) {
      reader.reset();
      ASSERT_THAT(receive(reader, "F1"), ElementsAre("F1"));
    }
  }
}

}  // namespace
}  // namespace protocol
