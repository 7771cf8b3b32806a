/// @file leds_and_ears.h
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_LEDS_AND_EARS_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_LEDS_AND_EARS_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

namespace simulated_ers7 {

/// An LED keeps its last command. Each frame has one command or none, so a command's period is ignored.
struct Led {
  int intensity = 0;  ///< 0..255; 0 or 255 for an LED without levels
  OLED3Mode mode = oled3_MODE_A;
};

/// A magnet draws the ear, but must not stay energised (Model Information ERS-7). Sony gives no limit. Here, a magnet
/// that is energised for a second without a pause overheats: it releases the ear, and does not work for five seconds.
class Ear {
 public:
  static constexpr longword kMostFramesEnergised = 125;
  static constexpr longword kFramesToCoolDown = 625;

  /// Switches the magnet. The command takes effect in the next frame, and lasts until the next command.
  void energise(bool on) { told_to_ = on; }

  /// Call this after each frame of 8 ms.
  /// @return true if the magnet overheated in this frame
  bool passFrame() {
    if (frames_to_cool_ > 0) {
      --frames_to_cool_;
      return false;
    }
    frames_energised_ = told_to_ ? frames_energised_ + 1 : 0;
    const bool became_hot = frames_energised_ > kMostFramesEnergised;
    if (became_hot) {
      frames_to_cool_ = kFramesToCoolDown;
      frames_energised_ = 0;
    }
    return became_hot;
  }

  bool isDrawn() const { return frames_energised_ > 0; }

  bool isHot() const { return frames_to_cool_ > 0; }

 private:
  bool told_to_ = false;
  longword frames_energised_ = 0;
  longword frames_to_cool_ = 0;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_LEDS_AND_EARS_H
