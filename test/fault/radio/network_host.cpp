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

namespace fault_bench {
namespace {

constexpr char kDevice[] = "radio0";
constexpr char kNetmask[] = "255.0.0.0";

[[noreturn]] void throwProblem(const std::string& what) {
  throw NoNetworkHosts("this machine cannot play two hosts: " + what + ": " + std::generic_category().message(errno) +
                       " (root and /dev/net/tun are needed)");
}

ifreq requestFor(const char* device) {
  ifreq request = {};
  std::strncpy(request.ifr_name, device, IFNAMSIZ - 1);
  return request;
}

void setAddress(int socket, unsigned long what, const std::string& address) {
  ifreq request = requestFor(kDevice);
  auto* internet = reinterpret_cast<sockaddr_in*>(&request.ifr_addr);
  internet->sin_family = AF_INET;
  if (::inet_pton(AF_INET, address.c_str(), &internet->sin_addr) != 1) {
    throw NoNetworkHosts("'" + address + "' is no IPv4 address");
  }
  if (::ioctl(socket, what, &request) != 0) {
    throwProblem("address " + address);
  }
}

void bringUp(int socket, const char* device) {
  ifreq request = requestFor(device);
  request.ifr_flags = IFF_UP | IFF_RUNNING;
  if (::ioctl(socket, SIOCSIFFLAGS, &request) != 0) {
    throwProblem(std::string("starting ") + device);
  }
}

int openTunDevice() {
  const int packets = ::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (packets < 0) {
    throwProblem("/dev/net/tun");
  }
  ifreq request = requestFor(kDevice);
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  if (::ioctl(packets, TUNSETIFF, &request) != 0) {
    const int error = errno;
    ::close(packets);
    errno = error;
    throwProblem("TUN device");
  }
  return packets;
}

void configure(const std::string& address) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) {
    throwProblem("socket");
  }
  try {
    bringUp(socket, "lo");
    setAddress(socket, SIOCSIFADDR, address);
    setAddress(socket, SIOCSIFNETMASK, kNetmask);
    bringUp(socket, kDevice);
  } catch (...) {
    ::close(socket);
    throw;
  }
  ::close(socket);
}

}  // namespace

NetworkHost::NetworkHost(const std::string& address) : address_(address) {
  std::exception_ptr problem;
  std::thread([&] {  // a thread of its own, because one that has left its namespace may not be able to go back
    try {
      if (::unshare(CLONE_NEWNET) != 0) {
        throwProblem("network namespace");
      }
      name_space_ = ::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
      if (name_space_ < 0) {
        throwProblem("network namespace");
      }
      packets_ = openTunDevice();
      configure(address_);
    } catch (...) {
      problem = std::current_exception();
    }
  })
      .join();
  if (problem) {
    ::close(packets_);
    ::close(name_space_);
    std::rethrow_exception(problem);
  }
}

NetworkHost::~NetworkHost() {
  ::close(packets_);
  ::close(name_space_);
}

void NetworkHost::enter() const {
  if (::setns(name_space_, CLONE_NEWNET) != 0) {
    throwProblem("entering a network namespace");
  }
}

}  // namespace fault_bench
