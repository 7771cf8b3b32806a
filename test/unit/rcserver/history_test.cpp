// Whatever a client has done and however it went, the next one finds the robot as one that has just started does.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "motion_bytes.h"
#include "protocol/color_requests.h"
#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "protocol/walk_requests.h"
#include "rcserver_fixture.h"
#include "support/udp_socket.h"

namespace {

using namespace protocol::version2;
using test_support::UdpSocket;

constexpr longword kBegin = FakeRobot::kFirstFrame + 2500;  // frame in which each robot's scenario begins
constexpr unsigned kHistories = 12;                         // before each kind of beginning
constexpr char kSettings[] =
    "ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\nALLOW_PICTURES=yes\nALLOW_MICROPHONE=yes\nALLOW_SOUND=yes\n";

// What begins the scenario: a client of this version, or the client of the history itself.
enum class Begin { kVersion1, kVersion2, kSameConnection };

std::string hash(const std::string& bytes) {
  return std::to_string(std::hash<std::string>()(bytes) & 0xffffffff);
}

// Long content by its hash.
std::string shown(const std::string& bytes) {
  std::ostringstream text;
  for (const char byte : bytes.substr(0, 1200)) {
    if (byte > ' ' && byte <= '~') {
      text << byte;
    } else {
      text << '<' << (byte & 0xff) << '>';
    }
  }
  text << (bytes.size() > 1200 ? "... " + std::to_string(bytes.size()) + " bytes " + hash(bytes) : "");
  return text.str();
}

std::string short16(int value) {
  return {static_cast<char>(value >> 8), static_cast<char>(value)};
}

std::string sound(unsigned position, int samples, bool last) {
  std::vector<unsigned char> bytes;
  for (int i = 0; i < samples; ++i) {
    bytes.push_back(static_cast<unsigned char>(i / 200));
    bytes.push_back(static_cast<unsigned char>(17 * i + 1));
  }
  return payloadOf(PlayedSound{position, last, bytes.data(), bytes.size()});
}

std::string colorTable(int channel, int lowest) {
  ColorTable table = {static_cast<unsigned char>(channel), {}};
  for (ColorSegment& segment : table.segments) {
    const auto low = static_cast<unsigned char>(lowest);
    segment = {low, static_cast<unsigned char>(low + 50), static_cast<unsigned char>(low + 1), 250};
  }
  return payloadOf(table);
}

std::string steering(double forward, double left, double turn) {
  return payloadOf(protocol::version2::Velocity{forward, left, turn});
}

/// A robot with its server, whose first client may do anything before the scenario.
class LivedRobot : public FakeRobotFixture {
 public:
  /// @param datagrams where pictures by UDP come; the same of all robots that are compared
  explicit LivedRobot(UdpSocket& datagrams) : datagrams_(datagrams) {
    host_.room = &room_;
    setUpWorld();
    for (const FakeRobot::FakeJoint& joint : robot_.joints) {
      places_.push_back(joint.position);
    }
    startWith(kSettings);
  }
  ~LivedRobot() override { machine_.reset(); }

  /// A client does what follows from the seed, and goes in one of many ways.
  void liveThrough(unsigned seed, bool goes) {
    random_.seed(seed);
    address_ = goes ? "127.0.0.2" : "127.0.0.1";
    stick_.write("OPEN-R/MW/DATA/P/A.JPG", std::string(9000, 'j'));
    const int clients = goes ? 1 + any(2) : 1;
    for (int i = 0; i < clients; ++i) {
      const bool is_version2 = !goes || any(5) != 0;
      did_ << "\n a client of version " << (is_version2 ? 2 : 1);
      begin(is_version2, goes && any(3) == 0 ? 4096 : 0);
      for (int step = 0; step < 14 && !client_->ended(); ++step) {
        is_version2 ? doSomething2() : doSomething1();
        live(any(4) == 0 ? any(60) : any(8));
      }
      if (goes) {
        go();
      }
    }
    setUpWorld();
  }

  /// A client does nothing.
  void beginIdly() { begin(true, 0); }

  /// Nothing more happens until the beginning of the scenario.
  void rest(bool is_connected) {
    EXPECT_LT(clock_.frame(), kBegin) << did_.str();
    while (clock_.frame() < kBegin) {
      is_connected ? live(1) : passFrames(1);
    }
    while (datagrams_.next()) {
    }
    std::filesystem::remove_all(stick_.path("OPEN-R/MW/DATA/P"));
    std::filesystem::copy(std::string(MEMORY_STICK) + "/OPEN-R/MW/DATA/P", stick_.path("OPEN-R/MW/DATA/P"));
  }

