#include "command_line/link_meter.h"

#include <algorithm>
#include <cstdio>
#include <string>

namespace aibo_driver::command_line {
namespace {

double secondsBetween(LinkMeter::SteadyTime begin, LinkMeter::SteadyTime end) {
  return std::chrono::duration<double>(end - begin).count();
}

}  // namespace

void LinkMeter::add(const Picture& picture, SteadyTime complete) {
  ++current_.pictures;
  current_.bytes += picture.jpeg.size();
  current_.longest_gap = std::max(current_.longest_gap, secondsBetween(last_, complete));
  last_ = complete;
  if (!picture.frame_number || !picture.image_count) {
    return;
  }
  const SteadyTime taken = clock_.timeOf(picture.connection_number, *picture.frame_number, picture.first_byte_time);
  const double age = std::max(0.0, secondsBetween(taken, complete));
  age_sum_ += age;
  current_.worst_age = std::max(current_.worst_age.value_or(0), age);
  if (image_ && connection_ == picture.connection_number) {
    due_ += std::max(1U, (*picture.image_count - *image_) / static_cast<std::uint32_t>(every_nth_image_));
    ++counted_;
  }
  connection_ = picture.connection_number;
  image_ = picture.image_count;
}

LinkMeter::Reading LinkMeter::read(SteadyTime now) {
  Reading reading = current_;
  reading.seconds = secondsBetween(begin_, now);
  reading.longest_gap = std::max(reading.longest_gap, secondsBetween(last_, now));
  if (reading.worst_age) {
    reading.mean_age = age_sum_ / static_cast<double>(reading.pictures);
  }
  if (due_ > 0) {
    reading.loss = 1 - static_cast<double>(counted_) / static_cast<double>(due_);
  }
  begin_ = now;
  current_ = Reading();
  age_sum_ = 0;
  due_ = 0;
  counted_ = 0;
  return reading;
}

std::string wordsOf(const LinkMeter::Reading& reading) {
  char text[160];
  std::snprintf(text, sizeof text, "%5.1f pictures/s %6.1f KB/s", reading.picturesPerSecond(),
                reading.kilobytesPerSecond());
  std::string words = text;
  if (reading.mean_age) {
    std::snprintf(text, sizeof text, "   age %3.0f ms (worst %3.0f)", 1000 * *reading.mean_age,
                  1000 * *reading.worst_age);
    words += text;
  }
  if (reading.loss) {
    std::snprintf(text, sizeof text, "   loss %.1f %%", 100 * *reading.loss);
    words += text;
  }
  return words;
}

Json jsonOf(const LinkMeter::Reading& reading) {
  return Json::object({{"seconds", reading.seconds},
                       {"pictures", reading.pictures},
                       {"bytes", reading.bytes},
                       {"pictures_per_second", reading.picturesPerSecond()},
                       {"age", reading.mean_age},
                       {"worst_age", reading.worst_age},
                       {"loss", reading.loss},
                       {"longest_gap", reading.longest_gap}});
}

}  // namespace aibo_driver::command_line
