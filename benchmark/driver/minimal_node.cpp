// A minimal driver, for comparison: it asks the robot for its stream by version 1 of the protocol and publishes each
// JPEG. It checks nothing, knows no joints, and ends when anything is wrong.
//
//   minimal_node [PORT]
//
// Without a port it has nothing to do, so its cost is that of roscpp.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace {

int connectTo(const char* port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::atoi(port)));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const void* const generic = &address;
  const int robot = ::socket(AF_INET, SOCK_STREAM, 0);
  return ::connect(robot, static_cast<const sockaddr*>(generic), sizeof address) == 0 ? robot : -1;
}

bool receive(int robot, void* bytes, std::size_t size) {
  return ::recv(robot, bytes, size, MSG_WAITALL) == static_cast<ssize_t>(size);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "minimal_node", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<sensor_msgs::CompressedImage>("camera/image_raw/compressed", 1);
  while (argc < 2 && ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(3600));
  }
  const int robot = argc > 1 ? connectTo(argv[1]) : -1;
  constexpr std::uint8_t kStreamAtQuality85[] = {'W', 85};
  if (robot < 0 || ::send(robot, kStreamAtQuality85, sizeof kStreamAtQuality85, 0) < 0) {
    return EXIT_FAILURE;
  }
  std::uint8_t header[5];
  while (ros::ok() && receive(robot, header, sizeof header)) {
    std::size_t size = 0;
    for (int i = 1; i < 5; ++i) {
      size = size * 256 + header[i];
    }
    const auto image = boost::make_shared<sensor_msgs::CompressedImage>();
    image->header.stamp = ros::Time::now();
    image->format = "bgr8; jpeg compressed bgr8";
    image->data.resize(size);
    if (!receive(robot, image->data.data(), size)) {
      break;
    }
    publisher.publish(image);
  }
  return EXIT_FAILURE;
}
