#include "rcserver/motions/MotionCommands.h"

#include <OPENR/OSyslog.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const size_t MotionCommands::MAX_PROBLEM_SIZE;

MotionCommands::MotionCommands(JointControl& joints, const MotorSwitch& motors, FileJobs& files,
                               const Settings& settings)
    : joints_(joints),
      motors_(motors),
      files_(files),
      settings_(settings),
      ticket_(0),
      operation_(FileJob::LIST),
      repetitions_(0),
      leave_out_(false),
      commands_(0),
      cancelled_why_(NULL) {
  problem_[0] = '\0';
  name_[0] = '\0';
}

MotionCommands::Outcome MotionCommands::Play(const protocol::MotionName& name, int repetitions, bool leave_out,
                                             unsigned commands) {
  if (CheckPlay() != DONE) {
    return REFUSED;
  }
  repetitions_ = repetitions;
  leave_out_ = leave_out;
  commands_ = commands;
  cancelled_why_ = NULL;
  return Post(FileJob::READ, name, NULL, 0);
}

void MotionCommands::Stop(const protocol::MotionName& name) {
  if (name[0] == '\0') {
    joints_.Motions().StopAll(MotionPlayer::STOPPED);
  } else {
    joints_.Motions().Stop(name);
  }
}

void MotionCommands::Cancel(const protocol::MotionName& name, const char* why) {
  if (name[0] == '\0' || strcmp(name, name_) == 0) {
    cancelled_why_ = why;
  }
}

MotionCommands::Outcome MotionCommands::CheckUpload(size_t size) {
  if (!settings_.allow_upload) {
    return Fail(REFUSED, "uploads are not allowed; ALLOW_UPLOAD=yes in RCSERVER.CFG on the memory stick allows them");
  }
  if (size > mtn::MAX_FILE_SIZE) {
    return Fail(REFUSED, "%lu bytes are too many: a motion may have %lu", static_cast<unsigned long>(size),
                static_cast<unsigned long>(mtn::MAX_FILE_SIZE));
  }
  return DONE;
}

MotionCommands::Outcome MotionCommands::Upload(const protocol::MotionName& name, const unsigned char* content,
                                               size_t size, bool leave_out) {
  if (CheckUpload(size) != DONE) {
    return REFUSED;
  }
  if (const char* problem = protocol::problemOfNewMotionName(name)) {
    return Fail(REFUSED, "%s: %s", name, problem);
  }
  if (!checked_.read(content, size)) {
    return Fail(REFUSED, "%s is not a motion file: %s", name, checked_.problem());
  }
  if (!fitted_.fit(checked_, joints_.Robot(), leave_out)) {
    return Fail(REFUSED, "%s %s", name, fitted_.problem());
  }
  return Post(FileJob::STORE, name, content, size);
}

MotionCommands::Outcome MotionCommands::Delete(const protocol::MotionName& name) {
  if (!settings_.allow_delete) {
    return Fail(REFUSED, "deleting is not allowed; ALLOW_DELETE=yes in RCSERVER.CFG on the memory stick allows it");
  }
  return Post(FileJob::DELETE, name, NULL, 0);
}

MotionCommands::Outcome MotionCommands::List() {
  const protocol::MotionName all = "";
  return Post(FileJob::LIST, all, NULL, 0);
}

MotionCommands::Outcome MotionCommands::Finish(const FileResult& result) {
  ticket_ = 0;
  if (operation_ == FileJob::READ && cancelled_why_ != NULL) {
    return Fail(REFUSED, "%s %s", name_, cancelled_why_);
  }
  switch (result.outcome) {
    case FileResult::MISSING:
      return Fail(FILE_MISSING, "there is no %s on the memory stick, in %s", name_, MOTION_FOLDER);
    case FileResult::TOO_LARGE:
      return Fail(FILE_MISSING, "%s has more than %lu bytes", name_, static_cast<unsigned long>(mtn::MAX_FILE_SIZE));
    case FileResult::FAILED:
      return FailOnMemoryStick();
    case FileResult::DONE:
      break;
  }
  return operation_ == FileJob::READ ? FinishPlay(result) : DONE;
}

MotionCommands::Outcome MotionCommands::Post(FileJob::Operation operation, const protocol::MotionName& name,
                                             const unsigned char* content, size_t size) {
  if (!files_.IsThere()) {
    return Fail(REFUSED,
                "the object FileKeeper does not run on the robot: FILES.BIN is missing on the memory stick, or "
                "in its OBJECT.CFG or CONNECT.CFG");
  }
  operation_ = operation;
  strcpy(name_, name);
  ticket_ = files_.Post(operation, name, content, size);
  return PENDING;
}

MotionCommands::Outcome MotionCommands::CheckPlay() {
  if (!motors_.AreOn()) {
    return Fail(REFUSED, "the motors are off; switch them on first");
  }
  if (joints_.Motions().FindRoom() == NULL) {
    return Fail(REFUSED, "%d motions are being played, which is the most; stop one first", MotionPlayer::MAX_PLAYING);
  }
  return DONE;
}

MotionCommands::Outcome MotionCommands::FinishPlay(const FileResult& result) {
  if (CheckPlay() != DONE) {
    return REFUSED;
  }
  MotionPlayer& player = joints_.Motions();
  memcpy(player.FindRoom(), result.content, result.size);
  bool commanded[robot_model::MAX_JOINTS];
  joints_.FindCommandedSince(commands_, commanded);
  if (const char* problem = player.Play(name_, result.size, repetitions_, leave_out_, commanded)) {
    return Fail(REFUSED, "%s", problem);
  }
  joints_.MotionHasBegun();
  if (Changes()[0] != '\0') {
    OSYSPRINT(("RCServer: %s: %s\n", name_, Changes()));
  }
  return DONE;
}

MotionCommands::Outcome MotionCommands::FailOnMemoryStick() {
  switch (operation_) {
    case FileJob::READ:
      return Fail(FILE_MISSING, "%s cannot be read", name_);
    case FileJob::STORE:
      return Fail(REFUSED, "%s cannot be written: the memory stick may be full, locked or without a folder %s", name_,
                  MOTION_FOLDER);
    default:
      return Fail(REFUSED, "%s cannot be deleted: the memory stick may be locked", name_);
  }
}

// Keeps the reason, and returns the outcome.
MotionCommands::Outcome MotionCommands::Fail(Outcome outcome, const char* format, ...) {
  va_list values;
  va_start(values, format);
  vsprintf(problem_, format, values);
  va_end(values);
  return outcome;
}
