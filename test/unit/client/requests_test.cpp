// What each function of RcServerClient sends, and what it makes of the answer: the tables of docs/protocol.md.

#include <cmath>

#include "client_fixture.h"
#include "protocol/stick_pictures.h"

using namespace aibo_client;
using std::chrono::milliseconds;
using test_pictures::Bytes;
using testing::HasSubstr;

namespace {

const std::string kNeeded = "S E";                       // the capabilities without which a call is not sent
const std::string kNod = "78 79 68 46 77 84 78";         // NOD.MTN
const std::string kMineJpg = "77 73 78 69 46 74 80 71";  // MINE.JPG
const Bytes kPictureOnTheStick = test_pictures::makeNumbered(7);

Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += name + " ";
  }
  return text;
}

std::string nameOf(const Bytes& jpeg) {
  return jpeg == kPictureOnTheStick ? "the picture" : "another picture";
}

/// A function that waits for the robot's answer.
struct CallRow {
  std::string words;  // what the robot refuses to do
  std::function<std::string(RcServerClient&, milliseconds)> call;
  std::string sent;  // kind, id and payload
  Bytes answer;
  std::string result;
  std::string version1;  // letter and the rest; empty: version 1 has no such request
};

const Bytes kNothing;
const Bytes kMotion = {1, 2, 3};
const std::vector<std::int16_t> kSamples = {0x1234, -1};
const std::vector<int> kTwoJoints = {2, 1};

const std::vector<CallRow> kCalls = {
    {"take a picture of this resolution",
     [](auto& c, auto time) { return nameOf(c.takePicture(37, time, Resolution::kDouble)->jpeg); }, "F 37 3",
     version2_frames::makePicture(kPictureOnTheStick, 1), "the picture", ""},
    {"switch the motors on", [](auto& c, auto time) { return c.setMotors(true, time) ? "on" : "off"; }, "O 0 1",
     Bytes{0}, "off", ""},
    {"switch the motors off", [](auto& c, auto time) { return c.setMotors(false, time) ? "on" : "off"; }, "O 0 0",
     Bytes{1}, "on", ""},
    {"hold its joints", [](auto& c, auto time) { return c.hold({}, time), ""; }, "I 0", kNothing, "", ""},
    {"hold its joints", [](auto& c, auto time) { return c.hold(kTwoJoints, time), ""; }, "I 1 2 1", kNothing, "", ""},
    {"take the posture stand", [](auto& c, auto time) { return c.takePosture(Posture::kStand, time), ""; }, "E 1",
     kNothing, "", ""},
    {"take the posture sit", [](auto& c, auto time) { return c.takePosture(Posture::kSit, time), ""; }, "E 2", kNothing,
     "", ""},
    {"take the posture rest", [](auto& c, auto time) { return c.takePosture(Posture::kRest, time), ""; }, "E 3",
     kNothing, "", ""},
    {"play the motion NOD.MTN", [](auto& c, auto time) { return c.playMotion("nod.mtn", 258, time); },
     "P 0 1 2 " + kNod, bytesOf("2 positions are clipped"), "2 positions are clipped",
     "P 0 " + kNod + " 0 0 0 0 0 2 1 0 0"},
    {"stop the motion NOD.MTN", [](auto& c, auto time) { return c.stopMotion("Nod.mtn", time), ""; }, "P 0 0 0 " + kNod,
     kNothing, "", "P 0 " + kNod + " 0 0 0 0 0 0 0 0 0"},
    {"stop all motions", [](auto& c, auto time) { return c.stopMotion("", time), ""; }, "P 0 0 0", kNothing, "",
     "P 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"},
    {"store the motion NOD.MTN", [](auto& c, auto time) { return c.uploadMotion("nod.MTN", kMotion, time), ""; },
     "U 0 7 " + kNod + " 1 2 3", kNothing, "", "U 0 " + kNod + " 0 0 0 0 0 0 0 3 0 1 2 3"},
    {"delete the motion NOD.MTN", [](auto& c, auto time) { return c.deleteMotion("nod.mtn", time), ""; }, "D 0 " + kNod,
     kNothing, "", "D 0 " + kNod + " 0 0 0 0 0 0 0 0 0"},
    {"list its motions", [](auto& c, auto time) { return joined(c.listMotions(time)); }, "N 0",
     bytesOf("NOD.MTN\nSIT.MTN"), "NOD.MTN SIT.MTN ", ""},
    {"take a picture onto its memory stick", [](auto& c, auto time) { return c.takePictureOnRobot(40, time); }, "M 40",
     bytesOf("AIBO0042.JPG"), "AIBO0042.JPG", ""},
    {"list the pictures on its memory stick", [](auto& c, auto time) { return joined(c.listPictures(time)); }, "Y 1",
     bytesOf("AIBO0001.JPG\nMINE.JPG"), "AIBO0001.JPG MINE.JPG ", ""},
    {"send the picture MINE.JPG", [](auto& c, auto time) { return nameOf(c.fetchPicture("mine.jpg", time)); },
     "Y 2 " + kMineJpg, kPictureOnTheStick, "the picture", ""},
    {"delete the picture MINE.JPG", [](auto& c, auto time) { return c.deletePicture("Mine.jpg", time), ""; },
     "Y 3 " + kMineJpg, kNothing, "", ""},
    {"play sound", [](auto& c, auto time) { return std::to_string(c.playSamples(0, kSamples, true, time).room); },
     "A 2 0 0 0 0 1 0 0 0 18 52 255 255", Bytes{0, 0, 32, 0}, "8192", ""},
    {"play sound", [](auto& c, auto time) { return c.stopSound(time), ""; }, "A 2 0 0 0 0 1 0 0 0", Bytes{0, 0, 64, 0},
     "", ""},
    {"set its volume", [](auto& c, auto time) { return std::to_string(c.setVolume(kVolumeOfRobot, time)); }, "A 3 255",
     Bytes{2}, "2", ""},
    {"set its volume", [](auto& c, auto time) { return std::to_string(c.setVolume(3, time)); }, "A 3 3", Bytes{3}, "3",
     ""},
    {"shut down", [](auto& c, auto time) { return c.shutDownRobot(time), ""; }, "Q 0", kNothing, "", "Q 0 0 0"},
    {"reboot", [](auto& c, auto time) { return c.rebootRobot(time), ""; }, "R 0", kNothing, "", "R 0 0 0"},
};

