#include "protocol/version2.h"

#include <string.h>

#include "protocol/big_endian.h"
#include "protocol/text.h"

namespace protocol {
namespace version2 {

namespace {

const char REPLY_NEWER_VERSION = 'x';

const size_t JOINT_TARGETS_HEADER_SIZE = 4;
const size_t TELEMETRY_HEADER_SIZE = 8;
const size_t ERROR_CODE_SIZE = 2;
const size_t END_HEADER_SIZE = 4;
const char END_SEPARATOR = '\n';

// A joint's value and a telemetry entry share a layout: two bytes, uint16 0, int32 value.
const size_t ENTRY_SIZE = 8;
const size_t LED_ENTRY_SIZE = 4;

const char WRONG_SIZE[] = "the payload does not have the size that this kind of frame has";
const char WRONG_COUNT[] = "the count does not match the size of the payload";
const char RESERVED_NOT_ZERO[] = "a reserved byte is not 0";
const char UNKNOWN_LAYER[] = "the layer is not 0 (H), 1 (M), 2 (L) or 3 (double)";
const char TOO_MANY_JOINTS[] = "more joints than any robot has";
const char TEXT_NOT_PLAIN[] = "the text is not UTF-8 or holds control characters";
const char JOINT_TWICE[] = "a joint is named twice";

void encodeEntry(unsigned char first, unsigned char second, int value, unsigned char* out) {
  out[0] = first;
  out[1] = second;
  encodeBigEndian16(0, out + 2);
  encodeBigEndianSigned32(value, out + 4);
}

size_t encodeJointValues(const JointValue* joints, size_t count, unsigned char* out) {
  for (size_t i = 0; i < count; ++i) {
    encodeEntry(joints[i].id, 0, joints[i].value, out + i * ENTRY_SIZE);
  }
  return count * ENTRY_SIZE;
}

// Entries begin with an id. True if an entry before this one has the same id.
bool isNamedBefore(const unsigned char* in, size_t index, size_t entry_size) {
  for (size_t i = 0; i < index; ++i) {
    if (in[i * entry_size] == in[index * entry_size]) {
      return true;
    }
  }
  return false;
}

const char* checkJointValues(const unsigned char* in, size_t count) {
  if (count > MAX_JOINTS) {
    return TOO_MANY_JOINTS;
  }
  for (size_t i = 0; i < count; ++i) {
    const unsigned char* entry = in + i * ENTRY_SIZE;
    if (entry[1] != 0 || decodeBigEndian16(entry + 2) != 0) {
      return RESERVED_NOT_ZERO;
    }
    if (isNamedBefore(in, i, ENTRY_SIZE)) {
      return JOINT_TWICE;
    }
  }
  return NULL;
}

void decodeJointValues(const unsigned char* in, size_t count, JointValue* joints) {
  for (size_t i = 0; i < count; ++i) {
    joints[i].id = in[i * ENTRY_SIZE];
    joints[i].value = decodeBigEndianSigned32(in + i * ENTRY_SIZE + 4);
  }
}

const char* checkLedValues(const unsigned char* in, size_t count) {
  if (count > MAX_LEDS) {
    return "more LEDs than any robot has";
  }
  for (size_t i = 0; i < count; ++i) {
    const unsigned char* entry = in + i * LED_ENTRY_SIZE;
    if (entry[2] > LED_MODE_B) {
      return "the mode of an LED is neither 0 (A) nor 1 (B)";
    }
    if (entry[3] != 0) {
      return RESERVED_NOT_ZERO;
    }
    if (isNamedBefore(in, i, LED_ENTRY_SIZE)) {
      return "an LED is named twice";
    }
  }
  return NULL;
}

const char* checkTelemetryEntries(const unsigned char* in, size_t count) {
  if (count > MAX_TELEMETRY_ENTRIES) {
    return "more values than any robot measures";
  }
  for (size_t i = 0; i < count; ++i) {
    const unsigned char* entry = in + i * ENTRY_SIZE;
    if (entry[0] != GROUP_JOINT && entry[0] != GROUP_SENSOR && entry[0] != GROUP_DUTY && entry[0] != GROUP_WALK) {
      return "the group of a value is not one of J, S, D and W";
    }
    if (decodeBigEndian16(entry + 2) != 0) {
      return RESERVED_NOT_ZERO;
    }
  }
  return NULL;
}

}  // namespace

BasicGetCommand versionRequest() {
  BasicGetCommand request;
  request.command = REQUEST_NEWER_VERSION;
  request.identifier = VERSION;
  return request;
}

ValueReply versionReply() {
  ValueReply reply;
  reply.letter = REPLY_NEWER_VERSION;
  reply.identifier = VERSION;
  reply.value = 0;
  return reply;
}

bool agreesToVersion2(const ValueReply& reply) {
  return reply.letter == REPLY_NEWER_VERSION && reply.identifier == VERSION && reply.value == 0;
}

size_t encodeFrameHeader(const FrameHeader& header, unsigned char* out) {
  out[0] = static_cast<unsigned char>(header.kind);
  out[1] = header.id;
  encodeBigEndian16(header.request_number, out + 2);
  encodeBigEndian32(header.payload_size, out + 4);
  return FRAME_HEADER_SIZE;
}

FrameHeader decodeFrameHeader(const unsigned char* in) {
  FrameHeader header;
  header.kind = static_cast<char>(in[0]);
  header.id = in[1];
  header.request_number = decodeBigEndian16(in + 2);
  header.payload_size = decodeBigEndian32(in + 4);
  return header;
}

char replyKind(char request_kind) {
  return static_cast<char>(request_kind - 'A' + 'a');
}

bool isError(char kind, size_t payload_size) {
  return kind == ERROR_MESSAGE && payload_size > 0;
}

size_t encodePictureRequest(Layer layer, unsigned char* out) {
  out[0] = static_cast<unsigned char>(layer);
  return PICTURE_REQUEST_SIZE;
}

const char* decodePictureRequest(const unsigned char* payload, size_t size, Layer* layer) {
  if (size != PICTURE_REQUEST_SIZE) {
    return WRONG_SIZE;
  }
  if (payload[0] > LAYER_DOUBLE) {
    return UNKNOWN_LAYER;
  }
  *layer = static_cast<Layer>(payload[0]);
  return NULL;
}

size_t encodeStreamSettings(const StreamSettings& settings, unsigned char* out) {
  out[0] = settings.on ? 1 : 0;
  out[1] = static_cast<unsigned char>(settings.layer);
  encodeBigEndian16(settings.every_nth_image, out + 2);
  return STREAM_SETTINGS_SIZE;
}

const char* decodeStreamSettings(const unsigned char* payload, size_t size, StreamSettings* settings) {
  if (size != STREAM_SETTINGS_SIZE) {
    return WRONG_SIZE;
  }
  if (payload[0] > 1) {
    return "the stream is neither off (0) nor on (1)";
  }
  if (payload[1] > LAYER_DOUBLE) {
    return UNKNOWN_LAYER;
  }
  if (decodeBigEndian16(payload + 2) == 0) {
    return "the image interval is 0; 1 means every image";
  }
  settings->on = payload[0] == 1;
  settings->layer = static_cast<Layer>(payload[1]);
  settings->every_nth_image = decodeBigEndian16(payload + 2);
  return NULL;
}

size_t encodeJointTargets(const JointTargets& targets, unsigned char* out) {
  encodeBigEndian16(targets.duration_ms, out);
  out[2] = targets.count;
  out[3] = 0;
  return JOINT_TARGETS_HEADER_SIZE + encodeJointValues(targets.joints, targets.count, out + JOINT_TARGETS_HEADER_SIZE);
}

const char* decodeJointTargets(const unsigned char* payload, size_t size, JointTargets* targets) {
  if (size < JOINT_TARGETS_HEADER_SIZE) {
    return WRONG_SIZE;
  }
  const unsigned char count = payload[2];
  if (payload[3] != 0) {
    return RESERVED_NOT_ZERO;
  }
  if (size != JOINT_TARGETS_HEADER_SIZE + count * ENTRY_SIZE) {
    return WRONG_COUNT;
  }
  const unsigned char* entries = payload + JOINT_TARGETS_HEADER_SIZE;
  if (const char* problem = checkJointValues(entries, count)) {
    return problem;
  }
  targets->duration_ms = decodeBigEndian16(payload);
  targets->count = count;
  decodeJointValues(entries, count, targets->joints);
  return NULL;
}

size_t encodeSpeedLimits(const SpeedLimits& limits, unsigned char* out) {
  return encodeJointValues(limits.joints, limits.count, out);
}

const char* decodeSpeedLimits(const unsigned char* payload, size_t size, SpeedLimits* limits) {
  if (size % ENTRY_SIZE != 0) {
    return WRONG_SIZE;
  }
  const size_t count = size / ENTRY_SIZE;
  if (const char* problem = checkJointValues(payload, count)) {
    return problem;
  }
  limits->count = static_cast<unsigned char>(count);
  decodeJointValues(payload, count, limits->joints);
  return NULL;
}

size_t encodeTelemetryPeriod(unsigned short frames, unsigned char* out) {
  encodeBigEndian16(frames, out);
  return TELEMETRY_PERIOD_SIZE;
}

const char* decodeTelemetryPeriod(const unsigned char* payload, size_t size, unsigned short* frames) {
  if (size != TELEMETRY_PERIOD_SIZE) {
    return WRONG_SIZE;
  }
  *frames = decodeBigEndian16(payload);
  return NULL;
}

size_t encodeMotorState(bool on, unsigned char* out) {
  out[0] = on ? 1 : 0;
  return MOTOR_STATE_SIZE;
}

const char* decodeMotorState(const unsigned char* payload, size_t size, bool* on) {
  if (size != MOTOR_STATE_SIZE) {
    return WRONG_SIZE;
  }
  if (payload[0] > 1) {
    return "the motors are neither off (0) nor on (1)";
  }
  *on = payload[0] == 1;
  return NULL;
}

size_t encodeMotorsAndPosture(const MotorsAndPosture& state, unsigned char* out) {
  out[0] = state.motors_on ? 1 : 0;
  out[1] = state.posture;
  encodeBigEndian16(0, out + 2);
  return MOTORS_AND_POSTURE_SIZE;
}

const char* decodeMotorsAndPosture(const unsigned char* payload, size_t size, MotorsAndPosture* state) {
  if (size != MOTORS_AND_POSTURE_SIZE) {
    return WRONG_SIZE;
  }
  if (payload[0] > 1) {
    return "the motors are neither off (0) nor on (1)";
  }
  if (decodeBigEndian16(payload + 2) != 0) {
    return RESERVED_NOT_ZERO;
  }
  state->motors_on = payload[0] == 1;
  state->posture = payload[1];
  return NULL;
}

size_t encodeJointIds(const JointIds& joints, unsigned char* out) {
  memcpy(out, joints.ids, joints.count);
  return joints.count;
}

const char* decodeJointIds(const unsigned char* payload, size_t size, JointIds* joints) {
  if (size == 0) {
    return "no joint is named";
  }
  if (size > MAX_JOINTS) {
    return TOO_MANY_JOINTS;
  }
  for (size_t i = 0; i < size; ++i) {
    if (isNamedBefore(payload, i, 1)) {
      return JOINT_TWICE;
    }
  }
  joints->count = static_cast<unsigned char>(size);
  memcpy(joints->ids, payload, size);
  return NULL;
}

size_t encodeTelemetry(const Telemetry& telemetry, unsigned char* out) {
  encodeBigEndian32(telemetry.frame_number, out);
  encodeBigEndian16(telemetry.count, out + 4);
  encodeBigEndian16(0, out + 6);
  unsigned char* entry = out + TELEMETRY_HEADER_SIZE;
  for (size_t i = 0; i < telemetry.count; ++i, entry += ENTRY_SIZE) {
    const TelemetryEntry& value = telemetry.entries[i];
    encodeEntry(static_cast<unsigned char>(value.group), value.id, value.value, entry);
  }
  return TELEMETRY_HEADER_SIZE + telemetry.count * ENTRY_SIZE;
}

const char* decodeTelemetry(const unsigned char* payload, size_t size, Telemetry* telemetry) {
  if (size < TELEMETRY_HEADER_SIZE) {
    return WRONG_SIZE;
  }
  const unsigned short count = decodeBigEndian16(payload + 4);
  if (decodeBigEndian16(payload + 6) != 0) {
    return RESERVED_NOT_ZERO;
  }
  if (size != TELEMETRY_HEADER_SIZE + count * ENTRY_SIZE) {
    return WRONG_COUNT;
  }
  const unsigned char* entry = payload + TELEMETRY_HEADER_SIZE;
  if (const char* problem = checkTelemetryEntries(entry, count)) {
    return problem;
  }
  telemetry->frame_number = decodeBigEndian32(payload);
  telemetry->count = count;
  for (size_t i = 0; i < count; ++i, entry += ENTRY_SIZE) {
    telemetry->entries[i].group = static_cast<char>(entry[0]);
    telemetry->entries[i].id = entry[1];
    telemetry->entries[i].value = decodeBigEndianSigned32(entry + 4);
  }
  return NULL;
}

size_t encodeLedValues(const LedValues& values, unsigned char* out) {
  for (size_t i = 0; i < values.count; ++i, out += LED_ENTRY_SIZE) {
    out[0] = values.leds[i].id;
    out[1] = values.leds[i].intensity;
    out[2] = static_cast<unsigned char>(values.leds[i].mode);
    out[3] = 0;
  }
  return values.count * LED_ENTRY_SIZE;
}

const char* decodeLedValues(const unsigned char* payload, size_t size, LedValues* values) {
  if (size % LED_ENTRY_SIZE != 0) {
    return WRONG_SIZE;
  }
  const size_t count = size / LED_ENTRY_SIZE;
  if (const char* problem = checkLedValues(payload, count)) {
    return problem;
  }
  values->count = static_cast<unsigned char>(count);
  for (size_t i = 0; i < count; ++i, payload += LED_ENTRY_SIZE) {
    values->leds[i].id = payload[0];
    values->leds[i].intensity = payload[1];
    values->leds[i].mode = static_cast<LedMode>(payload[2]);
  }
  return NULL;
}

size_t encodeEarPositions(const EarPositions& positions, unsigned char* out) {
  out[0] = positions.left ? 1 : 0;
  out[1] = positions.right ? 1 : 0;
  return EAR_POSITIONS_SIZE;
}

const char* decodeEarPositions(const unsigned char* payload, size_t size, EarPositions* positions) {
  if (size != EAR_POSITIONS_SIZE) {
    return WRONG_SIZE;
  }
  if (payload[0] > 1 || payload[1] > 1) {
    return "an ear is neither drawn (1) nor let go (0)";
  }
  positions->left = payload[0] == 1;
  positions->right = payload[1] == 1;
  return NULL;
}

const char* checkNoPayload(size_t size) {
  return size == 0 ? NULL : WRONG_SIZE;
}

size_t encodeImageHeader(const ImageHeader& header, unsigned char* out) {
  encodeBigEndian32(header.image_count, out);
  encodeBigEndian32(header.frame_number, out + 4);
  encodeBigEndian16(header.width, out + 8);
  encodeBigEndian16(header.height, out + 10);
  out[12] = header.quality;
  out[13] = static_cast<unsigned char>(header.layer);
  encodeBigEndian16(packCameraSettings(header.settings), out + 14);
  return IMAGE_HEADER_SIZE;
}

const char* decodePicture(const unsigned char* payload, size_t size, ImageHeader* header, size_t* jpeg_size) {
  if (size <= IMAGE_HEADER_SIZE) {
    return "there is no picture after the image header";
  }
  if (decodeBigEndian16(payload + 8) == 0 || decodeBigEndian16(payload + 10) == 0) {
    return "the picture has no width or no height";
  }
  if (payload[12] > MAX_JPEG_QUALITY) {
    return "the JPEG quality is above 100";
  }
  if (payload[13] > LAYER_DOUBLE) {
    return UNKNOWN_LAYER;
  }
  if (const char* problem = unpackCameraSettings(decodeBigEndian16(payload + 14), &header->settings)) {
    return problem;
  }
  header->image_count = decodeBigEndian32(payload);
  header->frame_number = decodeBigEndian32(payload + 4);
  header->width = decodeBigEndian16(payload + 8);
  header->height = decodeBigEndian16(payload + 10);
  header->quality = payload[12];
  header->layer = static_cast<Layer>(payload[13]);
  *jpeg_size = size - IMAGE_HEADER_SIZE;
  return NULL;
}

size_t encodeErrorMessage(const ErrorMessage& message, unsigned char* out) {
  const size_t text_size = sizeOfWholeCharacters(message.text, message.text_size, MAX_ERROR_TEXT_SIZE);
  encodeBigEndian16(message.code, out);
  memcpy(out + ERROR_CODE_SIZE, message.text, text_size);
  return ERROR_CODE_SIZE + text_size;
}

const char* decodeErrorMessage(const unsigned char* payload, size_t size, ErrorMessage* message) {
  if (size < ERROR_CODE_SIZE) {
    return WRONG_SIZE;
  }
  const char* text = reinterpret_cast<const char*>(payload + ERROR_CODE_SIZE);
  const size_t text_size = size - ERROR_CODE_SIZE;
  if (!isPlainText(text, text_size)) {
    return TEXT_NOT_PLAIN;
  }
  message->code = decodeBigEndian16(payload);
  message->text = text;
  message->text_size = text_size;
  return NULL;
}

size_t encodeEndMessage(const EndMessage& message, unsigned char* out) {
  const size_t name_size = sizeOfWholeCharacters(message.name, message.name_size, MAX_END_NAME_SIZE);
  const size_t reason_size = sizeOfWholeCharacters(message.reason, message.reason_size, MAX_END_REASON_SIZE);
  out[0] = message.what;
  out[1] = message.how;
  encodeBigEndian16(0, out + 2);
  unsigned char* text = out + END_HEADER_SIZE;
  memcpy(text, message.name, name_size);
  text[name_size] = END_SEPARATOR;
  memcpy(text + name_size + 1, message.reason, reason_size);
  return END_HEADER_SIZE + name_size + 1 + reason_size;
}

const char* decodeEndMessage(const unsigned char* payload, size_t size, EndMessage* message) {
  if (size < END_HEADER_SIZE) {
    return WRONG_SIZE;
  }
  if (decodeBigEndian16(payload + 2) != 0) {
    return RESERVED_NOT_ZERO;
  }
  const char* name = reinterpret_cast<const char*>(payload + END_HEADER_SIZE);
  const char* end = reinterpret_cast<const char*>(payload + size);
  const char* separator = static_cast<const char*>(memchr(name, END_SEPARATOR, end - name));
  if (separator == NULL) {
    return "there is no newline after the name";
  }
  if (!isPlainText(name, separator - name) || !isPlainText(separator + 1, end - separator - 1)) {
    return TEXT_NOT_PLAIN;
  }
  message->what = payload[0];
  message->how = payload[1];
  message->name = name;
  message->name_size = separator - name;
  message->reason = separator + 1;
  message->reason_size = end - separator - 1;
  return NULL;
}

}  // namespace version2
}  // namespace protocol
