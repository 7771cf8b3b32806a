#include "simulator/ers7/body/battery.h"

#include <algorithm>
#include <cmath>

#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

constexpr double kEmptyVoltage = 6.8;
constexpr double kFullVoltage = 8.2;
constexpr double kZeroCelsius = 273.15;  ///< in kelvin

word rounded(double value) {
  return static_cast<word>(std::lround(value));
}

}  // namespace

void Battery::passFrame() {
  charge_ = std::max(0.0, charge_ - openr_host::kFrameSeconds / (60 * minutes_));
  temperature_ += (kLastTemperature - temperature_) * openr_host::kFrameSeconds / kSecondsToWarmUp;
}

OPowerStatus Battery::status() const {
  OPowerStatus status;
  const bool is_low = charge_ <= kLowCharge;
  status.robotStatus = orsbBATTERY_CONNECTED | (is_low ? orsbBATTERY_CAPACITY_LOW : 0);
  status.batteryStatus =
      static_cast<word>(obsbINITIALIZED | obsbDISCHARGING | (is_low ? obsbREMAINING_CAPACITY_ALARM : 0) |
                        (charge_ == 0 ? obsbFULLY_DISCHARGED : 0));
  status.remainingCapacity = rounded(100 * charge_);
  status.temperature = rounded(10 * (temperature_ + kZeroCelsius));
  status.fullyChargedCapacity = kCapacity;
  status.voltage = rounded(1000 * (kEmptyVoltage + charge_ * (kFullVoltage - kEmptyVoltage)));
  status.current = static_cast<sword>(-std::min(60 * kCapacity / minutes_, 32767.0));
  return status;
}

}  // namespace simulated_ers7
