// The inspector and the decoder of pictures: any bytes.
#include <string>

#include "aibo_client/jpeg_inspector.h"
#include "camera/jpeg_decoder.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const aibo_client::JpegInspection inspection = aibo_client::inspectJpeg(data, size);
  require(!inspection.good() || (inspection.width <= 416 && inspection.height <= 320),
          "a good picture is not larger than a camera makes it");
  try {
    const aibo_driver::camera::BgrImage image = aibo_driver::camera::decodeJpeg(data, size);
    require(inspection.good(), "only good pictures are decoded");
    require(image.width == inspection.width && image.height == inspection.height, "an image has the announced size");
    require(image.pixels.size() == std::size_t{3} * std::size_t(image.width) * std::size_t(image.height),
            "an image has all pixels");
  } catch (const aibo_driver::camera::DecodeException& error) {
    require(!std::string(error.what()).empty(), "an error has a text");
  }
  return 0;
}
