#include "rcserver/Session.h"

using protocol::version2::FrameHeader;
using protocol::version2::FrameReader;

const size_t Session::INPUT_CAPACITY;
const size_t Session::MAX_PICTURE_HEADER_SIZE;

Session::Session(const Robot& robot, const Settings& settings, int newest_version)
    : robot_(robot),
      newest_version_(newest_version),
      files_(robot.files, robot.joints, robot.motors),
      outbox_(files_),
      version1_(robot_, settings, files_, pictures_, outbox_, payload_),
      version2_(robot_, settings, files_, pictures_, outbox_),
      frame_reader_(payload_, sizeof(payload_)) {}

void Session::Begin() {
  talk_ = Talk();
  frame_reader_.reset();
  outbox_.Clear();
  files_.Begin();
  version1_.Begin();
  version2_.Begin();
}

void Session::End() {
  pictures_.ClientGone();
  robot_.joints.ClientGone();
  robot_.lights.ClientGone();
  robot_.camera.ClientGone();
  robot_.datagrams.Stop();
  robot_.microphone.ClientGone();
  robot_.speaker.ClientGone();
  Begin();
}

void Session::AddInput(const unsigned char* bytes, size_t size) {
  talk_.input.append(bytes, size);
  if (talk_.version == 1) {
    talk_.opening.add(bytes, size);
  }
  talk_.has_input = !IsWithStranger();
}

void Session::HandleRequests(unsigned now) {
  while (MayHandle() && (talk_.version == 1 ? HandleRequest() : HandleFrame(now))) {
  }
}

void Session::FileDone(const FileResult& result, unsigned now) {
  if (!files_.Awaits(result)) {
    return;
  }
  if (talk_.version == 1) {
    version1_.FileDone(result);
  } else {
    version2_.Stick().FileDone(result, now);
  }
}

// A client of version 1 gets no message, because it would take the message for the answer to its next request.
void Session::RobotGoesOff(const char* reason) {
  talk_.power_reason = reason;
  if (talk_.version == protocol::version2::VERSION) {
    version2_.PushPowerOff(reason);
  }
}

void Session::Measured(unsigned frame) {
  if (talk_.version == protocol::version2::VERSION) {
    version2_.Measured(frame);
  }
}

size_t Session::EncodePictureHeader(const PictureOrder& order, const protocol::version2::ImageHeader& image,
                                    size_t jpeg_size, unsigned char* out) const {
  if (talk_.version == 1) {
    protocol::encodePictureHeader(jpeg_size, out);
    return protocol::PICTURE_HEADER_SIZE;
  }
  const size_t image_header_size = encode(image, out + protocol::version2::FRAME_HEADER_SIZE);
  const FrameHeader header = {protocol::version2::PICTURE, image.quality, order.request_number,
                              static_cast<unsigned>(image_header_size + jpeg_size)};
  return encode(header, out) + image_header_size;
}

// Handles reports and the content of an upload before new requests. Returns false if new requests have to wait, so that
// replies of version 1 keep their order.
bool Session::MayHandle() {
  if (talk_.version == protocol::version2::VERSION) {
    version2_.PushReports();
  } else if (!IsEnding()) {
    talk_.has_input = talk_.has_input && version1_.TakeContent(talk_.input);
  }
  return talk_.has_input && !IsEnding() && outbox_.HasRoom() && !(talk_.version == 1 && files_.IsPending());
}

// Returns false if there is no complete request, or if it has to wait.
bool Session::HandleRequest() {
  talk_.has_request = talk_.has_request || talk_.input.next(&talk_.request);
  talk_.has_input = talk_.has_request && !MayBeHttp();
  if (!talk_.has_input) {
    return false;
  }
  talk_.has_requested = true;
  talk_.has_request = false;
  if (AsksForVersion2()) {
    ChangeToVersion2();
  } else {
    version1_.Handle(talk_.request);
  }
  return true;
}

// True if the request may be the beginning of HTTP. If more bytes follow it, the sender is not a client.
bool Session::MayBeHttp() {
  const bool may_be =
      talk_.opening.verdict() == protocol::Opening::UNCLEAR && talk_.request.valid && talk_.request.payload_size > 0;
  talk_.is_stranger = may_be && talk_.input.waitingSize() > 0;
  return may_be;
}

bool Session::AsksForVersion2() const {
  return newest_version_ >= protocol::version2::VERSION && talk_.request.valid &&
         talk_.request.basic.command == protocol::REQUEST_NEWER_VERSION &&
         talk_.request.basic.identifier == protocol::version2::VERSION;
}

// Changes to version 2. The bytes after the request belong to version 2 already.
void Session::ChangeToVersion2() {
  unsigned char message[protocol::VALUE_REPLY_SIZE];
  protocol::encodeValueReply(protocol::version2::versionReply(), message);
  outbox_.Add(message, sizeof(message));
  talk_.version = protocol::version2::VERSION;
}

// Returns false if there is no complete frame, or if it is too large, which ends the session.
bool Session::HandleFrame(unsigned now) {
  size_t taken = 0;
  const FrameReader::Result result = frame_reader_.append(talk_.input.waiting(), talk_.input.waitingSize(), &taken);
  talk_.input.take(taken);
  talk_.has_input = talk_.input.waitingSize() > 0;
  talk_.is_over = result == FrameReader::FRAME_TOO_LARGE;
  if (talk_.is_over) {
    version2_.RefuseTooLarge(frame_reader_.header());
  } else if (result == FrameReader::FRAME_COMPLETE) {
    version2_.Handle(frame_reader_.header(), frame_reader_.payload(), now);
  }
  return result == FrameReader::FRAME_COMPLETE;
}
