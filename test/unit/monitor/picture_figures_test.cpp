#include "tools/picture_figures.h"

#include <gtest/gtest.h>

namespace aibo_driver::tools {
namespace {

TEST(PictureFigures, AreMeansOfAllPictures) {
  PictureFigures figures;
  EXPECT_TRUE(figures.empty());
  figures.add(20'000, std::chrono::milliseconds(30));
  figures.add(70'000, std::chrono::milliseconds(250));
  figures.add(5'000, std::chrono::microseconds(-2'400));  // the clocks differ
  EXPECT_FALSE(figures.empty());
  EXPECT_EQ(figures.words(std::chrono::milliseconds(2'500)),
            "  1.2 pictures/s   38.0 KB/s   stamp to topic: 92.5 ms (worst 250.0)");
}

}  // namespace
}  // namespace aibo_driver::tools
