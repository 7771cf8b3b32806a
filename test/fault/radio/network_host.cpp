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
  if (::inet_pton(AF_INET, address.c_str(), &internet->sin_addr) != 1 || ::ioctl(socket, what, &request) != 0) {
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

FileDescriptor openTunDevice() {
  FileDescriptor packets(::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (!packets.valid()) {
    throwProblem("/dev/net/tun");
  }
  ifreq request = requestFor(kDevice);
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  if (::ioctl(packets.get(), TUNSETIFF, &request) != 0) {
    throwProblem("TUN device");
  }
  return packets;
}

/// Computers differ in how TCP reacts to losses. Every system knows Reno, even an old one.
void useOrdinaryTcp() {
  constexpr char kName[] = "reno";
  const FileDescriptor setting(::open("/proc/sys/net/ipv4/tcp_congestion_control", O_WRONLY | O_CLOEXEC));
  if (!setting.valid() || ::write(setting.get(), kName, sizeof kName - 1) < 0) {
    throwProblem("TCP's congestion control");
  }
}

void configure(const std::string& address) {
  const FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket.valid()) {
    throwProblem("socket");
  }
  bringUp(socket.get(), "lo");
  setAddress(socket.get(), SIOCSIFADDR, address);
  setAddress(socket.get(), SIOCSIFNETMASK, kNetmask);
  bringUp(socket.get(), kDevice);
  useOrdinaryTcp();
}

}  // namespace

NetworkHost::NetworkHost(const std::string& address) : address_(address) {
  std::exception_ptr problem;
  std::thread([&] {  // because a thread that has left its namespace may not be able to go back
    try {
      if (::unshare(CLONE_NEWNET) != 0) {
        throwProblem("network namespace");
      }
      name_space_ = FileDescriptor(::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC));
      if (!name_space_.valid()) {
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
    std::rethrow_exception(problem);
  }
}

void NetworkHost::enter() const {
  if (::setns(name_space_.get(), CLONE_NEWNET) != 0) {
    throwProblem("entering a network namespace");
  }
}

}  // namespace fault_bench
