/// @file motion.h
/// Reads motion files (MTN), the format of Sony's motion editors.
#ifndef AIBO_RCSERVER_MTN_MOTION_H
#define AIBO_RCSERVER_MTN_MOTION_H

#include <stddef.h>

#include "mtn/layout.h"

namespace mtn {

/// The content of a motion file. It has a fixed size; the key frames stay in the caller's memory. Not thread-safe.
///
/// read() checks everything but three things: roll, pitch and yaw of the body; bytes after the texts of sections 1 and
/// 2; and whether a robot has these joints and reaches these positions.
class Motion {
 public:
  static const size_t MAX_PROBLEM_SIZE = 160;

  Motion();

  /// @param bytes must outlive the object, or stay until the next read()
  /// @return false if the bytes are not a motion file; in that case problem() says why, and the motion is empty
  bool read(const unsigned char* bytes, size_t size);

  /// Why the last file was refused, in a few words: "section 2 is cut off". The text is empty if the file was accepted.
  const char* problem() const { return problem_; }

  /// The file's texts. Their character set is unknown. A text may be empty.
  const char* name() const { return name_; }
  const char* creator() const { return creator_; }
  const char* design() const { return design_; }  ///< "DRX-1000" is an ERS-7, "DRX-910" an ERS-210

  int frameMilliseconds() const { return frame_milliseconds_; }
  int numberOfJoints() const { return number_of_joints_; }
  int numberOfKeyFrames() const { return number_of_key_frames_; }

  /// @param joint 0..numberOfJoints() - 1
  /// @return the locator for OPENR::OpenPrimitive(), unique in the motion
  const char* locator(int joint) const { return locators_[joint]; }

  /// @param key_frame 0..numberOfKeyFrames() - 1
  /// @return the position in microradians, within +-MAX_POSITION
  int position(int key_frame, int joint) const;

  /// The time since the previous key frame, in milliseconds, 8..MAX_STEP_MILLISECONDS; 0 for the first one.
  int milliseconds(int key_frame) const;

 private:
  Motion(const Motion&);
  Motion& operator=(const Motion&);

  struct Section;

  void clear();
  bool readAll(const unsigned char* bytes, size_t size);
  bool openSection(unsigned number, const unsigned char** bytes, size_t* size, Section* section);
  bool readGeneral(Section* section);
  bool readTexts(Section* section);
  bool readLocators(Section* section);
  bool readLocator(Section* section, int joint);
  bool readKeyFrames(Section* section);
  bool checkKeyFrame(int key_frame);
  bool takeText(Section* section, const char* what, size_t max_size, char* text);
  bool fail(const char* format, ...);
  size_t keyFrameSize() const;
  const unsigned char* keyFrame(int key_frame) const;

  char problem_[MAX_PROBLEM_SIZE];
  char name_[MAX_TEXT_SIZE + 1];
  char creator_[MAX_TEXT_SIZE + 1];
  char design_[MAX_TEXT_SIZE + 1];
  int frame_milliseconds_;
  int number_of_joints_;
  int number_of_key_frames_;
  char locators_[MAX_JOINTS][MAX_LOCATOR_SIZE + 1];
  const unsigned char* key_frames_;
};

}  // namespace mtn

#endif  // AIBO_RCSERVER_MTN_MOTION_H