  /// Asks for everything and uses it.
  /// @return all that the robot has sent, said and done
  std::string scenario(Begin first) {
    beginRecord();
    if (first == Begin::kSameConnection) {
      endEverything();
      place();
      beginRecord();
    } else {
      browser();
      if (first == Begin::kVersion1) {
        version1();
        end();
      }
      client_ = connect();
      beginVersion2();
      untouched();
      comeBack();
      place();
    }
    settings();
    pictures();
    datagrams();
    soundAndColors();
    stick();
    joints();
    motions();
    walks();
    breakTheProtocol();
    version1();
    end();
    return record_.str();
  }

  std::string history() const { return did_.str(); }

 private:
  void TestBody() override {}

  // ------------------------------------------------------------------------------------------------- the world

  // As it was before anything happened.
  void setUpWorld() {
    encoder_.speedUp();
    file_keeper_.speedUp();
    failing_entry_.reset();
    room_ = 1 << 30;
    robot_.stick_status = omemorystickWRITABLE;
    for (size_t i = 0; i < robot_.sensor_values.size(); ++i) {
      robot_.sensor_values[i] = static_cast<int>(1000 * i + 7);
    }
    robot_.sensor("acceleration_front_back") = 0;
    robot_.sensor("acceleration_right_left") = 0;
    robot_.sensor("acceleration_up_down") = -9806650;
    for (const char* const paw : {"paw_left_front", "paw_left_hind", "paw_right_front", "paw_right_hind"}) {
      robot_.sensor(paw) = 1;
    }
    for (FakeRobot::FakeJoint& joint : robot_.joints) {
      joint.jammed = joint.refuses_gain = joint.refuses_gains = joint.keeps_gain = joint.is_mute = false;
      joint.duty.reset();
    }
    robot_.refuses_power = robot_.refuses_camera_settings = robot_.refuses_color_tables = robot_.refuses_speaker =
        false;
    robot_.detail = std::array<byte, 3>{100, 130, 140};
    robot_.color_plane.assign(FakeRobot::kWidth / 2 * FakeRobot::kHeight / 2, 0);
    std::fill_n(robot_.color_plane.begin() + 500, 333, static_cast<byte>(0x23));
    robot_.sound = [](size_t sample) {
      return OSoundSampleStereo16{static_cast<sword>(sample * 7 % 9001), static_cast<sword>(sample * 13 % 4001)};
    };
  }

  // Someone puts it as it was.
  void place() {
    ask('O', 0, std::string(1, '\0'));
    is_recording_pushes_ = false;
    listen(30);
    for (size_t i = 0; i < places_.size(); ++i) {
      robot_.joints[i].position = places_[i];
    }
    listen(130);
    ask('O', 0, "\1");
    listen(30);
    for (FakeRobot::FakeJoint& joint : robot_.joints) {
      joint.path.clear();
    }
    is_placed_ = true;
    is_recording_pushes_ = true;
  }

  // ----------------------------------------------------------------------------------------------- the history

  int any(int count) { return static_cast<int>(random_() / 7 % static_cast<unsigned>(count)); }
  int jointId() { return robot_.model.joints[any(robot_.model.number_of_joints)].identifier; }
  std::string anyBytes(int most) {
    std::string bytes;
    for (int i = any(most + 1); i > 0; --i) {
      bytes += static_cast<char>(any(256));
    }
    return bytes;
  }

  void begin(bool is_version2, int receive_buffer) {
    client_ = connect(receive_buffer, address_);
    if (is_version2) {
      send(request('X', 2));
      passFrames(1);
      client_->next();
    }
    reads_ = receive_buffer == 0;
    speaks2_ = is_version2;
  }

  // Time passes for a client that says something now and then.
  void live(int frames) {
    for (int i = 0; i < frames; ++i) {
      if (speaks2_ && clock_.frame() % 50 == 0) {
        send(frame('H', 0, 60000));
      }
      if (walk_left_ > 0 && clock_.frame() % 25 == 0) {
        --walk_left_;
        send(frame('S', guard_, 60001, walk_));
      }
      passFrames(1);
      if (reads_) {
        client_->take(client_->received().size());
      }
    }
  }

