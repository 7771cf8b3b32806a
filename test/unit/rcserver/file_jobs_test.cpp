// Requests that need the memory stick, while it is at work.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fake_robot.h"
#include "motion_bytes.h"
#include "support/memory_stick.h"
#include "version2_fixture.h"

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr unsigned kUntilMeasured = 12;

class FileJobsTest : public Version2Fixture {
 protected:
  void SetUp() override {
    host_.memory_stick = stick_.path().c_str();
    stick_.write("OPEN-R/MW/CONF/RCSERVER.CFG", "ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\n");
    boot(robot_);
    passFrames(kUntilMeasured);
    connectVersion2();
    file_keeper_.slowDown();
  }

  static std::string play(const std::string& name, int repetitions) {
    return std::string{static_cast<char>(repetitions >> 8), static_cast<char>(repetitions)} + name;
  }

  static std::string upload(const std::string& name, const std::string& content) {
    return static_cast<char>(name.size()) + name + content;
  }

  // What has come: kind and request number of each frame, and what an error says.
  std::vector<std::string> answers() {
    std::vector<std::string> all;
    machine_->runPending();
    while (const std::optional<Frame> next = client_->nextFrame()) {
      all.push_back(next->header.kind + std::to_string(next->header.request_number));
      if (next->header.kind == 'e') {
        all.back() += " " + std::string(next->payload.begin() + 2, next->payload.end());
      }
    }
    return all;
  }

  // The memory stick does its job, and the next one that may come does not take any time.
  void finishJobs() {
    file_keeper_.speedUp();
    passFrames(FakeRobot::kFramesPerImage);
  }

  bool hasFile(const std::string& name) { return std::filesystem::exists(stick_.path("OPEN-R/MW/DATA/P/" + name)); }

  bool moves(const std::string& joint) {
    const int before = robot_.joint(joint).position;
    bool has_moved = false;
    for (int i = 0; i < 100; ++i) {
      passFrames(4);
      has_moved = has_moved || robot_.joint(joint).position != before;
    }
    return has_moved;
  }

  test_support::MemoryStick stick_;
  FakeRobot robot_;
  const std::string motion_ = motionBytes("at 0 head_pan 0\nat 800 head_pan 30\n");
};

TEST_F(FileJobsTest, OtherRequestsAreAnsweredWhileAFileIsRead) {
  send(frame('P', 0, 1, play("WAG.MTN", 1000)));
  ASSERT_TRUE(file_keeper_.hasJob());
  send(frame('H', 0, 2) + frame('O', 0, 3) + frame('J', 0, 4, std::string(4, '\0')) +
       frame('P', 0, 5, play("SIT.MTN", 0)));
  EXPECT_THAT(answers(), ElementsAre("h2", "o3", "j4", "p5"));
  EXPECT_FALSE(moves("tail_pan"));
  finishJobs();
  EXPECT_THAT(answers(), ElementsAre("p1"));
  EXPECT_TRUE(moves("tail_pan"));
}

// Level2 Reference Guide, chapter 1: an object handles one message at a time. So nothing may wait for the memory stick.
TEST_F(FileJobsTest, JointsMoveWhileAFileIsRead) {
  const std::string head_pan_to_half_a_radian("\0\0\1\0\2\0\0\0\0\7\241\40", 12);
  send(frame('P', 0, 1, play("WAG.MTN", 1)));
  send(frame('J', 0, 2, head_pan_to_half_a_radian));
  passFrames(300);
  EXPECT_EQ(robot_.joint("head_pan").position, 500000);
  EXPECT_TRUE(file_keeper_.hasJob());
}

TEST_F(FileJobsTest, JointThatIsCommandedWhileAFileIsReadGoesWhereItWasTold) {
  const std::string tail_pan_to_half_a_radian("\0\0\1\0\63\0\0\0\0\7\241\40", 12);
  send(frame('P', 0, 1, play("WAG.MTN", 1000)));
  ASSERT_TRUE(file_keeper_.hasJob());
  send(frame('J', 0, 2, tail_pan_to_half_a_radian));
  EXPECT_THAT(answers(), ElementsAre("j2"));
  finishJobs();
  const std::vector<std::string> got = answers();
  ASSERT_EQ(got.size(), 1U);
  EXPECT_THAT(got[0], HasSubstr("e1 tail_pan was commanded while the file of WAG.MTN was being read"));
  passFrames(300);
  EXPECT_EQ(robot_.joint("tail_pan").position, 500000);
  send(frame('P', 0, 3, play("WAG.MTN", 1000)));
  finishJobs();
  EXPECT_THAT(answers(), ElementsAre("p3")) << "a command of before it does not count";
}

