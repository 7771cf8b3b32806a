// Stands up, turns the head to the left, takes a picture, and walks for two seconds:
//   look_and_walk HOST FILE.jpg [PORT]
//
// This package builds this program. To build it elsewhere, let $AIBO be the prefix under which aibo_driver is
// installed:
//   g++ -std=c++17 look_and_walk.cpp -I$AIBO/include -L$AIBO/lib -Wl,-rpath,$AIBO/lib -laibo_client -pthread
#include <aibo_client/names.h>
#include <aibo_client/rcserver_client.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>

using namespace std::chrono_literals;

namespace {

void standUp(aibo_client::RcServerClient& robot) {
  robot.setMotors(true, 5s);
  robot.takePosture(aibo_client::Posture::kStand, 5s);  // returns when the robot begins to stand up
  for (int i = 0; robot.motorsAndPosture().posture != aibo_client::PostureNow::kStanding; ++i) {
    if (i == 300) {
      throw std::runtime_error("The robot does not stand after 30 s.");
    }
    std::this_thread::sleep_for(100ms);
  }
}

void takePicture(aibo_client::RcServerClient& robot, const std::string& path) {
  const aibo_client::PicturePtr picture = robot.takePicture(85, 5s);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(picture->jpeg.data()), static_cast<std::streamsize>(picture->jpeg.size()));
  if (!file.flush()) {
    throw std::runtime_error("Cannot write " + path + ".");
  }
  std::cout << path << " has " << picture->jpeg.size() << " bytes\n";
}

// A walk begins only after a velocity of 0. The robot stops by itself half a second after the last velocity.
void walk(aibo_client::RcServerClient& robot) {
  robot.steer({});
  for (int i = 0; i < 20; ++i) {
    robot.steer({0.1, 0, 0});  // m/s ahead
    std::this_thread::sleep_for(100ms);
  }
  robot.steer({});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: look_and_walk HOST FILE.jpg [PORT]\n";
    return EXIT_FAILURE;
  }
  try {
    aibo_client::ClientOptions options;
    options.host = argv[1];
    options.port = argc > 3 ? std::atoi(argv[3]) : options.port;
    aibo_client::RcServerClient robot(options, {});
    robot.start();
    robot.waitForConnection(5s);  // if there is no connection, the exception says why
    standUp(robot);
    robot.commandJoints({{aibo_client::idOfJoint("head_pan"), 0.5}}, 1s);  // rad, to the left
    std::this_thread::sleep_for(1500ms);
    takePicture(robot, argv[2]);
    walk(robot);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
