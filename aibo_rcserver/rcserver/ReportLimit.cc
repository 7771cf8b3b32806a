#include "rcserver/ReportLimit.h"

#include <OPENR/OSyslog.h>

namespace {

const longword PERIOD = 125;  // frames of 8 ms

}  // namespace

const unsigned ReportLimit::BURST;

bool ReportLimit::Admits(longword now) {
  const longword periods = (now - refilled_) / PERIOD;
  if (allowed_ + periods >= BURST) {
    allowed_ = BURST;
    refilled_ = now;
  } else {
    allowed_ += periods;
    refilled_ += periods * PERIOD;
  }
  if (allowed_ == 0) {
    ++left_out_;
    return false;
  }
  --allowed_;
  if (left_out_ > 0) {
    OSYSPRINT(("RCServer: %u lines about clients were left out\n", left_out_));
    left_out_ = 0;
  }
  return true;
}
