/// @file ended_movements.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ENDED_MOVEMENTS_H
#define AIBO_DRIVER_REMOTE_CONTROL_ENDED_MOVEMENTS_H

#include <aibo_driver/EndedMovement.h>

#include <QString>
#include <vector>

namespace aibo_driver::remote_control {

/// The movements that have ended between two messages of motion_state. Each message lists the latest ones; the newest
/// is last.
std::vector<EndedMovement> endedBetween(const std::vector<EndedMovement>& before,
                                        const std::vector<EndedMovement>& now);

/// What the user is told about a movement that failed. It is empty if the movement did what it should, or if somebody
/// wanted it to end.
QString complaintAbout(const EndedMovement& ended);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ENDED_MOVEMENTS_H
