#include "protocol/request_reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace protocol {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// "F1" = letter and identifier; then ":" and the payload if there is one; "error" for what is to be refused.
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

std::vector<std::string> receive(RequestReader& reader, const std::string& bytes) {
  EXPECT_EQ(reader.append(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()), bytes.size());
  return takeAll(reader);
}

// A request with a file name that announces `size` bytes of content, without the content.
std::string fileRequest(char letter, size_t size) {
  const size_t blocks = size / 512;
  const size_t rest = size % 512;
  std::string request = std::string{letter} + "1WALK.MTN";
  request.resize(BASIC_COMMAND_SIZE + 12, '\0');
  for (const size_t field : {blocks, rest}) {
    request += static_cast<char>(field & 0xff);
    request += static_cast<char>(field >> 8);
  }
  return request;
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

TEST_P(RequestOfTwoSizes, WhatStoodBeforeItDoesNotCount) {
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
  std::string request = fileRequest('U', 0);
  std::fill(request.end() - 4, request.end(), '\xff');
  ASSERT_EQ(receive(reader, request).size(), 1U);
  const std::string content(1024, 'W');
  size_t left = 65535 * 512 + 65535;
  for (; left > content.size(); left -= content.size()) {
    ASSERT_THAT(receive(reader, content), IsEmpty());
  }
  EXPECT_THAT(receive(reader, content.substr(0, left)), IsEmpty());
  EXPECT_THAT(receive(reader, "F1"), ElementsAre("F1"));
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

TEST(RequestReader, ServesTheNextClientWhateverBytesTheLastOneSent) {
  std::mt19937 random(2026);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<size_t> length(1, RequestReader::MAX_APPENDED);
  RequestReader reader;
  for (int round = 0; round < 2000; ++round) {
    std::string bytes(length(random), '\0');
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(byte(random)); });
    EXPECT_LE(receive(reader, bytes).size(), RequestReader::MAX_REQUESTS);
    if (round % 10 == 0) {
      reader.reset();
      ASSERT_THAT(receive(reader, "F1"), ElementsAre("F1"));
    }
  }
}

}  // namespace
}  // namespace protocol
