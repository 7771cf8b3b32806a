/// @file ros_robot.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_ROS_ROBOT_H
#define AIBO_DRIVER_REMOTE_CONTROL_ROS_ROBOT_H

#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "node/service_calls.h"
#include "remote_control/driver_search.h"
#include "remote_control/driver_topics.h"
#include "remote_control/robot.h"

namespace aibo_driver::remote_control {

/// The robot behind a running driver.
///
/// Functions that may wait for a node or for the ROS master run on threads of this object. One thread asks the master
/// and makes topics, and each call of a service has its own thread. Messages come on the window's thread.
class RosRobot : public Robot {
  Q_OBJECT

 public:
  /// Call ros::init() before this. ros::start() is called when the ROS master answers.
  explicit RosRobot(QObject* parent = nullptr);

  /// Ends the calls that are still running.
  ~RosRobot() override;

  void useDriver(const QString& name_space) override;
  void show(const std::set<Part>& parts) override;
  void stop() override;
  void release() override;
  void takePicture(const QString& folder) override;
  void setStreaming(bool on) override;
  void setMotors(bool on) override;
  void takePosture(const QString& posture) override;
  void listMotions() override;
  void playMotion(const QString& name, int repetitions) override;
  void uploadMotion(const QString& name, const QByteArray& motion) override;
  void stopMotions() override;
  void changeSetting(const QString& name, const QVariant& value) override;
  void setLeds(const QStringList& names, double intensity) override;
  void flickEars(bool left, bool right) override;
  void moveJoints(const JointPositions& positions) override;
  void say(const QString& text) override;
  void stopSound() override;
  void walk(double forward, double left, double turn) override;
  void lookAt(const QPointF& place) override;

 private:
  /// What the thread that asks the master should do.
  struct Wishes {
    std::string name_space;  ///< empty means the first driver that is found
    std::set<Part> visible;
    bool end = false;
    bool operator==(const Wishes& other) const {
      return name_space == other.name_space && visible == other.visible && end == other.end;
    }
  };

  void wish(const std::function<void(Wishes&)>& change);
  void manageTopics();
  void search();
  std::string findDriver() const;
  void forgetDriver(const std::string& next);
  void useTopicsOf(const std::string& name_space);
  void reportConnection();
  void report(const RobotConnection& now);
  RobotConnection connectionNow() const;

  std::shared_ptr<DriverTopics> topicsForCommand(const QString& request);
  std::shared_ptr<DriverTopics> topics() const;

  /// @param request the request in words
  /// @param service the service's name, either in the driver's namespace or a full name
  /// @param also called on a thread of its own with each answer that reports success; may be empty
  template <typename Service>
  void call(const QString& request, const std::string& service, const typename Service::Request& arguments,
            const std::function<void(const typename Service::Response&)>& also = {});
  void answer(bool success, const QString& text);
  void post(const std::function<void(Robot&)>& work);

  /// Does the work, unless another driver is used by then.
  /// @param driver the namespace of the driver that the work is about
  void postFrom(const QString& driver, const std::function<void(Robot&)>& work);

  // The pauses of the queues: a screen shows no more pictures, and nobody can read figures that change more often.
  WindowQueue queue_{std::chrono::milliseconds(20)};
  WindowQueue measurements_{std::chrono::milliseconds(100)};

  // Members that only the window's thread uses.
  RobotConnection connection_;
  node::ServiceCalls calls_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Wishes wishes_;
  bool connection_changed_ = false;
  std::shared_ptr<DriverTopics> topics_;  ///< null if no driver is known
  std::string name_space_;                ///< the namespace of the topics

  // Members that only the thread that asks the master uses.
  bool master_answers_ = true;
  QString reported_connection_;
  std::vector<std::string> found_drivers_;

  std::thread manager_;
};

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_ROS_ROBOT_H
