#include "protocol/request_reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
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

TEST(RequestReader, EndsEachRequestWhereTheDocumentSays) {
  const std::string name = fileRequest('P', 700).substr(BASIC_COMMAND_SIZE);
  const struct {
    std::vector<std::string> pieces;
    std::vector<std::string> requests;
  } rows[] = {
      {{"F1W2X3"}, {"F1", "W2", "X3"}},
      {{"F", "1W", "2"}, {"F1", "W2"}},
      {{"L1abY2cdK3efQ4ghR5ij"}, {"L1:ab", "Y2:cd", "K3:ef", "Q4:gh", "R5:ij"}},
      {{"D1" + name + "P1" + name + "F2"}, {"D1:" + name, "P1:" + name, "F2"}},
      {{"f1?2F3\r\n"}, {"error", "error", "F3", "error"}},
  };
  for (const auto& row : rows) {
    RequestReader reader;
    std::vector<std::string> found;
    std::string bytes;
    for (const std::string& piece : row.pieces) {
      bytes += piece;
      for (const std::string& request : receive(reader, piece)) {
        found.push_back(request);
      }
    }
    EXPECT_EQ(found, row.requests) << row.pieces[0];
    found.clear();
    for (const char byte : bytes) {
      for (const std::string& request : receive(reader, {byte})) {
        found.push_back(request);
      }
    }
    EXPECT_EQ(found, row.requests) << row.pieces[0] << ", byte by byte";
  }
}

TEST(RequestReader, TellsReadsFromWritesByTheBytesThatHaveArrived) {
  for (const std::string letter : {"J", "S", "V", "A"}) {
    RequestReader reader;
    EXPECT_THAT(receive(reader, letter + "1"), ElementsAre(letter + "1"));
    EXPECT_THAT(receive(reader, letter + "1ab"), ElementsAre(letter + "1:ab"));
    EXPECT_THAT(receive(reader, letter + "1a"), IsEmpty());
    EXPECT_THAT(receive(reader, "b"), ElementsAre(letter + "1:ab"));
    EXPECT_THAT(receive(reader, letter), IsEmpty());
    EXPECT_THAT(receive(reader, "1ab"), ElementsAre(letter + "1:ab"));
    EXPECT_THAT(receive(reader, "F1" + letter + "2"), ElementsAre("F1", letter + "2"));
    for (size_t size = 5; size <= RequestReader::MAX_APPENDED; size += 7) {
      EXPECT_THAT(receive(reader, letter + std::string(size - 1, 'F')), ElementsAre("error"));
    }
    EXPECT_THAT(receive(reader, "F1"), ElementsAre("F1"));
  }
}

TEST(RequestReader, SkipsTheContentThatAnUploadAnnounces) {
  for (const char letter : std::string("UC")) {
    for (const size_t size : {0, 1, 511, 512, 513, 5000, 65535 * 513}) {
      RequestReader reader;
      std::vector<std::string> found = receive(reader, fileRequest(letter, size));
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0][0], letter);
      for (size_t left = static_cast<size_t>(size); left > 0;) {
        const size_t piece = std::min(left, RequestReader::MAX_APPENDED);
        EXPECT_THAT(receive(reader, std::string(piece, 'W')), IsEmpty());
        left -= piece;
      }
      EXPECT_THAT(receive(reader, "F1"), ElementsAre("F1")) << size << " bytes announced";
    }
  }
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

TEST(RequestReader, TakesNoMoreThanItHasRoomFor) {
  RequestReader reader;
  const std::string flood(4 * RequestReader::MAX_APPENDED, 'F');
  const size_t taken = reader.append(reinterpret_cast<const unsigned char*>(flood.data()), flood.size());
  EXPECT_GE(taken, RequestReader::MAX_APPENDED);
  EXPECT_LT(taken, flood.size());
  EXPECT_EQ(takeAll(reader).size(), taken / 2);
}

TEST(Version1, SizeOfPictureIsBigEndian) {
  std::array<unsigned char, PICTURE_HEADER_SIZE> bytes{};
  encodePictureHeader(0x00012345, bytes.data());
  EXPECT_THAT(bytes, ElementsAre('f', 0x00, 0x01, 0x23, 0x45));
  size_t size = 0;
  EXPECT_TRUE(decodePictureHeader(bytes.data(), &size));
  EXPECT_EQ(size, 0x00012345U);
}

TEST(Version1, PictureHeaderIsRefusedWhenLetterOrSizeIsImpossible) {
  const std::vector<std::array<unsigned char, PICTURE_HEADER_SIZE>> impossible = {
      {'F', 0, 0, 1, 0}, {'e', 0, 0, 1, 0}, {'f', 0, 0, 0, 0}, {'f', 0, 4, 0, 1}, {'f', 255, 255, 255, 255}};
  for (const auto& bytes : impossible) {
    size_t size = 0;
    EXPECT_FALSE(decodePictureHeader(bytes.data(), &size)) << bytes[0] << " with size " << size;
  }
}

TEST(Version1, ValueIsLittleEndianAndSigned) {
  std::array<unsigned char, VALUE_REPLY_SIZE> bytes{};
  encodeValueReply({'j', 11, -2}, bytes.data());
  EXPECT_THAT(bytes, ElementsAre('j', 11, 0xfe, 0xff));
  const ValueReply reply = decodeValueReply(bytes.data());
  EXPECT_EQ(reply.letter, 'j');
  EXPECT_EQ(reply.identifier, 11);
  EXPECT_EQ(reply.value, -2);
}

TEST(FileRequest, IsANameAndTwoNumbers) {
  unsigned char bytes[FILE_PAYLOAD_SIZE];
  encodeFileRequest(FileRequest{"NOD.MTN", 0x0102, 0xfffe}, bytes);
  EXPECT_THAT(bytes, ElementsAre('N', 'O', 'D', '.', 'M', 'T', 'N', 0, 0, 0, 0, 0, 0x02, 0x01, 0xfe, 0xff));

  const FileRequest file = decodeFileRequest(bytes);
  EXPECT_STREQ(file.name, "NOD.MTN");
  EXPECT_EQ(file.a, 0x0102);
  EXPECT_EQ(file.b, 0xfffe);
}

TEST(FileRequest, EndsItsNameAtTheFirstZeroByteOrAfterTwelve) {
  unsigned char bytes[FILE_PAYLOAD_SIZE];
  encodeFileRequest(FileRequest{"WALK_FWD.MTN", 0xffff, 0xffff}, bytes);
  EXPECT_STREQ(decodeFileRequest(bytes).name, "WALK_FWD.MTN");
  bytes[3] = 0;  // whatever an old client has left behind that
  EXPECT_STREQ(decodeFileRequest(bytes).name, "WAL");
  bytes[0] = 0;
  EXPECT_STREQ(decodeFileRequest(bytes).name, "");
}

}  // namespace
}  // namespace protocol
