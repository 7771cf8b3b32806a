#ifndef AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H
#define AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H

#include "protocol/walk_requests.h"
#include "robot_model/legs.h"

/// Measures how the feet on the floor move the body, from what the joints and the paws report. Feet roll, but are
/// assumed not to slip, except for the little that they always slip sideways. So the measured velocity shows if motors
/// lag or give way under the robot's weight.
///
/// A foot is on the floor if its paw is pressed in two reports that follow each other. If fewer than two paws are
/// pressed, the lower pair of diagonal legs counts: paws may be broken, or the robot may be hung up for a test. When
/// the other pair becomes the lower one, the last velocity counts.
class WalkedVelocity {
 public:
  WalkedVelocity();

  /// Call this when the robot begins to walk.
  void Begin();

  /// Call this for each report of the sensors while the robot walks.
  /// @param legs the measured angles of the four legs, in the order of robot_model::Leg
  /// @param paws for each leg, true if its paw is pressed
  /// @param frame OPEN-R frame
  /// @param unseen the way ahead that feet do not show, as a share of the way that they show
  /// @return the frames since the report before, for which this is the velocity; 0 for the first report of a walk
  unsigned Measured(const robot_model::LegAngles* legs, const bool* paws, unsigned frame, double unseen = 0);

  /// The velocity in the last report.
  const protocol::version2::Velocity& Now() const { return now_; }

  /// The average since the last call; the last value if no report has come since. If no foot slips, the sum over all
  /// time is the distance walked.
  /// @param walks true if the robot walks now
  protocol::version2::Velocity Take(bool walks);

 private:
  struct Foot {
    robot_model::Point place;    ///< the centre of the foot
    robot_model::Point contact;  ///< where the foot touches the floor, apart from a constant
    bool is_pressed;
  };

  void FindFeet(const robot_model::LegAngles* legs, const bool* paws, Foot* feet) const;
  bool ChooseFeet(const Foot* next, bool* chosen) const;
  protocol::version2::Velocity VelocityTo(const Foot* next, const bool* chosen, unsigned frames) const;

  bool has_feet_;
  Foot feet_[robot_model::NUMBER_OF_LEGS];  ///< the feet in the last report
  unsigned frame_;                          ///< frame of the last report
  protocol::version2::Velocity now_;
  protocol::version2::Velocity sum_;  ///< sum over the reports
  int reports_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H
