#include "command_line/stream_report.h"

#include <cstdio>

namespace aibo_driver::command_line {

std::string wordsOf(const camera::LinkMeter::Reading& reading) {
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

Json jsonOf(const camera::LinkMeter::Reading& reading) {
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
