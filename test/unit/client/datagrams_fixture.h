/// @file datagrams_fixture.h
#ifndef TEST_UNIT_CLIENT_DATAGRAMS_FIXTURE_H
#define TEST_UNIT_CLIENT_DATAGRAMS_FIXTURE_H

#include "protocol/picture_datagram.h"
#include "support/test_pictures.h"
#include "version2_fixture.h"

constexpr int kPort = 40000;

/// Larger than a datagram: it has six parts.
inline test_pictures::Bytes makeJpeg(unsigned seed) {
  test_pictures::PictureKind kind;
  kind.seed = seed;
  kind.width = 176;
  kind.height = 144;
  kind.quality = 94;
  return test_pictures::make(kind);
}

/// The datagrams of a picture, as a robot sends them.
/// @param picture its number
/// @param[in,out] sequence the number of its first datagram; afterwards that of the next picture's
inline std::vector<test_pictures::Bytes> makeDatagrams(const test_pictures::Bytes& jpeg, unsigned picture,
                                                       unsigned frame_number, unsigned* sequence) {
  using namespace protocol::version2;
  std::vector<test_pictures::Bytes> datagrams;
  PictureDatagram header = {};
  header.picture = picture;
  header.jpeg_size = static_cast<unsigned>(jpeg.size());
  header.image = {picture + 12345, frame_number, 208, 160, 85, LAYER_HIGH, {}};
  for (std::size_t part = 0; part < numberOfParts(jpeg.size()); ++part) {
    const auto begin = jpeg.begin() + static_cast<std::ptrdiff_t>(part * DATAGRAM_PART_SIZE);
    header.sequence = (*sequence)++;
    header.part = static_cast<unsigned short>(part);
    test_pictures::Bytes& datagram = datagrams.emplace_back(DATAGRAM_HEADER_SIZE);
    encode(header, datagram.data());
    datagram.insert(datagram.end(), begin, begin + static_cast<std::ptrdiff_t>(sizeOfPart(jpeg.size(), part)));
  }
  return datagrams;
}

/// A robot that sends its pictures as datagrams.
class DatagramsFixture : public Version2SessionFixture {
 public:
  DatagramsFixture() { begin(); }

  /// The kind of the request that the session sends now, which is not answered; 0 if there is none.
  char request() {
    if (Version2SessionFixture::request().empty()) {
      return 0;
    }
    payload_ = frame_.payload;
    protocol::version2::DatagramOrder order = {};
    if (frame_.header.kind == 'B' && decode(payload_.data(), payload_.size(), &order) == nullptr && !order.is_test) {
      order_ = order;
      sequence_ = order.first_sequence;
      pictures_before_order_ = picture_;
    }
    return frame_.header.kind;
  }

  using Version2SessionFixture::answer;
  void answer() {
    for (char kind = request(); kind != 0; kind = request()) {
      answer(kind == 'H' ? version2_frames::makeHello(capabilities_, robotsFrame()) : payload_);
      asked_ += kind;
      if (kind == 'B' && isTest()) {
        arrive(testDatagram(payload_));
      }
    }
  }

  /// True if the request that was sent last is one for a test.
  bool isTest() const { return payload_.at(2) == 1; }

  static Bytes testDatagram(const Bytes& request) {
    protocol::version2::DatagramOrder order = {};
    EXPECT_EQ(nullptr, decode(request.data(), request.size(), &order));
    EXPECT_TRUE(order.is_test);
    Bytes datagram(protocol::version2::MAX_DATAGRAM_SIZE);
    protocol::version2::encodeTest(order, datagram.data());
    return datagram;
  }

  void startStream() {
    wanted_.streaming = true;
    wanted_.datagram_port = kPort;
    answer();
    asked_.clear();
  }

  /// Lets time pass while TCP works and no datagram comes.
  void wait(milliseconds time) {
    for (const TimePoint end = now_ + time; now_ < end && !HasFatalFailure();) {
      answer();
      pass(std::min(end, session_.nextDeadline()) - now_);
    }
  }

  /// `every_32_ms` is called for each image of the camera.
  void live(
      milliseconds time, const std::function<void()>& every_32_ms = [] {}) {
    for (milliseconds passed(0); passed < time; passed += milliseconds(32)) {
      every_32_ms();
      wait(milliseconds(32));
    }
    answer();
  }

  /// Lets time pass while nothing comes. At its end, TCP has repeated what was lost.
  void beOutOfReach(milliseconds time) {
    std::vector<Frame> unanswered;
    const TimePoint end = now_ + time;
    while (now_ < end && !HasFatalFailure()) {
      if (request() == 'H') {
        unanswered.push_back(frame_);
      }
      pass(std::min(end, session_.nextDeadline()) - now_);
    }
    for (const Frame& heartbeat : unanswered) {
      answer(heartbeat, version2_frames::makeHello(capabilities_, robotsFrame()));
    }
  }

  std::vector<Bytes> nextPicture() {
    ++picture_;
    jpegs_.push_back(makeJpeg(picture_));
    return makeDatagrams(jpegs_.back(), numberOf(picture_), frameOf(picture_), &sequence_);
  }

  /// The robot's number of the picture that is `picture` here.
  unsigned numberOf(unsigned picture) const { return order_.first_picture + picture - 1 - pictures_before_order_; }
  static unsigned frameOf(unsigned picture) { return kFrame + 4 * picture; }

  void arrive(const Bytes& datagram) { receiveDatagram(datagram); }
  void arrive(const std::vector<Bytes>& datagrams) {
    for (const Bytes& datagram : datagrams) {
      arrive(datagram);
    }
  }

  /// The numbers of the pictures delivered. They begin with 1; 0 means no picture.
  std::vector<unsigned> delivered() const {
    std::vector<unsigned> numbers;
    for (const aibo_client::PicturePtr& picture : pictures_) {
      const auto found = std::find(jpegs_.begin(), jpegs_.end(), picture->jpeg);
      numbers.push_back(found == jpegs_.end() ? 0 : static_cast<unsigned>(found - jpegs_.begin()) + 1);
    }
    return numbers;
  }

  void arriveByTcp(unsigned seed, unsigned frame_number) {
    push('f', version2_frames::makePicture(makeJpeg(seed), frame_number));
  }

  Bytes payload_;                                 // of the request that was sent last
  protocol::version2::DatagramOrder order_ = {};  // the last one that was not a test
  unsigned pictures_before_order_ = 0;
  std::string asked_;  // kinds of the requests that were answered
  std::vector<Bytes> jpegs_;
  unsigned picture_ = 0;
  unsigned sequence_ = 0;
};

#endif  // TEST_UNIT_CLIENT_DATAGRAMS_FIXTURE_H
