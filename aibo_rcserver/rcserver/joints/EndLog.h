/// @file EndLog.h
/// How motions, walks and postures have ended.
#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_END_LOG_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_END_LOG_H

#include "protocol/text.h"
#include "protocol/version2.h"

/// Why something ends. A plain structure, so that constants need no constructor when the object starts.
struct EndReason {
  unsigned char how;   ///< END_DONE and so on
  const char* format;  ///< of the words for the user, in which %s stands for the joint; a literal
  const char* joint;   ///< its name in the robot's table, or ""

  static EndReason Of(unsigned char how, const char* format, const char* joint = "") {
    const EndReason reason = {how, format, joint};
    return reason;
  }

  /// @param[out] text room for EndLog::MAX_TEXT_SIZE bytes
  void Describe(char* text) const;
};

/// Keeps what has ended, until the client and the console have been told.
class EndLog {
 public:
  /// Room for the words of an EndReason.
  static const int MAX_TEXT_SIZE = 160;

  /// More than can end at once: four motions, a walk and a posture. When there are more, the oldest is forgotten.
  static const unsigned MAX_ENDS = 16;

  enum Reader { CLIENT, CONSOLE };

  struct End {
    unsigned char what;  ///< ENDED_MOTION, ENDED_WALK or ENDED_POSTURE
    unsigned char how;   ///< END_DONE and so on
    char name[protocol::MAX_FILE_NAME_SIZE + 1];
    char reason[MAX_TEXT_SIZE];  ///< in words, such as "left_front_knee was commanded"; empty if it is done
    bool is_for_client;          ///< false if the client that asked for it has gone
  };

  EndLog();

  /// @param name of the motion, WALK_NAME, or postureName()
  void Add(unsigned char what, const char* name, const EndReason& reason, bool is_for_client = true);

  /// Returns each end once to each reader, the oldest first.
  /// @return false if there is none
  bool Take(Reader reader, End* end);

  /// The next client hears nothing of what has ended so far.
  void ClientGone() { taken_[CLIENT] = added_; }

 private:
  End ends_[MAX_ENDS];
  unsigned added_;     ///< how many so far
  unsigned taken_[2];  ///< by each reader
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_END_LOG_H
