// Pictures by UDP.
#include "protocol/picture_datagram.h"
#include "rcserver_fixture.h"
#include "support/udp_socket.h"

namespace {

using namespace protocol::version2;
using test_support::UdpSocket;
using ::testing::IsEmpty;

std::string orderPayload(int port, bool is_test = false, unsigned sequence = 5000, unsigned picture = 700) {
  return payloadOf(DatagramOrder{static_cast<unsigned short>(port), is_test, sequence, picture});
}

struct ReceivedPart {
  PictureDatagram header{};
  std::vector<uint8_t> bytes;
};

class DatagramsTest : public Version2Fixture {
 protected:
  void switchOn(const UdpSocket& receiver, unsigned sequence = 5000, unsigned picture = 700) {
    const std::string order = orderPayload(receiver.port(), false, sequence, picture);
    const Frame answer = answerTo('B', 0, order);
    ASSERT_EQ(answer.header.kind, 'b');
    EXPECT_EQ(textOf(answer), order);
  }

  /// The first picture is 700.
  void streamTo(const UdpSocket& receiver) {
    switchOn(receiver);
    answerTo('W', 85, kStreamOn);
  }

  std::vector<ReceivedPart> partsAt(UdpSocket& receiver) {
    std::vector<ReceivedPart> parts;
    machine_->runPending();
    while (const auto datagram = receiver.next()) {
      ReceivedPart part;
      sizes_.push_back(datagram->size());
      EXPECT_EQ(decodePictureDatagram(datagram->data(), datagram->size(), &part.header), nullptr);
      part.bytes.assign(datagram->begin() + DATAGRAM_HEADER_SIZE, datagram->end());
      parts.push_back(part);
    }
    machine_->runPending();
    return parts;
  }

  /// The parts of the next picture.
  std::vector<ReceivedPart> nextPicture(UdpSocket& receiver) {
    takeImage();
    return partsAt(receiver);
  }

  /// The client has all pictures before this one, and lacks these parts of it.
  void tell(UdpSocket& receiver, unsigned picture, unsigned first_part = 0, unsigned missing = 0) {
    receiver.reply(status(picture, first_part, missing));
  }

  // The pictures that come by TCP, as the client reads what the robot can send.
  std::vector<Frame> picturesByTcp() {
    std::vector<Frame> pictures;
    for (int i = 0; i < 20; ++i) {
      const std::vector<Frame> some = arrived('f');
      pictures.insert(pictures.end(), some.begin(), some.end());
    }
    return pictures;
  }

  static std::vector<uint8_t> status(unsigned picture, unsigned first_part = 0, unsigned missing = 0) {
    const std::string bytes = payloadOf(DatagramStatus{static_cast<unsigned short>(first_part), picture, missing});
    return {bytes.begin(), bytes.end()};
  }

  static std::vector<uint8_t> joined(const std::vector<ReceivedPart>& parts) {
    std::vector<uint8_t> jpeg;
    for (const ReceivedPart& part : parts) {
      jpeg.insert(jpeg.end(), part.bytes.begin(), part.bytes.end());
    }
    return jpeg;
  }

