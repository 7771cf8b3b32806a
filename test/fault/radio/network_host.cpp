#include "radio/network_host.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <system_error>
#include <thread>

using host_files::FileDescriptor;

namespace fault_bench {
namespace {

constexpr char kDevice[] = "radio0";
constexpr char kNetmask[] = "255.0.0.0";

/// @return the result of a call of the system
/// @throw NoNetworkHosts it is an error
int check(long result, const std::string& what) {
  if (result < 0) {
    throw NoNetworkHosts("this machine cannot play two hosts: " + what + ": " + std::generic_category().message(errno) +
                         " (root and /dev/net/tun are needed)");
  }
  return static_cast<int>(result);
}

ifreq requestFor(const char* device, int flags) {
  ifreq request = {};
  std::strncpy(request.ifr_name, device, IFNAMSIZ - 1);
  request.ifr_flags = static_cast<short>(flags);
  return request;
}

void setAddress(int socket, unsigned long what, const std::string& address) {
  ifreq request = requestFor(kDevice, 0);
  auto* internet = reinterpret_cast<sockaddr_in*>(&request.ifr_addr);
  internet->sin_family = AF_INET;
  ::inet_pton(AF_INET, address.c_str(), &internet->sin_addr);
  check(::ioctl(socket, what, &request), "address " + address);
}

void bringUp(int socket, const char* device) {
  ifreq request = requestFor(device, IFF_UP | IFF_RUNNING);
  check(::ioctl(socket, SIOCSIFFLAGS, &request), std::string("starting ") + device);
}

FileDescriptor openTunDevice() {
  FileDescriptor packets(check(::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC), "/dev/net/tun"));
  ifreq request = requestFor(kDevice, IFF_TUN | IFF_NO_PI);
  check(::ioctl(packets.get(), TUNSETIFF, &request), "TUN device");
  return packets;
}

void configure(const std::string& address) {
  const FileDescriptor socket(check(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), "socket"));
  bringUp(socket.get(), "lo");
  setAddress(socket.get(), SIOCSIFADDR, address);
  setAddress(socket.get(), SIOCSIFNETMASK, kNetmask);
  bringUp(socket.get(), kDevice);
  // Computers differ in how TCP reacts to losses. Every system knows Reno, even an old one.
  constexpr char kName[] = "reno";
  const FileDescriptor setting(::open("/proc/sys/net/ipv4/tcp_congestion_control", O_WRONLY | O_CLOEXEC));
  check(::write(setting.get(), kName, sizeof kName - 1), "TCP's congestion control");
}

}  // namespace

NetworkHost::NetworkHost(const std::string& address) : address_(address) {
  std::exception_ptr problem;
  std::thread([&] {  // because a thread that has left its namespace may not be able to go back
    try {
      check(::unshare(CLONE_NEWNET), "network namespace");
      name_space_ =
          FileDescriptor(check(::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC), "network namespace"));
      packets_ = openTunDevice();
      configure(address_);
    } catch (...) {
      problem = std::current_exception();
    }
  })
      .join();
  if (problem) {
    std::rethrow_exception(problem);
  }
}

void NetworkHost::enter() const {
  check(::setns(name_space_.get(), CLONE_NEWNET), "entering a network namespace");
}

}  // namespace fault_bench
