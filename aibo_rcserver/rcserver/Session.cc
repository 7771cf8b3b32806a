#include "rcserver/Session.h"

#include <string.h>

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
      motions_(robot.joints, robot.motors, files_, settings),
      stick_pictures_(camera_, files_, settings),
      version1_(robot_, settings, files_, motions_, camera_, outbox_, payload_),
      version2_(robot_, settings, files_, motions_, stick_pictures_, camera_, outbox_),
      is_stranger_(false),
      has_requested_(false),
      frame_reader_(payload_, sizeof(payload_)),
      has_request_(false),
      has_requests_(false),
      input_begin_(0),
      input_end_(0) {}

void Session::Begin() {
  version_ = 1;
  is_over_ = false;
  power_reason_ = "it switched the robot off";
  has_request_ = false;
  has_requests_ = false;
  input_begin_ = 0;
  input_end_ = 0;
  opening_ = protocol::Opening();
  is_stranger_ = false;
  has_requested_ = false;
  request_reader_.reset();
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
  robot_.datagrams.SendTo(0);
  robot_.colors.ClientGone();
  Begin();
}

bool Session::WantsInput() const {
  return !IsEnding() && !has_requests_ && input_begin_ == input_end_;
}

void Session::AddInput(const unsigned char* bytes, size_t size) {
  if (version_ == 1) {
    request_reader_.append(bytes, size);
    opening_.add(bytes, size);
    has_requests_ = !IsWithStranger();
    return;
  }
  memcpy(input_, bytes, size);
  input_begin_ = 0;
  input_end_ = size;
}

void Session::HandleRequests(unsigned now) {
  if (version_ == 1) {
    HandleVersion1();
  }
  if (version_ == protocol::version2::VERSION) {
    HandleVersion2(now);
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

// A client of version 1 would take an unasked message for the answer to its next request.
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
  const size_t image_header_size = encodeImageHeader(HeaderToTell(image), out + protocol::version2::FRAME_HEADER_SIZE);
  const FrameHeader header = {protocol::version2::PICTURE, image.quality, order.request_number,
                              static_cast<unsigned>(image_header_size + jpeg_size)};
  return encodeFrameHeader(header, out) + image_header_size;
}

void Session::HandleVersion1() {
  // The answer to an upload, or to a request that waits for the memory stick, goes into room that is reserved for it.
  while (version_ == 1 && !IsEnding() && has_requests_) {
    has_requests_ = version1_.TakeContent(request_reader_);
    outbox_.Reserve(files_.IsPending());
    if (!has_requests_ || files_.IsPending() || !outbox_.HasRoom() || !HandleRequestOfVersion1()) {
      return;
    }
  }
}

// False if there is no complete request, or if it has to wait.
bool Session::HandleRequestOfVersion1() {
  has_request_ = has_request_ || request_reader_.next(&request_);
  has_requests_ = has_request_ && !MayBeHttp();
  if (!has_requests_) {
    return false;
  }
  has_requested_ = true;
  const bool asks_for_version2 = request_.valid && request_.basic.command == protocol::REQUEST_NEWER_VERSION &&
                                 request_.basic.identifier == protocol::version2::VERSION;
  if (asks_for_version2 && newest_version_ >= protocol::version2::VERSION) {
    has_request_ = false;
    ChangeToVersion2();
    return false;
  }
  has_request_ = !version1_.Handle(request_);
  outbox_.Reserve(files_.IsPending());
  return !has_request_;
}

// Such a request waits for the next byte. No client's is followed by one that leaves the question open.
bool Session::MayBeHttp() {
  const bool may_be = opening_.verdict() == protocol::Opening::UNCLEAR && request_.valid && request_.payload_size > 0;
  is_stranger_ = may_be && !request_reader_.isEmpty();
  return may_be;
}

void Session::HandleVersion2(unsigned now) {
  while (MayHandleVersion2() && ReadFrame()) {
    version2_.Handle(frame_reader_.header(), frame_reader_.payload(), now);
    outbox_.Reserve(files_.IsPending());
  }
}

// Reports and the request that waits for the memory stick go before new requests. False if those have to wait.
bool Session::MayHandleVersion2() {
  version2_.PushReports();
  if (!IsEnding() && outbox_.HasRoom()) {
    version2_.HandleWaiting();
    outbox_.Reserve(files_.IsPending());
  }
  return !IsEnding() && outbox_.HasRoom();
}

// False if there is no complete frame, or if it is too large, which ends the session.
bool Session::ReadFrame() {
  while (input_begin_ < input_end_) {
    size_t taken = 0;
    const FrameReader::Result result = frame_reader_.append(input_ + input_begin_, input_end_ - input_begin_, &taken);
    input_begin_ += taken;
    if (result == FrameReader::FRAME_COMPLETE) {
      return true;
    }
    if (result == FrameReader::FRAME_TOO_LARGE) {
      version2_.RefuseTooLarge(frame_reader_.header());
      is_over_ = true;
      return false;
    }
  }
  return false;
}

// Bytes after the request belong to version 2.
void Session::ChangeToVersion2() {
  unsigned char message[protocol::VALUE_REPLY_SIZE];
  protocol::encodeValueReply(protocol::version2::versionReply(), message);
  outbox_.Add(message, sizeof(message));
  version_ = protocol::version2::VERSION;
  has_requests_ = false;
  input_begin_ = 0;
  input_end_ = request_reader_.takeWaiting(input_);
}
