#include "rcserver/commands/MotionCommands.h"

#include <stdarg.h>
#include <stdio.h>

#include "rcserver/memory_stick/MotionFiles.h"

const size_t MotionCommands::MAX_PROBLEM_SIZE;

MotionCommands::MotionCommands(const Robot& robot, const Settings& settings) : robot_(robot), settings_(settings) {
  problem_[0] = '\0';
}

MotionCommands::Outcome MotionCommands::Play(const protocol::MotionName& name, int repetitions) {
  if (!robot_.motors.AreOn()) {
    return Fail(REFUSED, "the motors are off; switch them on first");
  }
  MotionPlayer& player = robot_.joints.Motions();
  unsigned char* const room = player.FindRoom();
  if (room == NULL) {
    return Fail(REFUSED, "%d motions are being played, and no more can be; stop one first", MotionPlayer::MAX_PLAYING);
  }
  size_t size = 0;
  switch (robot_.motion_files.Read(name, room, mtn::MAX_FILE_SIZE, &size)) {
    case MotionFiles::MISSING:
      return Fail(FILE_MISSING, "there is no %s on the memory stick, in %s", name, MOTION_FOLDER);
    case MotionFiles::TOO_LARGE:
      return Fail(FILE_MISSING, "%s has more than %lu bytes", name, static_cast<unsigned long>(mtn::MAX_FILE_SIZE));
    case MotionFiles::FAILED:
      return Fail(FILE_MISSING, "%s cannot be read", name);
    case MotionFiles::DONE:
      break;
  }
  const char* const problem = player.Play(name, size, repetitions);
  return problem == NULL ? DONE : Fail(REFUSED, "%s", problem);
}

void MotionCommands::Stop(const protocol::MotionName& name) {
  if (name[0] == '\0') {
    robot_.joints.Motions().StopAll();
  } else {
    robot_.joints.Motions().Stop(name);
  }
}

MotionCommands::Outcome MotionCommands::CheckUpload(size_t size) {
  if (!settings_.allow_upload) {
    return Fail(REFUSED, "uploads are not allowed; ALLOW_UPLOAD=yes in RCSERVER.CFG on the memory stick allows them");
  }
  if (size > mtn::MAX_FILE_SIZE) {
    return Fail(REFUSED, "%lu bytes are more than a motion may have, which is %lu", static_cast<unsigned long>(size),
                static_cast<unsigned long>(mtn::MAX_FILE_SIZE));
  }
  return DONE;
}

MotionCommands::Outcome MotionCommands::Upload(const protocol::MotionName& name, const unsigned char* content,
                                               size_t size) {
  if (CheckUpload(size) != DONE) {
    return REFUSED;
  }
  if (!checked_.read(content, size)) {
    return Fail(REFUSED, "%s is no motion file: %s", name, checked_.problem());
  }
  int joints[mtn::MAX_JOINTS];
  if (const char* missing = FindJoints(checked_, robot_.joints.Robot(), joints)) {
    return Fail(REFUSED, "%s moves the joint %s, which this robot does not have", name, missing);
  }
  if (!robot_.motion_files.Store(name, content, size)) {
    return Fail(REFUSED, "%s cannot be written: the memory stick may be full, locked or without a folder %s", name,
                MOTION_FOLDER);
  }
  return DONE;
}

MotionCommands::Outcome MotionCommands::Delete(const protocol::MotionName& name) {
  if (!settings_.allow_delete) {
    return Fail(REFUSED, "deleting is not allowed; ALLOW_DELETE=yes in RCSERVER.CFG on the memory stick allows it");
  }
  switch (robot_.motion_files.Delete(name)) {
    case MotionFiles::DONE:
      return DONE;
    case MotionFiles::MISSING:
      return Fail(FILE_MISSING, "there is no %s on the memory stick, in %s", name, MOTION_FOLDER);
    default:
      return Fail(REFUSED, "%s cannot be deleted: the memory stick may be locked", name);
  }
}

const protocol::version2::MotionList& MotionCommands::List() {
  robot_.motion_files.List(&list_);
  return list_;
}

// Says why; the outcome.
MotionCommands::Outcome MotionCommands::Fail(Outcome outcome, const char* format, ...) {
  va_list values;
  va_start(values, format);
  vsprintf(problem_, format, values);
  va_end(values);
  return outcome;
}
