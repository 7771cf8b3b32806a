// The server's reader of version 1: any bytes in any pieces.
#include "protocol/request_reader.h"

#include <cstring>

#include "fuzz_input.h"

using protocol::RequestReader;

namespace {

void check(const protocol::Request& request) {
  require(request.payload_size <= sizeof(request.payload), "a payload fits");
  if (request.valid && request.payload_size == sizeof(request.payload)) {
    const protocol::FileRequest file = protocol::decodeFileRequest(request.payload);
    protocol::MotionName name;
    protocol::readMotionName(file.name, std::strlen(file.name), name);
  }
}

// Takes some of the content, and leaves the rest for next() to skip.
void takeContent(RequestReader& reader) {
  Bytes content(reader.contentLeft() % 64);
  while (!content.empty() && reader.contentLeft() > 0) {
    const std::size_t left = reader.contentLeft();
    const std::size_t taken = reader.takeContent(content.data(), content.size());
    require(reader.contentLeft() + taken == left, "content is counted");
    if (taken == 0) {
      return;
    }
  }
}

std::size_t takeRequests(RequestReader& reader) {
  protocol::Request request;
  std::size_t requests = 0;
  while (reader.next(&request)) {
    check(request);
    takeContent(reader);
    ++requests;
  }
  return requests;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  PiecewiseInput input(data, size);
  RequestReader reader;
  while (!input.empty()) {
    Bytes piece = input.takePiece();
    piece.resize(std::min(piece.size(), RequestReader::MAX_APPENDED));
    require(reader.append(piece.data(), piece.size()) == piece.size(), "there is room for the bytes");
    require(takeRequests(reader) <= RequestReader::MAX_WAITING / protocol::BASIC_COMMAND_SIZE,
            "there are no more requests than fit");
  }
  return 0;
}