/// A function that sends a request and returns at once.
struct CommandRow {
  std::string name;
  std::function<void(RcServerClient&)> command;
  std::string sent;
  std::string version1;  // the same; empty: version 1 has no such request
};

const std::vector<JointTarget> kHead = {{2, -0.5}};
const std::vector<JointSpeedLimit> kSpeed = {{2, 1.25}};
const WalkVelocity kWalk = {0.1, 0, -0.5};
const std::vector<LedCommand> kLed = {{7, 200, LedMode::kB}};

const std::vector<CommandRow> kCommands = {
    {"joints", [](auto& client) { client.commandJoints(kHead, milliseconds(300)); },
     "J 0 1 44 1 0 2 0 0 0 255 248 94 224", "J 2 207 244"},
    {"speed limits", [](auto& client) { client.setJointSpeedLimits(kSpeed); }, "V 0 2 0 0 0 0 19 18 208", "V 2 250 27"},
    {"walk", [](auto& client) { client.steer(kWalk); }, "S 1 0 100 0 0 254 12 0 0", ""},
    {"LEDs", [](auto& client) { client.commandLeds(kLed); }, "L 0 7 200 1 0", "L 7 200 0"},
    {"ears", [](auto& client) { client.commandEars(true, false); }, "K 0 1 0", "K 1 1 0"},
};

class Requests : public ClientFixture {
 protected:
  std::future<std::string> inBackground(const CallRow& row) {
    return std::async(std::launch::async, [this, &row] { return row.call(client_, test_support::kSafetyNet); });
  }

  /// The message of the exception that the row's call ends with.
  template <typename Expected>
  std::future<std::string> complaintInBackground(const CallRow& row) {
    return std::async(std::launch::async,
                      [this, &row] { return refusalOf<Expected>([&] { inBackground(row).get(); }); });
  }

  static void answer(ScriptedPeer* peer, const version2_frames::Frame& request, char kind, const Bytes& payload) {
    Bytes frame = version2_frames::makeFrame(kind, request.header.request_number, payload);
    frame[1] = request.header.id;
    peer->send(frame);
  }

  /// The request as text, without the frame until which an order may be carried out.
  static std::string textOf(version2_frames::Frame request) {
    if (std::string("JSEPO").find(request.header.kind) != std::string::npos) {
      request.payload.erase(request.payload.begin(), request.payload.begin() + 4);
    }
    return version2_frames::describe(request);
  }

  /// Waits for a request of version 1 of this size, as text.
  static std::string readVersion1(ScriptedPeer* peer, const std::string& like) {
    const auto size = static_cast<std::size_t>(std::count(like.begin(), like.end(), ' ') + 1);
    std::string text;
    for (const std::uint8_t byte : peer->read(size)) {
      text += text.empty() ? std::string(1, static_cast<char>(byte)) : " " + std::to_string(byte);
    }
    return text;
  }
};

