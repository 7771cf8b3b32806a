// Encodes pictures of the simulated camera, to count instructions.
//
//   encode_pictures QUALITY LAYER ROUNDS    encodes each of eight images ROUNDS times; LAYER 0 is 208x160, 1 is 104x80
#include <OPENR/OFbkImage.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "picture_encoder/JpegEncoder.h"
#include "simulator/ers7/camera/camera.h"
#include "simulator/ers7/camera/scene_view.h"

namespace {

using simulated_ers7::Camera;

constexpr longword kFramesApart = 60;  // half a second: the scene has moved
constexpr int kImages = 8;

CameraImage planesOf(OFbkImageVectorData* images, OFbkImageLayer layer) {
  const auto band = [&](OFbkImageBand which) {
    return OFbkImage(images->GetInfo(layer), images->GetData(layer), which);
  };
  OFbkImage y = band(ofbkimageBAND_Y);
  return {y.Pointer(),
          band(ofbkimageBAND_Cr).Pointer(),
          band(ofbkimageBAND_Cb).Pointer(),
          static_cast<size_t>(y.Width()),
          static_cast<size_t>(y.Height()),
          static_cast<size_t>(y.Width() + y.Skip())};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "encode_pictures QUALITY LAYER ROUNDS\n");
    return 2;
  }
  const int quality = std::atoi(argv[1]);
  const auto layer = static_cast<OFbkImageLayer>(std::atoi(argv[2]));
  const int rounds = std::atoi(argv[3]);

  simulated_ers7::Scene scene;
  simulated_ers7::SceneView view(scene, 1);
  Camera camera(view, 0);
  JpegEncoder encoder;
  std::vector<CameraImage> images;
  for (int i = 0; i < kImages; ++i) {
    RCRegion* region = camera.capture(kFramesApart * static_cast<longword>(i));
    region->AddReference();
    void* base = region->Base();
    images.push_back(planesOf(static_cast<OFbkImageVectorData*>(base), layer));
  }
  std::vector<unsigned char> jpeg(JpegEncoder::WorstCaseSize(images[0].width, images[0].height));
  std::size_t bytes = 0;
  for (int round = 0; round < rounds; ++round) {
    for (const CameraImage& image : images) {
      bytes += encoder.Encode(image, quality, jpeg.data(), jpeg.size());
    }
  }
  std::printf("%zu bytes per picture\n", bytes / static_cast<std::size_t>(rounds * kImages));
  return 0;
}
