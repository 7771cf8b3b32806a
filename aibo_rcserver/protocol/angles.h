/// @file angles.h
/// The wire's two units of angle: version 1 counts in 0.01 degree, version 2 and OPEN-R in microradian. The same
/// conversions hold for speeds (0.01 degree/s, microradian/s) and accelerations.
#ifndef AIBO_RCSERVER_PROTOCOL_ANGLES_H
#define AIBO_RCSERVER_PROTOCOL_ANGLES_H

namespace protocol {

/// 0.01 degree in microradian, rounded to the nearest, halves away from zero. Every value has one: -32768 (-327.68
/// degrees) is -5719095.
int microradiansFromCentidegrees(short centidegrees);

/// Microradian in 0.01 degree, rounded to the nearest, halves away from zero, and limited to what version 1 can say:
/// below -327.68 degrees it says -327.68, above 327.67 degrees it says 327.67. No angle of a joint comes near that,
/// but some speeds do: the ERS-7's head_pan turns at up to 576 degrees a second, which version 1 reports as 327.67.
///
/// An angle that came from microradiansFromCentidegrees() gives what it was made of.
short centidegreesFromMicroradians(int microradians);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_ANGLES_H
