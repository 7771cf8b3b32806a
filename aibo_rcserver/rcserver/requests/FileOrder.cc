#include "rcserver/requests/FileOrder.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const size_t FileOrder::MAX_PROBLEM_SIZE;

FileOrder::FileOrder(FileJobs& jobs, JointControl& joints, const MotorSwitch& motors)
    : jobs_(jobs),
      joints_(joints),
      motors_(motors),
      is_prepared_(false),
      ticket_(0),
      operation_(FileJob::LIST),
      kind_(MOTION_FILE),
      repetitions_(0),
      leave_out_(false),
      number_(0) {
  name_[0] = '\0';
  problem_[0] = '\0';
}

void FileOrder::Begin() {
  jobs_.ClientGone();
  is_prepared_ = false;
  ticket_ = 0;
}

FileOrder::Outcome FileOrder::PlayMotion(const protocol::MotionName& name, int repetitions, bool leave_out,
                                         unsigned short number) {
  if (CheckPlay() != DONE) {
    return REFUSED;
  }
  repetitions_ = repetitions;
  leave_out_ = leave_out;
  number_ = number;
  joints_.ForgetOrders();
  return Post(FileJob::READ, MOTION_FILE, name);
}

FileOrder::Outcome FileOrder::StoreMotion(const protocol::MotionName& name, const unsigned char* content, size_t size,
                                          bool leave_out) {
  if (size > mtn::MAX_FILE_SIZE) {
    return Fail(REFUSED, "%lu bytes are too many: a motion may have %lu", static_cast<unsigned long>(size),
                static_cast<unsigned long>(mtn::MAX_FILE_SIZE));
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
  return Post(FileJob::STORE, MOTION_FILE, name, content, size);
}

FileOrder::Outcome FileOrder::Prepare() {
  if (!jobs_.IsThere()) {
    return Fail(REFUSED,
                "the object FileKeeper does not run on the robot: FILES.BIN is missing on the memory stick, or "
                "in its OBJECT.CFG or CONNECT.CFG");
  }
  is_prepared_ = true;
  return PENDING;
}

FileOrder::Outcome FileOrder::Post(FileJob::Operation operation, FileKind kind, const protocol::FileName& name,
                                   const unsigned char* content, size_t size) {
  if (Prepare() != PENDING) {
    return REFUSED;
  }
  is_prepared_ = false;
  operation_ = operation;
  kind_ = kind;
  strcpy(name_, name);
  ticket_ = jobs_.Post(operation, kind, name, content, size);
  return PENDING;
}

// For version 1, FILE_MISSING means that a read has failed or that there was no file to delete.
FileOrder::Outcome FileOrder::Finish(const FileResult& result) {
  ticket_ = 0;
  const bool needs_file = operation_ == FileJob::READ || operation_ == FileJob::DELETE;
  switch (result.outcome) {
    case FileResult::MISSING:
      return Fail(FILE_MISSING, "there is no %s on the memory stick, in %s", name_, DATA_FOLDER);
    case FileResult::TOO_LARGE:
      return Fail(FILE_MISSING, "%s has more than %lu bytes", name_, static_cast<unsigned long>(largestFile(kind_)));
    case FileResult::NO_STICK:
      return Fail(needs_file ? FILE_MISSING : REFUSED, "there is no memory stick in the robot; insert it");
    case FileResult::LOCKED:
      return Fail(REFUSED, "the memory stick is write-protected; take it out and move its switch");
    case FileResult::FULL:
      return Fail(REFUSED,
                  "the memory stick is full: a picture needs its own size and %lu KB that stay free; fetch and delete "
                  "pictures",
                  static_cast<unsigned long>(PICTURE_RESERVE / 1024));
    case FileResult::TOO_MANY:
      return Fail(REFUSED, "the memory stick has %lu pictures, which is the most; fetch and delete some",
                  static_cast<unsigned long>(protocol::version2::MAX_LISTED_FILES));
    case FileResult::NO_NUMBER:
      return Fail(REFUSED, "the memory stick has AIBO9999.JPG, the last number; fetch and delete it");
    case FileResult::FAILED:
      return FailOnMemoryStick();
    case FileResult::DONE:
      break;
  }
  return operation_ == FileJob::READ && kind_ == MOTION_FILE ? BeginToPlay(result) : DONE;
}

FileOrder::Outcome FileOrder::CheckPlay() {
  if (!motors_.AreOn()) {
    return Fail(REFUSED, "the motors are off; switch them on first");
  }
  if (joints_.Motions().FindRoom() == NULL) {
    return Fail(REFUSED, "%d motions are already being played; stop one first", MotionPlayer::MAX_PLAYING);
  }
  return DONE;
}

FileOrder::Outcome FileOrder::BeginToPlay(const FileResult& result) {
  if (CheckPlay() != DONE) {
    return REFUSED;
  }
  memcpy(joints_.Motions().FindRoom(), result.content, result.size);
  const char* const problem = joints_.Play(name_, result.size, repetitions_, leave_out_, number_);
  return problem == NULL ? DONE : Fail(REFUSED, "%s", problem);
}

FileOrder::Outcome FileOrder::FailOnMemoryStick() {
  switch (operation_) {
    case FileJob::READ:
      return Fail(FILE_MISSING, "%s cannot be read", name_);
    case FileJob::STORE:
      return Fail(REFUSED, "%s cannot be written: the memory stick may be full, damaged or without a folder %s",
                  kind_ == PICTURE_FILE ? "the picture" : name_, DATA_FOLDER);
    default:
      return Fail(REFUSED, "%s cannot be deleted: the memory stick may be damaged", name_);
  }
}

FileOrder::Outcome FileOrder::Fail(Outcome outcome, const char* format, ...) {
  is_prepared_ = false;
  va_list values;
  va_start(values, format);
  vsprintf(problem_, format, values);
  va_end(values);
  return outcome;
}
