#include "rcserver/requests/MotionCommands.h"

#include <string.h>

MotionCommands::MotionCommands(JointControl& joints, const MotorSwitch& motors, FileOrder& order)
    : joints_(joints), motors_(motors), order_(order), repetitions_(0), leave_out_(false), number_(0) {}

MotionCommands::Outcome MotionCommands::Play(const protocol::MotionName& name, int repetitions, bool leave_out,
                                             unsigned short number) {
  if (CheckPlay() != FileOrder::DONE) {
    return FileOrder::REFUSED;
  }
  repetitions_ = repetitions;
  leave_out_ = leave_out;
  number_ = number;
  joints_.ForgetOrders();
  return order_.Post(FileJob::READ, MOTION_FILE, name);
}

void MotionCommands::Stop(const protocol::MotionName& name) {
  if (name[0] == '\0') {
    joints_.Motions().StopAll();
  } else {
    joints_.Motions().Stop(name);
  }
}

MotionCommands::Outcome MotionCommands::Upload(const protocol::MotionName& name, const unsigned char* content,
                                               size_t size, bool leave_out) {
  if (size > mtn::MAX_FILE_SIZE) {
    return order_.Fail(FileOrder::REFUSED, "%lu bytes are too many: a motion may have %lu",
                       static_cast<unsigned long>(size), static_cast<unsigned long>(mtn::MAX_FILE_SIZE));
  }
  if (const char* problem = protocol::problemOfNewMotionName(name)) {
    return order_.Fail(FileOrder::REFUSED, "%s: %s", name, problem);
  }
  if (!checked_.read(content, size)) {
    return order_.Fail(FileOrder::REFUSED, "%s is not a motion file: %s", name, checked_.problem());
  }
  if (!fitted_.fit(checked_, joints_.Robot(), leave_out)) {
    return order_.Fail(FileOrder::REFUSED, "%s %s", name, fitted_.problem());
  }
  return order_.Post(FileJob::STORE, MOTION_FILE, name, content, size);
}

MotionCommands::Outcome MotionCommands::Delete(const protocol::MotionName& name) {
  return order_.Post(FileJob::DELETE, MOTION_FILE, name);
}

MotionCommands::Outcome MotionCommands::List() {
  const protocol::MotionName all = "";
  return order_.Post(FileJob::LIST, MOTION_FILE, all);
}

MotionCommands::Outcome MotionCommands::Finish(const FileResult& result) {
  const Outcome outcome = order_.Finish(result);
  const bool is_read = outcome == FileOrder::DONE && order_.Operation() == FileJob::READ;
  return is_read ? FinishPlay(result) : outcome;
}

MotionCommands::Outcome MotionCommands::CheckPlay() {
  if (!motors_.AreOn()) {
    return order_.Fail(FileOrder::REFUSED, "the motors are off; switch them on first");
  }
  if (joints_.Motions().FindRoom() == NULL) {
    return order_.Fail(FileOrder::REFUSED, "%d motions are already being played; stop one first",
                       MotionPlayer::MAX_PLAYING);
  }
  return FileOrder::DONE;
}

MotionCommands::Outcome MotionCommands::FinishPlay(const FileResult& result) {
  if (CheckPlay() != FileOrder::DONE) {
    return FileOrder::REFUSED;
  }
  MotionPlayer& player = joints_.Motions();
  memcpy(player.FindRoom(), result.content, result.size);
  if (const char* problem =
          player.Play(order_.Name(), result.size, repetitions_, leave_out_, joints_.Ordered(), number_)) {
    return order_.Fail(FileOrder::REFUSED, "%s", problem);
  }
  joints_.MotionHasBegun();
  return FileOrder::DONE;
}