TEST_F(Requests, AreAnsweredAsInTheTable) {
  ScriptedPeer peer = connectVersion2(kNeeded);
  for (const CallRow& row : kCalls) {
    auto result = inBackground(row);
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ(row.sent, textOf(request));
    answer(&peer, request, protocol::version2::replyKind(request.header.kind), row.answer);
    EXPECT_EQ(row.result, result.get()) << row.sent;
  }
}

TEST_F(Requests, ThatAreRefusedThrowTheRobotsReason) {
  ScriptedPeer peer = connectVersion2(kNeeded);
  for (const CallRow& row : kCalls) {
    auto complaint = complaintInBackground<CommandException>(row);
    answer(&peer, peer.readRequest(), 'e', version2_frames::makeError(0, "why"));
    EXPECT_THAT(complaint.get(), HasSubstr("refused to " + row.words + ": why")) << row.sent;
  }
}

TEST_F(Requests, WhoseAnswerNoServerSendsEndTheConnection) {
  const struct {
    std::string words;
    Bytes answer;
  } rows[] = {
      {"list its motions", bytesOf("A/..")},
      {"list the pictures on its memory stick", bytesOf("NOD.MTN")},
      {"take a picture onto its memory stick", {}},
      {"take a picture onto its memory stick", bytesOf("../A.JPG")},
      {"send the picture MINE.JPG", Bytes(protocol::version2::MAX_STICK_PICTURE_SIZE + 1)},
      {"play the motion NOD.MTN", bytesOf("\x1b[J")},
      {"set its volume", {kVolumeOfRobot}},
  };
  for (const auto& row : rows) {
    ScriptedPeer peer = connectVersion2(kNeeded);
    const auto call =
        std::find_if(kCalls.begin(), kCalls.end(), [&](const CallRow& each) { return each.words == row.words; });
    auto complaint = complaintInBackground<NetworkException>(*call);
    const version2_frames::Frame request = peer.readRequest();
    answer(&peer, request, protocol::version2::replyKind(request.header.kind), row.answer);
    EXPECT_THAT(complaint.get(), HasSubstr("bad answer to the request to " + row.words));
  }
}

TEST_F(Requests, OfVersion1AreThoseOfTheTable) {
  ScriptedPeer peer = connectVersion1();
  for (const CallRow& row : kCalls) {
    if (row.version1.empty()) {
      EXPECT_THAT(complaintInBackground<CommandException>(row).get(),
                  HasSubstr("speaks version 1 of the protocol, which "))
          << row.words;
      continue;
    }
    auto result = inBackground(row);
    const std::string sent = readVersion1(&peer, row.version1);
    EXPECT_EQ(row.version1, sent);
    peer.send({static_cast<std::uint8_t>(sent[0] - 'A' + 'a'), 0, 0, 0});
    EXPECT_EQ("", result.get()) << row.words;
  }
  for (const CommandRow& row : kCommands) {
    if (row.version1.empty()) {
      EXPECT_THROW(row.command(client_), CommandException) << row.name;
      continue;
    }
    row.command(client_);
    EXPECT_EQ(row.version1, readVersion1(&peer, row.version1));
    peer.send({'e', 0, 0, 0});
    if (row.name == "ears") {
      EXPECT_EQ("K 2 0 0", readVersion1(&peer, "K 2 0 0"));
    }
  }
}

TEST_F(Requests, ThatAreCommandsAreSentAtOnce) {
  ScriptedPeer peer = connectVersion2("J V S L K");
  for (const CommandRow& row : kCommands) {
    row.command(client_);
    EXPECT_EQ(row.sent, textOf(peer.readRequest())) << row.name;
  }
}

TEST_F(Requests, WaitAsLongAsTheyAreTold) {
  const ScriptedPeer silent = connectVersion2(kNeeded);
  for (std::size_t i = 0; i < kCalls.size(); ++i) {
    const milliseconds time(10 + static_cast<int>(i));
    EXPECT_THAT(refusalOf<TimeoutException>([&] { kCalls[i].call(client_, time); }),
                HasSubstr(" within " + std::to_string(time.count()) + " ms"))
        << kCalls[i].words;
  }
}

