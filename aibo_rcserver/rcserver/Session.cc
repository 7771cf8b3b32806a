#include "rcserver/Session.h"

using protocol::version2::FrameHeader;
using protocol::version2::FrameReader;

const size_t Session::INPUT_CAPACITY;
const size_t Session::MAX_PICTURE_HEADER_SIZE;

Session::Session(const Robot& robot, const Settings& settings, int newest_version)
    : robot_(robot),
      newest_version_(newest_version),
      version_(1),
      is_over_(false),
      power_reason_(NULL),
      files_(robot.files),
      motions_(robot.joints, robot.motors, files_),
      version1_(robot_, settings, motions_, camera_, outbox_, payload_),
      version2_(robot_, settings, files_, motions_, camera_, outbox_),
      is_stranger_(false),
      has_requested_(false),
      frame_reader_(payload_, sizeof(payload_)),
      has_request_(false),
      has_input_(false) {}

void Session::Begin() {
  version_ = 1;
  is_over_ = false;
  power_reason_ = "it switched the robot off";
  has_request_ = false;
  has_input_ = false;
  opening_ = protocol::Opening();
  is_stranger_ = false;
  has_requested_ = false;
  input_.reset();
  frame_reader_.reset();
  outbox_.Clear();
  files_.Begin();
  version1_.Begin();
  version2_.Begin();
}

void Session::End() {
  camera_.ClientGone();
  robot_.joints.ClientGone();
  robot_.lights.ClientGone();
  robot_.camera.ClientGone();
  robot_.datagrams.Stop();
  robot_.colors.ClientGone();
  robot_.microphone.ClientGone();
  robot_.speaker.ClientGone();
  Begin();
}

void Session::AddInput(const unsigned char* bytes, size_t size) {
  input_.append(bytes, size);
  if (version_ == 1) {
    opening_.add(bytes, size);
  }
  has_input_ = !IsWithStranger();
}

void Session::HandleRequests(unsigned now) {
  while (MayHandle() && (version_ == 1 ? HandleRequest() : HandleFrame(now))) {
    outbox_.Reserve(files_.IsPending());
  }
}

void Session::FileDone(const FileResult& result) {
  if (!files_.Awaits(result)) {
    return;
  }
  if (version_ == 1) {
    version1_.FileDone(result);
  } else {
    version2_.FileDone(result);
  }
  outbox_.Reserve(false);
}

// A client of version 1 is not told, because it would take the message for the answer to its next request.
void Session::RobotGoesOff(const char* reason) {
  power_reason_ = reason;
  if (version_ == protocol::version2::VERSION) {
    version2_.PushPowerOff(reason);
  }
}

void Session::Measured(unsigned frame) {
  if (version_ == protocol::version2::VERSION) {
    version2_.Measured(frame);
  }
}

protocol::version2::ImageHeader Session::HeaderToTell(const protocol::version2::ImageHeader& image) const {
  protocol::version2::ImageHeader told = image;
  if (!version2_.TellsCameraSettings()) {
    told.settings = protocol::version2::CameraSettings();
  }
  return told;
}

void Session::ColorsDetected(const ColorPlane& plane, unsigned image_count, unsigned frame) {
  version2_.ColorsDetected(plane, image_count, frame);
}

size_t Session::EncodePictureHeader(const PictureOrder& order, const protocol::version2::ImageHeader& image,
                                    size_t jpeg_size, unsigned char* out) const {
  if (version_ == 1) {
    protocol::encodePictureHeader(jpeg_size, out);
    return protocol::PICTURE_HEADER_SIZE;
  }
  const size_t image_header_size = encode(HeaderToTell(image), out + protocol::version2::FRAME_HEADER_SIZE);
  const FrameHeader header = {protocol::version2::PICTURE, image.quality, order.request_number,
                              static_cast<unsigned>(image_header_size + jpeg_size)};
  return encode(header, out) + image_header_size;
}

// Handles reports and the content of an upload before new requests. False if new requests have to wait, so that replies
// of version 1 keep their order.
bool Session::MayHandle() {
  if (version_ == protocol::version2::VERSION) {
    version2_.PushReports();
  } else if (!IsEnding()) {
    has_input_ = has_input_ && version1_.TakeContent(input_);
    outbox_.Reserve(files_.IsPending());
  }
  return has_input_ && !IsEnding() && outbox_.HasRoom() && !(version_ == 1 && files_.IsPending());
}

// False if there is no complete request, or if it has to wait.
bool Session::HandleRequest() {
  has_request_ = has_request_ || input_.next(&request_);
  has_input_ = has_request_ && !MayBeHttp();
  if (!has_input_) {
    return false;
  }
  has_requested_ = true;
  has_request_ = false;
  if (AsksForVersion2()) {
    ChangeToVersion2();
  } else {
    version1_.Handle(request_);
  }
  return true;
}

// True if the request may be the beginning of HTTP. If more bytes follow it, the sender is not a client.
bool Session::MayBeHttp() {
  const bool may_be = opening_.verdict() == protocol::Opening::UNCLEAR && request_.valid && request_.payload_size > 0;
  is_stranger_ = may_be && input_.waitingSize() > 0;
  return may_be;
}

bool Session::AsksForVersion2() const {
  return newest_version_ >= protocol::version2::VERSION && request_.valid &&
         request_.basic.command == protocol::REQUEST_NEWER_VERSION &&
         request_.basic.identifier == protocol::version2::VERSION;
}

// Bytes after the request belong to version 2.
void Session::ChangeToVersion2() {
  unsigned char message[protocol::VALUE_REPLY_SIZE];
  protocol::encodeValueReply(protocol::version2::versionReply(), message);
  outbox_.Add(message, sizeof(message));
  version_ = protocol::version2::VERSION;
}

// False if there is no complete frame, or if it is too large, which ends the session.
bool Session::HandleFrame(unsigned now) {
  size_t taken = 0;
  const FrameReader::Result result = frame_reader_.append(input_.waiting(), input_.waitingSize(), &taken);
  input_.take(taken);
  has_input_ = input_.waitingSize() > 0;
  is_over_ = result == FrameReader::FRAME_TOO_LARGE;
  if (is_over_) {
    version2_.RefuseTooLarge(frame_reader_.header());
  } else if (result == FrameReader::FRAME_COMPLETE) {
    version2_.Handle(frame_reader_.header(), frame_reader_.payload(), now);
  }
  return result == FrameReader::FRAME_COMPLETE;
}
