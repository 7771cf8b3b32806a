// Requests about motions, in both versions, and all that need the memory stick, while FileKeeper is at work.

#include <tuple>

#include "motion_bytes.h"
#include "protocol/motion_requests.h"
#include "protocol/stick_pictures.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver_fixture.h"

namespace {

using protocol::version2::LEAVE_OUT_MISSING_JOINTS;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kPan = 2;

const char kFolder[] = "OPEN-R/MW/DATA/P";

class MotionsInVersion1 : public Version1Fixture {
 protected:
  std::vector<std::string> motions() const { return namesIn(stick_.path(kFolder)); }

  static std::string upload(const std::string& name, const std::string& content) {
    return fileRequest('U', name, static_cast<unsigned short>(content.size() / 512),
                       static_cast<unsigned short>(content.size() % 512)) +
           content;
  }

  std::string answerTo(const std::string& bytes) {
    client_->send(bytes);
    const std::optional<Reply> reply = await(*client_);
    machine_->runPending();
    return reply ? reply->letter + std::to_string(reply->value.identifier) + " " + std::to_string(reply->value.value)
                 : "none";
  }

  const std::string motion_ = motionBytes("at 0 head_pan 0\nat 800 head_pan 30\n");
};

TEST_F(MotionsInVersion1, AnswersWhatItCannotPlayByAnErrorCode) {
  stick_.write(std::string(kFolder) + "/BAD.MTN", "OMTN and nothing more");
  const std::pair<std::string, std::string> rows[] = {
      {"MISSING.MTN", "e0 1"}, {"NOD.TXT", "e0 2"}, {"../A.MTN", "e0 2"}, {"", "e0 2"}, {"BAD.MTN", "e0 0"}};
  for (const auto& [name, error] : rows) {
    EXPECT_EQ(answerTo(fileRequest('P', name, 1)), error) << name;
  }
}

TEST_F(MotionsInVersion1, PlaysAMotionAndStopsItWithZeroRepetitions) {
  for (const char* const name : {"WAG.MTN", ""}) {
    EXPECT_EQ(answerTo(fileRequest('P', "wag.mtn", 1000)), "p7 0");
    EXPECT_TRUE(moves("tail_pan"));
    EXPECT_EQ(answerTo(fileRequest('P', name, 0)), "p7 0");
    passFrames(100);
    EXPECT_FALSE(moves("tail_pan", 100));
  }
  EXPECT_EQ(answerTo(fileRequest('P', "WAG.MTN", 0)), "p7 0") << "it is over already";
}

TEST_F(MotionsInVersion1, UploadsAndDeletesOnlyIfAllowed) {
  EXPECT_EQ(answerTo(upload("NEW.MTN", motion_)), "e0 0");
  EXPECT_EQ(answerTo(fileRequest('D', "NOD.MTN", 0)), "e0 0");
  EXPECT_EQ(answerTo(request('J', kPan)).substr(0, 2), "j2") << "the content was skipped";
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "NOD.MTN", "SIT.MTN", "WAG.MTN"));
}

TEST_F(MotionsInVersion1, AnUploadThatIsCutOffLeavesNoFile) {
  startWith("ALLOW_UPLOAD=yes\n");
  const std::string bytes = upload("NEW.MTN", motion_);
  client_->send(bytes.substr(0, bytes.size() - 1));
  machine_->runPending();
  client_->close();
  passFrames(kUntilMeasured);
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "NOD.MTN", "SIT.MTN", "WAG.MTN"));
  client_ = connectServed();
  EXPECT_EQ(answerTo(fileRequest('P', "NEW.MTN", 1)), "e0 1");
  EXPECT_EQ(answerTo(upload("NEW.MTN", motion_)), "u7 0");
  EXPECT_EQ(contentOf(stick_.path(kFolder) / "NEW.MTN"), motion_);
}

TEST_F(MotionsInVersion1, AFileThatIsNotAMotionIsNotStored) {
  startWith("ALLOW_UPLOAD=yes\n");
  EXPECT_EQ(answerTo(upload("NEW.MTN", "no motion")), "e0 0");
  EXPECT_EQ(answerTo(upload("NEW.MTN", "")), "e0 0");
  EXPECT_EQ(answerTo(upload("NEW.TXT", motion_)), "e0 2");
  EXPECT_EQ(answerTo(upload("COM1.MTN", motion_)), "e0 0");
  EXPECT_EQ(answerTo(upload("WAG~1.MTN", motion_)), "e0 0");
  EXPECT_EQ(answerTo(upload("NEW.MTN", motionBytes("robot ERS-210\nat 0 head_roll 0\n"))), "e0 0");
  EXPECT_EQ(answerTo(fileRequest('U', "NEW.MTN", 1000)), "e0 0") << "at once, before any of the content has arrived";
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "NOD.MTN", "SIT.MTN", "WAG.MTN"));
}

