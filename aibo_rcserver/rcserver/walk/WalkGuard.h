/// Keeps a walking robot away from edges and walls.
#ifndef AIBO_RCSERVER_RCSERVER_WALK_WALK_GUARD_H
#define AIBO_RCSERVER_RCSERVER_WALK_WALK_GUARD_H

#include "protocol/walk_requests.h"
#include "rcserver/Queue.h"
#include "rcserver/walk/Gait.h"
#include "robot_model/head.h"
#include "robot_model/legs.h"

/// Decides from the distance sensors, the paws and the way walked whether the robot may walk on.
///
/// - The chest sensor looks at the floor ahead. If the floor is much farther away than the legs put it, there is an
///   edge. If something is much nearer than the floor, it is in the way.
/// - The head's sensors see what is in the way while the head looks ahead.
/// - A paw that has touched the floor in its last steps, and now touches nothing, is beyond an edge.
/// - No sensor looks back or to the sides. There the robot walks only over ground that it has just walked over, and
///   over 4 cm of other ground. It remembers edges, too, and puts no foot there when it turns.
///
/// The robot turns on the spot without seeing where its feet go. They leave the ground they stood on by up to 7 cm.
///
/// Lengths are in metres and angles in radians, in the frames of robot_model/legs.h. All numbers are our choice.
class WalkGuard {
 public:
  struct Reading {
    double chest;  ///< distances in m; 0 if the sensor has not measured
    double near;
    double far;
    robot_model::HeadAngles head;
    bool paws[robot_model::NUMBER_OF_LEGS];  ///< true for each paw that is pressed
  };

  explicit WalkGuard(const Gait& gait);

  /// Call this when the robot may have been moved to another place. The guard forgets the ground and the edges.
  void Forget();

  /// Call this for each report of the joints while the robot walks.
  /// @param walked the velocity of the feet since the last report
  /// @param commanded the velocity of the gait
  /// @param frames number of frames of 8 ms since the last report
  void HaveWalked(const protocol::version2::Velocity& walked, const protocol::version2::Velocity& commanded,
                  unsigned frames);

  /// Call this for each report of the sensors while the robot stands or walks.
  /// @param legs the commanded angles of the legs, in the order of robot_model::Leg
  /// @param phase of the step, 0..1
  /// @param step the step that the robot makes; NULL if it does not lift its feet
  void Look(const Reading& reading, const robot_model::LegAngles* legs, double phase, const StepParameters* step);

  /// Why the robot must not walk with this velocity now, in words for the user; NULL if it may.
  const char* Objection(const protocol::version2::Velocity& velocity) const;

  /// How fast the robot may walk forward towards what is in its way, in m/s.
  double HighestForward() const;

 private:
  struct Pose {
    double x;
    double y;
    double yaw;
    double cosine;  ///< of yaw
    double sine;

    void TurnTo(double angle);
  };

  static const int MOST_POSES = 48;
  static const int MOST_EDGES = 32;
  static const int CORNERS = 4;

  struct Place {
    double x;
    double y;
  };

  struct Paw {
    int steps_felt;      ///< in how many steps in a row the paw has touched the floor
    int reports_in_air;  ///< reports in a row in which it has missed the floor
    bool has_touched;    ///< it has touched the floor in this step
  };

  /// The floor in the body's frame: z = height + slope * x.
  struct Floor {
    double height;
    double slope;

    double AlongRay(const robot_model::Point& origin, const robot_model::Point& direction) const;
  };

  static Floor FloorUnder(const robot_model::LegAngles* legs);
  void LookAtFloor(double distance, const Floor& floor);
  void LookAhead(const Reading& reading, const Floor& floor);
  double WayTo(const robot_model::Point& origin, const robot_model::Point& direction, double distance,
               double floor) const;
  void FeelFloor(const Reading& reading, const robot_model::LegAngles* legs, double phase, const StepParameters* step);
  static bool IsLongOnFloor(const StepParameters& step, robot_model::Leg leg, double phase);
  static bool IsBlind(const protocol::version2::Velocity& velocity);
  Pose After(const protocol::version2::Velocity& velocity) const;
  bool ComesToEdge(const Pose& then) const;
  bool LeavesGround(const Pose& then) const;
  double ToGround(const Place& place) const;
  double ToFeet(const Pose& pose, const Place& place) const;
  Place Corner(const Pose& pose, int corner) const;
  static Place Outside(const Pose& pose, const Place& inside);
  void AddEdge(const Place& place);

  const Gait& gait_;
  Place front_corner_;  ///< the farthest place of the left front foot, from the middle of the shoulders
  Place hind_corner_;
  Pose pose_;
  Queue<Pose, MOST_POSES> poses_;
  Queue<Place, MOST_EDGES> edges_;
  int reports_without_floor_;  ///< how many in a row
  int reports_with_obstacle_;
  double reach_;     ///< how far ahead of the middle of the shoulders the robot's nose is
  double obstacle_;  ///< how far ahead of that middle something is in the way
  Paw paws_[robot_model::NUMBER_OF_LEGS];
  int paw_without_floor_;  ///< a robot_model::Leg without floor under its paw, or NO_PAW
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_WALK_GUARD_H
