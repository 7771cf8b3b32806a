#include "tools/joystick/sdl_joystick.h"

#include <SDL2/SDL.h>
#include <gmock/gmock.h>

namespace joystick {
namespace {

using ::testing::_;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;

// Older ones have no virtual joysticks, lose some of their values, or call all of them the same.
#if SDL_VERSION_ATLEAST(2, 24, 0)

// A joystick without hardware, with 3 axes, 2 buttons and 2 hats.
class VirtualJoystick {
 public:
  explicit VirtualJoystick(const char* name = "Pedals") {
    SDL_VirtualJoystickDesc description{};
    description.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    description.naxes = 3;
    description.nbuttons = description.nhats = 2;
    description.name = name;
    index_ = SDL_JoystickAttachVirtualEx(&description);
    EXPECT_GE(index_, 0) << SDL_GetError();
    joystick_ = SDL_JoystickOpen(index_);
  }
  ~VirtualJoystick() {
    SDL_JoystickClose(joystick_);
    SDL_JoystickDetachVirtual(index_);
  }

  VirtualJoystick(const VirtualJoystick&) = delete;
  VirtualJoystick& operator=(const VirtualJoystick&) = delete;

  void setAxis(int axis, int value) { SDL_JoystickSetVirtualAxis(joystick_, axis, static_cast<Sint16>(value)); }
  void setButton(int button, bool on) { SDL_JoystickSetVirtualButton(joystick_, button, on ? 1 : 0); }
  void setHat(int hat, int value) { SDL_JoystickSetVirtualHat(joystick_, hat, static_cast<Uint8>(value)); }

 private:
  int index_;
  SDL_Joystick* joystick_ = nullptr;
};

TEST(SdlJoystick, ReadsAxesHatsAndButtonsWithTheSignsOfRos) {
  SdlJoystick joystick(1, "");
  VirtualJoystick other("Wheel");
  other.setAxis(2, 32767);
  VirtualJoystick hardware;
  hardware.setAxis(0, -32768);  // left
  hardware.setAxis(1, 32767);   // down
  hardware.setAxis(2, 16384);
  hardware.setButton(1, true);
  hardware.setHat(0, SDL_HAT_LEFTUP);
  hardware.setHat(1, SDL_HAT_DOWN);
  joystick.read();  // SDL passes on what was set
  const auto state = joystick.read();
  ASSERT_TRUE(state);
  EXPECT_THAT(state->axes, ElementsAre(1, -1, FloatNear(-0.5F, 1e-3F), 1, 1, 0, -1));
  EXPECT_THAT(state->buttons, ElementsAre(0, 1));
  EXPECT_EQ(joystick.describe(), "Pedals, with 7 axes and 2 buttons");
  for (const auto& [hat, right_and_up] : {std::pair(SDL_HAT_RIGHTDOWN, -1), std::pair(SDL_HAT_CENTERED, 0)}) {
    hardware.setHat(0, hat);
    joystick.read();
    EXPECT_THAT(joystick.read()->axes, ElementsAre(_, _, _, right_and_up, right_and_up, 0, -1));
  }
}

TEST(SdlJoystick, MayBePulledOutAndPluggedInAgain) {
  SdlJoystick joystick(1, "");
  const VirtualJoystick other("Wheel");
  EXPECT_FALSE(joystick.read());
  EXPECT_EQ(joystick.describe(), "");
  for (int i = 0; i < 3; ++i) {
    {
      const VirtualJoystick hardware;
      EXPECT_TRUE(joystick.read());
    }
    EXPECT_FALSE(joystick.read());
  }
}

TEST(SdlJoystick, IsTheOneThatIsWanted) {
  {
    SdlJoystick second(1, "");
    const VirtualJoystick one;
    EXPECT_FALSE(second.read());
    const VirtualJoystick other("Wheel");
    EXPECT_TRUE(second.read());
  }
  {
    SdlJoystick named(0, "of anna");
    const VirtualJoystick pedals;
    EXPECT_FALSE(named.read());
    const VirtualJoystick gamepad("Gamepad of anna");
    EXPECT_TRUE(named.read());
    EXPECT_THAT(named.describe(), HasSubstr("Gamepad of anna, with"));
  }
  SdlJoystick another(0, "no joystick has this name");
  const VirtualJoystick hardware;
  EXPECT_FALSE(another.read());
}

#else

TEST(SdlJoystick, IsNotThereWithoutHardware) {
  SdlJoystick joystick(0, "no joystick has this name");
  EXPECT_FALSE(joystick.read());
}

#endif

}  // namespace
}  // namespace joystick