  void doSomething2() {
    const int what = any(36);
    did_ << ' ' << what;
    const auto say = [this](char kind, int id, const std::string& payload = {}) {
      did_ << kind;
      send(frame(kind, id, ++last_number_, payload));
    };
    switch (what) {
      case 0:
        return say('F', any(101), {static_cast<char>(any(4))});
      case 1:
      case 2:
        return say('W', any(101),
                   payloadOf(StreamSettings{any(4) != 0, static_cast<Layer>(any(4)),
                                            static_cast<unsigned short>(1 + any(4))}));
      case 3: {
        const int setting = 1 + any(5);
        return say('G', setting, {static_cast<char>(setting > 3 ? any(2) : 1 + any(3))});
      }
      case 4:
        return say('B', 0, payloadOf(DatagramPort{any(4) != 0 ? datagrams_.port() : static_cast<unsigned short>(0)}));
      case 5:
        return say(
            'X', 0,
            payloadOf(DatagramOrder{any(4) != 0 ? datagrams_.port() : static_cast<unsigned short>(0), any(2) != 0,
                                    static_cast<unsigned>(any(99)), static_cast<unsigned>(any(99))}));
      case 6:
      case 7:
      case 8: {
        JointTargets targets = {static_cast<unsigned short>(any(2) * any(3000)), 1, {}};
        targets.joints[0] = {static_cast<unsigned char>(jointId()), 10000 * (any(400) - 200)};
        return say('J', 0, payloadOf(targets));
      }
      case 9: {
        SpeedLimits limits = {1, {}};
        limits.joints[0] = {static_cast<unsigned char>(jointId()), 1000 * (1 + any(3000))};
        return say('V', 0, payloadOf(limits));
      }
      case 10:
        return say('T', any(4), short16(any(20)));
      case 11:
        return say('O', 0, std::string(1, static_cast<char>(any(3) != 0)));
      case 12:
        return say('I', 0);
      case 13:
        return say('I', 1, {static_cast<char>(jointId())});
      case 14: {
        LedValues leds = {3, {}};
        for (size_t i = 0; i < 3; ++i) {
          leds.leds[i] = {static_cast<unsigned char>(1 + 8 * i + static_cast<size_t>(any(8))),
                          static_cast<unsigned char>(any(256)), any(2) != 0 ? LED_MODE_B : LED_MODE_A};
        }
        return say('L', 0, payloadOf(leds));
      }
      case 15:
        return say('K', 0, {static_cast<char>(any(2)), static_cast<char>(any(2))});
      case 16:
        return say(
            'A', SOUND_MICROPHONE,
            payloadOf(MicrophoneSettings{static_cast<unsigned char>(any(4)), static_cast<unsigned char>(1 + any(2)),
                                         static_cast<unsigned short>(8000 * (1 + any(2)))}));
      case 17:
      case 18:
        return say('A', SOUND_SPEAKER, sound(static_cast<unsigned>(any(2) * any(2000)), any(3000), any(2) != 0));
      case 19:
        return say('A', SOUND_VOLUME, {static_cast<char>(any(5) == 4 ? 255 : any(4))});
      case 20:
        return say('Z', COLORS_ON, payloadOf(ColorSettings{static_cast<unsigned short>(1 + any(3)), any(2) != 0}));
      case 21:
        return say('Z', COLORS_TABLE, colorTable(any(7), any(200)));
      case 22:
      case 23:
        return say('P', any(4), playPayload(any(2) != 0 ? "NOD.MTN" : "WAG.MTN", any(4)));
      case 24:
        return say(any(2) != 0 ? 'N' : 'P', any(4), any(2) != 0 ? playPayload("SIT.MTN", 1) : "");
      case 25:
        return say(
            'U', 0,
            uploadPayload("ANY.MTN", any(2) != 0 ? "nonsense" : motionBytes("at 0 head_pan 0\nat 800 head_pan 30\n")));
      case 26:
        return say('D', 0, any(2) != 0 ? "NOD.MTN" : "NONE.MTN");
      case 27:
        return say('M', any(101));
      case 28:
        return any(3) != 0 ? say('Y', 2, "A.JPG") : say('Y', 1);
      case 29:
      case 30:
        walk_ = steering(0.001 * (any(300) - 100), 0.001 * (any(100) - 50), 0.001 * (any(600) - 300));
        guard_ = any(2);
        walk_left_ = any(12);
        return say('S', guard_, walk_);
      case 31:
      case 32:
        return say('E', 1 + any(3));
      case 33:
        return say(static_cast<char>('A' + any(26)), any(4), anyBytes(20));
      default:
        return changeTheWorld();
    }
  }

