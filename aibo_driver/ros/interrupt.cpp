#include "ros/interrupt.h"

#include <ros/init.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>

namespace aibo_driver::node {
namespace {

constexpr unsigned kTimeToSignOff = 10;  // s; a master that answers takes less than 1; roslaunch kills after 15

// Nothing but what is allowed in a signal handler.
void endAtOnce(int) {
  constexpr char kReason[] =
      "This node has not come to its end within 10 s. If that is because the ROS master does not answer, all is well. "
      "It ends now, without signing off.\n";
  if (::write(STDERR_FILENO, kReason, sizeof(kReason) - 1) < 0) {
    // Then nobody is there to read it.
  }
  ::_exit(EXIT_FAILURE);
}

void end(int) {
  ros::requestShutdown();
  ::alarm(kTimeToSignOff);
}

}  // namespace

void endOnInterrupt() {
  ::signal(SIGALRM, endAtOnce);
  struct sigaction action = {};
  action.sa_handler = end;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  ::sigaction(SIGINT, &action, nullptr);
}

}  // namespace aibo_driver::node
