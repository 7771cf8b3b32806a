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

/// Asks something of an opened primitive (OPrimitiveControl.h).
/// @param param, paramSize argument of the request; 0, 0 if it has none
/// @param result, resultSize where its result goes; 0, 0 if it has none
/// @return oINVALID_PRIMITIVE_ID if it is not open, oINVALID_ARG if request or argument is unknown to it
OStatus ControlPrimitive(OPrimitiveID primitiveID, OPrimitiveRequest request, void* param, size_t paramSize,
                         void* result, size_t resultSize);

/// Memory for a command vector with room for this many entries (maxNumData), all of them with a dataOffset of their
/// own. It has none yet (numData).
/// @param[out] memID to make an RCRegion of: RCRegion(memID, vectorInfo.offset, vector, vectorInfo.totalSize)
/// @return oNO_MEMORY if that is no entry, or more than any robot has effectors
OStatus NewCommandVectorData(size_t count, MemoryRegionID* memID, OCommandVectorData** vector);

/// Gives it back; not before its RCRegion is free.
/// @return oFAIL if there is none with this number
OStatus DeleteCommandVectorData(MemoryRegionID memID);

/// Memory for tables of the colour detection. There is none in it yet (numData).
OStatus NewCdtVectorData(MemoryRegionID* memID, OCdtVectorData** vector);

/// Gives it back.
/// @return oFAIL if there is none with this number
OStatus DeleteCdtVectorData(MemoryRegionID memID);

/// Gives the tables to the camera.
/// @return oFAIL on Linux, where the camera detects no colours
OStatus SetCdtVectorData(MemoryRegionID memID);

/// @name Keys by which motions, lights and sounds begin together (ODataVectorInfo::syncKey)
/// On Linux there are none, and a vector begins as it comes.
/// @{

/// @return oNO_SYNC_KEY if there is none left
OStatus NewSyncKey(OVRSyncKey* key);
/// @return oINVALID_SYNC_KEY if this is not a key
OStatus CancelSyncKey(OVRSyncKey key);
/// Makes two keys of one.
/// @return oINVALID_SYNC_KEY if this is not a key
OStatus DivideSyncKey(OVRSyncKey key, OVRSyncKey* key1, OVRSyncKey* key2);
/// @}

/// @name Joints
/// `primitiveID` may be oprimitiveID_UNDEF, which means all joints that are open, except with the two that read.
/// @return oINVALID_PRIMITIVE_ID if it is not open or no joint
/// @{

/// Gains of the servo, each with its shift (Level2 Reference Guide, page 71).
/// @return oGAIN_DISABLED, and no gain is set, unless EnableJointGain() was called before
OStatus SetJointGain(OPrimitiveID primitiveID, word pg, word ig, word dg, word ps, word is, word ds);

/// Makes the joint's gain effective; it is 0 until SetJointGain() is called (page 70). The servo pulls its joint then
/// to where it was commanded last: command the present position first.
/// @return oALERT_JOINT_UNCONTROLLABLE if its potentiometer is broken
OStatus EnableJointGain(OPrimitiveID primitiveID);

/// Makes the joint's gain 0 and ineffective (page 70): the joint can be moved by hand.
OStatus DisableJointGain(OPrimitiveID primitiveID);

/// What the joint reports now.
OStatus GetJointValue(OPrimitiveID primitiveID, OJointValue* value);
/// @}

/// What a sensor reports now.
/// @return oINVALID_PRIMITIVE_ID if it is not open or no sensor
OStatus GetSensorValue(OPrimitiveID primitiveID, OSensorValue* value);

/// Power of all motors. It is off when the robot boots; without it no gain has an effect.
OStatus SetMotorPower(OPower power);

/// Battery, motor power and what else the power supply knows.
OStatus GetPowerStatus(OPowerStatus* status);

/// Calls an `Extra` entry with an OPowerStatusMessage (OPENRMessages.h) whenever the power status changes as asked,
/// until UnobservePowerStatus() (page 79).
/// @param notifyStatus bits of robotStatus and batteryStatus whose every change is told; for remainingCapacity,
///        temperature, timeDif and volume a value that is told when it is reached, or one of the opso constants of
///        OPower.h. fullyChargedCapacity, voltage and current are not looked at
/// @param entry Extra_Entry[entryNAME] of the object that calls
/// @return oINVALID_ARG if there is no such entry
OStatus ObservePowerStatus(const OPowerStatus& notifyStatus, const OServiceEntry& entry);

/// @return oINVALID_ARG if the entry observes nothing
OStatus UnobservePowerStatus(const OServiceEntry& entry);

/// Ends all objects and switches the robot off, soon after the entry point that calls this has returned.
/// @param condition when to boot again: with obcbBOOT_TIMER after bootTime seconds, else when somebody touches the
///        robot. On Linux 0 seconds is the one time there is: the machine boots again at once; nobody touches it
/// @return oINVALID_ARG, and the robot stays on, if `condition` asks for another time on Linux
OStatus Shutdown(const OBootCondition& condition);

/// Reads a file of the memory stick into memory, by the key that DESIGNDB.CFG has for it.
/// @param[out] data, size the file's content; it stays there until DeleteDesignData()
/// @return oNOT_FOUND if DESIGNDB.CFG has no such key or there is no such file, oDESIGNDATA_SIZE_ZERO if it is empty
OStatus FindDesignData(const char* keyword, ODesignDataID* dataID, byte** data, size_t* size);

/// @return oINVALID_ARG if there is none with this number
OStatus DeleteDesignData(ODesignDataID dataID);

/// Name of the robot's model, "ERS-7" or "ERS-210".
/// @param[out] design at least orobotdesignNAME_MAX + 1 characters
OStatus GetRobotDesign(char* design);

}  // namespace OPENR

#endif  // OPENR_OPENRAPI_H
