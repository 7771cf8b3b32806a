// Requests about motions, in both versions.
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motion_bytes.h"
#include "protocol/motion_requests.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "rcserver/body/LightDriver.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver_fixture.h"

namespace {

using protocol::version2::LEAVE_OUT_MISSING_JOINTS;
using protocol::version2::TELL_CHANGES;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr unsigned kLongestMotion = 2000;
constexpr int kPan = 2;

const char kFolder[] = "OPEN-R/MW/DATA/P";

class MotionsTest : public FakeRobotFixture {
 protected:
  void start(const std::string& settings) {
    startWith(settings);
    client_ = connectServed();
  }

  std::vector<std::string> motions() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(stick_.path(kFolder))) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  // A motion outside the folder.
  void writeOutside() { stick_.write("OPEN-R/MW/DATA/OUT.MTN", motion_); }

  // Everything on the stick is unchanged.
  void expectNothingTouchedOutside() const {
    EXPECT_EQ(fileContent(stick_.path("OPEN-R/MW/DATA/OUT.MTN")), motion_);
    EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "NOD.MTN", "SIT.MTN", "WAG.MTN"));
  }

  // The number of frames in which an ear was drawn.
  std::ptrdiff_t framesDrawn(std::size_t ear) const {
    const std::vector<bool>& path = robot_.ears[ear].path;
    return std::count(path.begin(), path.end(), true);
  }

  double degrees(const std::string& joint) { return robot_.joint(joint).position * 180e-6 / std::acos(-1.0); }

  const std::string motion_ = motionBytes("at 0 head_pan 0\nat 800 head_pan 30\n");
};

// ------------------------------------------------------------------------------------------------------ version 1

class Version1MotionsTest : public MotionsTest {
 protected:
  static std::string upload(const std::string& name, const std::string& content) {
    return fileRequest('U', name, static_cast<unsigned short>(content.size() / 512),
                       static_cast<unsigned short>(content.size() % 512)) +
           content;
  }

  std::string answer() {
    const std::optional<Reply> reply = await(*client_);
    machine_->runPending();
    if (!reply) {
      return "none";
    }
    return reply->letter + std::to_string(reply->value.identifier) + " " + std::to_string(reply->value.value);
  }

  std::string answerTo(const std::string& bytes) {
    client_->send(bytes);
    return answer();
  }
};

TEST_F(Version1MotionsTest, playsAMotionFromTheMemoryStick) {
  start("");
  EXPECT_EQ(answerTo(fileRequest('P', "nod.mtn", 1)), "p7 0");
  passFrames(kLongestMotion);
  const std::vector<int>& path = robot_.joint("neck_tilt").path;
  EXPECT_LT(*std::min_element(path.begin(), path.end()), -450000) << "it has nodded";
  EXPECT_NEAR(degrees("neck_tilt"), -10, 0.01);
}

TEST_F(Version1MotionsTest, flicksTheEarsOfAMotionAndTellsTheConsoleWhatIsDifferent) {
  start("");
  stick_.write(std::string(kFolder) + "/EARS.MTN",
               motionBytes("at 0 head_pan 0 left_ear 0 right_ear 0\nat 800 head_pan 90 left_ear 1 right_ear 1\n"
                           "at 1600 head_pan 90 right_ear 0\n"));
  EXPECT_EQ(answerTo(fileRequest('P', "EARS.MTN", 1)), "p7 0");
  passFrames(kLongestMotion);
  EXPECT_NEAR(degrees("head_pan"), 88, 0.01);
  EXPECT_EQ(framesDrawn(0), LightDriver::EAR_FRAMES);
  EXPECT_EQ(framesDrawn(1), 2 * LightDriver::EAR_FRAMES);
  const std::string line = "RCServer: EARS.MTN: 2 positions are clipped, by up to 2.0 degrees (head_pan at 800 ms)\n";
  EXPECT_EQ(answerTo(fileRequest('P', "EARS.MTN", 1)), "p7 0");
  EXPECT_THAT(console_.str(), HasSubstr(line));
  EXPECT_EQ(console_.str().find(line), console_.str().rfind(line)) << "once";
}

