// The client's parser of version 1: any bytes in any pieces.
#include "client/reply_parser.h"

#include "aibo_driver/exceptions.h"
#include "fuzz_input.h"

namespace {

class Checker final : public aibo_driver::ReplyHandler {
 public:
  void onPicture(Bytes jpeg, TimePoint) override {
    require(!jpeg.empty() && jpeg.size() <= protocol::MAX_PICTURE_SIZE, "a picture has a possible size");
  }
  void onValueReply(const protocol::ValueReply& reply, TimePoint) override {
    require(protocol::isValueReply(reply.letter), "a value reply is one");
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  PiecewiseInput input(data, size);
  aibo_driver::ReplyParser parser;
  Checker checker;
  try {
    while (!input.empty()) {
      const Bytes piece = input.takePiece();
      parser.feed(piece.data(), piece.size(), {}, checker);
    }
  } catch (const aibo_driver::ProtocolException&) {
  }
  return 0;
}