TEST_F(Requests, ThatWaitAreRefusedInACallback) {
  std::promise<std::string> waited;
  RcServerClient* self = nullptr;
  Callbacks callbacks;
  callbacks.on_telemetry = [&](const Telemetry&) {
    std::string words;
    EXPECT_THROW(self->waitForConnection(milliseconds(1)), Exception);
    for (const CallRow& row : kCalls) {
      const std::string complaint = refusalOf<Exception>([&] { row.call(*self, milliseconds(1)); });
      words += complaint.find("cannot be called from a callback") == std::string::npos ? row.words : "";
    }
    waited.set_value(words);
  };
  RcServerClient client(optionsFor(server_), callbacks);
  self = &client;
  ScriptedPeer peer = connectVersion2(&client, kNeeded);
  peer.send(version2_frames::makeFrame('t', 0, version2_frames::makeTelemetry(7, {{'J', 1, 0}})));
  EXPECT_EQ("", waited.get_future().get());
}

TEST_F(Requests, WithoutAConnectionAreRefusedAndNotKept) {
  for (const CallRow& row : kCalls) {
    EXPECT_THAT(complaintInBackground<NetworkException>(row).get(), HasSubstr("has not been started")) << row.words;
  }
  for (const CommandRow& row : kCommands) {
    EXPECT_THROW(row.command(client_), NetworkException) << row.name;
  }
  ScriptedPeer peer = connectVersion2("L");
  client_.commandLeds({{200, 1}});
  EXPECT_EQ("L 0 200 1 0 0", version2_frames::describe(peer.readRequest())) << "the first that is sent";
}

TEST_F(Requests, ThatTheServerDoesNotKnowAreRefusedByName) {
  const ScriptedPeer peer = connectVersion2("F W");
  EXPECT_THAT(refusalOf<CommandException>([this] { client_.steer(kWalk); }),
              testing::AllOf(HasSubstr("(a test 1.0)"), HasSubstr("cannot walk: its robot does not walk")));
  EXPECT_THAT(refusalOf<CommandException>([this] { client_.takePosture(Posture::kSit, std::chrono::seconds(1)); }),
              HasSubstr("cannot take the posture sit: its robot does not walk"));
}

// argument_checks_test.cpp has the ranges of what several functions share.
TEST_F(Requests, WithWrongArgumentsAreNotSent) {
  const std::chrono::seconds time(1);
  ColorTable table;
  table.segments[0] = ColorRange{2, 1, 3, 4};
  CameraSettings camera;
  camera.gain = 4;
  CameraSettings no_balance;
  no_balance.white_balance = 0;
  CameraSettings fastest;
  fastest.shutter_speed = 4;
  const std::vector<std::int16_t> too_many(2049);
  const std::vector<JointTarget> negative_speed = {{1, 0, -1}};
  const std::vector<LedCommand> too_bright = {{1, 256}};
  const StreamFormat no_image{Resolution::kHigh, 0};
  const StreamFormat too_few_images{Resolution::kHigh, 65536};
  const ColorDetection no_detection{true, 0, false};
  const ColorDetection rare_detection{true, 65536, false};
  const MicrophoneSettings three_channels{true, 3, 16000};
  const MicrophoneSettings odd_rate{true, 2, 11025};
  const WalkVelocity too_fast{0, -32.768, 0};
  const WalkVelocity no_number{0, 0, std::nan("")};
  const std::function<void()> calls[] = {
      [&] { client_.setJpegQuality(0); },
      [&] { client_.setJpegQuality(101); },
      [&] { client_.setStreamFormat(no_image); },
      [&] { client_.setStreamFormat(too_few_images); },
      [&] { client_.setColorDetection(no_detection); },
      [&] { client_.setColorDetection(rare_detection); },
      [&] { client_.setColorTable(-1, nullptr); },
      [&] { client_.setColorTable(8, nullptr); },
      [&] { client_.setColorTable(0, std::make_shared<ColorTable>(table)); },
      [&] { client_.setCameraSettings(camera); },
      [&] { client_.setCameraSettings(no_balance); },
      [&] { client_.setCameraSettings(fastest); },
      [&] { client_.setMicrophone(three_channels); },
      [&] { client_.setMicrophone(odd_rate); },
      [&] { client_.setTelemetryPeriod(-1); },
      [&] { client_.setTelemetryPeriod(65536); },
      [&] { client_.takePicture(-1, time); },
      [&] { client_.takePicture(101, time); },
      [&] { client_.takePicture(50, milliseconds(0)); },
      [&] { client_.takePicture(50, std::chrono::hours(1) + milliseconds(1)); },
      [&] { client_.commandJoints(negative_speed, milliseconds(0)); },
      [&] { client_.setJointSpeedLimits({}); },
      [&] { client_.hold({0}, time); },
      [&] { client_.steer(too_fast); },
      [&] { client_.steer(no_number); },
      [&] { client_.commandLeds(too_bright); },
      [&] { client_.playMotion("../NOD.MTN", 1, time); },
      [&] { client_.playMotion("NOD.MTN", 0, time); },
      [&] { client_.playMotion("NOD.MTN", 65536, time); },
      [&] { client_.stopMotion("NOD", time); },
      [&] { client_.uploadMotion("NOD.MTN", {}, time); },
      [&] { client_.uploadMotion("NOD.MTN", std::vector<std::uint8_t>(65524), time); },
      [&] { client_.uploadMotion("CON.MTN", {1}, time); },
      [&] { client_.deleteMotion("", time); },
      [&] { client_.takePictureOnRobot(0, time); },
      [&] { client_.takePictureOnRobot(101, time); },
      [&] { client_.fetchPicture("../A.JPG", time); },
      [&] { client_.deletePicture("NOD.MTN", time); },
      [&] { client_.playSamples(0, {}, true, time); },
      [&] { client_.playSamples(0, too_many, true, time); },
      [&] { client_.setVolume(-1, time); },
      [&] { client_.setVolume(4, time); },
      [&] { client_.waitForConnection(milliseconds(0)); },
      [&] { client_.waitForConnection(std::chrono::hours(1) + milliseconds(1)); },
  };
  for (std::size_t i = 0; i < std::size(calls); ++i) {
    EXPECT_THROW(calls[i](), InvalidArgumentException) << "row " << i;
  }
}

