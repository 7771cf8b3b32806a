// Takes one picture with the robot's camera and writes it to a file:
//   take_picture HOST FILE.jpg [PORT]
//
// Built with this package. Elsewhere, with $AIBO the prefix that aibo_driver is installed under:
//   g++ -std=c++17 take_picture.cpp -I$AIBO/include -L$AIBO/lib -Wl,-rpath,$AIBO/lib -laibo_driver_client -pthread
#include <aibo_driver/exceptions.h>
#include <aibo_driver/rcserver_client.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>

using namespace std::chrono_literals;

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: take_picture HOST FILE.jpg [PORT]\n";
    return EXIT_FAILURE;
  }
  try {
    aibo_driver::ClientOptions options;
    options.host = argv[1];
    options.port = argc > 3 ? std::atoi(argv[3]) : options.port;
    aibo_driver::RcServerClient robot(options, {});
    robot.start();
    for (int i = 0; i < 50 && robot.status().state != aibo_driver::ConnectionState::kConnected; ++i) {
      std::this_thread::sleep_for(100ms);
    }
    const aibo_driver::PicturePtr picture = robot.takePicture(85, 5s);  // says why if there is no connection
    std::ofstream file(argv[2], std::ios::binary);
    file.write(reinterpret_cast<const char*>(picture->jpeg.data()), static_cast<std::streamsize>(picture->jpeg.size()));
    std::cout << picture->width << "x" << picture->height << " pixels, " << picture->jpeg.size() << " bytes\n";
    return file.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const aibo_driver::Exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