TEST_F(Version1MotionsTest, reportsMotionsThatCannotBePlayedByErrorCode) {
  start("");
  stick_.write(std::string(kFolder) + "/BAD.MTN", "OMTN and nothing more");
  EXPECT_EQ(answerTo(fileRequest('P', "MISSING.MTN", 1)), "e0 1");
  EXPECT_EQ(answerTo(fileRequest('P', "NOD.TXT", 1)), "e0 2");
  EXPECT_EQ(answerTo(fileRequest('P', "../A.MTN", 1)), "e0 2");
  EXPECT_EQ(answerTo(fileRequest('P', "", 1)), "e0 2");
  EXPECT_EQ(answerTo(fileRequest('P', "BAD.MTN", 1)), "e0 0");
}

TEST_F(Version1MotionsTest, stopsAMotionWithZeroRepetitions) {
  start("");
  for (const char* const name : {"WAG.MTN", ""}) {
    EXPECT_EQ(answerTo(fileRequest('P', "WAG.MTN", 1000)), "p7 0");
    passFrames(400);
    EXPECT_EQ(answerTo(fileRequest('P', name, 0)), "p7 0");
    passFrames(100);
    const int stopped_at = robot_.joint("tail_pan").position;
    passFrames(100);
    EXPECT_EQ(robot_.joint("tail_pan").position, stopped_at);
  }
  EXPECT_EQ(answerTo(fileRequest('P', "WAG.MTN", 0)), "p7 0") << "it is over already";
}

TEST_F(Version1MotionsTest, uploadsAndDeletesOnlyIfAllowed) {
  start("");
  EXPECT_EQ(answerTo(upload("NEW.MTN", motion_)), "e0 0");
  EXPECT_EQ(answerTo(fileRequest('D', "NOD.MTN", 0)), "e0 0");
  EXPECT_EQ(answerTo(request('J', kPan)).substr(0, 2), "j2") << "the content was skipped";
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "NOD.MTN", "SIT.MTN", "WAG.MTN"));
}

TEST_F(Version1MotionsTest, uploadsInPiecesOfAnySize) {
  start("ALLOW_UPLOAD=yes\n");
  std::string text = "at 0 head_pan 0\n";
  for (int i = 1; i < 200; ++i) {
    text += "at " + std::to_string(16 * i) + " head_pan " + std::to_string(i % 10) + "\n";
  }
  const std::string content = motionBytes(text);
  ASSERT_GT(content.size(), 2U * 1024);
  for (const std::string name : {"NEW.MTN", "next.mtn"}) {
    const std::string bytes = upload(name, content) + request('J', kPan);
    for (size_t begin = 0; begin < bytes.size(); begin += 700) {
      client_->send(bytes.substr(begin, 700));
      machine_->runPending();
    }
    EXPECT_EQ(answer(), "u7 0") << name;
    EXPECT_EQ(answer().substr(0, 2), "j2") << "bytes after the content are a request";
  }
  EXPECT_EQ(fileContent(stick_.path(kFolder) / "NEW.MTN"), content);
  EXPECT_EQ(fileContent(stick_.path(kFolder) / "NEXT.MTN"), content);
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "NEW.MTN", "NEXT.MTN", "NOD.MTN", "SIT.MTN", "WAG.MTN"));
}

TEST_F(Version1MotionsTest, anUploadThatIsCutOffLeavesNoFile) {
  start("ALLOW_UPLOAD=yes\n");
  const std::string bytes = upload("NEW.MTN", motion_);
  client_->send(bytes.substr(0, bytes.size() - 1));
  machine_->runPending();
  client_->close();
  passFrames(kUntilMeasured);
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "NOD.MTN", "SIT.MTN", "WAG.MTN"));
  client_ = connectServed();
  EXPECT_EQ(answerTo(fileRequest('P', "NEW.MTN", 1)), "e0 1");
  EXPECT_EQ(answerTo(upload("NEW.MTN", motion_)), "u7 0");
  EXPECT_EQ(fileContent(stick_.path(kFolder) / "NEW.MTN"), motion_);
}

