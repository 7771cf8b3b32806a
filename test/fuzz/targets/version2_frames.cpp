// The reader of version 2 frames, and all decoders of payloads and of what a client answers to datagrams: any bytes in
// any pieces.
#include <algorithm>

#include "fuzz_input.h"
#include "protocol/color_requests.h"
#include "protocol/frame_reader.h"
#include "protocol/motion_requests.h"
#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace version2 = protocol::version2;
using version2::FrameReader;

namespace {

// Larger than any payload with a layout, and small enough that some frames are too large.
constexpr std::size_t kCapacity = 4096;

// An accepted payload has only one form: it is encoded into the same number of bytes, which are accepted, too.
template <typename Payload>
void decodeAs(const Bytes& bytes) {
  Payload payload;
  if (version2::decode(bytes.data(), bytes.size(), &payload) != nullptr) {
    return;
  }
  require(version2::encodedSize(payload) == bytes.size(), "encoded into the same number of bytes");
  Bytes again(bytes.size());
  require(version2::encode(payload, again.data()) == bytes.size(), "encodedSize() is right");
  require(version2::decode(again.data(), again.size(), &payload) == nullptr, "an encoded payload is accepted");
}

template <typename... Payloads>
void decodeAsEach(const Bytes& bytes) {
  (decodeAs<Payloads>(bytes), ...);
}

void decodeList(version2::ReadFileName read, const Bytes& bytes) {
  version2::FileList list;
  if (version2::decodeFileList(read, bytes.data(), bytes.size(), &list) == nullptr) {
    Bytes again(bytes.size());
    require(version2::encodeFileList(list, again.data()) == bytes.size(), "a list has only one form");
  }
}

void decodePicture(const Bytes& payload) {
  version2::PicturePayload picture;
  if (version2::decode(payload.data(), payload.size(), &picture) == nullptr) {
    require(version2::IMAGE_HEADER_SIZE + picture.jpeg_size == payload.size(), "the JPEG is the rest");
    Bytes again(payload.size());
    version2::encode(picture, again.data());
    require(again == payload, "an accepted picture has only one form");
  }
}

void decodeCameraValue(const Bytes& payload) {
  for (int id = 0; id <= version2::NUMBER_OF_CAMERA_SETTINGS + 1; ++id) {
    version2::CameraValue value = {static_cast<unsigned char>(id), 0xff};
    const char* const problem = version2::decode(payload.data(), payload.size(), &value);
    require(problem != nullptr || version2::problemOfCameraValue(id, value.value) == nullptr,
            "only values of the setting are accepted");
  }
}

// What follows the regions is the plane, which may be packed in many ways.
void decodeColorRegions(const Bytes& payload) {
  version2::ColorRegions regions;
  if (version2::decode(payload.data(), payload.size(), &regions) != nullptr) {
    return;
  }
  Bytes again(payload.size());
  require(version2::encode(regions, again.data()) == again.size(), "the plane is the rest");
  require(again == payload, "accepted regions have only one form");
  Bytes plane(std::min<std::size_t>(std::size_t{regions.width} * regions.height, kCapacity));
  if (version2::unpackColorPlane(regions.plane, regions.plane_size, plane.size(), plane.data()) == nullptr) {
    Bytes once_more(plane.size() + plane.size() / 128 + 1);
    const std::size_t size = version2::packColorPlane(plane.data(), plane.size(), once_more.data());
    require(size <= once_more.size(), "a packed plane is not larger than its maximum");
    Bytes same(plane.size());
    require(version2::unpackColorPlane(once_more.data(), size, same.size(), same.data()) == nullptr && same == plane,
            "a packed plane is unpacked again");
  }
}

// The encoder truncates long texts.
void decodeErrorMessage(const Bytes& payload) {
  version2::ErrorMessage message;
  if (version2::decode(payload.data(), payload.size(), &message) == nullptr) {
    require(message.text_size + 2 == payload.size(), "the text is the rest");
    Bytes again(std::min(payload.size(), version2::MAX_ERROR_MESSAGE_SIZE));
    require(version2::encode(message, again.data()) <= again.size(), "a message is not larger than its maximum");
  }
}

// The same for both of its texts.
void decodeEndMessage(const Bytes& payload) {
  version2::EndMessage message;
  if (version2::decode(payload.data(), payload.size(), &message) == nullptr) {
    require(4 + message.name_size + 1 + message.reason_size == payload.size(), "name and reason are the rest");
    Bytes again(std::min(payload.size(), version2::MAX_END_MESSAGE_SIZE));
    require(version2::encode(message, again.data()) <= again.size(), "a message is not larger than its maximum");
  }
}

void decodeAsEverything(const Bytes& payload) {
  using namespace version2;
  decodeAsEach<PictureRequest, StreamSettings, JointTargets, SpeedLimits, TelemetryPeriod, Telemetry, MotorState,
               MotorsAndPosture, JointIds, LedValues, EarPositions, ColorSettings, ColorTable, MicrophoneSettings,
               HeardSound, PlayedSound, SpeakerRoom, SoundEnd, Volume, DatagramOrder, DatagramStatus, Velocity,
               MotionUpload, MotionToDelete, MotionOrder, MotionChanges, StickPicture, FetchedPicture>(payload);
  decodeList(protocol::readMotionName, payload);
  decodeList(protocol::readPictureName, payload);
  decodePicture(payload);
  decodeCameraValue(payload);
  decodeColorRegions(payload);
  decodeErrorMessage(payload);
  decodeEndMessage(payload);
}

// Returns the number of bytes taken.
std::size_t append(FrameReader& reader, const unsigned char* bytes, std::size_t size) {
  std::size_t taken = 0;
  switch (reader.append(bytes, size, &taken)) {
    case FrameReader::FRAME_COMPLETE:
      require(reader.header().payload_size <= kCapacity, "a frame fits");
      decodeAsEverything(Bytes(reader.payload(), reader.payload() + reader.header().payload_size));
      break;
    case FrameReader::FRAME_TOO_LARGE:
      require(reader.header().payload_size > kCapacity, "only frames that do not fit are refused");
      reader.reset();
      break;
    case FrameReader::FRAME_INCOMPLETE:
      require(taken == size, "an unfinished frame takes all bytes");
      break;
  }
  require(taken > 0 && taken <= size, "at least one byte is taken, and no more than there are");
  return taken;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  PiecewiseInput input(data, size);
  static Bytes buffer(kCapacity);  // static, because allocating it is slow
  FrameReader reader(buffer.data(), buffer.size());
  while (!input.empty()) {
    const Bytes piece = input.takePiece();
    for (std::size_t used = 0; used < piece.size();) {
      used += append(reader, piece.data() + used, piece.size() - used);
    }
  }
  return 0;
}
