#include <aibo_driver/DeleteMotion.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/StopMotion.h>
#include <aibo_driver/UploadMotion.h>
#include <gmock/gmock.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "node/services.h"
#include "support/fake_client.h"
#include "support/temporary_folder.h"
#include "unit/driver/call_service.h"

namespace aibo_driver::node {
namespace {

using namespace std::chrono_literals;
using test_support::callService;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kMotion = std::string(MEMORY_STICK) + "/OPEN-R/MW/DATA/P/NOD.MTN";

class RobotServicesTest : public ::testing::Test {
 protected:
  RobotServicesTest() {
    mover_.connected();
    for (const Services& each : {stopServices(mover_), motionServices(mover_), robotServices(client_, mover_)}) {
      services_.insert(services_.end(), each.begin(), each.end());
    }
  }

  std_srvs::SetBool::Response setMotors(bool on) {
    std_srvs::SetBool::Request request;
    request.data = static_cast<std::uint8_t>(on);
    return callService<std_srvs::SetBool>(services_, "motors", request);
  }

  PlayMotion::Response play(const std::string& name, std::uint16_t repetitions = 1) {
    PlayMotion::Request request;
    request.name = name;
    request.repetitions = repetitions;
    return callService<PlayMotion>(services_, "play_motion", request);
  }

  StopMotion::Response stopMotion(const std::string& name) {
    StopMotion::Request request;
    request.name = name;
    return callService<StopMotion>(services_, "stop_motion", request);
  }

  UploadMotion::Response upload(const std::string& name, const std::string& file, std::vector<std::uint8_t> data) {
    UploadMotion::Request request;
    request.name = name;
    request.file = file;
    request.data = std::move(data);
    return callOfStick<UploadMotion>("upload_motion", 15s, request);
  }

  DeleteMotion::Response remove(const std::string& name) {
    DeleteMotion::Request request;
    request.name = name;
    return callOfStick<DeleteMotion>("delete_motion", 5s, request);
  }

  /// A call that waits as long as this for the memory stick, if it comes to that.
  template <typename Service>
  typename Service::Response callOfStick(const std::string& name, std::chrono::seconds timeout,
                                         const typename Service::Request& request = {}) {
    client_.timeout = timeout;
    const auto response = callService<Service>(services_, name, request);
    EXPECT_EQ(client_.timeout, timeout) << name;
    return response;
  }

  /// Calls stop, release, shut_down or reboot.
  std_srvs::Trigger::Response call(const std::string& name) { return callService<std_srvs::Trigger>(services_, name); }

  const std::string& lastTold() const { return client_.told.back(); }

  test_support::FakeClient client_;
  movement::JointTable table_{"ERS-7", 3.0};
  movement::MeasuredJoints measured_{table_};
  movement::Mover mover_{table_, measured_, client_, 0.5};
  Services services_;
};

TEST_F(RobotServicesTest, StopUntilRelease) {
  const auto response = call("stop");
  EXPECT_TRUE(response.success);
  EXPECT_EQ(response.message, "The robot holds. Until release is called, only rest moves it.");
  EXPECT_THAT(client_.told, ElementsAre("hold"));
  EXPECT_EQ(play("nod").message, "Nothing was played: stopped by /user; call release.");
  EXPECT_EQ(setMotors(true).message, "The motors were not switched: stopped by /user; call release.");
  EXPECT_EQ(call("release").message, "The robot may be moved again.");
  EXPECT_TRUE(setMotors(true).success);
  EXPECT_TRUE(play("nod").success);
}

TEST_F(RobotServicesTest, NeitherShutDownNorRebootAStoppedRobotWhichMightFall) {
  call("stop");
  client_.told.clear();
  EXPECT_EQ(call("shut_down").message, "The robot does not shut down: stopped by /user; call release.");
  EXPECT_EQ(call("reboot").message, "The robot does not reboot: stopped by /user; call release.");
  EXPECT_THAT(client_.told, testing::IsEmpty());
}

TEST_F(RobotServicesTest, StopWithoutARobot) {
  client_.problem = "there is no robot";
  const auto response = call("stop");
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.message,
            "Until release is called, only rest moves the robot, but it could not be told to stop: there is no robot");
}

TEST_F(RobotServicesTest, SwitchTheMotors) {
  EXPECT_EQ(setMotors(true).message, "The motors are on.");
  const auto off = setMotors(false);
  EXPECT_TRUE(off.success);
  EXPECT_THAT(off.message, HasSubstr("moved by hand"));
  EXPECT_THAT(client_.told, ElementsAre("motors on", "motors off"));
}

TEST_F(RobotServicesTest, SayThatTheMotorsDidNotSwitch) {
  client_.motors_work = false;
  const auto on = setMotors(true);
  EXPECT_FALSE(on.success);
  EXPECT_THAT(on.message, testing::AllOf(testing::StartsWith("The motors were not switched"), HasSubstr("still off")));
  const auto off = setMotors(false);
  EXPECT_FALSE(off.success) << "somebody might take hold of a joint that moves";
  EXPECT_THAT(off.message, testing::AllOf(testing::StartsWith("The motors were not switched"), HasSubstr("still on")));
}

TEST_F(RobotServicesTest, PlayAMotionAsOftenAsAskedFor) {
  EXPECT_EQ(play("nod", 1).message, "NOD.MTN has begun and plays once.");
  EXPECT_EQ(play("nod", 0).message, "NOD.MTN has begun and plays once.") << "a call that leaves it out";
  client_.motion_changes = "1 step is too fast, so it takes 2.98 s, which is 1.38 s longer";
  EXPECT_EQ(play("nod", 3).message,
            "NOD.MTN has begun and plays 3 times: 1 step is too fast, so it takes 2.98 s, which is 1.38 s longer.");
  EXPECT_EQ(lastTold(), "play NOD.MTN 3");
  EXPECT_THAT(play("").message, HasSubstr("list_motions"));
}

TEST_F(RobotServicesTest, SayWhetherAMotionWasPlayedWhoseEndIsKnownBeforeTheAnswer) {
  EXPECT_EQ(play("nod").message, "NOD.MTN has begun and plays once.") << "it plays on";
  EXPECT_THAT(mover_.state().movements, ::testing::SizeIs(1));
  const auto end_meanwhile = [this](aibo_client::EndedHow how) {
    client_.meanwhile = [this, how] {
      mover_.ended({aibo_client::EndedKind::kMotion, how, "", "the joints were commanded", client_.order()});
    };
  };
  end_meanwhile(aibo_client::EndedHow::kDone);
  EXPECT_EQ(play("wag").message, "WAG.MTN has begun and plays once.");
  end_meanwhile(aibo_client::EndedHow::kReplaced);
  const auto response = play("wag");
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.message, "Nothing was played: the joints were commanded.");
}