TEST_F(Version1MotionsTest, aFileThatIsNotAMotionIsNotStored) {
  start("ALLOW_UPLOAD=yes\n");
  EXPECT_EQ(answerTo(upload("NEW.MTN", "no motion")), "e0 0");
  EXPECT_EQ(answerTo(upload("NEW.MTN", "")), "e0 0");
  EXPECT_EQ(answerTo(upload("NEW.TXT", motion_)), "e0 2");
  EXPECT_EQ(answerTo(upload("COM1.MTN", motion_)), "e0 0");
  EXPECT_EQ(answerTo(upload("WAG~1.MTN", motion_)), "e0 0");
  EXPECT_EQ(answerTo(upload("NEW.MTN", motionBytes("robot ERS-210\nat 0 head_roll 0\n"))), "e0 0");
  EXPECT_EQ(answerTo(upload("NEW.MTN", motionBytes("at 0 head_pan 110\n"))), "e0 0") << "it could not be played";
  EXPECT_EQ(answerTo(fileRequest('U', "NEW.MTN", 1000)), "e0 0") << "at once, before any of the content has arrived";
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "NOD.MTN", "SIT.MTN", "WAG.MTN"));
}

TEST_F(Version1MotionsTest, deletesExistingMotions) {
  start("ALLOW_DELETE=yes\n");
  EXPECT_EQ(answerTo(fileRequest('D', "nod.mtn", 0)), "d7 0");
  EXPECT_EQ(answerTo(fileRequest('D', "NOD.MTN", 0)), "e0 1");
  EXPECT_THAT(motions(), ElementsAre("LIE.MTN", "SIT.MTN", "WAG.MTN"));
}

// ------------------------------------------------------------------------------------------------------ version 2

class Version2MotionsTest : public MotionsTest {
 protected:
  void startVersion2(const std::string& settings) {
    startWith(settings);
    connectVersion2();
  }

  static std::string frame(char kind, const std::string& payload) { return ::frame(kind, 0, 1, payload); }

  /// @param bits the id, of motion_requests.h
  static std::string play(const std::string& name, int repetitions, int bits = 0) {
    return ::frame('P', bits, 1, playPayload(name, repetitions));
  }

  static std::string upload(const std::string& name, const std::string& content, int bits = 0) {
    return ::frame('U', bits, 1, uploadPayload(name, content));
  }

  // The next frame: its kind, the code if it is an error, and its payload.
  std::string answer() {
    std::optional<Frame> frame;
    EXPECT_TRUE(machine_->runUntil([&] { return (frame = client_->nextFrame()).has_value(); }));
    machine_->runPending();
    if (!frame) {
      return "none";
    }
    const std::string payload = textOf(*frame);
    if (frame->header.kind == 'i' && frame->header.request_number == 0) {
      return "ended " + std::to_string(static_cast<int>(payload.at(0))) + " " +
             std::to_string(static_cast<int>(payload.at(1))) + " " + payload.substr(4);
    }
    if (frame->header.kind != 'e') {
      return frame->header.kind + payload;
    }
    return "e" + std::to_string(static_cast<int>(payload.at(1))) + " " + payload.substr(2);
  }

  // Leaves out reports that a motion has ended.
  std::string answerTo(const std::string& bytes) {
    client_->send(bytes);
    std::string text = answer();
    while (text.rfind("ended ", 0) == 0) {
      text = answer();
    }
    return text;
  }
};

