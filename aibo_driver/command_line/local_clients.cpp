#include "command_line/local_clients.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace aibo_driver::command_line {
namespace {

namespace fs = std::filesystem;

/// The sockets that are connected to this port, by their names in /proc: "socket:[12345]".
std::vector<std::string> socketsTo(const in_addr& address, int port) {
  // The kernel prints the address as a number in this computer's byte order.
  char wanted[16];
  std::snprintf(wanted, sizeof wanted, "%08X:%04X", static_cast<unsigned>(address.s_addr), static_cast<unsigned>(port));
  std::vector<std::string> sockets;
  std::ifstream table("/proc/net/tcp");
  for (std::string line; std::getline(table, line);) {
    std::istringstream fields(line);
    std::string number, local, remote, state, queues, timer, retransmits, user, timeout, inode;
    fields >> number >> local >> remote >> state >> queues >> timer >> retransmits >> user >> timeout >> inode;
    if (remote == wanted && state == "01") {  // the connection is established
      sockets.push_back("socket:[" + inode + "]");
    }
  }
  return sockets;
}

bool holds(const fs::path& process, const std::string& socket) {
  std::error_code error;
  for (fs::directory_iterator file(process / "fd", error), end; !error && file != end; file.increment(error)) {
    std::error_code unreadable;
    if (fs::read_symlink(file->path(), unreadable) == socket) {
      return true;
    }
  }
  return false;
}

std::string describe(const fs::path& process) {
  std::error_code unreadable;
  const std::string name = fs::read_symlink(process / "exe", unreadable).filename().string();
  return name + " (process " + process.filename().string() + ")";
}

/// @return empty if this process owns the socket
std::string ownerOf(const std::string& socket) {
  std::error_code error;
  for (fs::directory_iterator process("/proc", error), end; !error && process != end; process.increment(error)) {
    const std::string number = process->path().filename().string();
    if (number.find_first_not_of("0123456789") != std::string::npos || !holds(process->path(), socket)) {
      continue;
    }
    return number == std::to_string(::getpid()) ? "" : describe(process->path());
  }
  return "a program of another user";
}

}  // namespace

std::vector<std::string> localClients(const std::string& address, int port) {
  in_addr numeric = {};
  std::vector<std::string> clients;
  if (::inet_pton(AF_INET, address.c_str(), &numeric) == 1) {
    for (const std::string& socket : socketsTo(numeric, port)) {
      const std::string owner = ownerOf(socket);
      if (!owner.empty() && std::find(clients.begin(), clients.end(), owner) == clients.end()) {
        clients.push_back(owner);
      }
    }
  }
  return clients;
}

}  // namespace aibo_driver::command_line
