#include "camera/jpeg_decoder.h"

#include <turbojpeg.h>

#include <string>

#include "aibo_client/jpeg_inspector.h"

namespace aibo_driver::camera {
namespace {

constexpr int kBytesPerPixel = 3;

// libjpeg-turbo 2.0 cannot limit scans yet, but inspectJpeg() lets only single scans through anyway.
#ifdef TJFLAG_LIMITSCANS
constexpr int kFlags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
#else
constexpr int kFlags = TJFLAG_STOPONWARNING;
#endif

// A decompressor is for one picture only. It keeps its tables, so it would decode a picture without tables with the
// tables of the last picture.
class Decompressor {
 public:
  Decompressor() : handle_(tjInitDecompress()) {
    if (handle_ == nullptr) {
      throw DecodeException(std::string("cannot make a JPEG decoder: ") + tjGetErrorStr2(nullptr));
    }
  }
  ~Decompressor() { tjDestroy(handle_); }

  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;

  tjhandle get() const { return handle_; }

 private:
  tjhandle handle_;
};

}  // namespace

BgrImage decodeJpeg(const std::uint8_t* jpeg, std::size_t size) {
  const aibo_client::JpegInspection inspection = aibo_client::inspectJpeg(jpeg, size);
  if (!inspection.good()) {
    throw DecodeException(inspection.problem);
  }
  BgrImage image;
  image.width = inspection.width;
  image.height = inspection.height;
  image.pixels.resize(static_cast<std::size_t>(kBytesPerPixel) * static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height));
  const Decompressor decompressor;
  if (tjDecompress2(decompressor.get(), jpeg, static_cast<unsigned long>(size), image.pixels.data(), image.width,
                    image.width * kBytesPerPixel, image.height, TJPF_BGR, kFlags) != 0) {
    throw DecodeException(std::string("the compressed data is damaged: ") + tjGetErrorStr2(decompressor.get()));
  }
  return image;
}

}  // namespace aibo_driver::camera
