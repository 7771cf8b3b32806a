// The client's parser of version 1: any bytes in any pieces.
#include "client/reply_parser.h"

#include "client/fault.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using Result = aibo_client::ReplyParser::Result;
  PiecewiseInput input(data, size);
  aibo_client::ReplyParser parser;
  try {
    while (!input.empty()) {
      const Bytes piece = input.takePiece();
      std::size_t taken = 0;
      for (std::size_t at = 0; at < piece.size(); at += taken) {
        const Result result = parser.append(piece.data() + at, piece.size() - at, {}, &taken);
        require(taken > 0, "the reader goes on");
        if (result == Result::kPicture) {
          const Bytes jpeg = parser.takeJpeg();
          require(!jpeg.empty() && jpeg.size() <= protocol::MAX_PICTURE_SIZE, "a picture has a possible size");
        } else if (result == Result::kValue) {
          require(protocol::isValueReply(parser.value().letter), "a value reply is one");
        }
      }
    }
  } catch (const aibo_client::ProtocolException&) {
  }
  return 0;
}