  void doSomething1() {
    const int what = any(12);
    did_ << ' ' << what;
    const char letters[] = "FWJJVALKYS";
    if (what < 10) {
      const char letter = letters[what];
      const bool is_joint = letter == 'J' || letter == 'V' || letter == 'A';
      const int id = is_joint ? jointId() : any(letter == 'F' || letter == 'W' ? 101 : 30);
      did_ << letter;
      const bool has_value = letter != 'F' && letter != 'W';
      send(has_value ? request(letter, id, letter == 'S' || letter == 'K' ? any(2) : any(9000)) : request(letter, id));
    } else if (what == 10) {
      send(fileRequest('P', any(2) != 0 ? "NOD.MTN" : "WAG.MTN", static_cast<unsigned short>(any(4))));
    } else {
      changeTheWorld();
    }
  }

  void changeTheWorld() {
    const int what = any(18);
    did_ << "world" << what;
    FakeRobot::FakeJoint& joint = robot_.joints[static_cast<size_t>(any(robot_.model.number_of_joints))];
    switch (what) {
      case 0:
      case 1:
        joint.jammed = true;
        break;
      case 2:
        robot_.refuses_power = true;
        break;
      case 3:
        joint.refuses_gain = true;
        break;
      case 4:
        joint.is_mute = true;
        break;
      case 5:
        robot_.refuses_camera_settings = true;
        break;
      case 6:
        robot_.refuses_color_tables = true;
        break;
      case 7:
        robot_.refuses_speaker = true;
        break;
      case 8:
      case 9:
        encoder_.slowDown();
        break;
      case 10:
        file_keeper_.slowDown();
        break;
      case 11:
        robot_.sensor("acceleration_right_left") = 9806650;
        robot_.sensor("acceleration_up_down") = 0;
        break;
      case 12:
        robot_.color_plane.clear();
        break;
      case 13:
        robot_.stick_status = omemorystickNOT_EXIST;
        break;
      case 14:
        room_ = static_cast<size_t>(any(70000));
        break;
      case 15:
        encoder_.speedUp();
        break;
      case 16:
        file_keeper_.speedUp();
        break;
      default:
        robot_.detail.reset();
        break;
    }
  }

  // The client ends, mostly while much is under way. What the camera and the speaker refuse to set back stays set.
  void go() {
    robot_.refuses_camera_settings = robot_.refuses_color_tables = robot_.refuses_speaker = false;
    const int how = any(9);
    did_ << " ends " << how;
    switch (how) {
      case 0:
      case 1:
        client_->close();
        break;
      case 2:
        client_->reset();
        break;
      case 3:
        send(speaks2_ ? std::string("Z\0\0\1\0\1\0\1", 8) : "GET / HTTP/1.1\r\n");
        client_->close();
        break;
      case 4:
        client_->send(speaks2_ ? frame('J', 0, 9, "abcd").substr(0, 10) : "U1WALK.MTN\377\377\377\377");
        machine_->runPending();
        client_->close();
        break;
      case 5:
        passFrames(speaks2_ ? 640 : 100);
        client_->close();
        break;
      case 6: {
        passFrames(80);
        auto guest = connect(0, address_);
        guest->send(request('X', 2));
        passFrames(2);
        client_->close();
        passFrames(2);
        guest->close();
        break;
      }
      default:
        failing_entry_ = how - 6;
        failure_ = how == 7 ? TCP_CONNECTION_RESET : TCP_CONNECTION_TIMEOUT;
        send(speaks2_ ? frame('H', 0, 1) : kRefused);
        failing_entry_.reset();
        client_->close();
        break;
    }
    machine_->runPending();
    passFrames(static_cast<unsigned>(any(6)));
    walk_left_ = 0;
  }

  // ---------------------------------------------------------------------------------------------- the recording

  void beginRecord() {
    record_.str("");
    console_.str("");
    robot_.camera_requests.clear();
    robot_.played.clear();
    for (FakeRobot::FakeJoint& joint : robot_.joints) {
      joint.path.clear();
    }
    for (FakeRobot::FakeEar& ear : robot_.ears) {
      ear.path.clear();
    }
    for (FakeRobot::FakeLed& led : robot_.leds) {
      led.commands = 0;
    }
    robot_.images_read = 0;
  }

