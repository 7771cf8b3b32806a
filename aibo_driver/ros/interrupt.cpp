#include "interrupt.h"

#include <ros/init.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>

namespace aibo_driver {
namespace {

constexpr unsigned kTimeToSignOff = 3;  // s; a master that answers takes a tenth of it

// Nothing but what is allowed in a signal handler.
void endAtOnce(int) {
  constexpr char kReason[] = "The ROS master does not answer; this node ends without signing off.\n";
  if (::write(STDERR_FILENO, kReason, sizeof(kReason) - 1) < 0) {
    // Then nobody is there to read it.
  }
  ::_exit(EXIT_SUCCESS);
}

void end(int) {
  ros::requestShutdown();
  ::alarm(kTimeToSignOff);
}

}  // namespace

void endOnInterrupt() {
  ::signal(SIGALRM, endAtOnce);
  ::signal(SIGINT, end);
}

}  // namespace aibo_driver