  std::vector<size_t> sizes_;
};

TEST_F(DatagramsTest, PictureOfTheStreamComesInDatagramsThatNoNetworkHasToCut) {
  UdpSocket receiver;
  robot_.showNoise();
  streamTo(receiver);
  const std::vector<ReceivedPart> parts = nextPicture(receiver);
  ASSERT_GE(parts.size(), 3U);
  for (size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(parts[i].header.part, i);
    EXPECT_EQ(parts[i].header.sequence, 5000 + i);
    EXPECT_EQ(parts[i].header.picture, 700U);
    EXPECT_EQ(parts[i].header.image.image_count, robot_.lastImage());
    EXPECT_EQ(parts[i].header.image.width, 208);
  }
  EXPECT_THAT(sizes_, testing::Each(testing::Le(1372U)));
  const std::vector<uint8_t> jpeg = joined(parts);
  EXPECT_EQ(jpeg.size(), parts[0].header.jpeg_size);
  EXPECT_EQ(std::vector<uint8_t>(jpeg.end() - 2, jpeg.end()), (std::vector<uint8_t>{0xff, 0xd9}));
  EXPECT_THAT(picturesByTcp(), IsEmpty());
}

TEST_F(DatagramsTest, RequestedPictureComesByTcp) {
  UdpSocket receiver;
  streamTo(receiver);
  send(frame('F', 50, 77, kLayerHigh));
  EXPECT_THAT(nextPicture(receiver), IsEmpty()) << "the image is the requested picture's";
  const std::vector<Frame> pictures = picturesByTcp();
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_EQ(pictures[0].header.request_number, 77);
  EXPECT_FALSE(nextPicture(receiver).empty());
}

TEST_F(DatagramsTest, DatagramsGoToTheClientAloneAndEndWithIt) {
  UdpSocket receiver;
  UdpSocket elsewhere("127.0.0.2");
  streamTo(elsewhere);  // its port, at the client's address
  EXPECT_THAT(nextPicture(elsewhere), IsEmpty());
  switchOn(receiver);
  EXPECT_FALSE(nextPicture(receiver).empty());
  reconnect();
  answerTo('W', 85, kStreamOn);
  EXPECT_THAT(nextPicture(receiver), IsEmpty());
  EXPECT_EQ(picturesByTcp().size(), 1U);
  disconnect();
  client_ = connect(0, "127.0.0.2");
  send(request('X', 2));
  ASSERT_TRUE(await(*client_));
  streamTo(elsewhere);
  EXPECT_FALSE(nextPicture(elsewhere).empty());
}

TEST_F(DatagramsTest, OnlyTheClientAcknowledgesAllPicturesBeforeTheOneNamed) {
  UdpSocket receiver;
  UdpSocket stranger;
  UdpSocket elsewhere("127.0.0.2", receiver.port());
  robot_.showNoise();  // many parts, so that no picture goes without a status
  streamTo(receiver);
  nextPicture(receiver);
  nextPicture(receiver);
  stranger.send(receiver.senderPort(), status(702));
  elsewhere.send(receiver.senderPort(), status(702));
  std::vector<uint8_t> too_long = status(702);
  too_long.push_back(0);
  for (const std::vector<uint8_t>& nonsense : {std::vector<uint8_t>(), std::vector<uint8_t>(12, 's'),
                                               std::vector<uint8_t>(1400, 's'), too_long, status(1000), status(0)}) {
    receiver.reply(nonsense);
  }
  EXPECT_THAT(nextPicture(receiver), IsEmpty());
  tell(receiver, 702);
  EXPECT_FALSE(nextPicture(receiver).empty());
  EXPECT_FALSE(nextPicture(receiver).empty());
}

TEST_F(DatagramsTest, WithoutAStatusTheNextPictureWaitsForAsLongAsTheDocumentSays) {
  UdpSocket receiver;
  robot_.showNoise();
  streamTo(receiver);
  nextPicture(receiver);
  const size_t patience = 6 + 2 * nextPicture(receiver).size();
  size_t images = 1;
  while (nextPicture(receiver).empty() && images < 100) {
    ++images;
  }
  EXPECT_EQ(images, (patience + FakeRobot::kFramesPerImage - 1) / FakeRobot::kFramesPerImage);
}

TEST_F(DatagramsTest, ATestIsOneDatagramOfFullSizeAndChangesNothing) {
  UdpSocket receiver;
  answerTo('W', 85, kStreamOn);
  answerTo('B', 0, orderPayload(receiver.port(), true, 0x12345678, 0x9abcdef0));
  machine_->runPending();
  std::vector<uint8_t> test(MAX_DATAGRAM_SIZE);
  encodeTest({0, true, 0x12345678, 0x9abcdef0}, test.data());
  EXPECT_EQ(receiver.next(), test);
  for (int i = 0; i < 3; ++i) {
    takeImage();
  }
  EXPECT_FALSE(receiver.next().has_value());
  EXPECT_EQ(picturesByTcp().size(), 3U);
}

TEST_F(DatagramsTest, NumbersBeginAsOrderedAndPassTheLargestOne) {
  UdpSocket receiver;
  switchOn(receiver, 0xffffffff, 0xfffffffe);
  answerTo('W', 85, kStreamOn);
  for (const unsigned picture : {0xfffffffeU, 0xffffffffU, 0U, 1U}) {
    const std::vector<ReceivedPart> parts = nextPicture(receiver);
    ASSERT_FALSE(parts.empty()) << picture;
    EXPECT_EQ(parts[0].header.picture, picture);
    EXPECT_EQ(parts[0].header.sequence == 0xffffffff, picture == 0xfffffffe);
    tell(receiver, picture + 1);
  }
}

TEST_F(DatagramsTest, MissingPartsAreRepeatedAlone) {
  UdpSocket receiver;
  robot_.showNoise();
  streamTo(receiver);
  const std::vector<ReceivedPart> first = nextPicture(receiver);
  const std::vector<ReceivedPart> second = nextPicture(receiver);
  ASSERT_GE(second.size(), 4U);
  for (const std::vector<ReceivedPart>* picture : {&first, &second}) {
    tell(receiver, (*picture)[0].header.picture, 1, 5);
    const std::vector<ReceivedPart> repeated = partsAt(receiver);
    ASSERT_EQ(repeated.size(), 2U);
    for (int i = 0; i < 2; ++i) {
      const ReceivedPart& original = (*picture)[static_cast<size_t>(1 + 2 * i)];
      EXPECT_EQ(repeated[i].header.part, original.header.part);
      EXPECT_EQ(repeated[i].header.picture, original.header.picture);
      EXPECT_GT(repeated[i].header.sequence, second.back().header.sequence);
      EXPECT_EQ(repeated[i].bytes, original.bytes);
    }
  }
  tell(receiver, 701, static_cast<unsigned>(second.size() - 1), ~0U);
  EXPECT_EQ(partsAt(receiver).size(), 1U) << "the last part";
}

TEST_F(DatagramsTest, WhatIsNotKeptIsNotRepeated) {
  UdpSocket receiver;
  streamTo(receiver);
  for (unsigned picture = 700; picture < 704; ++picture) {
    EXPECT_FALSE(nextPicture(receiver).empty());
    tell(receiver, picture + 1);
  }
  for (const unsigned picture : {700U, 699U, 704U, 705U, 0U}) {
    tell(receiver, picture, 0, ~0U);
    EXPECT_THAT(partsAt(receiver), IsEmpty()) << picture;
  }
}

// Otherwise the radio would idle while a part is repeated.
TEST_F(DatagramsTest, APictureThatIsRepairedDoesNotHoldUpTheNextButOne) {
  UdpSocket receiver;
  robot_.showNoise();
  streamTo(receiver);
  nextPicture(receiver);
  nextPicture(receiver);
  EXPECT_THAT(nextPicture(receiver), IsEmpty());
  tell(receiver, 700, 1, 1);
  EXPECT_EQ(nextPicture(receiver).front().header.picture, 700U) << "the repeated part";
  EXPECT_THAT(nextPicture(receiver), IsEmpty()) << "two others are on their way";
  tell(receiver, 701);
  EXPECT_THAT(nextPicture(receiver), IsEmpty()) << "the same";
  tell(receiver, 702);
  EXPECT_FALSE(nextPicture(receiver).empty());
}

TEST_F(DatagramsTest, WhatMayBeMissingIsSentByTcpWhenDatagramsEnd) {
  UdpSocket receiver;
  robot_.showNoise();
  streamTo(receiver);
  nextPicture(receiver);
  tell(receiver, 701);
  const std::vector<ReceivedPart> second = nextPicture(receiver);
  const std::vector<ReceivedPart> third = nextPicture(receiver);
  ASSERT_FALSE(third.empty());
  send(frame('B', 0, 9, orderPayload(0)));
  const std::vector<Frame> pictures = picturesByTcp();
  ASSERT_EQ(pictures.size(), 2U);
  size_t i = 0;
  for (const std::vector<ReceivedPart>* expected : {&second, &third}) {
    const std::vector<uint8_t>& payload = pictures[i++].payload;
    EXPECT_EQ(std::vector<uint8_t>(payload.begin() + IMAGE_HEADER_SIZE, payload.end()), joined(*expected));
  }
  send(frame('B', 0, 10, orderPayload(0)));
  EXPECT_THAT(picturesByTcp(), IsEmpty()) << "they have been sent";
  EXPECT_THAT(nextPicture(receiver), IsEmpty());
  EXPECT_EQ(picturesByTcp().size(), 1U);
}

TEST_F(DatagramsTest, AreForgottenAfter200Milliseconds) {
  UdpSocket receiver;
  for (const unsigned frames : {24U, 29U}) {
    streamTo(receiver);
    nextPicture(receiver);
    answerTo('W', 85, kStreamOff);
    passFrames(frames);
    send(frame('B', 0, 9, orderPayload(0)));
    EXPECT_EQ(picturesByTcp().size(), frames == 24 ? 1U : 0U) << frames;
  }
}

}  // namespace
