// The programs that steer, or that move the robot by themselves, while somebody has stopped it. The driver is a fake.

#include <aibo_driver/LookAtResult.h>
#include <geometry_msgs/PointStamped.h>
#include <gmock/gmock.h>
#include <sensor_msgs/CompressedImage.h>

#include "ros/driver_user.h"
#include "ros/fake_driver.h"

namespace {

using aibo_driver::Movement;
using aibo_driver::RobotState;
using geometry_msgs::Twist;
using test_support::DriverUser;
using test_support::FakeDriver;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::TopicListener;
using test_support::TopicPublishers;

// It follows the ball with the head, or walks after it.
class FollowBall : public ::testing::Test {
 protected:
  static constexpr bool kWalks = true;

  void start(bool walks) {
    ros::param::del("/follows/aibo_follow_ball");  // without the parameter, it does not walk
    std::vector<std::string> command{AIBO_FOLLOW_BALL, "__ns:=/follows"};
    command.insert(command.end(), walks ? 1 : 0, "_walk:=true");
    node_ = std::make_unique<Process>(command);
  }

  bool follows() {
    points_.clear();
    steps_.clear();
    return DriverUser::becomesTrue([this] {
      points_.waitForNext(std::chrono::milliseconds(50));
      return points_.count() + steps_.count() > 0;
    });
  }

  bool ends(const std::string& why) {
    EXPECT_NO_THROW(node_->waitForOutput("any more: " + why + "\\. To go on: rosrun")) << why;
    return node_->waitForExit(kSafetyNet) == 0;
  }

  bool waits() { return points_.waitForCount(1, std::chrono::milliseconds(300)).empty(); }

  void pointTheHead() {
    ros::Publisher& points = user_.publisherOf<geometry_msgs::PointStamped>("look_at");
    EXPECT_TRUE(DriverUser::becomesTrue([&points] { return points.getNumSubscribers() == 2; }));  // with this test
    points.publish(geometry_msgs::PointStamped());
  }

  void loseConnection() {
    ros::Publisher& connections = user_.publisherOf<aibo_driver::Connection>("connection");
    EXPECT_TRUE(DriverUser::becomesTrue([&connections] { return connections.getNumSubscribers() > 0; }));
    connections.publish(aibo_driver::Connection());
  }

  void move(const std::string& source, std::uint8_t kind) {
    Movement movement;
    movement.source = source;
    movement.kind = kind;
    driver_.move({movement});
  }

