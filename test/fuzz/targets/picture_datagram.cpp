// Pictures by UDP at the client: datagrams of any kind, in any order. Those that are parts of a picture have its number
// as their content, so that a picture of mixed parts would show.
//
// An input is a row of datagrams: a byte for the Kind, and what belongs to it.
#include <algorithm>
#include <optional>

#include "client/datagram_intake.h"
#include "fuzz_input.h"

using namespace aibo_client;
namespace version2 = protocol::version2;

namespace {

enum Kind { PART, RAW = 5, TIME_PASSES, TCP_WORKS, BEGINS_ANEW, COUNT };

constexpr std::size_t kQualityOffset = 28;

class Receiver {
 public:
  explicit Receiver(FuzzInput& input) : input_(input) { begin(); }

  void run() {
    while (!input_.empty()) {
      play();
      const std::string problem = intake_.problem(now_, std::chrono::milliseconds(0));
      require(problem.empty() == (now_ < intake_.deadline(std::chrono::milliseconds(0))),
              "a problem is there when due");
    }
  }

 private:
  void play() {
    const unsigned kind = input_.takeByte() % COUNT;
    if (kind < RAW) {
      arrive(takePart());
    } else if (kind == RAW) {
      arrive(takeRaw());
    } else if (kind == TIME_PASSES) {
      now_ += std::chrono::milliseconds(input_.take16() % 2000);
    } else if (kind == TCP_WORKS) {
      intake_.heardByTcp(now_);
    } else {
      begin();
    }
    takePictures();
    replies();
  }

  void begin() {
    intake_.begin(kStart, now_);
    newest_.reset();
  }

  void replies() {
    intake_.takeStatus(now_);
    require(intake_.nextLook() > now_, "it need not be looked at again at once");
  }

  Bytes takePart() {
    version2::PictureDatagram datagram = {};
    datagram.picture = input_.takeByte();
    datagram.sequence = input_.take16();
    datagram.jpeg_size = 1 + input_.takeByte() * 31U;
    datagram.part = static_cast<unsigned short>(input_.takeByte() % version2::numberOfParts(datagram.jpeg_size));
    datagram.image = {
        datagram.picture, 4 * datagram.picture + input_.takeByte() / 128, 208, 160, 85, version2::LAYER_HIGH, {}};
    Bytes bytes(version2::DATAGRAM_HEADER_SIZE);
    const unsigned picture = datagram.picture;
    datagram.picture += kStart.picture;
    datagram.sequence += kStart.sequence;
    version2::encode(datagram, bytes.data());
    bytes.resize(bytes.size() + version2::sizeOfPart(datagram.jpeg_size, datagram.part),
                 static_cast<std::uint8_t>(picture));
    return bytes;
  }

  // A part that never belongs to a picture of takePart().
  Bytes takeRaw() {
    Bytes bytes = input_.takeBytes(input_.takeByte());
    if (bytes.size() > kQualityOffset) {
      bytes[kQualityOffset] = 0;
    }
    return bytes;
  }

  void arrive(const Bytes& bytes) {
    const bool is_robots = intake_.arrived(bytes.data(), bytes.size(), now_);
    version2::DatagramStatus status = {};
    require(version2::decode(bytes.data(), bytes.size(), &status) != nullptr || !is_robots,
            "a status is no part of a picture");
  }

  void takePictures() {
    while (const auto whole = intake_.takeWhole()) {
      take(*whole);
    }
  }

  void take(const PictureAssembly::Begun& whole) {
    require(!whole.jpeg.empty() && whole.jpeg.size() <= version2::MAX_JPEG_SIZE, "a picture has a possible size");
    require(whole.began <= now_, "it began before it was whole");
    if (whole.header.quality != 0) {
      const auto picture_number = static_cast<std::uint8_t>(whole.header.image_count);
      require(std::count(whole.jpeg.begin(), whole.jpeg.end(), picture_number) ==
                  static_cast<std::ptrdiff_t>(whole.jpeg.size()),
              "all parts are of the picture");
      require(!newest_ || whole.header.image_count > *newest_, "no picture comes after a newer one");
      newest_ = whole.header.image_count;
      intake_.goodPicture(whole.number, now_);
    }
  }

  // Both counters overflow.
  static constexpr DatagramIntake::Start kStart = {0xffffff00, 0xfffffff0};

  FuzzInput& input_;
  const Notifier notifier_{Callbacks()};
  ClientStatistics counters_;
  const ConnectionContext context_{"robot:54321", std::chrono::milliseconds(500), notifier_, counters_};
  DatagramIntake intake_{context_};
  DatagramIntake::TimePoint now_ = DatagramIntake::TimePoint() + std::chrono::hours(1);
  std::optional<unsigned> newest_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  Receiver(input).run();
  return 0;
}
