#include "mishaps.h"

#include <signal.h>

#include <algorithm>

#include "support/raw_client.h"

namespace soak {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using test_support::Action;
using test_support::Bytes;
using test_support::Conditions;
using test_support::Direction;
using test_support::Fault;
using test_support::Place;
using test_support::Welcome;

// A safety net: every kind of message comes within a second.
constexpr milliseconds kPatience{10000};

// About the bytes from one picture to the next, so that faults hit pictures and what is between them.
constexpr int kBytesFromPictureToPicture = 6000;

constexpr int kOthers = 20;

int uniform(Random& random, int lowest, int highest) {
  return std::uniform_int_distribution<int>(lowest, highest)(random);
}

// How long a fault lasts.
milliseconds someTime(Random& random) {
  return milliseconds(uniform(random, 100, 3000));
}

Bytes someBytes(Random& random) {
  Bytes bytes(static_cast<std::size_t>(uniform(random, 1, 50)));
  std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(uniform(random, 0, 255)); });
  return bytes;
}

void carryOut(const Scene& scene, const Fault& fault) {
  const std::size_t done = scene.proxy->faultsDone();
  scene.proxy->add(fault);
  if (!scene.proxy->waitForFaults(done + 1, kPatience)) {
    scene.proxy->clearFaults();
    throw NothingCame();
  }
}

/// A fault between one picture and the next.
Mishap inStream(const std::string& name, Action action) {
  return {name, false, [action](const Scene& scene, Random& random) {
            Fault fault;
            fault.action = action;
            fault.place = Place::kPicture;
            fault.offset = static_cast<std::uint64_t>(uniform(random, 0, kBytesFromPictureToPicture));
            fault.time = milliseconds(uniform(random, 1, 1500));
            carryOut(scene, fault);
            if (action == Action::kSilence) {
              scene.pass(someTime(random));
            }
          }};
}

Mishap damage(const std::string& name, Action action) {
  return {name, true, [action](const Scene& scene, Random& random) {
            Fault fault;
            fault.action = action;
            fault.place = Place::kPicture;
            fault.offset = static_cast<std::uint64_t>(uniform(random, 0, kBytesFromPictureToPicture));
            fault.bytes = someBytes(random);
            fault.count = fault.bytes.size();
            carryOut(scene, fault);
          }};
}

/// The robot may take damaged requests for others, so a new connection follows.
Mishap damageToRobot(const std::string& name, Action action) {
  return {name, true, [action](const Scene& scene, Random& random) {
            Fault fault;
            fault.action = action;
            fault.direction = Direction::kToServer;
            fault.bytes = someBytes(random);
            fault.count = fault.bytes.size();
            carryOut(scene, fault);
            scene.pass(someTime(random));
            scene.proxy->endConnections(Action::kReset);
          }};
}

/// The way is bad for a while.
Mishap badWay(const std::string& name, const std::function<Conditions(Random&)>& make) {
  return {name, false, [make](const Scene& scene, Random& random) {
            scene.proxy->setConditions(make(random));
            scene.pass(someTime(random));
          }};
}

/// The connection is reset, and for a while there is no new one.
Mishap noWay(const std::string& name, Welcome welcome) {
  return {name, false, [welcome](const Scene& scene, Random& random) {
            scene.proxy->setWelcome(welcome);
            scene.proxy->endConnections(Action::kReset);
            scene.pass(someTime(random));
          }};
}

void moveAwayAndBack(const Scene& scene, Random& random) {
  scene.proxy->moveTo("127.0.0.2");
  scene.pass(someTime(random));
  scene.proxy->moveTo("127.0.0.1");
}

void killAndRestart(const Scene& scene, Random& random) {
  scene.robot->kill();
  scene.pass(someTime(random));
  scene.robot->restart();
}

void hold(const Scene& scene, Random& random) {
  scene.robot->process().signal(SIGSTOP);
  scene.pass(someTime(random));
  scene.robot->process().signal(SIGCONT);
}

void othersConnect(const Scene& scene, Random& random) {
  for (int i = 0; i < kOthers; ++i) {
    test_support::RawClient other(scene.robot->port());
    const Bytes noise = someBytes(random);
    other.send(std::string(noise.begin(), noise.end()));
  }
}

std::vector<Mishap> badWays() {
  return {badWay("random delays",
                 [](Random& random) {
                   Conditions conditions;
                   conditions.delay = milliseconds(uniform(random, 1, 100));
                   conditions.jitter = milliseconds(uniform(random, 1, 300));
                   return conditions;
                 }),
          badWay("slow",
                 [](Random& random) {
                   Conditions conditions;
                   conditions.bytes_per_second = static_cast<std::size_t>(uniform(random, 5000, 100000));
                   return conditions;
                 }),
          badWay("in small pieces",
                 [](Random& random) {
                   Conditions conditions;
                   conditions.largest_piece = static_cast<std::size_t>(uniform(random, 50, 1000));
                   conditions.random_pieces = uniform(random, 0, 1) == 1;
                   conditions.piece_gap = microseconds(uniform(random, 0, 1000));
                   return conditions;
                 }),
          badWay("in large pieces",
                 [](Random& random) {
                   Conditions conditions;
                   conditions.join = milliseconds(uniform(random, 10, 300));
                   return conditions;
                 }),
          badWay("nothing gets through", [](Random&) {
            Conditions conditions;
            conditions.paused = true;
            return conditions;
          })};
}

}  // namespace

std::vector<Mishap> allMishaps() {
  std::vector<Mishap> mishaps = {
      inStream("connection closed", Action::kClose),
      inStream("connection reset", Action::kReset),
      inStream("connection half closed", Action::kHalfClose),
      inStream("connection falls silent", Action::kSilence),
      inStream("stream pauses", Action::kPause),
      inStream("stream split", Action::kSplit),
      damage("bytes lost", Action::kDrop),
      damage("bytes inserted", Action::kInsert),
      damage("bytes overwritten", Action::kOverwrite),
      damage("bits flipped", Action::kFlip),
      damageToRobot("to the robot: bytes lost", Action::kDrop),
      damageToRobot("to the robot: bytes inserted", Action::kInsert),
      damageToRobot("to the robot: bits flipped", Action::kFlip),
      noWay("connections are closed at once", Welcome::kClose),
      noWay("connections are reset at once", Welcome::kReset),
      noWay("connections stay silent", Welcome::kSilence),
      noWay("connections are refused", Welcome::kRefuse),
      noWay("attempts get no answer", Welcome::kUnreachable),
      {"robot moves away and back", false, moveAwayAndBack},
      {"robot killed and restarted", false, killAndRestart},
      {"robot stopped and continued", false, hold},
      {"other clients connect", false, othersConnect},
      {"stream off and on", false, [](const Scene& scene, Random&) { scene.workload->toggleStream(); }},
  };
  const std::vector<Mishap> more = badWays();
  mishaps.insert(mishaps.end(), more.begin(), more.end());
  return mishaps;
}

}  // namespace soak
