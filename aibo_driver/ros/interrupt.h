/// @file interrupt.h
#ifndef AIBO_DRIVER_INTERRUPT_H
#define AIBO_DRIVER_INTERRUPT_H

namespace aibo_driver {

/// From now on, Ctrl-C (SIGINT) ends this process as ROS' own handler does; and after 3 s also if the ROS master does
/// not answer, whom roscpp tells of each topic and service, one by one, and waits for without end.
///
/// To be called before ros::init() with ros::init_options::NoSigintHandler. Takes SIGALRM.
void endOnInterrupt();

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_INTERRUPT_H
