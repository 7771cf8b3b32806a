#include "client/call.h"

#include <algorithm>

#include "protocol/motion_requests.h"

namespace aibo_driver {

namespace version2 = protocol::version2;

namespace {

std::string allowedBy(const std::string& setting) {
  return "is it allowed? OPEN-R/MW/CONF/RCSERVER.CFG on the robot's memory stick has to have a line " + setting +
         "=yes; it is read when the robot starts";
}

/// @param name of a motion, or empty
void copyName(const std::string& name, protocol::MotionName& out) {
  name.copy(out, protocol::MAX_MOTION_NAME_SIZE);
  out[name.size()] = '\0';
}

RobotRequest::Bytes encodeFileRequest(const RobotRequest& request) {
  protocol::FileRequest file = {};
  copyName(request.name, file.name);
  file.a = static_cast<unsigned short>(request.number);
  if (!request.content.empty()) {
    protocol::announceContent(request.content.size(), &file);
  }
  RobotRequest::Bytes bytes(protocol::FILE_REQUEST_SIZE);
  bytes[0] = static_cast<std::uint8_t>(request.letter);
  protocol::encodeFileRequest(file, bytes.data() + protocol::BASIC_COMMAND_SIZE);
  bytes.insert(bytes.end(), request.content.begin(), request.content.end());
  return bytes;
}

std::size_t encodeUpload(const RobotRequest& request, unsigned char* out) {
  version2::MotionUpload upload = {};
  copyName(request.name, upload.name);
  upload.content = request.content.data();
  upload.content_size = request.content.size();
  return version2::encodeMotionUpload(upload, out);
}

std::size_t encodeName(const RobotRequest& request, unsigned char* out) {
  protocol::MotionName name;
  copyName(request.name, name);
  return version2::encodeMotionName(name, out);
}

std::size_t encodeOrder(const RobotRequest& request, unsigned char* out) {
  version2::MotionOrder order = {};
  copyName(request.name, order.name);
  order.repetitions = static_cast<unsigned short>(request.number);
  return version2::encodeMotionOrder(order, out);
}

std::size_t encodePayload(const RobotRequest& request, unsigned char* out) {
  switch (request.letter) {
    case version2::REQUEST_MOTORS:
      return version2::encodeMotorState(request.number != 0, out);
    case version2::REQUEST_UPLOAD:
      return encodeUpload(request, out);
    case version2::REQUEST_DELETE:
      return encodeName(request, out);
    case version2::REQUEST_PLAY:
      return encodeOrder(request, out);
    default:
      return 0;
  }
}

}  // namespace

std::string describe(const RobotRequest& request) {
  switch (request.letter) {
    case version2::REQUEST_MOTORS:
      return request.number != 0 ? "switch the motors on" : "switch the motors off";
    case version2::REQUEST_UPLOAD:
      return "store the motion " + request.name;
    case version2::REQUEST_DELETE:
      return "delete the motion " + request.name;
    case version2::REQUEST_PLAY:
      return (request.number != 0 ? "play " : "stop ") +
             (request.name.empty() ? "all motions" : "the motion " + request.name);
    case version2::REQUEST_LIST:
      return "list its motions";
    case version2::REQUEST_SHUT_DOWN:
      return "shut down";
    default:
      return "reboot";
  }
}

std::string explainRefusal(const RobotRequest& request, int code) {
  switch (code) {
    case protocol::ERROR_FILE_MISSING:
      return "there is no such file in OPEN-R/MW/DATA/P on its memory stick, or it cannot be read";
    case protocol::ERROR_NOT_A_MOTION:
      return "it does not take this for the name of a motion";
    default:
      break;
  }
  switch (request.letter) {
    case version2::REQUEST_UPLOAD:
      return allowedBy("ALLOW_UPLOAD");
    case version2::REQUEST_DELETE:
      return allowedBy("ALLOW_DELETE");
    case version2::REQUEST_PLAY:
      return "are its motors on, and is the file a motion for this robot?";
    case version2::REQUEST_SHUT_DOWN:
      return allowedBy("ALLOW_SHUT_DOWN");
    case version2::REQUEST_REBOOT:
      return allowedBy("ALLOW_REBOOT");
    default:
      return "it does not say why";
  }
}

bool takesOverJoints(const RobotRequest& request) {
  return request.letter == version2::REQUEST_MOTORS || (request.letter == version2::REQUEST_PLAY && request.number > 0);
}

bool isKnownToVersion1(const RobotRequest& request) {
  return request.letter != version2::REQUEST_MOTORS && request.letter != version2::REQUEST_LIST;
}

RobotRequest::Bytes encodeForVersion1(const RobotRequest& request) {
  const bool about_motion = request.letter != protocol::REQUEST_SHUT_DOWN && request.letter != protocol::REQUEST_REBOOT;
  if (about_motion) {
    return encodeFileRequest(request);
  }
  return {static_cast<std::uint8_t>(request.letter), 0, 0, 0};
}

RobotRequest::Bytes encodeForVersion2(const RobotRequest& request) {
  RobotRequest::Bytes payload(protocol::FILE_REQUEST_SIZE + request.content.size());  // no other is longer
  payload.resize(encodePayload(request, payload.data()));
  return payload;
}

}  // namespace aibo_driver