TEST_F(Version2MotionsTest, listsPlaysAndStops) {
  startVersion2("");
  EXPECT_EQ(answerTo(frame('N', "")), "nLIE.MTN\nNOD.MTN\nSIT.MTN\nWAG.MTN");
  EXPECT_EQ(answerTo(play("nod.mtn", 2)), "p");
  EXPECT_EQ(answerTo(play("WAG.MTN", 65535)), "p") << "two at once";
  EXPECT_THAT(answerTo(play("SIT.MTN", 1)), HasSubstr("e0 NOD.MTN is being played and moves neck_tilt, too"));
  passFrames(300);
  EXPECT_EQ(answerTo(play("", 0)), "p");
  EXPECT_EQ(answer(), "ended 1 2 NOD.MTN\nthe client stopped it");
  EXPECT_EQ(answer(), "ended 1 2 WAG.MTN\nthe client stopped it");
  live();
  EXPECT_EQ(answerTo(play("SIT.MTN", 1)), "p");
}

TEST_F(Version2MotionsTest, tellsTheConsoleOfEachMotionThatIsPlayedDifferently) {
  startVersion2("");
  for (const std::string name : {"ONE.MTN", "TWO.MTN"}) {
    stick_.write(std::string(kFolder) + "/" + name, motionBytes("at 0 head_pan 0\nat 1600 head_pan 91\n"));
    EXPECT_EQ(answerTo(play(name, 1)), "p");
    EXPECT_THAT(console_.str(), HasSubstr("RCServer: " + name + ": 1 position is clipped"));
    EXPECT_EQ(answerTo(play("", 0)), "p");
  }
  for (int i = 3; i <= 17; ++i) {  // the last of the 16 that the robot remembers comes again
    const std::string name = "M" + std::to_string(std::min(i, 16)) + ".MTN";
    stick_.write(std::string(kFolder) + "/" + name, motionBytes("at 0 head_pan 0\nat 1600 head_pan 91\n"));
    EXPECT_EQ(answerTo(play(name, 1)), "p");
    EXPECT_EQ(answerTo(play("", 0)), "p");
  }
  EXPECT_EQ(console_.str().find("M16.MTN:"), console_.str().rfind("M16.MTN:"));
}

TEST_F(Version2MotionsTest, tellsWhatIsPlayedDifferentlyOnlyIfItIsAsked) {
  startVersion2("");
  stick_.write(std::string(kFolder) + "/FAST.MTN", motionBytes("at 0 head_pan 0\nat 160 head_pan 91\nat 1600\n"));
  EXPECT_EQ(answerTo(play("FAST.MTN", 1)), "p") << "clients from before expect nothing more";
  EXPECT_THAT(console_.str(), HasSubstr("RCServer: FAST.MTN: 2 positions are clipped"));
  EXPECT_EQ(answerTo(play("", 0, TELL_CHANGES)), "p");
  EXPECT_EQ(answerTo(play("FAST.MTN", 1, TELL_CHANGES)),
            "p2 positions are clipped, by up to 3.0 degrees (head_pan at 160 ms)");
  EXPECT_EQ(console_.str().find("FAST.MTN: 2"), console_.str().rfind("FAST.MTN: 2")) << "the console has it once";
  EXPECT_EQ(answerTo(play("", 0)), "p");
  EXPECT_EQ(answerTo(::frame('V', 0, 1, std::string("\2\0\0\0\0\x0f\x42\x40", 8))).front(), 'v') << "1 rad/s";
  EXPECT_THAT(answerTo(play("FAST.MTN", 1, TELL_CHANGES)),
              HasSubstr("; 1 step is too fast, so it takes 2.98 s, which is 1.38 s longer"));
  EXPECT_THAT(console_.str(), HasSubstr("; 1 step is too fast")) << "this is new";
  EXPECT_EQ(answerTo(play("", 0)), "p");
  EXPECT_EQ(answerTo(::frame('V', 0, 1, std::string("\2\0\0\0\x7f\xff\xff\xff", 8))).front(), 'v');
  EXPECT_EQ(answerTo(play("FAST.MTN", 1)), "p");
  const std::string first = "FAST.MTN: 2 positions are clipped, by up to 3.0 degrees (head_pan at 160 ms)\n";
  EXPECT_EQ(console_.str().find(first), console_.str().rfind(first)) << "the console still knows that it has this";
  EXPECT_EQ(answerTo(play("WAG.MTN", 1, TELL_CHANGES)), "p") << "as it is in the file";
}