TEST_F(FileJobsTest, SecondFileRequestWaitsForItsTurnAndWhatFollowsItToo) {
  send(frame('P', 0, 1, play("WAG.MTN", 1)));
  send(frame('D', 0, 2, "NOD.MTN") + frame('H', 0, 3));
  send(frame('U', 0, 4, upload("NEW.MTN", motion_)) + frame('N', 0, 5) + frame('H', 0, 6));
  EXPECT_THAT(answers(), ElementsAre());
  file_keeper_.finish();
  passFrames(FakeRobot::kFramesPerImage);
  EXPECT_THAT(answers(), ElementsAre("p1", "h3"));
  EXPECT_TRUE(hasFile("NOD.MTN"));
  finishJobs();
  EXPECT_THAT(answers(), ElementsAre("d2", "u4", "h6", "n5"));
  EXPECT_FALSE(hasFile("NOD.MTN"));
  EXPECT_TRUE(hasFile("NEW.MTN"));
}

TEST_F(FileJobsTest, MotionThatIsStoppedWhileItsFileIsReadIsNotPlayed) {
  for (const std::string& name : {std::string("WAG.MTN"), std::string()}) {
    file_keeper_.slowDown();
    send(frame('P', 0, 1, play("WAG.MTN", 1000)));
    ASSERT_TRUE(file_keeper_.hasJob());
    send(frame('P', 0, 2, play(name, 0)));
    EXPECT_THAT(answers(), ElementsAre("p2"));
    finishJobs();
    EXPECT_THAT(answers(), ElementsAre("e1 WAG.MTN was stopped while its file was being read"));
    EXPECT_FALSE(moves("tail_pan"));
  }
}

TEST_F(FileJobsTest, MotionIsNotPlayedIfTheMotorsWereOffWhileItsFileWasRead) {
  for (const bool are_on_again : {false, true}) {
    file_keeper_.slowDown();
    send(frame('P', 0, 1, play("WAG.MTN", 1000)));
    ASSERT_TRUE(file_keeper_.hasJob());
    send(frame('O', 0, 2, std::string(1, '\0')) + (are_on_again ? frame('O', 0, 3, "\1") : ""));
    answers();
    finishJobs();
    EXPECT_THAT(answers(), ElementsAre(HasSubstr("e1 WAG.MTN is not played: the motors were switched off")));
    send(frame('O', 0, 4, "\1"));
    answers();
    EXPECT_FALSE(moves("tail_pan"));
  }
}

TEST_F(FileJobsTest, JointsThatAreTakenMeanwhileRefuseTheMotion) {
  file_keeper_.speedUp();
  send(frame('P', 0, 1, play("NOD.MTN", 1000)));
  EXPECT_THAT(answers(), ElementsAre("p1"));
  send(frame('P', 0, 2, play("SIT.MTN", 1)));
  EXPECT_THAT(answers(), ElementsAre(HasSubstr("e2 NOD.MTN is being played and moves neck_tilt")));
}

TEST_F(FileJobsTest, ResultForAClientThatHasGoneIsNotTakenForTheNextOnes) {
  send(frame('P', 0, 1, play("WAG.MTN", 1000)));
  ASSERT_TRUE(file_keeper_.hasJob());
  reconnect();
  send(frame('D', 0, 1, "NOD.MTN"));
  EXPECT_TRUE(hasFile("NOD.MTN"));
  finishJobs();
  EXPECT_THAT(answers(), ElementsAre("d1"));
  EXPECT_FALSE(hasFile("NOD.MTN"));
  EXPECT_FALSE(moves("tail_pan"));
}

TEST_F(FileJobsTest, UploadIsFinishedAsAWholeThoughItsClientHasGone) {
  send(frame('U', 0, 1, upload("NEW.MTN", motion_)));
  ASSERT_TRUE(file_keeper_.hasJob());
  client_->close();
  machine_->runPending();
  EXPECT_FALSE(hasFile("NEW.MTN"));
  finishJobs();
  EXPECT_EQ(fileContent(stick_.path("OPEN-R/MW/DATA/P/NEW.MTN")), motion_);
}

