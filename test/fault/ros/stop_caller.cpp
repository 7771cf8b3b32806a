// Calls a service `stop` again and again, and prints a line for each call: how many milliseconds it took. A process of
// its own measures what a user has to wait for; the sockets of an attacker's process are busy with the attack.

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <cstdio>

int main(int argc, char** argv) {
  // The master shuts down whoever has the address of an earlier node of the same name. That may be the driver by now.
  ros::init(argc, argv, "stop_caller", ros::init_options::AnonymousName);
  if (argc != 2) {
    std::fprintf(stderr, "usage: stop_caller SERVICE\n");
    return 2;
  }
  ros::NodeHandle node;
  ros::ServiceClient service = node.serviceClient<std_srvs::Trigger>(argv[1]);
  while (ros::ok()) {
    const auto begin = std::chrono::steady_clock::now();
    std_srvs::Trigger stop;
    const bool is_stopped = service.call(stop) && stop.response.success != 0;
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    if (!is_stopped && ros::ok()) {
      std::printf("stop failed: %s\n", stop.response.message.c_str());
      return 1;
    }
    std::printf("stop took %.0f ms\n", took.count());
    std::fflush(stdout);
    ros::WallDuration(0.1).sleep();
  }
}
