/// @file interrupt.h
#ifndef AIBO_DRIVER_ROS_INTERRUPT_H
#define AIBO_DRIVER_ROS_INTERRUPT_H

namespace aibo_driver::node {

/// From now on, Ctrl-C (SIGINT) ends this process as ROS' own handler does. If that takes longer than 10 s, it ends at
/// once, says so on stderr, and its exit status is EXIT_FAILURE: roscpp tells the ROS master of each topic and service,
/// one by one, and waits for its answers without end. A second Ctrl-C ends it at once in any case.
///
/// To be called once, when there is a ros::NodeHandle, whose making sets ROS' handler. Takes SIGALRM.
void endOnInterrupt();

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_INTERRUPT_H
