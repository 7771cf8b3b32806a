// Plays a motion from the robot's memory stick, or lists them all:
//   play_motion HOST NAME.MTN [PORT]
//   play_motion HOST list [PORT]
//
// This package builds this program. To build it elsewhere, let $AIBO be the prefix under which aibo_driver is
// installed:
//   g++ -std=c++17 play_motion.cpp -I$AIBO/include -L$AIBO/lib -Wl,-rpath,$AIBO/lib -laibo_client -pthread
#include <aibo_client/rcserver_client.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>

using namespace std::chrono_literals;

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: play_motion HOST NAME.MTN|list [PORT]\n";
    return EXIT_FAILURE;
  }
  try {
    aibo_client::ClientOptions options;
    options.host = argv[1];
    options.port = argc > 3 ? std::atoi(argv[3]) : options.port;
    aibo_client::RcServerClient robot(options, {});
    robot.start();
    robot.waitForConnection(5s);  // if there is none, the exception says why
    if (argv[2] == std::string("list")) {
      for (const std::string& name : robot.listMotions(5s)) {
        std::cout << name << '\n';
      }
      return EXIT_SUCCESS;
    }
    robot.setMotors(true, 5s);
    const std::string changes = robot.playMotion(argv[2], 1, 5s);  // returns when the robot has begun
    std::cout << (changes.empty() ? "" : "Played differently than in the file: " + changes + ".\n");
    std::cout << "Press Enter to end. The robot stops its motions when this program disconnects.\n";
    std::cin.get();
    return EXIT_SUCCESS;
  } catch (const aibo_client::NetworkException& error) {
    const bool off = error.kind() == aibo_client::FaultKind::kRefused;
    std::cerr << error.what() << (off ? "\nTo try this without a robot: rosrun aibo_driver aibo_rcserver" : "") << '\n';
  } catch (const aibo_client::Exception& error) {
    std::cerr << error.what() << '\n';  // for example, the robot has no such motion
  }
  return EXIT_FAILURE;
}
