#include "tools/picture_figures.h"

#include <cstdio>

namespace aibo_driver::tools {

std::string PictureFigures::words(std::chrono::duration<double> time) const {
  const auto pictures = static_cast<double>(pictures_);
  char words[128];
  std::snprintf(words, sizeof words, "%5.1f pictures/s %6.1f KB/s   stamp to topic: %.1f ms (worst %.1f)",
                pictures / time.count(), static_cast<double>(bytes_) / 1000 / time.count(),
                latencies_.count() / pictures, worst_.count());
  return words;
}

}  // namespace aibo_driver::tools
