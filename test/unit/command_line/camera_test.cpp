#include "command_line/commands/commands.h"

#include <gmock/gmock.h>

namespace aibo_driver::command_line {
namespace {

TEST(StreamReport, ALineHasEachFigureInItsUnit) {
  camera::LinkMeter::Reading reading;
  reading.seconds = 2;
  reading.pictures = 50;
  reading.bytes = 600000;
  reading.mean_age = 0.012;
  reading.worst_age = 0.345;
  reading.loss = 0.034;
  reading.longest_gap = 0.078;
  EXPECT_EQ(wordsOf(reading), " 25.0 pictures/s  300.0 KB/s   age  12 ms (worst 345)   loss 3.4 %");
  EXPECT_EQ(jsonOf(reading).text(),
            R"({"seconds": 2, "pictures": 50, "bytes": 600000, "pictures_per_second": 25, "age": 0.012, )"
            R"("worst_age": 0.345, "loss": 0.034, "longest_gap": 0.078})");
}

TEST(StreamReport, LeavesOutWhatIsNotKnown) {
  EXPECT_THAT(jsonOf({}).text(), ::testing::HasSubstr("\"age\": null"));
  EXPECT_EQ(wordsOf({}), "  0.0 pictures/s    0.0 KB/s");
}

}  // namespace
}  // namespace aibo_driver::command_line
