/// @file OPENRAPI.h
/// Calls from an object to the robot.
#ifndef OPENR_OPENRAPI_H
#define OPENR_OPENRAPI_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/OPENRMessages.h>
#include <OPENR/OPower.h>
#include <OPENR/OPrimitiveControl.h>

namespace OPENR {

/// @param locator from the Model Information: "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1"
/// @return oNOT_FOUND if the robot has no primitive there
OStatus OpenPrimitive(const char* locator, OPrimitiveID* primitiveID);

/// @return oINVALID_PRIMITIVE_ID if the primitive is not open
OStatus ClosePrimitive(OPrimitiveID primitiveID);

/// Sends a request to an open primitive (OPrimitiveControl.h).
/// @param param, paramSize the argument; 0, 0 if there is none
/// @param result, resultSize room for the result; 0, 0 if there is none
/// @return oINVALID_PRIMITIVE_ID if it is not open, oINVALID_ARG if the request or argument is unknown
OStatus ControlPrimitive(OPrimitiveID primitiveID, OPrimitiveRequest request, void* param, size_t paramSize,
                         void* result, size_t resultSize);

/// Allocates a command vector with room for this many entries (maxNumData), each with its own dataOffset. It begins
/// without entries (numData).
/// @param[out] memID for RCRegion(memID, vectorInfo.offset, vector, vectorInfo.totalSize)
/// @return oNO_MEMORY if the count is 0 or larger than any robot's number of effectors
OStatus NewCommandVectorData(size_t count, MemoryRegionID* memID, OCommandVectorData** vector);

/// Frees a command vector, whose RCRegion must be free.
/// @return oFAIL if no command vector has this number
OStatus DeleteCommandVectorData(MemoryRegionID memID);

/// Allocates a sound vector with room for this many sounds of `dataSize` bytes each. It begins without sounds.
/// @param[out] memID as for NewCommandVectorData()
/// @return oNO_MEMORY if there is no room for any sound, or more than a speaker can play
OStatus NewSoundVectorData(size_t numSounds, size_t dataSize, MemoryRegionID* memID, OSoundVectorData** baseAddr);

/// Frees a sound vector. Its RCRegion must be free before.
/// @return oINVALID_ARG if no sound vector has this number
OStatus DeleteSoundVectorData(MemoryRegionID memID);

/// Allocates memory for tables of the colour detection. It begins without tables (numData).
OStatus NewCdtVectorData(MemoryRegionID* memID, OCdtVectorData** vector);

/// @return oFAIL if no colour tables have this number
OStatus DeleteCdtVectorData(MemoryRegionID memID);

/// Copies the tables to the camera. Channels without a table here keep theirs.
/// @return oINVALID_ARG if the camera lacks a channel, oINVALID_PRIMITIVE_ID if the primitive is not an open camera,
///   oINVALID_DATA_TYPE if this is not an OCdtVectorData, oFAIL if nothing has this number. After an error, no table
///   has changed
OStatus SetCdtVectorData(MemoryRegionID memID);

/// Keys that make motions, lights and sounds start together (ODataVectorInfo::syncKey). Linux has no keys: every vector
/// starts when it arrives.

/// @return oNO_SYNC_KEY if no key is left
OStatus NewSyncKey(OVRSyncKey* key);
/// @return oINVALID_SYNC_KEY if this is not a key
OStatus DivideSyncKey(OVRSyncKey key, OVRSyncKey* key1, OVRSyncKey* key2);

/// Joints. Except when reading, oprimitiveID_UNDEF means all open joints. The result is oINVALID_PRIMITIVE_ID if the
/// primitive is not open or no joint.

/// Sets the servo's gains with their shifts (Level2 Reference Guide, page 71).
/// @return oGAIN_DISABLED, and no gain is set, before EnableJointGain()
OStatus SetJointGain(OPrimitiveID primitiveID, word pg, word ig, word dg, word ps, word is, word ds);

/// Sets the servo's standard gains (page 72; Model Information, "PID gains").
/// @return as SetJointGain()
OStatus SetDefaultJointGain(OPrimitiveID primitiveID);

/// Makes the gain effective; it is 0 until SetJointGain() (page 70). The servo then pulls the joint to its last
/// commanded position, so command the present position first.
/// @return oALERT_JOINT_UNCONTROLLABLE if the potentiometer is broken
OStatus EnableJointGain(OPrimitiveID primitiveID);

/// Makes the gain 0 and ineffective (page 70). The joint can then be moved by hand.
OStatus DisableJointGain(OPrimitiveID primitiveID);

OStatus GetJointValue(OPrimitiveID primitiveID, OJointValue* value);

/// @return oINVALID_PRIMITIVE_ID if the primitive is not open or no sensor
OStatus GetSensorValue(OPrimitiveID primitiveID, OSensorValue* value);

/// Switches the power of all motors, which is off when the robot boots. Without power, gains have no effect.
OStatus SetMotorPower(OPower power);

/// Battery, motor power and power supply.
OStatus GetPowerStatus(OPowerStatus* status);

/// Calls an `Extra` entry with an OPowerStatusMessage (OPENRMessages.h) at certain changes of the power status, until
/// UnobservePowerStatus() (page 79).
/// @param notifyStatus the bits of robotStatus and batteryStatus to watch. In remainingCapacity, temperature, timeDif
///   and volume: the value to watch for, or an opso constant of OPower.h. Other members are ignored
/// @param entry Extra_Entry[entryNAME] of the calling object
/// @return oINVALID_ARG if there is no such entry
OStatus ObservePowerStatus(const OPowerStatus& notifyStatus, const OServiceEntry& entry);

/// @return oINVALID_ARG if the entry observes nothing
OStatus UnobservePowerStatus(const OServiceEntry& entry);

/// The switch with which the owner sets the volume (Level2 Reference Guide, page 84).
OStatus GetVolumeSwitch(OVolumeSwitch* volSW);

/// Whether there is a memory stick, and whether it can be written (Level2 Reference Guide, page 81).
OStatus GetMemoryStickStatus(OMemoryStickStatus* status);

/// Stops all objects and switches the robot off, soon after the calling entry point returns.
/// @param condition when to boot again: with obcbBOOT_TIMER after bootTime seconds, otherwise when the robot is
///   touched. Linux supports only 0 seconds (at once) or never
/// @return oINVALID_ARG, and the robot stays on, for another time on Linux
OStatus Shutdown(const OBootCondition& condition);

/// Loads a file by its keyword in DESIGNDB.CFG.
/// @param[out] data, size the content, until DeleteDesignData()
/// @return oNOT_FOUND without such a keyword or file, oDESIGNDATA_SIZE_ZERO if the file is empty
OStatus FindDesignData(const char* keyword, ODesignDataID* dataID, byte** data, size_t* size);

/// @return oINVALID_ARG if no file has this number
OStatus DeleteDesignData(ODesignDataID dataID);

/// @param[out] design "ERS-7" or "ERS-210"; room for orobotdesignNAME_MAX + 1 characters
OStatus GetRobotDesign(char* design);

}  // namespace OPENR

#endif  // OPENR_OPENRAPI_H
