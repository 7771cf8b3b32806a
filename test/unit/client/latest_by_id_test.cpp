#include "client/latest_by_id.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "aibo_driver/leds.h"

using namespace aibo_driver;

namespace {

std::string takeAll(LatestById<LedCommand> leds) {
  std::string taken;
  while (!leds.empty()) {
    const LedCommand led = leds.take(1).front();
    taken += std::to_string(led.id) + ":" + std::to_string(led.intensity) + " ";
  }
  return taken;
}

TEST(LatestByIdTest, TheLatestWinsAndTakesThePlaceOfTheOldest) {
  LatestById<LedCommand> leds;
  leds.add({{5, 10}, {6, 20}});
  leds.add({{7, 30}, {5, 40}});
  EXPECT_EQ("5:40 6:20 7:30 ", takeAll(leds));
}

TEST(LatestByIdTest, NoMoreAreTakenThanThereAre) {
  LatestById<LedCommand> leds;
  leds.add({{5, 10}, {6, 20}, {7, 30}});
  EXPECT_EQ(2u, leds.take(2).size());
  EXPECT_EQ(1u, leds.take(2).size());
  EXPECT_TRUE(leds.empty());
}

}  // namespace