  // Takes what has come.
  void collect() {
    while (const auto next = client_->nextFrame()) {
      const bool is_push = next->header.request_number == 0;
      answered_ = is_push ? answered_ : next->header.request_number;
      if (is_recording_pushes_ || !is_push) {
        record_ << next->header.kind << int{next->header.id} << " #" << next->header.request_number << ' '
                << shown(textOf(*next)) << '\n';
      }
    }
    while (const auto datagram = datagrams_.next()) {
      record_ << "UDP " << shown({datagram->begin(), datagram->end()}) << '\n';
      PictureDatagram header = {};
      if (decodePictureDatagram(datagram->data(), datagram->size(), &header) == nullptr &&
          header.part + 1U == numberOfParts(header.jpeg_size)) {
        const std::string status = repeats_-- > 0 ? payloadOf(DatagramStatus{0, header.picture, 1})
                                                  : payloadOf(Acknowledgement{header.picture});
        datagrams_.reply({status.begin(), status.end()});
        machine_->runPending();
      }
    }
  }

  void ask(char kind, int id, const std::string& payload = {}) {
    const int number = ++number_;
    send(frame(kind, id, number, payload));
    EXPECT_TRUE(machine_->runUntil(
        [&] {
          collect();
          return answered_ == number || client_->ended();
        },
        std::chrono::seconds(1)))
        << "no answer to " << kind << did_.str();
    machine_->runPending();
    collect();
  }

  // Sends what is answered later.
  void order(char kind, int id, const std::string& payload = {}) { send(frame(kind, id, ++number_, payload)); }

  void listen(unsigned frames) {
    for (unsigned i = 0; i < frames; ++i) {
      if (i % 50 == 49) {
        ask('H', 0);
      }
      passFrames(1);
      collect();
    }
    ask('H', 0);
  }

  // Everything in version 1, byte by byte.
  void takeReplies() {
    const std::string bytes = client_->received();
    client_->take(bytes.size());
    record_ << shown(bytes) << '\n';
  }

  // What the robot has done since the last note.
  void note(const std::string& what) {
    for (size_t i = 0; i < robot_.joints.size(); ++i) {
      FakeRobot::FakeJoint& joint = robot_.joints[i];
      std::string path;
      for (const int position : std::exchange(joint.path, {})) {
        path += std::to_string(position - (is_placed_ ? 0 : joint.position)) + ' ';
      }
      record_ << robot_.model.joints[i].name << ' ' << hash(path);
      if (is_placed_) {
        record_ << ' ' << joint.position << (joint.gain ? " on " : " off ") << joint.gains.proportional;
      }
      record_ << '\n';
    }
    for (size_t i = 0; i < robot_.leds.size(); ++i) {
      FakeRobot::FakeLed& led = robot_.leds[i];
      record_ << "LED" << i << ' ' << led.intensity << ' ' << (led.intensity == 0 ? 0 : led.mode) << " by "
              << std::exchange(led.commands, 0) << '\n';
    }
    for (FakeRobot::FakeEar& ear : robot_.ears) {
      record_ << "ear drawn for " << std::count(ear.path.begin(), ear.path.end(), true) << '\n';
      ear.path.clear();
    }
    for (const auto& [asked, value] : std::exchange(robot_.camera_requests, {})) {
      record_ << "camera " << asked << ' ' << value << '\n';
    }
    for (const auto& [channel, table] : robot_.color_tables) {
      std::string all;
      for (const longword segment : table) {
        all += segment == ocdtINIT ? "" : std::to_string(segment) + ' ';
      }
      record_ << (all.empty() ? "" : "table " + std::to_string(channel) + ' ' + hash(all) + '\n');
    }
    const std::vector<sword> played = std::exchange(robot_.played, {});
    record_ << "played " << played.size() << ' '
            << hash({reinterpret_cast<const char*>(played.data()), 2 * played.size()}) << '\n'
            << "power " << (!is_placed_ || robot_.powered) << ", images read " << std::exchange(robot_.images_read, 0)
            << '\n'
            << std::regex_replace(console_.str(), std::regex("127.0.0.1:[0-9]+"), "CLIENT") << "--- " << what << '\n';
    console_.str("");
  }

  void end() {
    client_->close();
    machine_->runPending();
    passFrames(40);
    note("client gone");
  }

  // ---------------------------------------------------------------------------------------------- the scenario

  // It is no client. How often the console says so depends on the history.
  void browser() {
    client_ = connect();
    send("POST / HTTP/1.1\r\n");
    passFrames(4);
    record_ << "browser " << client_->wasReset() << client_->received() << '\n';
    console_.str("");
  }