TEST_F(Version2MotionsTest, leavesOutJointsThatTheRobotDoesNotHaveIfItIsTold) {
  startVersion2("ALLOW_UPLOAD=yes\n");
  const std::string motion = motionBytes("at 0 PRM:/r1/c1/c2/c3-Joint2:j3 0 head_pan 0\nat 800 head_pan 30\n");
  EXPECT_THAT(answerTo(upload("NEW.MTN", motion)),
              HasSubstr("e0 NEW.MTN moves the joint PRM:/r1/c1/c2/c3-Joint2:j3, which this robot does not have"));
  EXPECT_EQ(answerTo(upload("NEW.MTN", motion, LEAVE_OUT_MISSING_JOINTS)), "u");
  EXPECT_THAT(answerTo(play("NEW.MTN", 1)), HasSubstr("which this robot does not have"));
  EXPECT_THAT(answerTo(play("NEW.MTN", 1, TELL_CHANGES)), HasSubstr("which this robot does not have"));
  EXPECT_EQ(answerTo(play("NEW.MTN", 1, LEAVE_OUT_MISSING_JOINTS)), "p");
  passFrames(300);
  EXPECT_NEAR(degrees("head_pan"), 30, 0.01);
  live();
  EXPECT_EQ(answerTo(play("NEW.MTN", 1, LEAVE_OUT_MISSING_JOINTS | TELL_CHANGES)),
            "p1 joint that this robot does not have is left out");
  EXPECT_THAT(answerTo(play("NEW.MTN", 1)), HasSubstr("which this robot does not have")) << "only if it is told";
}

TEST_F(Version2MotionsTest, reportsWhyAMotionCannotBePlayed) {
  startVersion2("");
  stick_.write(std::string(kFolder) + "/BAD.MTN", "OMTN and nothing more");
  stick_.write(std::string(kFolder) + "/LARGE.MTN", std::string(64001, 'x'));
  EXPECT_THAT(answerTo(play("MISSING.MTN", 1)), HasSubstr("e1 there is no MISSING.MTN on the memory stick"));
  EXPECT_EQ(answerTo(play("LARGE.MTN", 1)), "e1 LARGE.MTN has more than 64000 bytes");
  EXPECT_THAT(answerTo(play("NOD.TXT", 1)), HasSubstr("e0 bad request"));
  EXPECT_THAT(answerTo(play("BAD.MTN", 1)), HasSubstr("e0 BAD.MTN is not a motion file: section 0"));
  EXPECT_EQ(answerTo(frame('O', std::string(1, '\0'))), std::string("o") + '\0');
  EXPECT_THAT(answerTo(play("NOD.MTN", 1)), HasSubstr("e0 the motors are off"));
}

TEST_F(Version2MotionsTest, namesTheSettingThatWouldAllowARequest) {
  startVersion2("");
  EXPECT_THAT(answerTo(upload("NEW.MTN", motion_)), HasSubstr("ALLOW_UPLOAD=yes in RCSERVER.CFG"));
  EXPECT_THAT(answerTo(frame('D', "NOD.MTN")), HasSubstr("ALLOW_DELETE=yes in RCSERVER.CFG"));
  EXPECT_THAT(answerTo(frame('H', "")), HasSubstr(" P N A S E guard\n"));
}