TEST_F(MotionsInVersion1, DeletesExistingMotions) {
  startWith("ALLOW_DELETE=yes\n");
  EXPECT_EQ(answerTo(fileRequest('D', "nod.mtn", 0)), "d7 0");
  EXPECT_EQ(answerTo(fileRequest('D', "NOD.MTN", 0)), "e0 1");
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "SIT.MTN", "WAG.MTN"));
}

class MotionsInVersion2 : public Version2Fixture {};

TEST_F(MotionsInVersion2, TellsWhatIsPlayedDifferently) {
  stick_.write(
      std::string(kFolder) + "/FAST.MTN",
      motionBytes("at 0 PRM:/r1/c1/c2/c3-Joint2:j3 0 head_pan 0 left_ear 0\nat 1600 head_pan 91 left_ear 1\n"));
  const std::string play = playPayload("FAST.MTN", 1);
  expectRefusal(ask('P', 0, play), protocol::version2::CODE_REFUSED, "which this robot does not have");
  EXPECT_EQ(textOf(ask('P', LEAVE_OUT_MISSING_JOINTS, play)),
            "1 joint that this robot does not have is left out; head_pan is clipped by up to 3.0 degrees (at 1600 ms)");
  passFrames(400);
  const std::vector<bool>& ear = robot_.ears[0].path;
  EXPECT_EQ(std::count(ear.begin(), ear.end(), true), LightDriver::EAR_FRAMES);
}

TEST_F(MotionsInVersion2, ReportsAMotionThatAFaultyJointStops) {
  EXPECT_EQ(ask('P', 0, playPayload("NOD.MTN", 100)).header.kind, 'p');
  passFrames(100);
  robot_.joint("neck_tilt").jammed = true;
  robot_.joint("neck_tilt").position -= 800000;
  passFrames(2 * JointWatch::PATIENCE);
  expectRefusal(nextPush('e'), protocol::version2::CODE_JOINT_FAULT, "neck_tilt is jammed");
  EXPECT_THAT(textOf(nextPush('i')), HasSubstr("NOD.MTN\nneck_tilt does not follow"));
  passFrames(100);
  EXPECT_FALSE(moves("head_tilt"));
}

// How long the memory stick takes for a file, in seconds. A newly booted robot, and one with a full stick, are slow.
constexpr double kReadingTimes[] = {0, 1.5, 3, 6};

class FileJobsTest : public FakeRobotFixture {
 protected:
  void SetUp() override {
    startWith("ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\nALLOW_PICTURES=yes\n");
    connectVersion2();
    file_keeper_.slowDown();
  }

  // The memory stick works for this time. Meanwhile only the answers to the heartbeat come.
  void wait(double seconds) {
    for (double passed = 0; passed < seconds; passed += 0.5) {
      EXPECT_EQ(answerTo('H', 0).header.kind, 'h');
      passFrames(kFramesASecond / 2);
    }
    EXPECT_THAT(heard(), IsEmpty());
  }

  // Finishes the job; later jobs take no time.
  void finishJobs() {
    file_keeper_.speedUp();
    passFrames(FakeRobot::kFramesPerImage);
  }

  bool hasFile(const std::string& name) { return std::filesystem::exists(stick_.path("OPEN-R/MW/DATA/P/" + name)); }

  const std::string motion_ = motionBytes("at 0 head_pan 0\nat 800 head_pan 30\n");
};

TEST_F(FileJobsTest, AMotionDoesNotBeginIfAJointWasOrderedWhileItWasRead) {
  for (const std::string& last : {frame('J', 0, 2, order(targetsOf({{51, 500000}}))), frame('I', 1, 2, "\1\63")}) {
    for (const double seconds : kReadingTimes) {
      SCOPED_TRACE(last.substr(0, 1) + ", " + std::to_string(seconds) + " s");
      file_keeper_.slowDown();
      send(frame('P', 0, 1, playPayload("WAG.MTN", 1000)));
      ASSERT_TRUE(file_keeper_.hasJob());
      send(last);
      EXPECT_THAT(heard(), Contains(HasSubstr("2")));
      passFrames(seconds > 0 ? 300 : 0);
      heard();  // the joint may have arrived
      wait(seconds);
      finishJobs();
      EXPECT_THAT(heard(), ElementsAre(HasSubstr("e1 0 tail_pan was commanded while the file of WAG.MTN")));
      passFrames(300);
      EXPECT_EQ(robot_.joint("tail_pan").position, 500000);
      heard();
    }
  }
  send(frame('P', 0, 3, playPayload("WAG.MTN", 1000)));
  finishJobs();
  EXPECT_THAT(heard(), ElementsAre("p3")) << "an earlier command does not matter";
  file_keeper_.slowDown();
  send(frame('P', 0, 4, playPayload("SIT.MTN", 1)) + frame('E', 2, 5, order()));
  finishJobs();
  EXPECT_THAT(heard(), Contains(HasSubstr("was commanded while the file of SIT.MTN"))) << "a posture takes the legs";
}

