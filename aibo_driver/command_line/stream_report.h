/// @file stream_report.h
#ifndef AIBO_DRIVER_COMMAND_LINE_STREAM_REPORT_H
#define AIBO_DRIVER_COMMAND_LINE_STREAM_REPORT_H

#include <string>

#include "camera/link_meter.h"
#include "command_line/json.h"

namespace aibo_driver::command_line {

/// Describes a reading in one line: pictures a second, data rate, age, loss.
std::string wordsOf(const camera::LinkMeter::Reading& reading);

Json jsonOf(const camera::LinkMeter::Reading& reading);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_STREAM_REPORT_H
