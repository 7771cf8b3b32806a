/// @file EndLog.h
/// Records how motions, walks and postures have ended.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_END_LOG_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_END_LOG_H

#include "protocol/text.h"
#include "protocol/version2.h"

/// Why a motion, walk or posture ends. This is a plain structure, so that constants need no constructor at start-up.
struct EndReason {
  unsigned char how;   ///< END_DONE and so on
  const char* format;  ///< text for the user, with %s for the joint; a literal
  const char* joint;   ///< its name in the robot's table, or ""

  static EndReason Of(unsigned char how, const char* format, const char* joint = "") {
    const EndReason reason = {how, format, joint};
    return reason;
  }

  /// @param[out] text room for EndLog::MAX_TEXT_SIZE bytes
  void Describe(char* text) const;
};

/// Keeps each end until the client and the console have been told.
class EndLog {
 public:
  /// Room for the text of an EndReason.
  static const int MAX_TEXT_SIZE = 160;

  /// More than can end at once: four motions, a walk and a posture. When there are more, the oldest is forgotten.
  static const unsigned MAX_ENDS = 16;

  enum Reader { CLIENT, CONSOLE };

  struct End {
    unsigned char what;  ///< ENDED_MOTION, ENDED_WALK or ENDED_POSTURE
    unsigned char how;   ///< END_DONE and so on
    char name[protocol::MAX_FILE_NAME_SIZE + 1];
    char reason[MAX_TEXT_SIZE];  ///< such as "left_front_knee was commanded"; empty for END_DONE
    bool is_for_client;          ///< false if the client that requested it has gone
  };

  EndLog();

  /// @param name of the motion, WALK_NAME, or postureName()
  void Add(unsigned char what, const char* name, const EndReason& reason, bool is_for_client = true);

  /// Returns each end once to each reader, the oldest first.
  /// @return false if there is none
  bool Take(Reader reader, End* end);

  /// Drops the ends that the client has not taken, so that the next client does not get them.
  void ClientGone() { taken_[CLIENT] = added_; }

 private:
  End ends_[MAX_ENDS];
  unsigned added_;     ///< number of ends so far
  unsigned taken_[2];  ///< number of ends taken by each reader
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_END_LOG_H
