/// @file OPENRAPI.h
/// Calls from an object to the robot.
#ifndef OPENR_OPENRAPI_H
#define OPENR_OPENRAPI_H

#include <OPENR/OPENR.h>
#include <OPENR/OPrimitiveControl.h>

/// Characters that GetRobotDesign() may write, the closing 0 included.
const size_t orobotdesignNAME_MAX = 128;

namespace OPENR {

/// Opens the joint, sensor, LED or camera at a locator of the Model Information, such as
/// "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1".
/// @return oNOT_FOUND if the robot has none there
OStatus OpenPrimitive(const char* locator, OPrimitiveID* primitiveID);

/// @return oINVALID_PRIMITIVE_ID if it is not open
OStatus ClosePrimitive(OPrimitiveID primitiveID);

/// Asks something of an opened primitive (OPrimitiveControl.h).
/// @param param, paramSize argument of the request; 0, 0 if it has none
/// @param result, resultSize where its result goes; 0, 0 if it has none
/// @return oINVALID_PRIMITIVE_ID if it is not open, oINVALID_ARG if request or argument is unknown to it
OStatus ControlPrimitive(OPrimitiveID primitiveID, OPrimitiveRequest request, void* param, size_t paramSize,
                         void* result, size_t resultSize);

/// Name of the robot's model, "ERS-7" or "ERS-210".
/// @param[out] design at least orobotdesignNAME_MAX characters
OStatus GetRobotDesign(char* design);

}  // namespace OPENR

#endif  // OPENR_OPENRAPI_H