// 256 names of 12 letters make the longest answer there is.
TEST_F(FileJobsTest, LongestAnswerFindsRoomHoweverManyOthersWait) {
  for (int i = 0; i < 256; ++i) {
    stick_.write("OPEN-R/MW/DATA/P/DANCE" + std::to_string(100 + i) + ".MTN", "");
  }
  client_->close();
  machine_->runPending();
  client_ = connect(4096);
  send(request('X', 2));
  ASSERT_TRUE(await(*client_));
  std::string bytes = frame('N', 0, 1);
  for (int i = 0; i < 4096; ++i) {
    bytes += frame('V', 0, 7);
  }
  for (size_t sent = 0; sent < bytes.size(); machine_->runPending()) {
    sent += client_->send(bytes.substr(sent));
  }
  ASSERT_TRUE(file_keeper_.hasJob());
  finishJobs();
  int limits = 0;
  std::string list;
  while (limits < 4096 || list.empty()) {
    const std::optional<Frame> next = nextFrame();
    ASSERT_TRUE(next);
    if (next->header.kind == 'n') {
      list.assign(next->payload.begin(), next->payload.end());
    } else {
      ASSERT_EQ(next->header.kind, 'v') << "after " << limits;
      ++limits;
    }
  }
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 255);
}

TEST_F(FileJobsTest, Version1AnswersInTheOrderOfTheRequests) {
  client_->close();
  machine_->runPending();
  client_ = connectServed();
  const std::string play_wag = std::string("P\7WAG.MTN\0\0\0\0\0\1\0\0\0", 18);
  client_->send(play_wag + request('?', 0) + request('X', 3));
  machine_->runPending();
  ASSERT_TRUE(file_keeper_.hasJob());
  passFrames(100);
  EXPECT_FALSE(client_->next());
  finishJobs();
  for (const char letter : {'p', 'e', 'e'}) {
    const std::optional<Reply> reply = await(*client_);
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->letter, letter);
  }
}

TEST_F(FileJobsTest, ConsoleNamesTheMemoryStickWhenARequestWaitsTooLong) {
  send(frame('P', 0, 1, play("WAG.MTN", 1)) + frame('P', 0, 2, play("NOD.MTN", 1)));
  passFrames(640);
  EXPECT_TRUE(awaitEnd(*client_));
  EXPECT_THAT(console_.str(), HasSubstr("is gone: FileKeeper has not answered its request for 5 s"));
}

TEST_F(FileJobsTest, NextClientOfVersion1IsServedWhenTheMemoryStickHasDoneTheLastOnesJob) {
  send(frame('P', 0, 1, play("WAG.MTN", 1000)));
  client_->close();
  machine_->runPending();
  client_ = connect();
  client_->send(request('?', 0));
  machine_->runPending();
  finishJobs();
  EXPECT_TRUE(await(*client_));
  EXPECT_FALSE(moves("tail_pan"));
}

// ---------------------------------------------------------------------------------------------- missing objects

// A memory stick whose owner has forgotten the two helpers.
class LonelyServerTest : public FileJobsTest {
 protected:
  void SetUp() override {
    stick_.write("OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/RCSERVER.BIN\n");
    stick_.write("OPEN-R/MW/CONF/CONNECT.CFG",
                 "OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S RCServer.Image.OFbkImageVectorData.O\n"
                 "OVirtualRobotComm.Sensor.OSensorFrameVectorData.S RCServer.Sensor.OSensorFrameVectorData.O\n"
                 "RCServer.Effector.OCommandVectorData.S OVirtualRobotComm.Effector.OCommandVectorData.O\n");
    FileJobsTest::SetUp();
  }
};

TEST_F(LonelyServerTest, WithoutFileKeeperItsRequestsAreRefusedAndOthersAreServed) {
  send(frame('P', 0, 1, play("WAG.MTN", 1)) + frame('N', 0, 2) + frame('H', 0, 3));
  const std::vector<std::string> got = answers();
  ASSERT_EQ(got.size(), 3U);
  EXPECT_THAT(got[0], HasSubstr("e1 the object FileKeeper does not run on the robot: FILES.BIN is missing"));
  EXPECT_THAT(got[1], HasSubstr("e2 the object FileKeeper does not run"));
  EXPECT_EQ(got[2], "h3");
}

TEST_F(LonelyServerTest, WithoutPictureEncoderTheConsoleNamesIt) {
  send(frame('F', 85, 1, std::string(1, '\0')));
  passFrames(FakeRobot::kFramesPerImage);
  EXPECT_TRUE(awaitEnd(*client_));
  EXPECT_THAT(console_.str(), HasSubstr("the object PictureEncoder does not run: ENCODER.BIN is missing"));
}

}  // namespace