// The setting is sent as soon as there is a connection, and again over the next one.
TEST_F(Requests, OfSettingsAreSentOverEachConnection) {
  ColorTable table;
  table.segments[0] = ColorRange{1, 2, 3, 4};
  CameraSettings camera;
  camera.white_balance = camera.shutter_speed = 1;
  camera.gain = 3;
  camera.auto_exposure = true;
  client_.setStreaming(true);
  client_.setJpegQuality(60);
  client_.setStreamFormat({Resolution::kLow, 3});
  client_.setCameraSettings(camera);
  client_.setColorDetection({true, 4, true});
  client_.setColorTable(5, std::make_shared<ColorTable>(table));
  client_.setMicrophone({true, 1, 8000});
  client_.setTelemetryPeriod(4);
  EXPECT_EQ(60, client_.jpegQuality());
  EXPECT_TRUE(client_.streamFormat() == (StreamFormat{Resolution::kLow, 3}));
  for (int connection = 1; connection <= 2; ++connection) {
    ScriptedPeer peer = connectVersion2();
    EXPECT_EQ("G 1 1;G 2 3;G 3 1;G 4 1;G 5 0;", peer.camera());
    for (const std::string each : {"W 60 1 2 0 3", "T 1 0 4", "Z 2 5 0 0 0 1 2 3 4", "Z 1 0 4 1 0", "A 1 1 1 31 64"}) {
      EXPECT_EQ(each, version2_frames::describe(peer.readRequest(), 8)) << connection;
    }
  }
}

TEST_F(Requests, CarryTheOptionsOfTheClientUntilTheyAreChanged) {
  ClientOptions options = optionsFor(server_);
  options.leave_out_missing_joints = true;
  options.guard_walks = false;
  RcServerClient client(options, recorder_.callbacks());
  ScriptedPeer peer = connectVersion2(&client, "U P S");
  for (const char* sent : {"S 0 0 100 0 0 254 12 0 0", "S 1 0 100 0 0 254 12 0 0"}) {
    client.steer(kWalk);
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ(sent, textOf(request));
    answer(&peer, request, 's', Bytes(8));
    client.guardWalks(true);
  }
  auto calls = std::async(std::launch::async, [&client] {
    client.uploadMotion("NOD.MTN", {1}, test_support::kSafetyNet);
    client.playMotion("NOD.MTN", 1, test_support::kSafetyNet);
  });
  for (int i = 0; i < 2; ++i) {
    const version2_frames::Frame request = peer.readRequest();
    EXPECT_EQ(1, request.header.id) << "leave out the joints";
    answer(&peer, request, protocol::version2::replyKind(request.header.kind), {});
  }
  calls.get();
}

TEST_F(Requests, ForAPictureRefuseAFileThatIsNone) {
  ScriptedPeer peer = connectVersion2();
  for (const Bytes& content : {bytesOf("no JPEG"), Bytes(kPictureOnTheStick.begin(), kPictureOnTheStick.end() - 9)}) {
    auto complaint = std::async(std::launch::async, [this] {
      return refusalOf<CommandException>([this] { client_.fetchPicture("A.JPG", test_support::kSafetyNet); });
    });
    answer(&peer, peer.readRequest(), 'y', content);
    EXPECT_THAT(complaint.get(), HasSubstr("has sent A.JPG, which is not a picture of its camera: "));
  }
}

}  // namespace
