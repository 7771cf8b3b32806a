/// @file options.h
#ifndef AIBO_CLIENT_OPTIONS_H
#define AIBO_CLIENT_OPTIONS_H

#include <chrono>
#include <string>

#include "aibo_client/camera.h"

namespace aibo_client {

/// How to reach the robot, and how long to wait for it. The constructor of RcServerClient checks every option. Where no
/// source is named, defaults and ranges are our choice.
struct ClientOptions {
  std::string host = "127.0.0.1";  ///< name or address of the robot, without a port; an IPv6 address without brackets
  int port = 54321;                ///< 1..65535; the RCServer's port (section 2.2 of the report that README.md names)
  int jpeg_quality = 85;           ///< 1..100, for the stream; the report gives 85 as the standard (section 3.3.3)
  int protocol_version = 0;        ///< 0: the newest version that the server speaks; 1: version 1, without asking
  PictureTransport picture_transport = PictureTransport::kTcp;  ///< see setPictureTransport()
  std::chrono::milliseconds connect_timeout{2000};              ///< 50 ms..60 s, including the name lookup
  std::chrono::milliseconds read_timeout{500};         ///< 50 ms..60 s; a stream that is silent for longer is dead
  std::chrono::milliseconds reconnect_wait_min{100};   ///< 10 ms..reconnect_wait_max; the wait doubles at each failure
  std::chrono::milliseconds reconnect_wait_max{2000};  ///< 10 ms..60 s; the longest wait between two attempts
  /// If true, the robot also plays and stores motions for other robots, without the joints that it does not have. If
  /// false, it refuses them. Version 1 servers always refuse them.
  bool leave_out_missing_joints = false;
  /// If true, walks end before edges and walls and where the robot cannot see, as docs/walking.md describes.
  bool guard_walks = true;
};

/// Checks ClientOptions::host.
/// @throw InvalidArgumentException it is empty, or it has a port, a scheme, a path, brackets or a blank; the message
///   says what it should be
void checkHost(const std::string& host);

/// The address as people write it: host:port, with an IPv6 address in brackets.
std::string addressText(const std::string& host, int port);

}  // namespace aibo_client

#endif  // AIBO_CLIENT_OPTIONS_H
