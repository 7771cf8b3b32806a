#include "client/version1_requests.h"

#include "protocol/motion_requests.h"
#include "protocol/version1.h"
#include "protocol/version2.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

/// The payload that the call has in version 2.
template <typename Payload>
Payload payloadOf(const Call& call) {
  Payload payload = {};
  version2::decode(call.payload.data(), call.payload.size(), &payload);
  return payload;
}

/// A request about the motion that the call is for.
/// @param repetitions used only to play the motion
/// @param content used only to store the motion
Call::Bytes motionRequest(const Call& call, unsigned short repetitions, const unsigned char* content,
                          std::size_t content_size) {
  protocol::FileRequest file = {};
  call.object.copy(file.name, protocol::MAX_MOTION_NAME_SIZE);
  file.a = repetitions;
  if (content_size > 0) {
    protocol::announceContent(content_size, &file);
  }
  Call::Bytes bytes(protocol::FILE_REQUEST_SIZE);
  bytes[0] = static_cast<std::uint8_t>(call.request.letter);
  protocol::encodeFileRequest(file, bytes.data() + protocol::BASIC_COMMAND_SIZE);
  bytes.insert(bytes.end(), content, content + content_size);
  return bytes;
}

std::string allowedBy(const std::string& setting) {
  return "is it allowed? OPEN-R/MW/CONF/RCSERVER.CFG on the robot's memory stick needs a line " + setting +
         "=yes; it is read when the robot starts";
}

std::string explain(const Call& call, int code) {
  if (code == protocol::ERROR_FILE_MISSING) {
    return "there is no such file in OPEN-R/MW/DATA/P on its memory stick, or it cannot be read";
  }
  if (code == protocol::ERROR_NOT_A_MOTION) {
    return "it does not accept this as the name of a motion";
  }
  if (call.request.setting != nullptr) {
    return allowedBy(call.request.setting);
  }
  return call.request.letter == version2::REQUEST_PLAY ? "are its motors on, and is the file a motion for this robot?"
                                                       : "";
}

}  // namespace

VersionAnswer takeVersionAnswer(Call::Bytes* bytes) {
  if (bytes->size() < protocol::VALUE_REPLY_SIZE) {
    return VersionAnswer::kNone;
  }
  const protocol::ValueReply reply = protocol::decodeValueReply(bytes->data());
  if (reply.letter != version2::versionReply().letter && reply.letter != protocol::REPLY_ERROR) {
    return VersionAnswer::kNone;
  }
  bytes->erase(bytes->begin(), bytes->begin() + protocol::VALUE_REPLY_SIZE);
  return version2::agreesToVersion2(reply) ? VersionAnswer::kVersion2 : VersionAnswer::kVersion1;
}

Call::Bytes version1Command(char letter, int identifier) {
  protocol::BasicGetCommand command;
  command.command = letter;
  command.identifier = static_cast<unsigned char>(identifier);
  Call::Bytes bytes(protocol::BASIC_COMMAND_SIZE);
  protocol::encodeCommand(command, bytes.data());
  return bytes;
}

// A request that sets a value has the layout of its reply.
Call::Bytes version1SetCommand(char letter, int identifier, short value) {
  protocol::ValueReply request;
  request.letter = letter;
  request.identifier = static_cast<unsigned char>(identifier);
  request.value = value;
  Call::Bytes bytes(protocol::VALUE_REQUEST_SIZE);
  protocol::encodeValueReply(request, bytes.data());
  return bytes;
}

Call::Bytes version1Request(const Call& call) {
  switch (call.request.letter) {
    case version2::REQUEST_PLAY:
      return motionRequest(call, payloadOf<version2::MotionOrder>(call).repetitions, nullptr, 0);
    case version2::REQUEST_UPLOAD: {
      const auto upload = payloadOf<version2::MotionUpload>(call);
      return motionRequest(call, 0, upload.content, upload.content_size);
    }
    case version2::REQUEST_DELETE:
      return motionRequest(call, 0, nullptr, 0);
    case version2::REQUEST_SHUT_DOWN:
    case version2::REQUEST_REBOOT:
      return version1SetCommand(call.request.letter, 0, 0);
    default:
      return {};
  }
}

bool isKnownToVersion1(const Call& call) {
  return call.isForPicture() ? call.resolution.value_or(Resolution::kHigh) == Resolution::kHigh
                             : !version1Request(call).empty();
}

std::string explainRefusal(const Call& call, int code) {
  const std::string code_text = "error code " + std::to_string(code);
  const std::string hint = call.isForPicture() ? "" : explain(call, code);
  return hint.empty() ? code_text : hint + " (" + code_text + ")";
}

}  // namespace aibo_client
