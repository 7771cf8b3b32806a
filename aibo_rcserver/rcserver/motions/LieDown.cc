#include "rcserver/motions/LieDown.h"

#include <string.h>

namespace {

const protocol::MotionName MOTION = "LIE.MTN";

}  // namespace

const unsigned LieDown::MOST_FRAMES;

void LieDown::Begin(unsigned now) {
  if (!IsUnderWay()) {
    state_ = WAITING;
    begin_ = now;
  }
}

const char* LieDown::Continue(unsigned now, FileJobs& files, bool body_is_at_rest) {
  if (now - begin_ >= MOST_FRAMES) {
    const bool moves = state_ == LYING_DOWN;
    state_ = OVER;
    return moves ? "it takes longer than 10 s" : "FileKeeper has not read LIE.MTN within 10 s";
  }
  if (state_ == LYING_DOWN && body_is_at_rest) {
    state_ = OVER;
  } else if (state_ == WAITING && files.IsFree()) {
    ticket_ = files.Post(FileJob::READ, MOTION, NULL, 0);
    state_ = READING;
  }
  return NULL;
}

const char* LieDown::Play(const FileResult& result, JointControl& joints) {
  state_ = OVER;
  MotionPlayer& player = joints.Motions();
  unsigned char* const room = player.FindRoom();
  if (result.outcome != FileResult::DONE || room == NULL) {
    return "LIE.MTN cannot be read from OPEN-R/MW/DATA/P on the memory stick";
  }
  memcpy(room, result.content, result.size);
  if (const char* problem = player.Play(MOTION, result.size, 1, false, NULL)) {
    return problem;
  }
  state_ = LYING_DOWN;
  return NULL;
}