  FakeDriver driver_{"/follows"};
  TopicPublishers user_{"/follows"};
  TopicListener<geometry_msgs::PointStamped> points_{"/follows/look_at"};
  TopicListener<Twist> steps_{"/follows/cmd_vel"};
  std::unique_ptr<Process> node_;
};

TEST_F(FollowBall, WalksToTheBallAndAroundItAndLooksForItWhereItWasLast) {
  start(kWalks);
  const auto steers = [this](double forward, double left, double turn) {
    return steps_.waitFor([&](const Twist& step) {
      return std::hypot(step.linear.x - forward, step.linear.y - left, step.angular.z - turn) < 1e-3;
    }) != nullptr;
  };
  EXPECT_TRUE(steers(0, 0, 0.4)) << "it has not seen a ball yet";
  driver_.showBall(10, 6);
  EXPECT_TRUE(steers(0.12, 0, 0.569)) << "far away on the left";
  driver_.showBall(65, 16);
  EXPECT_TRUE(steers(0.036, -0.04, -0.306)) << "near on the right";
  driver_.showBall(0, 0);
  EXPECT_TRUE(steers(0, 0, -0.4)) << "gone to the right";
  driver_.showBall(37, 30);
  EXPECT_TRUE(steers(-0.05, -0.04, 0)) << "too near";
  EXPECT_EQ(points_.count(), 0U) << "its head keeps still";
}

TEST_F(FollowBall, TurnsTheHeadToTheBallUnlessItIsInTheMiddle) {
  driver_.showBall(70, 12);  // its middle is 24 pixels to the right of the picture's, and 14 above it
  start(!kWalks);
  const auto point = points_.waitForFirst();
  ASSERT_TRUE(point);
  EXPECT_EQ(point->header.stamp, ros::Time(7)) << "where the camera was then";
  EXPECT_EQ(point->header.frame_id, "camera_optical_frame");
  EXPECT_NEAR(point->point.x / point->point.z, 24 / 96.0, 1e-3);
  EXPECT_NEAR(point->point.y / point->point.z, -14 / 96.0, 1e-3);
  EXPECT_NEAR(point->point.z, 0.085 * 96 / 12, 1e-3);
  for (const auto& [left, width] : {std::pair(32, 40), std::pair(0, 0)}) {  // in the middle, and nowhere
    driver_.showBall(left, width);
    EXPECT_TRUE(DriverUser::becomesTrue([this] {
      points_.clear();
      return waits();
    })) << left;
    driver_.showBall(70, 12);
    EXPECT_TRUE(follows());
  }
}

TEST_F(FollowBall, EndsWhenSomebodyStopsTheRobotOrAnythingElseMovesIt) {
  driver_.showBall(10, 6);
  const std::tuple<bool, std::string, std::function<void()>> rows[] = {
      {kWalks, "/user has stopped the robot", [this] { driver_.stop("/user"); }},
      {kWalks, "the motors are off", [this] { driver_.tell(RobotState::OFF, RobotState::LYING); }},
      {kWalks, "the robot is carried", [this] { driver_.tell(RobotState::ON, RobotState::CARRIED); }},
      {kWalks, "the robot has fallen", [this] { driver_.tell(RobotState::ON, RobotState::FALLEN); }},
      {kWalks, "/somebody moves the robot", [this] { move("/somebody", Movement::WALK); }},
      {kWalks, "/follows/aibo_look_at moves the robot", [this] { move("/follows/aibo_look_at", Movement::LOOK_AT); }},
      {kWalks, "the connection was lost", [this] { loseConnection(); }},
      {!kWalks, "/user has stopped the robot", [this] { driver_.stop("/user"); }},
      {!kWalks, "/somebody moves the robot", [this] { move("/somebody", Movement::COMMAND); }},
      {!kWalks, ros::this_node::getName() + " points the head", [this] { pointTheHead(); }},
  };
  for (const auto& [walks, why, happen] : rows) {
    start(walks);
    EXPECT_TRUE(follows()) << why;
    happen();
    EXPECT_TRUE(ends(why)) << why;
    driver_.release();
    driver_.tell(RobotState::ON, RobotState::STANDING);
    driver_.move({});
  }
}

TEST_F(FollowBall, BeginsWhenTheMotorsAreOnAndNothingElseMovesTheHead) {
  driver_.showBall(10, 6);
  driver_.tell(RobotState::OFF, RobotState::LYING);
  move("/somebody", Movement::POSTURE);
  start(!kWalks);
  node_->waitForOutput("cannot follow the ball yet: the motors are off");
  driver_.tell(RobotState::ON, RobotState::LYING);
  EXPECT_TRUE(waits());
  move("/somebody", Movement::WALK);
  EXPECT_TRUE(follows());
}

TEST(LookAt, SaysWhyTheHeadDoesNotTurn) {
  FakeDriver driver("/stares");
  TopicListener<aibo_driver::LookAtResult> results("/stares/look_at_result");
  TopicPublishers user("/stares");
  const Process node({AIBO_LOOK_AT, "__ns:=/stares"});
  geometry_msgs::PointStamped point;
  point.header.frame_id = "base_link";
  const auto says = [&](const std::string& text) {  // in the end: a point may come before the robot's state
    return DriverUser::becomesTrue([&] {
      results.clear();
      user.publish("look_at", point);
      const auto result = results.waitForNext(std::chrono::seconds(5));
      EXPECT_TRUE(!result || (!result->success && !result->moves));
      return result && result->message.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("nobody listens on /stares/joint_command"));
  driver.stop("/user");
  EXPECT_TRUE(says("/user has stopped the robot; call release"));
  driver.release();
  driver.tell(RobotState::OFF, RobotState::LYING);
  EXPECT_TRUE(says("the motors are off"));
}

TEST(Monitor, WithoutADriverEndsAfterItsTimeAndSaysThatNoPictureCame) {
  for (const char* parameter : {"_first_picture_timeout:=1", "_seconds:=1"}) {
    ros::param::del("/nobody");
    Process monitor({AIBO_MONITOR, "__ns:=/nobody", parameter});
    EXPECT_EQ(monitor.waitForExit(kSafetyNet), 1);
    EXPECT_THAT(monitor.output(), testing::HasSubstr("no driver in namespace /nobody"));
    EXPECT_THAT(monitor.output(), testing::HasSubstr("no picture came within 1 s"));
  }
}

// A computer that stalls for seconds gets another chance.
TEST(Monitor, SaysEachSecondWhatIsMissing) {
  bool says_it_twice = false;
  for (int attempt = 0; attempt < 5 && !says_it_twice; ++attempt) {
    Process monitor({AIBO_MONITOR, "__ns:=/nobody", "_first_picture_timeout:=3"});
    EXPECT_EQ(monitor.waitForExit(kSafetyNet), 1);
    says_it_twice = monitor.output().find("no pictures") != monitor.output().rfind("no pictures");
  }
  EXPECT_TRUE(says_it_twice);
}

TEST(Monitor, SaysWhyNoPicturesComeAndWhoHasStoppedTheRobot) {
  FakeDriver driver("/watched");
  driver.stop("/user");
  TopicPublishers connections("/watched");
  Process monitor({AIBO_MONITOR, "__ns:=/watched"});
  aibo_driver::Connection connection;
  connection.text = "the robot \x1b[2J is off";
  connections.publish("connection", connection);
  monitor.waitForOutput("no pictures: the robot [^\x1b]* is off   stopped by /user, until release\\n");
}

TEST(Monitor, TellsFromTheFirstPictureOnHowManyComeAndHowOldTheyAre) {
  ros::Publisher pictures =
      ros::NodeHandle("/filmed").advertise<sensor_msgs::CompressedImage>("camera/image_raw/compressed", 10);
  Process monitor({AIBO_MONITOR, "__ns:=/filmed", "_seconds:=2", "_first_picture_timeout:=3600"});
  monitor.waitForOutput("(no pictures[^\\n]*\\n){3}");  // its time begins with the first picture
  sensor_msgs::CompressedImage picture;
  picture.data.resize(1000);
  const ros::WallTimer film = ros::NodeHandle().createWallTimer(
      ros::WallDuration(0.02), [&](const ros::WallTimerEvent&) { pictures.publish(picture); });
  EXPECT_NO_THROW(monitor.waitForOutput("[0-9]+\\.[0-9] pictures/s +[0-9.]+ KB/s   stamp to topic: .*\\n"));
  EXPECT_EQ(monitor.waitForExit(kSafetyNet), 0);
}

}  // namespace
