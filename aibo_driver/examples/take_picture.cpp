// Takes one picture with the robot's camera and writes it to a file:
//   take_picture HOST FILE.jpg [PORT]
//
// This package builds this program. To build it elsewhere, let $AIBO be the prefix under which aibo_driver is
// installed:
//   g++ -std=c++17 take_picture.cpp -I$AIBO/include -L$AIBO/lib -Wl,-rpath,$AIBO/lib -laibo_client -pthread
#include <aibo_client/rcserver_client.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>

using namespace std::chrono_literals;

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: take_picture HOST FILE.jpg [PORT]\n";
    return EXIT_FAILURE;
  }
  try {
    aibo_client::ClientOptions options;
    options.host = argv[1];
    options.port = argc > 3 ? std::atoi(argv[3]) : options.port;
    aibo_client::RcServerClient robot(options, {});
    robot.start();
    robot.waitForConnection(5s);  // if there is no connection, the exception says why
    const aibo_client::PicturePtr picture = robot.takePicture(85, 5s);
    std::ofstream file(argv[2], std::ios::binary);
    file.write(reinterpret_cast<const char*>(picture->jpeg.data()), static_cast<std::streamsize>(picture->jpeg.size()));
    std::cout << picture->width << "x" << picture->height << " pixels, " << picture->jpeg.size() << " bytes\n";
    return file.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const aibo_client::Exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
