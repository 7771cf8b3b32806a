// Requests about motions, in both versions.

#include "motion_bytes.h"
#include "protocol/motion_requests.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver_fixture.h"

namespace {

using protocol::version2::LEAVE_OUT_MISSING_JOINTS;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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

}  // namespace
