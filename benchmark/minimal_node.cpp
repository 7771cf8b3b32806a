// The least that a ROS node can do with the robot's stream: it asks an RCServer for pictures with version 1 of the
// protocol, and publishes each one. What the driver needs beyond this buys its checks, clocks, reconnects and the rest.
//
//   rosrun aibo_driver minimal_node 127.0.0.1 54321
#include <arpa/inet.h>
#include <netinet/in.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr unsigned char kStreamAtQuality85[] = {'W', 85};
constexpr std::size_t kHeaderSize = 5;  // 'f' and the size, big-endian

int connectTo(const char* address, int port) {
  sockaddr_in server = {};
  server.sin_family = AF_INET;
  server.sin_port = htons(static_cast<std::uint16_t>(port));
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  if (::inet_pton(AF_INET, address, &server.sin_addr) != 1 ||
      ::connect(socket, reinterpret_cast<const sockaddr*>(&server), sizeof(server)) != 0) {
    std::perror("minimal_node: there is no RCServer at this address and port");
    std::exit(EXIT_FAILURE);
  }
  return socket;
}

bool receive(int socket, void* out, std::size_t size) {
  return ::recv(socket, out, size, MSG_WAITALL) == static_cast<ssize_t>(size);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "minimal_node");
  if (argc != 3) {
    std::fprintf(stderr, "minimal_node ADDRESS PORT\n");
    return EXIT_FAILURE;
  }
  ros::NodeHandle handle("~");
  ros::Publisher publisher = handle.advertise<sensor_msgs::CompressedImage>("image_raw/compressed", 5);
  const int socket = connectTo(argv[1], std::atoi(argv[2]));
  if (::send(socket, kStreamAtQuality85, sizeof(kStreamAtQuality85), 0) < 0) {
    return EXIT_FAILURE;
  }
  std::uint8_t header[kHeaderSize];
  while (ros::ok() && receive(socket, header, sizeof(header))) {
    const auto message = boost::make_shared<sensor_msgs::CompressedImage>();
    message->header.stamp = ros::Time::now();
    message->format = "jpeg";
    message->data.resize(static_cast<std::size_t>(header[1]) << 24 | static_cast<std::size_t>(header[2]) << 16 |
                         static_cast<std::size_t>(header[3]) << 8 | header[4]);
    if (!receive(socket, message->data.data(), message->data.size())) {
      break;
    }
    publisher.publish(message);
  }
  ::close(socket);
  return EXIT_SUCCESS;
}
