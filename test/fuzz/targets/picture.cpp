// A picture on its way through the driver: any bytes.
#include <string>

#include "aibo_driver/jpeg_inspector.h"
#include "fuzz_input.h"
#include "ros/camera/jpeg_decoder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const aibo_driver::JpegInspection inspection = aibo_driver::inspectJpeg(data, size);
  require(!inspection.good() || (inspection.width <= 416 && inspection.height <= 320), "no camera makes larger ones");
  try {
    const aibo_driver::node::BgrImage image = aibo_driver::node::decodeJpeg(data, size);
    require(inspection.good(), "only what was found good is decoded");
    require(image.width == inspection.width && image.height == inspection.height, "an image has the size announced");
    require(image.pixels.size() == std::size_t{3} * std::size_t(image.width) * std::size_t(image.height),
            "an image has all of its pixels");
  } catch (const aibo_driver::node::DecodeException& error) {
    require(!std::string(error.what()).empty(), "who refuses says why");
  }
  return 0;
}
