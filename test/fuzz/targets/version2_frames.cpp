// The reader of version 2 frames, and all decoders of payloads and of what a client answers to datagrams: any bytes in
// any pieces.
#include <algorithm>

#include "fuzz_input.h"
#include "protocol/color_requests.h"
#include "protocol/frame_reader.h"
#include "protocol/motion_requests.h"
#include "protocol/picture_datagram.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace version2 = protocol::version2;
using version2::FrameReader;

namespace {

// Larger than any payload with a layout, and small enough that some frames are too large.
constexpr std::size_t kCapacity = 4096;

// An accepted payload has only one form: it is encoded into the same number of bytes, which are accepted, too.
template <typename Value, typename Argument>
void decode(const char* (*decode)(const unsigned char*, std::size_t, Value*),
            std::size_t (*encode)(Argument, unsigned char*), const Bytes& payload) {
  Value value;
  if (decode(payload.data(), payload.size(), &value) != nullptr) {
    return;
  }
  Bytes again(payload.size());
  require(encode(value, again.data()) == payload.size(), "encoded into the same number of bytes");
  require(decode(again.data(), again.size(), &value) == nullptr, "an encoded payload is accepted");
}

// A struct for a name.
struct Name {
  protocol::FileName text;
};

const char* decodeName(const unsigned char* payload, std::size_t size, Name* name) {
  return version2::decodeMotionName(payload, size, name->text);
}

std::size_t encodeName(const Name& name, unsigned char* out) {
  return version2::encodeMotionName(name.text, out);
}

const char* decodeStickName(const unsigned char* payload, std::size_t size, Name* name) {
  return version2::decodePictureName(payload, size, name->text);
}

std::size_t encodeStickName(const Name& name, unsigned char* out) {
  return version2::encodePictureName(name.text, out);
}

void decodePicture(const Bytes& payload) {
  version2::ImageHeader header;
  std::size_t jpeg_size = 0;
  if (version2::decodePicture(payload.data(), payload.size(), &header, &jpeg_size) == nullptr) {
    require(version2::IMAGE_HEADER_SIZE + jpeg_size == payload.size() && jpeg_size > 0, "the JPEG is the rest");
    Bytes again(version2::IMAGE_HEADER_SIZE);
    version2::encodeImageHeader(header, again.data());
    require(std::equal(again.begin(), again.end(), payload.begin()), "an accepted header has only one form");
  }
}

void decodeCameraValue(const Bytes& payload) {
  for (int id = 0; id <= version2::NUMBER_OF_CAMERA_SETTINGS + 1; ++id) {
    unsigned char value = 0xff;
    const char* const problem = version2::decodeCameraValue(id, payload.data(), payload.size(), &value);
    require((problem == nullptr) == version2::hasCameraValue(id, value), "only values of the setting are accepted");
  }
}

// What follows the regions is the plane, which may be packed in many ways.
void decodeColorRegions(const Bytes& payload) {
  version2::ColorRegions regions;
  const unsigned char* packed = nullptr;
  std::size_t packed_size = 0;
  if (version2::decodeColorRegions(payload.data(), payload.size(), &regions, &packed, &packed_size) != nullptr) {
    return;
  }
  Bytes again(payload.size() - packed_size);
  require(version2::encodeColorRegions(regions, again.data()) == again.size(), "the plane is the rest");
  require(std::equal(again.begin(), again.end(), payload.begin()), "accepted regions have only one form");
  Bytes plane(std::min<std::size_t>(std::size_t{regions.width} * regions.height, kCapacity));
  if (version2::unpackColorPlane(packed, packed_size, plane.size(), plane.data()) == nullptr) {
    Bytes once_more(version2::packedColorPlaneSize(plane.size()));
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
  if (version2::decodeErrorMessage(payload.data(), payload.size(), &message) == nullptr) {
    require(message.text_size + 2 == payload.size(), "the text is the rest");
    Bytes again(std::min(payload.size(), version2::MAX_ERROR_MESSAGE_SIZE));
    require(version2::encodeErrorMessage(message, again.data()) <= again.size(),
            "a message is not larger than its maximum");
  }
}

// The same for both of its texts.
void decodeEndMessage(const Bytes& payload) {
  version2::EndMessage message;
  if (version2::decodeEndMessage(payload.data(), payload.size(), &message) == nullptr) {
    require(4 + message.name_size + 1 + message.reason_size == payload.size(), "name and reason are the rest");
    Bytes again(std::min(payload.size(), version2::MAX_END_MESSAGE_SIZE));
    require(version2::encodeEndMessage(message, again.data()) <= again.size(),
            "a message is not larger than its maximum");
  }
}

void decodeAsEverything(const Bytes& payload) {
  decode(version2::decodePictureRequest, version2::encodePictureRequest, payload);
  decode(version2::decodeStreamSettings, version2::encodeStreamSettings, payload);
  decode(version2::decodeJointTargets, version2::encodeJointTargets, payload);
  decode(version2::decodeSpeedLimits, version2::encodeSpeedLimits, payload);
  decode(version2::decodeTelemetryPeriod, version2::encodeTelemetryPeriod, payload);
  decode(version2::decodeTelemetry, version2::encodeTelemetry, payload);
  decode(version2::decodeMotorState, version2::encodeMotorState, payload);
  decode(version2::decodeJointIds, version2::encodeJointIds, payload);
  decode(version2::decodeLedValues, version2::encodeLedValues, payload);
  decode(version2::decodeEarPositions, version2::encodeEarPositions, payload);
  decode(version2::decodeColorSettings, version2::encodeColorSettings, payload);
  decode(version2::decodeColorTable, version2::encodeColorTable, payload);
  decode(version2::decodeDatagramPort, version2::encodeDatagramPort, payload);
  decode(version2::decodeAcknowledgement, version2::encodeAcknowledgement, payload);
  decode(version2::decodeLossReport, version2::encodeLossReport, payload);
  decode(version2::decodeVelocity, version2::encodeVelocity, payload);
  decode(version2::decodeMotionUpload, version2::encodeMotionUpload, payload);
  decode(decodeName, encodeName, payload);
  decode(version2::decodeMotionOrder, version2::encodeMotionOrder, payload);
  decode(version2::decodeMotionList, version2::encodeMotionList, payload);
  decode(decodeStickName, encodeStickName, payload);
  decode(version2::decodePictureList, version2::encodePictureList, payload);
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