TEST_F(RobotServicesTest, StopOneMotionOrAll) {
  EXPECT_EQ(stopMotion("nod").message, "NOD.MTN does not play now: the joints hold where they are.");
  EXPECT_EQ(lastTold(), "stop NOD.MTN");
  EXPECT_EQ(stopMotion("").message, "No motion plays now: the joints hold where they are.");
  EXPECT_EQ(lastTold(), "stop ");
}

TEST_F(RobotServicesTest, WaitTwoSecondsUntilTheRobotHasBegunOrStopped) {
  const std::function<void()> calls[] = {[&] { setMotors(false); }, [&] { setMotors(true); }, [&] { play("nod"); },
                                         [&] { stopMotion("nod"); }, [&] { call("stop"); }};
  for (const auto& each : calls) {
    each();
    EXPECT_EQ(std::exchange(client_.timeout, 0s), 2s) << lastTold();
  }
}

TEST_F(RobotServicesTest, ListTheMotions) {
  client_.motions = {"NOD.MTN", "SIT.MTN"};
  const auto response = callOfStick<ListMotions>("list_motions", 5s);
  EXPECT_TRUE(response.success);
  EXPECT_EQ(response.message, "Motions on the robot: 2.");
  EXPECT_THAT(response.names, ElementsAre("NOD.MTN", "SIT.MTN"));
}

TEST_F(RobotServicesTest, UploadDataOrAFileUnderItsOwnNameUnlessThereIsAnother) {
  const test_support::TemporaryFolder folder;
  const std::string file = folder.path("bow.mtn").string();
  std::filesystem::copy_file(kMotion, file);
  EXPECT_EQ(upload("wag", "", {1, 2, 3}).message, "WAG.MTN is on the robot, 3 bytes.");
  EXPECT_TRUE(upload("", file, {}).success);
  EXPECT_TRUE(upload("wag", file, {}).success);
  const std::string size = std::to_string(std::filesystem::file_size(kMotion));
  EXPECT_THAT(client_.told, ElementsAre("upload WAG.MTN 3", "upload BOW.MTN " + size, "upload WAG.MTN " + size));
}

TEST_F(RobotServicesTest, UploadNoFileThatIsNotAWholeMotion) {
  EXPECT_THAT(upload("env", "/proc/self/environ", {}).message, HasSubstr("is not a motion file"));
  EXPECT_THAT(client_.told, testing::IsEmpty());
}

TEST_F(RobotServicesTest, UploadNothingWithoutExactlyOneSource) {
  EXPECT_EQ(upload("wag", "", {}).message, "Nothing was uploaded: give a file or data");
  EXPECT_EQ(upload("wag", "bow.mtn", {1}).message, "Nothing was uploaded: give a file or data, not both");
  EXPECT_THAT(upload("wag", "/no/such/file", {}).message, HasSubstr("there is no such file on the computer "));
  EXPECT_THAT(client_.told, testing::IsEmpty());
}

TEST_F(RobotServicesTest, AnswerWithTheReasonIfTheRobotCannotBeAsked) {
  client_.problem = "there is no robot";
  const auto response = remove("nod");
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.message, "Nothing was deleted: there is no robot");
  EXPECT_EQ(stopMotion("nod").message, "Nothing was stopped: there is no robot");
  EXPECT_EQ(play("nod").message, "Nothing was played: there is no robot.") << "a call has no past";
  EXPECT_EQ(call("shut_down").message, "The robot does not shut down: there is no robot");
  EXPECT_EQ(call("reboot").message, "The robot does not reboot: there is no robot");
}

TEST_F(RobotServicesTest, AnswerInPlainTextOfLimitedLength) {
  client_.problem = "\x1b[2J" + std::string(5000, 'x');
  const std::string message = remove("nod").message;
  EXPECT_THAT(message, testing::StartsWith("Nothing was deleted: ?[2Jxx"));
  EXPECT_EQ(message.size(), 4000U);
}

TEST_F(RobotServicesTest, DeleteAMotionShutDownAndReboot) {
  EXPECT_EQ(remove("").message, "Nothing was deleted: give the name of a motion. list_motions lists them.");
  EXPECT_EQ(remove("nod").message, "NOD.MTN was deleted from the robot.");
  EXPECT_TRUE(callOfStick<std_srvs::Trigger>("shut_down", 5s).success);
  EXPECT_TRUE(callOfStick<std_srvs::Trigger>("reboot", 5s).success);
  EXPECT_THAT(client_.told, ElementsAre("delete NOD.MTN", "shut down", "reboot"));
}

}  // namespace
}  // namespace aibo_driver::node