  void beginVersion2() {
    send(request('X', 2));
    passFrames(1);
    record_ << shown({client_->received().data(), protocol::VALUE_REPLY_SIZE}) << '\n';
    client_->take(protocol::VALUE_REPLY_SIZE);
    listen(20);
    note("version 2");
  }

  // Another client is turned away. After an outage, the client itself takes its place again, though not at once.
  void comeBack() {
    const auto other = connect();
    other->send(request('X', 2));
    passFrames(4);
    EXPECT_TRUE(other->wasReset());
    passFrames(80);
    const auto gone = std::exchange(client_, connect());
    passFrames(30);
    beginVersion2();
    EXPECT_TRUE(gone->wasReset());
  }

  // The server ends the connection, but the client does not.
  void breakTheProtocol() {
    order('F', 50, kLayerHigh);
    send(std::string("Z\0\0\1\0\1\0\1", 8));
    passFrames(260);
    collect();
    record_ << "reset " << client_->wasReset() << '\n';
    note("protocol broken");
  }

  void version1() {
    client_ = connect();
    const auto say = [this](const std::string& bytes) {
      client_->send(bytes + kRefused);
      machine_->runPending();
      passFrames(8);
      takeReplies();
    };
    passFrames(20);
    takeReplies();
    say(request('F', 60));
    say(request('W', 40));
    say(request('W', 40));
    for (const int joint : {1, 3, 23, 52}) {
      say(request('V', joint) + request('A', joint));
      say(request('V', joint, 1000 + joint) + request('A', joint, 30000));
    }
    say(request('L', 3, 1) + request('L', 9, 100) + request('Y', 2, 40) + request('L', 26, 0) + request('K', 1, 1));
    say(request('S', 66) + request('S', 5) + request('S', 53));
    client_->send(request('S', 255) + kRefused);
    passFrames(8);
    record_ << "block of " << client_->received().size() << '\n';
    client_->take(client_->received().size());
    client_->send(std::string("U\0MINE.MTN\0\0\0\0\0\0\3\0", 18) + "abcW");
    say("");
    say(fileRequest('D', "NONE.MTN", 0));
  }

  // What a client finds.
  void untouched() {
    order('F', 255, {LAYER_DOUBLE});
    listen(8);
    ask('W', 30, payloadOf(StreamSettings{true, LAYER_MIDDLE, 2}));
    listen(20);
    ask('W', 30, kStreamOff);
    ask('Z', COLORS_ON, payloadOf(ColorSettings{2, true}));
    listen(20);
    ask('Z', COLORS_OFF);
    ask('V', 0);
    ask('A', SOUND_VOLUME);
    ask('A', SOUND_SPEAKER, sound(500, 10, false));
    for (int setting = 1; setting <= 5; ++setting) {
      ask('G', setting);
    }
    order('F', 10, kLayerHigh);
    ask('N', 0);
    ask('Y', 1);
    listen(20);
    note("untouched");
  }

  // What a client does that wants to begin anew. Only then do both robots stand alike.
  void endEverything() {
    ask('W', 85, kStreamOff);
    ask('B', 0, payloadOf(DatagramPort{0}));
    ask('T', 0, short16(0));
    ask('Z', COLORS_OFF);
    for (int channel = 0; channel < 7; ++channel) {
      ask('Z', COLORS_TABLE, colorTableEmpty(channel));
    }
    ask('A', SOUND_MICROPHONE, payloadOf(MicrophoneSettings{0, 1, 16000}));
    ask('A', SOUND_SPEAKER, sound(0, 0, true));
    ask('A', SOUND_VOLUME, "\377");
    ask('P', 0, playPayload("", 0));
    ask('I', 0);
    for (int setting = 5; setting > 0; --setting) {
      ask('G', setting, {static_cast<char>(defaultCameraSettings().values[setting - 1])});
    }
    SpeedLimits limits = {static_cast<unsigned char>(robot_.joints.size()), {}};
    LedValues leds = {static_cast<unsigned char>(robot_.leds.size()), {}};
    for (size_t i = 0; i < robot_.joints.size(); ++i) {
      limits.joints[i] = {robot_.model.joints[i].identifier, robot_.model.joints[i].highest_speed};
    }
    for (size_t i = 0; i < robot_.leds.size(); ++i) {
      leds.leds[i] = {robot_.model.leds[i].identifier, 0, LED_MODE_A};
    }
    ask('V', 0, payloadOf(limits));
    ask('L', 0, payloadOf(leds));
    ask('K', 0, std::string(2, '\0'));
    note("ended");
  }

