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

/// Opens the joint, sensor, LED or camera at a locator of the Model Information, such as
/// "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1".
/// @return oNOT_FOUND if the robot has none there
OStatus OpenPrimitive(const char* locator, OPrimitiveID* primitiveID);

/// @return oINVALID_PRIMITIVE_ID if it is not open
OStatus ClosePrimitive(OPrimitiveID primitiveID);

/// Sends a request to an opened primitive (OPrimitiveControl.h).
/// @param param, paramSize argument of the request; 0, 0 if it has none
/// @param result, resultSize where its result goes; 0, 0 if it has none
/// @return oINVALID_PRIMITIVE_ID if it is not open, oINVALID_ARG if it does not know the request or argument
OStatus ControlPrimitive(OPrimitiveID primitiveID, OPrimitiveRequest request, void* param, size_t paramSize,
                         void* result, size_t resultSize);

/// Allocates a command vector with room for this many entries (maxNumData), each with a dataOffset of its own. At first
/// it has no entries (numData).
/// @param[out] memID for creating an RCRegion: RCRegion(memID, vectorInfo.offset, vector, vectorInfo.totalSize)
/// @return oNO_MEMORY if the count is 0, or larger than any robot's number of effectors
OStatus NewCommandVectorData(size_t count, MemoryRegionID* memID, OCommandVectorData** vector);

/// Frees it; only after its RCRegion is free.
/// @return oFAIL if nothing has this number
OStatus DeleteCommandVectorData(MemoryRegionID memID);

/// Allocates memory for tables of the colour detection. At first it has no tables (numData).
OStatus NewCdtVectorData(MemoryRegionID* memID, OCdtVectorData** vector);

/// Frees it.
/// @return oFAIL if nothing has this number
OStatus DeleteCdtVectorData(MemoryRegionID memID);

/// Passes the tables to the camera, which copies them. Channels that have no table here keep theirs.
/// @return oINVALID_ARG for a channel that the camera does not have, oINVALID_PRIMITIVE_ID for a primitive that is not
/// an
///         open camera, oINVALID_DATA_TYPE if this is not an OCdtVectorData, oFAIL if nothing has this number; then
///         no table changes
OStatus SetCdtVectorData(MemoryRegionID memID);

/// @name Keys that make motions, lights and sounds start together (ODataVectorInfo::syncKey)
/// On Linux there are none, and every vector starts when it arrives.
/// @{

/// @return oNO_SYNC_KEY if there is none left
OStatus NewSyncKey(OVRSyncKey* key);
/// @return oINVALID_SYNC_KEY if this is not a key
OStatus CancelSyncKey(OVRSyncKey key);
/// Splits a key into two.
/// @return oINVALID_SYNC_KEY if this is not a key
OStatus DivideSyncKey(OVRSyncKey key, OVRSyncKey* key1, OVRSyncKey* key2);
/// @}

/// @name Joints
/// Except when reading, `primitiveID` may be oprimitiveID_UNDEF, which means all open joints.
/// @return oINVALID_PRIMITIVE_ID if it is not open or not a joint
/// @{

/// Gains of the servo, each with its shift (Level2 Reference Guide, page 71).
/// @return oGAIN_DISABLED, and no gain is set, unless EnableJointGain() was called before
OStatus SetJointGain(OPrimitiveID primitiveID, word pg, word ig, word dg, word ps, word is, word ds);

/// Makes the joint's gain effective; it is 0 until SetJointGain() is called (page 70). The servo then pulls the joint
/// to its last commanded position, so command the present position first.
/// @return oALERT_JOINT_UNCONTROLLABLE if its potentiometer is broken
OStatus EnableJointGain(OPrimitiveID primitiveID);

/// Makes the joint's gain 0 and ineffective (page 70): the joint can be moved by hand.
OStatus DisableJointGain(OPrimitiveID primitiveID);

/// Reads the joint.
OStatus GetJointValue(OPrimitiveID primitiveID, OJointValue* value);
/// @}

/// Reads a sensor.
/// @return oINVALID_PRIMITIVE_ID if it is not open or not a sensor
OStatus GetSensorValue(OPrimitiveID primitiveID, OSensorValue* value);

/// Switches the power of all motors. It is off when the robot boots; without it no gain has an effect.
OStatus SetMotorPower(OPower power);

/// Reads the state of battery, motor power and power supply.
OStatus GetPowerStatus(OPowerStatus* status);

/// Calls an `Extra` entry with an OPowerStatusMessage (OPENRMessages.h) whenever the power status changes as asked,
/// until UnobservePowerStatus() (page 79).
/// @param notifyStatus the bits of robotStatus and batteryStatus to watch for any change; for remainingCapacity,
///        temperature, timeDif and volume the value to watch for, or one of the opso constants in OPower.h.
///        fullyChargedCapacity, voltage and current are ignored
/// @param entry Extra_Entry[entryNAME] of the object that calls
/// @return oINVALID_ARG if there is no such entry
OStatus ObservePowerStatus(const OPowerStatus& notifyStatus, const OServiceEntry& entry);

/// @return oINVALID_ARG if the entry observes nothing
OStatus UnobservePowerStatus(const OServiceEntry& entry);

/// Tells whether there is a memory stick, and whether it can be written (Level2 Reference Guide, page 81).
OStatus GetMemoryStickStatus(OMemoryStickStatus* status);

/// Stops all objects and switches the robot off, soon after the calling entry point has returned.
/// @param condition when to boot again: with obcbBOOT_TIMER after bootTime seconds, otherwise when the robot is
/// touched.
///        Linux supports only 0 seconds, which boots again at once, or never
/// @return oINVALID_ARG, and the robot stays on, if `condition` asks for another time on Linux
OStatus Shutdown(const OBootCondition& condition);

/// Loads a file of the memory stick into memory, by its keyword in DESIGNDB.CFG.
/// @param[out] data, size the file's content; it stays there until DeleteDesignData()
/// @return oNOT_FOUND if DESIGNDB.CFG has no such keyword or the file is missing, oDESIGNDATA_SIZE_ZERO if it is empty
OStatus FindDesignData(const char* keyword, ODesignDataID* dataID, byte** data, size_t* size);

/// @return oINVALID_ARG if nothing has this number
OStatus DeleteDesignData(ODesignDataID dataID);

/// Name of the robot's model, "ERS-7" or "ERS-210".
/// @param[out] design at least orobotdesignNAME_MAX + 1 characters
OStatus GetRobotDesign(char* design);

}  // namespace OPENR

#endif  // OPENR_OPENRAPI_H
