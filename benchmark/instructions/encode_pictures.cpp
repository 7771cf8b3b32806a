// Encodes pictures of the simulated camera, to count instructions.
//
//   encode_pictures QUALITY LAYER ROUNDS    encodes each of eight images ROUNDS times; LAYER 0 is 208x160, 1 is 104x80,
//                                           2 is 52x40, 3 is 416x320 (double resolution)
#include <OPENR/OFbkImage.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "picture_encoder/JpegEncoder.h"
#include "picture_encoder/PictureJob.h"
#include "simulator/ers7/camera/camera.h"
#include "simulator/ers7/camera/scene_view.h"

namespace {

using simulated_ers7::Camera;

constexpr longword kFramesApart = 60;  // half a second: the scene has moved
constexpr int kImages = 8;
constexpr int kDouble = 3;

OFbkImage bandOf(OFbkImageVectorData* images, OFbkImageLayer layer, OFbkImageBand band) {
  return OFbkImage(images->GetInfo(layer), images->GetData(layer), band);
}

CameraImage planesOf(OFbkImageVectorData* images, OFbkImageLayer layer) {
  const OFbkImage y = bandOf(images, layer, ofbkimageBAND_Y);
  return {y.Pointer(),
          bandOf(images, layer, ofbkimageBAND_Cr).Pointer(),
          bandOf(images, layer, ofbkimageBAND_Cb).Pointer(),
          static_cast<size_t>(y.Width()),
          static_cast<size_t>(y.Height()),
          static_cast<size_t>(y.Width() + y.Skip())};
}

DetailBands detailOf(OFbkImageVectorData* images) {
  return {bandOf(images, ofbkimageLAYER_H, ofbkimageBAND_Y_LH).Pointer(),
          bandOf(images, ofbkimageLAYER_H, ofbkimageBAND_Y_HL).Pointer(),
          bandOf(images, ofbkimageLAYER_H, ofbkimageBAND_Y_HH).Pointer()};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "encode_pictures QUALITY LAYER ROUNDS\n");
    return 2;
  }
  const int quality = std::atoi(argv[1]);
  const bool is_double = std::atoi(argv[2]) == kDouble;
  const auto layer = static_cast<OFbkImageLayer>(is_double ? 0 : std::atoi(argv[2]));
  const int rounds = std::atoi(argv[3]);

  simulated_ers7::Scene scene;
  simulated_ers7::SceneView view(scene, 1);
  Camera camera(view, 0);
  JpegEncoder encoder;
  std::vector<CameraImage> images;
  std::vector<DetailBands> details;
  for (int i = 0; i < kImages; ++i) {
    RCRegion* region = camera.capture(kFramesApart * static_cast<longword>(i));
    region->AddReference();
    void* base = region->Base();
    images.push_back(planesOf(static_cast<OFbkImageVectorData*>(base), layer));
    details.push_back(detailOf(static_cast<OFbkImageVectorData*>(base)));
  }
  std::vector<unsigned char> jpeg(ENCODED_PICTURE_CAPACITY);
  std::size_t bytes = 0;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      bytes += is_double ? encoder.EncodeDouble(images[i], details[i], quality, jpeg.data(), jpeg.size())
                         : encoder.Encode(images[i], quality, jpeg.data(), jpeg.size());
    }
  }
  std::printf("%zu bytes per picture\n", bytes / static_cast<std::size_t>(rounds * kImages));
  return 0;
}