  static std::string colorTableEmpty(int channel) {
    ColorTable table = {static_cast<unsigned char>(channel), {}};
    std::fill(std::begin(table.segments), std::end(table.segments), EMPTY_COLOR_SEGMENT);
    return payloadOf(table);
  }

  void settings() {
    ask('G', SETTING_GAIN, "\3");
    ask('G', SETTING_AUTO_EXPOSURE, std::string(1, '\0'));
    ask('G', SETTING_SHUTTER_SPEED);
    ask('V', 0, payloadOf(SpeedLimits{2, {{2, 700000}, {52, 900000}}}));
    ask('V', 0);
    LedValues leds = {static_cast<unsigned char>(robot_.leds.size()), {}};
    for (size_t i = 0; i < robot_.leds.size(); ++i) {
      leds.leds[i] = {robot_.model.leds[i].identifier, static_cast<unsigned char>(9 * i + 3),
                      i % 2 != 0 ? LED_MODE_B : LED_MODE_A};
    }
    ask('L', 0, payloadOf(leds));
    ask('K', 0, {0, 1});
    listen(40);
    ask('T', 3, short16(8));
    listen(20);
    ask('T', 1, short16(16));
    listen(20);
    note("settings");
  }

  void pictures() {
    order('F', 50, {LAYER_LOW});
    order('F', 70, {LAYER_HIGH});
    listen(12);
    ask('W', 60, payloadOf(StreamSettings{true, LAYER_HIGH, 1}));
    listen(9);
    ask('W', 60, payloadOf(StreamSettings{true, LAYER_DOUBLE, 2}));
    order('F', 10, {LAYER_HIGH});
    listen(17);
    ask('W', 20, payloadOf(StreamSettings{true, LAYER_MIDDLE, 3}));
    listen(25);
    note("pictures");
  }

  // The stream goes on by UDP.
  void datagrams() {
    ask('W', 95, kStreamOn);
    robot_.cr = 90;
    ask('B', 0, payloadOf(DatagramPort{datagrams_.port()}));
    listen(20);
    repeats_ = 1;
    ask('X', 0, payloadOf(DatagramOrder{datagrams_.port(), true, 5, 9}));
    listen(6);
    robot_.detail = std::array<byte, 3>{90, 180, 20};
    ask('X', 0, payloadOf(DatagramOrder{datagrams_.port(), false, 7, 11}));
    ask('W', 70, payloadOf(StreamSettings{true, LAYER_DOUBLE, 1}));
    listen(20);
    ask('X', 0, payloadOf(DatagramOrder{0, false, 0, 0}));
    listen(12);
    ask('W', 95, kStreamOff);
    robot_.cr = 128;
    listen(8);
    note("datagrams");
  }

  void soundAndColors() {
    ask('A', SOUND_MICROPHONE, payloadOf(MicrophoneSettings{1, 2, 8000}));
    listen(12);
    ask('A', SOUND_MICROPHONE, payloadOf(MicrophoneSettings{3, 1, 16000}));
    ask('A', SOUND_VOLUME, "\2");
    ask('A', SOUND_SPEAKER, sound(0, 3000, false));
    listen(8);
    ask('A', SOUND_SPEAKER, sound(3200, 700, true));
    listen(50);
    ask('A', SOUND_MICROPHONE, payloadOf(MicrophoneSettings{0, 1, 16000}));
    ask('Z', COLORS_TABLE, colorTable(1, 30));
    ask('Z', COLORS_TABLE, colorTable(5, 60));
    ask('Z', COLORS_ON, payloadOf(ColorSettings{3, true}));
    listen(30);
    ask('Z', COLORS_OFF);
    note("sound and colours");
  }

  void stick() {
    ask('N', 0);
    ask('U', 0, uploadPayload("MINE.MTN", motionBytes("at 0 head_pan 0\nat 800 head_pan 30\n")));
    ask('U', 0, uploadPayload("MINE.MTN", "nonsense"));
    ask('N', 0);
    ask('D', 0, "MINE.MTN");
    order('M', 33);
    listen(12);
    ask('Y', 1);
    ask('Y', 2, "NONE.JPG");
    note("stick");
  }

