/// @file ended_movements.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ENDED_MOVEMENTS_H
#define AIBO_DRIVER_REMOTE_CONTROL_ENDED_MOVEMENTS_H

#include <aibo_driver/EndedMovement.h>

#include <QString>
#include <vector>

namespace aibo_driver::remote_control {

/// Those that have ended between two messages of motion_state, each of which has the latest, the newest last.
std::vector<EndedMovement> endedBetween(const std::vector<EndedMovement>& before,
                                        const std::vector<EndedMovement>& now);

/// What a user is told of a movement that did not do what it was to do; empty if there is nothing to tell, because it
/// did, or because somebody wanted it to end.
QString complaintAbout(const EndedMovement& ended);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ENDED_MOVEMENTS_H
