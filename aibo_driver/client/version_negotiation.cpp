#include "client/version_negotiation.h"

#include "protocol/version2.h"

namespace aibo_client {

VersionNegotiation::Bytes VersionNegotiation::request() {
  Bytes bytes(protocol::BASIC_COMMAND_SIZE);
  protocol::encodeCommand(protocol::version2::versionRequest(), bytes.data());
  return bytes;
}

void VersionNegotiation::bytesArrived(const std::uint8_t* data, std::size_t size) {
  bytes_.insert(bytes_.end(), data, data + size);
  if (!bytes_.empty()) {
    judge();
  }
}

void VersionNegotiation::judge() {
  const char letter = static_cast<char>(bytes_.front());
  if (letter != protocol::version2::versionReply().letter && letter != protocol::REPLY_ERROR) {
    // The bytes are no answer to `X`, so they are left for the session to parse.
    result_ = Result::kVersion1Unanswered;
    return;
  }
  if (bytes_.size() < protocol::VALUE_REPLY_SIZE) {
    return;
  }
  const bool agrees = protocol::version2::agreesToVersion2(protocol::decodeValueReply(bytes_.data()));
  result_ = agrees ? Result::kVersion2 : Result::kVersion1;
  bytes_.erase(bytes_.begin(), bytes_.begin() + protocol::VALUE_REPLY_SIZE);
}

void VersionNegotiation::checkDeadline(TimePoint now) {
  if (result_ == Result::kOpen && now >= deadline_) {
    result_ = Result::kVersion1Unanswered;
  }
}

}  // namespace aibo_client