  void joints() {
    JointTargets targets = {0, 4, {{2, -400000}, {12, 500000}, {51, 300000}, {52, 250000}}};
    ask('J', 0, payloadOf(targets));
    listen(10);
    targets.duration_ms = 600;
    targets.joints[0].value = 600000;
    ask('J', 0, payloadOf(targets));
    listen(30);
    ask('I', 1, {12, 2});
    listen(12);
    robot_.joint("tail_pan").jammed = true;
    targets.joints[2].value = -500000;
    ask('J', 0, payloadOf(targets));
    listen(120);
    robot_.joint("tail_pan").jammed = false;
    targets.joints[2].value = 100000;
    ask('J', 0, payloadOf(targets));
    listen(100);
    ask('I', 0);
    note("joints");
  }

  void motions() {
    ask('P', 2, playPayload("WAG.MTN", 2));
    ask('P', 0, playPayload("NOD.MTN", 1));
    listen(60);
    ask('P', 0, playPayload("NOD.MTN", 0));
    listen(60);
    ask('O', 0, std::string(1, '\0'));
    ask('P', 0, playPayload("NOD.MTN", 1));
    listen(10);
    ask('O', 0, "\1");
    listen(10);
    note("motions");
  }

  void walks() {
    ask('E', POSTURE_STAND);
    listen(150);
    for (int i = 0; i < 8; ++i) {
      ask('S', 0, steering(0.1, -0.02, i < 4 ? 0.2 : -0.1));
      listen(25);
    }
    ask('S', 0, steering(0, 0, 0));
    listen(100);
    ask('E', POSTURE_SIT);
    listen(60);
    ask('J', 0, payloadOf(JointTargets{0, 1, {{21, 100000}}}));
    listen(20);
    note("walks");
  }

  UdpSocket& datagrams_;
  const char* address_ = "127.0.0.1";  ///< of the clients before the scenario
  size_t room_ = 0;                    ///< on the memory stick
  std::vector<int> places_;
  std::minstd_rand random_;
  std::ostringstream did_;
  bool reads_ = true;
  bool speaks2_ = true;
  std::string walk_;
  int guard_ = 0;
  int walk_left_ = 0;  ///< how often it is steered on
  std::ostringstream record_;
  bool is_recording_pushes_ = true;
  bool is_placed_ = false;  ///< the robot stands as any other in the scenario
  int number_ = 100;
  int answered_ = 0;
  int repeats_ = 0;  ///< how many pictures by UDP are said to be incomplete
};

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

// The first difference, with what came before and after it.
std::string difference(const std::string& text, const std::string& expected) {
  const std::vector<std::string> is = linesOf(text);
  const std::vector<std::string> should_be = linesOf(expected);
  size_t i = 0;
  while (i < std::min(is.size(), should_be.size()) && is[i] == should_be[i]) {
    ++i;
  }
  size_t from = 0;
  if (i < std::min(is.size(), should_be.size())) {
    from = static_cast<size_t>(
        std::mismatch(is[i].begin(), is[i].end(), should_be[i].begin(), should_be[i].end()).first - is[i].begin());
  }
  std::string part = "line " + std::to_string(i) + ", byte " + std::to_string(from) + '\n';
  from = from < 100 ? 0 : from - 100;
  for (size_t k = i < 3 ? 0 : i - 3; k < i; ++k) {
    part += "    " + is[k].substr(0, 100) + '\n';
  }
  const auto line = [&](const std::vector<std::string>& lines, size_t k) {
    return (lines.size() <= k ? "nothing" : k == i ? lines[k].substr(from, 200) : lines[k].substr(0, 100)) + '\n';
  };
  for (size_t k = i; k < i + 3; ++k) {
    part += " is " + line(is, k) + " not " + line(should_be, k);
  }
  return part;
}

class HistoryTest : public ::testing::TestWithParam<Begin> {};

TEST_P(HistoryTest, LeavesNothing) {
  const bool is_connected = GetParam() == Begin::kSameConnection;
  UdpSocket datagrams;
  std::string expected;
  for (unsigned seed = 0; seed <= kHistories; ++seed) {
    LivedRobot robot(datagrams);
    if (seed > 0) {
      robot.liveThrough(seed + 1000 * static_cast<unsigned>(GetParam()), !is_connected);
    } else if (is_connected) {
      robot.beginIdly();
    }
    robot.rest(is_connected);
    const std::string done = robot.scenario(GetParam());
    if (seed == 0) {
      expected = done;
    } else {
      EXPECT_TRUE(done == expected) << "after " << seed << robot.history() << '\n' << difference(done, expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Begins, HistoryTest,
                         ::testing::Values(Begin::kVersion1, Begin::kVersion2, Begin::kSameConnection));

}  // namespace
