#include "support/scripted_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "support/safety_net.h"
#include "support/sockets.h"
#include "support/test_pictures.h"

using host_files::FileDescriptor;
using std::chrono::milliseconds;

namespace test_support {
namespace {

bool readableWithin(int descriptor, milliseconds time) {
  pollfd polled = {descriptor, POLLIN, 0};
  const int count = ::poll(&polled, 1, static_cast<int>(time.count()));
  check(count >= 0, "poll");
  return count > 0;
}

}  // namespace

protocol::BasicGetCommand ScriptedPeer::readCommand() {
  return protocol::decodeCommand(read(protocol::BASIC_COMMAND_SIZE).data());
}

ScriptedPeer::Bytes ScriptedPeer::read(std::size_t size) {
  Bytes bytes;
  while (bytes.size() < size) {
    if (!readableWithin(socket_.get(), kSafetyNet)) {
      throw std::runtime_error("the client has sent nothing");
    }
    Bytes part(size - bytes.size());
    const ssize_t count = ::recv(socket_.get(), part.data(), part.size(), 0);
    if (count <= 0) {
      throw std::runtime_error("the client has closed the connection");
    }
    bytes.insert(bytes.end(), part.begin(), part.begin() + count);
  }
  return bytes;
}

version2_frames::Frame ScriptedPeer::readFrame() {
  const Bytes header = read(protocol::version2::FRAME_HEADER_SIZE);
  version2_frames::Frame frame = {protocol::version2::decodeFrameHeader(header.data()), {}};
  frame.payload = read(frame.header.payload_size);
  return frame;
}

version2_frames::Frame ScriptedPeer::readRequest() {
  const auto end = std::chrono::steady_clock::now() + kSafetyNet;
  while (std::chrono::steady_clock::now() < end) {
    version2_frames::Frame frame = readFrame();
    if (frame.header.kind != protocol::version2::REQUEST_HELLO) {
      return frame;
    }
    send(version2_frames::makeFrame('h', frame.header.request_number, version2_frames::makeHello()));
  }
  throw std::runtime_error("the client has sent nothing but heartbeats");
}

void ScriptedPeer::agreeToVersion2(const std::string& capabilities) {
  const protocol::BasicGetCommand question = readCommand();
  if (question.command != protocol::REQUEST_NEWER_VERSION) {
    throw std::runtime_error("the client has not asked for version 2, but sent " + std::string(1, question.command));
  }
  send({'x', 2, 0, 0});
  const int number = readFrame().header.request_number;
  send(version2_frames::makeFrame('h', number, version2_frames::makeHello(capabilities)));
  for (int i = 0; i < protocol::version2::NUMBER_OF_CAMERA_SETTINGS; ++i) {
    const version2_frames::Frame setting = readFrame();
    camera_ += version2_frames::textOf(setting) + ";";
    Bytes reply = version2_frames::makeFrame('g', setting.header.request_number, setting.payload);
    reply[1] = setting.header.id;
    send(reply);
  }
}

void ScriptedPeer::send(const Bytes& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    // The beginning goes alone, as part of a header.
    const std::size_t part = sent == 0 ? std::min<std::size_t>(bytes.size(), 3) : bytes.size() - sent;
    const ssize_t count = ::send(socket_.get(), bytes.data() + sent, part, MSG_NOSIGNAL);
    check(count >= 0, "send");
    sent += static_cast<std::size_t>(count);
  }
}

void ScriptedPeer::sendPicture(const Bytes& jpeg) {
  send(test_pictures::makeReply(jpeg));
}

void ScriptedPeer::reset() {
  resetWhenClosed(socket_);
  socket_.close();
}

void ScriptedPeer::waitUntilClosed() {
  char ignored[256];
  do {
    if (!readableWithin(socket_.get(), kSafetyNet)) {
      throw std::runtime_error("the client has not closed the connection");
    }
  } while (::recv(socket_.get(), ignored, sizeof ignored, 0) > 0);
}

ScriptedServer::ScriptedServer(Begin begin) {
  bind();
  if (begin == Begin::kListening) {
    listen();
  }
}

void ScriptedServer::bind() {
  socket_ = FileDescriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  check(socket_.valid(), "socket");
  bindSocket(socket_, "127.0.0.1", port_);
  port_ = portOf(socket_);
}

void ScriptedServer::listen(int backlog) {
  if (!std::exchange(listening_, true)) {
    check(::listen(socket_.get(), backlog) == 0, "listen");
  }
}

void ScriptedServer::limitReceiveBuffer() {
  const int size = 4096;
  check(::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &size, sizeof size) == 0, "SO_RCVBUF");
}

void ScriptedServer::vanish() {
  socket_.close();
  listening_ = false;
  bind();
}

ScriptedPeer ScriptedServer::accept() {
  if (!readableWithin(socket_.get(), kSafetyNet)) {
    throw std::runtime_error("no client has come");
  }
  FileDescriptor socket(::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  check(socket.valid(), "accept");
  const int yes = 1;
  check(::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes) == 0, "TCP_NODELAY");
  return ScriptedPeer(std::move(socket));
}

bool ScriptedServer::clientComesWithin(milliseconds time) {
  if (!readableWithin(socket_.get(), time)) {
    return false;
  }
  accept();
  return true;
}

}  // namespace test_support
