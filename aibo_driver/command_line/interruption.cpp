#include "command_line/interruption.h"

#include <csignal>

#include "system/event.h"

namespace aibo_driver::command_line {
namespace {

volatile std::sig_atomic_t first_signal = 0;

aibo_system::Event& event() {
  static aibo_system::Event event;
  return event;
}

extern "C" void noteInterruption(int signal) {
  first_signal = signal;
  event().raise();
}

}  // namespace

void noteInterruptions() {
  event();  // makes the event here, because the handler must not make it
  struct sigaction action = {};
  action.sa_handler = noteInterruption;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

int interruption() {
  return first_signal;
}

int interruptionDescriptor() {
  return event().descriptor();
}

}  // namespace aibo_driver::command_line