TEST_F(Version2MotionsTest, uploadsAndDeletes) {
  startVersion2("ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\n");
  EXPECT_THAT(answerTo(frame('H', "")), HasSubstr(" P N A S E U D guard\n"));
  EXPECT_EQ(answerTo(upload("NEW.MTN", motion_)), "u");
  EXPECT_EQ(fileContent(stick_.path(kFolder) / "NEW.MTN"), motion_);
  EXPECT_EQ(answerTo(play("NEW.MTN", 1)), "p");
  EXPECT_EQ(answerTo(frame('D', "NEW.MTN")), "d");
  EXPECT_THAT(answerTo(frame('D', "NEW.MTN")), HasSubstr("e1 there is no NEW.MTN"));
  passFrames(kLongestMotion);
  EXPECT_NEAR(degrees("head_pan"), 30, 0.01) << "it was still played to its end";
}

TEST_F(Version2MotionsTest, noNameLeadsOutOfTheFolder) {
  startVersion2("ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\n");
  writeOutside();
  const std::string with_zero("OUT\0.MTN", 8);
  for (const std::string& name : {std::string("../OUT.MTN"), std::string("../../CONF/RCSERVER.CFG"), with_zero,
                                  std::string("/MS/OPEN-R/MW/DATA/OUT.MTN"), std::string(255, 'A') + ".MTN"}) {
    EXPECT_THAT(answerTo(play(name, 1)), HasSubstr("e0 bad request")) << name;
    EXPECT_THAT(answerTo(frame('D', name)), HasSubstr("e0 bad request")) << name;
    EXPECT_THAT(answerTo(upload(name, motion_)), HasSubstr("e0 bad request")) << name;
  }
  expectNothingTouchedOutside();
}

TEST_F(Version2MotionsTest, reportsWhyAnUploadIsRefused) {
  startVersion2("ALLOW_UPLOAD=yes\n");
  EXPECT_THAT(answerTo(upload("CON.MTN", motion_)), HasSubstr("that of a device on Windows"));
  EXPECT_THAT(answerTo(upload("WAG~1.MTN", motion_)), HasSubstr("could stand for another file"));
  EXPECT_THAT(answerTo(upload("NEW.MTN", "OMTN")),
              HasSubstr("e0 NEW.MTN is not a motion file: it ends before section 0"));
  EXPECT_THAT(answerTo(upload("NEW.MTN", std::string(mtn::MAX_FILE_SIZE, 'x'))), HasSubstr("is not a motion file"));
  EXPECT_THAT(answerTo(upload("NEW.MTN", std::string(mtn::MAX_FILE_SIZE + 1, 'x'))),
              HasSubstr("e0 64001 bytes are too many: a motion may have 64000"));
  std::filesystem::remove_all(stick_.path(kFolder));
  EXPECT_THAT(answerTo(upload("NEW.MTN", motion_)), HasSubstr("e0 NEW.MTN cannot be written"));
}

// A folder can be opened like a file, but neither be read nor, if it is not empty, deleted.
TEST_F(Version2MotionsTest, reportsAFileThatTheMemoryStickCannotReadOrDelete) {
  startVersion2("ALLOW_DELETE=yes\n");
  stick_.write(std::string(kFolder) + "/BAD.MTN/FULL.TXT", "");
  EXPECT_EQ(answerTo(play("BAD.MTN", 1)), "e1 BAD.MTN cannot be read");
  EXPECT_EQ(answerTo(frame('D', "BAD.MTN")), "e0 BAD.MTN cannot be deleted: the memory stick may be damaged");
}

TEST_F(Version2MotionsTest, refusesOneMotionMoreThanItPlaysAtOnce) {
  startVersion2("");
  const char* const joints[] = {"head_pan", "mouth", "tail_pan", "tail_tilt", "neck_tilt"};
  for (int i = 0; i <= MotionPlayer::MAX_PLAYING; ++i) {
    const std::string name = std::to_string(i) + ".MTN";
    stick_.write(std::string(kFolder) + "/" + name, motionBytes(std::string("at 0 ") + joints[i] + " 0\nat 1600\n"));
    EXPECT_EQ(answerTo(play(name, 1)), i < MotionPlayer::MAX_PLAYING
                                           ? "p"
                                           : "e0 " + std::to_string(MotionPlayer::MAX_PLAYING) +
                                                 " motions are already being played; stop one first");
  }
}