TEST_F(FileJobsTest, ASecondFileRequestIsRefusedAndAllOthersAreAnsweredAtOnce) {
  send(frame('P', 0, 1, playPayload("WAG.MTN", 1)));
  using namespace protocol::version2;
  for (const auto& [kind, id, payload] : {std::tuple('D', 0, std::string("NOD.MTN")),
                                          {'N', 0, ""},
                                          {'P', 0, playPayload("NOD.MTN", 1)},
                                          {'U', 0, uploadPayload("NEW.MTN", motion_)},
                                          {'M', 85, ""},
                                          {'Y', int{LIST_PICTURES}, ""},
                                          {'Y', int{FETCH_PICTURE}, "A.JPG"},
                                          {'Y', int{DELETE_PICTURE}, "A.JPG"}}) {
    send(frame(kind, id, 2, payload));
    EXPECT_THAT(heard(), ElementsAre(HasSubstr("e2 0 the memory stick is busy with an earlier request"))) << kind;
  }
  send(frame('H', 0, 3));
  EXPECT_THAT(heard(), ElementsAre("h3"));
  finishJobs();
  EXPECT_THAT(heard(), ElementsAre("p1"));
  EXPECT_TRUE(hasFile("NOD.MTN"));
  EXPECT_FALSE(hasFile("NEW.MTN"));
  send(frame('N', 0, 4));
  EXPECT_THAT(heard(), ElementsAre("n4"));
}

TEST_F(FileJobsTest, NoMotionBeginsAfterAnOrderToStopHoweverSlowTheMemoryStickIs) {
  const std::pair<std::string, std::string> orders[] = {
      {frame('I', 0, 3), "is not played: everything was told to hold before its file had been read"},
      {frame('O', 0, 3, order(std::string(1, '\0'))) + frame('O', 0, 4, order("\1")),
       "is not played: the motors were switched off before its file had been read"},
      {frame('P', 0, 3, playPayload("", 0)), "was stopped before its file had been read"},
      {frame('P', 0, 3, playPayload("WAG.MTN", 0)), "was stopped before its file had been read"}};
  for (const auto& [stop, reason] : orders) {
    for (const double seconds : kReadingTimes) {
      SCOPED_TRACE(reason + ", " + std::to_string(seconds) + " s");
      file_keeper_.slowDown();
      send(frame('P', 0, 1, playPayload("WAG.MTN", 1000)));
      ASSERT_TRUE(file_keeper_.hasJob());
      send(stop);
      const std::vector<std::string> at_once = heard();
      ASSERT_GE(at_once.size(), 2U);
      EXPECT_EQ(at_once[0], "e1 0 WAG.MTN " + reason) << "before the answer to the stop";
      EXPECT_EQ(at_once[1].substr(1), "3");
      send(frame('N', 0, 5));
      EXPECT_THAT(heard(), ElementsAre(HasSubstr("e5 0 the memory stick is busy")));
      wait(seconds);
      finishJobs();
      EXPECT_THAT(heard(), IsEmpty());
      EXPECT_FALSE(moves("tail_pan"));
    }
  }
}

TEST_F(FileJobsTest, ResultForAClientThatHasGoneIsNotUsedForTheNextOne) {
  send(frame('P', 0, 1, playPayload("WAG.MTN", 1000)));
  ASSERT_TRUE(file_keeper_.hasJob());
  reconnect();
  send(frame('D', 0, 1, "NOD.MTN"));
  EXPECT_TRUE(hasFile("NOD.MTN"));
  finishJobs();
  EXPECT_THAT(heard(), ElementsAre("d1"));
  EXPECT_FALSE(hasFile("NOD.MTN"));
  EXPECT_FALSE(moves("tail_pan"));
}

TEST_F(FileJobsTest, UploadIsCompletedThoughItsClientHasGone) {
  send(frame('U', 0, 1, uploadPayload("NEW.MTN", motion_)));
  ASSERT_TRUE(file_keeper_.hasJob());
  disconnect();
  EXPECT_FALSE(hasFile("NEW.MTN"));
  finishJobs();
  EXPECT_EQ(contentOf(stick_.path("OPEN-R/MW/DATA/P/NEW.MTN")), motion_);
}

// A memory stick without PictureEncoder and FileKeeper.
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

TEST_F(LonelyServerTest, RefusesFileRequestsAndNamesWhatPicturesNeedOnTheConsole) {
  const std::pair<char, int> requests[] = {{'P', 0}, {'N', 0}, {'M', 85}, {'Y', 1}};
  for (const auto& [kind, id] : requests) {
    expectRefusal(answerTo(kind, id, kind == 'P' ? playPayload("WAG.MTN", 1) : ""), protocol::version2::CODE_REFUSED,
                  "the object FileKeeper does not run on the robot: FILES.BIN is missing");
  }
  send(frame('F', 85, 1, kLayerHigh));
  passFrames(FakeRobot::kFramesPerImage);
  EXPECT_TRUE(awaitEnd(*client_));
  EXPECT_THAT(console_.str(), HasSubstr("the object PictureEncoder does not run: ENCODER.BIN is missing"));
}

}  // namespace
