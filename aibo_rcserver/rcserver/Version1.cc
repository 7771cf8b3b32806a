#include "rcserver/Version1.h"

Version1::Version1(const Robot& robot, const Settings& settings, MotionCommands& motions, ImageObserver& camera,
                   Outbox& outbox, unsigned char* upload_buffer)
    : camera_(camera),
      replies_(outbox),
      joints_(robot.joints, robot.motors, replies_),
      lights_(robot.lights, replies_),
      motions_(motions, replies_, upload_buffer),
      power_(robot.power_order, settings, replies_),
      sensors_(robot.joints, robot.sensors, replies_) {}

void Version1::Begin() {
  motions_.Begin();
  sensors_.Begin();
}

bool Version1::Handle(const protocol::Request& request) {
  if (request.valid && IsForMotions(request)) {
    return motions_.Execute(request);
  }
  if (!request.valid || !Execute(request)) {
    replies_.Refuse(protocol::ERROR_REFUSED);
  }
  return true;
}

bool Version1::IsForMotions(const protocol::Request& request) {
  return request.basic.command == protocol::REQUEST_UPLOAD_MOTION ||
         request.basic.command == protocol::REQUEST_DELETE_MOTION ||
         request.basic.command == protocol::REQUEST_PLAY_MOTION;
}

// False: to be refused.
bool Version1::Execute(const protocol::Request& request) {
  const PictureOrder order = {protocol::limitJpegQuality(request.basic.identifier), 0, 0, false};
  switch (request.basic.command) {
    case protocol::REQUEST_PICTURE:
      return camera_.RequestPicture(order);
    case protocol::REQUEST_STREAM_TOGGLE:
      camera_.ToggleStream(order);
      return true;
    case protocol::REQUEST_JOINT:
    case protocol::REQUEST_MAX_VELOCITY:
    case protocol::REQUEST_MAX_ACCELERATION:
      return joints_.Execute(request);
    case protocol::REQUEST_SENSOR:
      return sensors_.Execute(request);
    case protocol::REQUEST_LED:
    case protocol::REQUEST_FACE_LEDS:
    case protocol::REQUEST_EARS:
      return lights_.Execute(request);
    case protocol::REQUEST_SHUT_DOWN:
    case protocol::REQUEST_REBOOT:
      return power_.Execute(request);
    default:
      return false;
  }
}
