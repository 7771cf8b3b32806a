/// @file sockets.h
/// TCP over IPv4 for test servers, clients and proxies.
#ifndef TEST_SUPPORT_SOCKETS_H
#define TEST_SUPPORT_SOCKETS_H

#include <poll.h>

#include <chrono>
#include <string>
#include <vector>

#include "host_files/file_descriptor.h"

namespace test_support {

/// Binds a TCP socket to an address of this computer.
/// @param port 0 = any free one that no ROS node has had
/// @throw std::system_error, std::invalid_argument
void bindSocket(const host_files::FileDescriptor& socket, const std::string& address, int port);

/// A socket that is bound as by bindSocket(), and does not listen yet. It does not block, and its buffers are small.
/// @throw std::system_error, std::invalid_argument
host_files::FileDescriptor bindTo(const std::string& address, int port);

/// The port that a socket is bound to.
int portOf(const host_files::FileDescriptor& socket);

/// A socket that is being connected; it does not block.
/// @throw std::system_error, std::invalid_argument
host_files::FileDescriptor beginConnecting(const std::string& address, int port);

/// Takes the next client of a listening socket; its socket does not block.
/// @return no descriptor if there is none
host_files::FileDescriptor acceptFrom(const host_files::FileDescriptor& listener);

/// Waits until one of these is ready, or until this time.
void pollUntil(std::vector<pollfd>* polled, std::chrono::steady_clock::time_point end);

/// From now on, closing the socket resets the connection.
void resetWhenClosed(const host_files::FileDescriptor& socket);

/// @throw std::system_error with what errno says, unless `good`
void check(bool good, const std::string& what);

}  // namespace test_support

#endif  // TEST_SUPPORT_SOCKETS_H