TEST_F(Version2MotionsTest, reportsAMotionThatAFaultyJointStops) {
  startVersion2("");
  EXPECT_EQ(answerTo(play("NOD.MTN", 100)), "p");
  passFrames(100);
  robot_.joint("neck_tilt").jammed = true;
  robot_.joint("neck_tilt").position -= 800000;
  passFrames(2 * JointWatch::PATIENCE);
  EXPECT_THAT(answer(), HasSubstr("e3 neck_tilt is jammed"));
  EXPECT_THAT(answer(), HasSubstr("e3 NOD.MTN is stopped: neck_tilt does not follow"));
  EXPECT_EQ(answer(), "ended 1 3 NOD.MTN\nneck_tilt does not follow");
  passFrames(100);
  const int stopped_at = robot_.joint("head_tilt").position;
  passFrames(200);
  EXPECT_EQ(robot_.joint("head_tilt").position, stopped_at);
}

TEST_F(Version2MotionsTest, reportsWhatHasStoppedAMotion) {
  const std::string one_joint("\0\0\1\0\63\0\0\0\0\0\0\0", 12);
  const std::pair<std::string, std::string> orders[] = {
      {frame('J', one_joint), "ended 1 1 WAG.MTN\ntail_pan was commanded"},
      {play("WAG.MTN", 0), "ended 1 2 WAG.MTN\nthe client stopped it"},
      {frame('I', ""), "ended 1 2 WAG.MTN\neverything was told to hold"},
      {::frame('I', 1, 1, "\2\63"), "ended 1 2 WAG.MTN\ntail_pan was told to hold"},
      {frame('O', std::string(1, '\0')), "ended 1 2 WAG.MTN\nthe motors were switched off"}};
  startVersion2("");
  for (const auto& [order, end] : orders) {
    live();
    EXPECT_EQ(answerTo(play("WAG.MTN", 1000)), "p");
    passFrames(400);
    live();
    EXPECT_EQ(answerTo(order).substr(0, 1), std::string(1, static_cast<char>(std::tolower(order[0]))));
    EXPECT_EQ(answer(), end);
    passFrames(100);
    const int stopped_at = robot_.joint("tail_pan").position;
    passFrames(100);
    EXPECT_EQ(robot_.joint("tail_pan").position, stopped_at);
  }
}

TEST_F(Version2MotionsTest, aClientThatDoesNotReadGetsEveryEndLater) {
  startVersion2("");
  client_->close();
  connectVersion2(4096);
  EXPECT_EQ(answerTo(play("WAG.MTN", 1000)), "p");
  EXPECT_EQ(answerTo(play("NOD.MTN", 1)), "p");
  stallBehind(::frame('P', 0, 1, playPayload("WAG.MTN", 0)));
  passFrames(500);
  std::vector<std::string> ended;
  for (int limits = 0; limits < 4096 || ended.size() < 2;) {
    const std::string next = answer();
    ASSERT_NE(next, "none");
    limits += next[0] == 'v' ? 1 : 0;
    if (next.substr(0, 5) == "ended") {
      ended.push_back(next);
    }
  }
  EXPECT_THAT(ended, ElementsAre("ended 1 2 WAG.MTN\nthe client stopped it", "ended 1 0 NOD.MTN\n"));
}

TEST_F(Version2MotionsTest, endsWithTheClient) {
  startVersion2("");
  EXPECT_EQ(answerTo(play("WAG.MTN", 1000)), "p");
  passFrames(400);
  client_->close();
  passFrames(100);
  const int stopped_at = robot_.joint("tail_pan").position;
  passFrames(100);
  EXPECT_EQ(robot_.joint("tail_pan").position, stopped_at);
}

}  // namespace
