/// @file OPENR.h
/// OPEN-R's elementary types and limits.
///
/// This folder has headers with the names and data layouts of Sony's OPEN-R SDK 1.1.5, written from its documentation.
/// So one source compiles for the robot with the SDK, and for Linux with these. They are C++98. Everything here belongs
/// to the one thread that runs the machine (simulator/openr_host/machine.h).
#ifndef OPENR_OPENR_H
#define OPENR_OPENR_H

// The SDK's header includes these, too, and objects may rely on that.
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <OID.h>
#include <OPENR/OStatus.h>
#include <Types.h>

typedef longword OPrimitiveID;  ///< an open joint, sensor, LED, camera...
typedef longword OPrimitiveType;
typedef longword ODesignDataID;      ///< a design database file in memory
typedef longword OVRSyncKey;         ///< a key that makes effectors start together
typedef longword OPrimitiveRequest;  ///< to a primitive (OPrimitiveControl.h)
typedef longword OMemoryStickStatus;
typedef byte OVolumeSwitch;

const OPrimitiveID oprimitiveID_UNDEF = 0xffffffffU;  ///< all open primitives, in calls that accept it
const OPrimitiveType oprimitiveUNDEF = 0;
const ODesignDataID odesigndataID_UNDEF = 0xffffffffU;

const OMemoryStickStatus omemorystickUNDEF = 0xffffffffU;
const OMemoryStickStatus omemorystickNOT_EXIST = 0;
const OMemoryStickStatus omemorystickWRITE_PROTECTED = 1;
const OMemoryStickStatus omemorystickWRITABLE = 2;

const longword oframeMAX_NUMBER = 0x0ffffff0U;  ///< 0 follows it
const longword oframeINVALID_NUMBER = 0xffffffffU;

const OVRSyncKey ovrsynckeyUNDEF = 0xffffffffU;
const size_t ovrsynckeyMAX_NUM_KEY = 8;
const size_t ovrsynckeyMAX_NUM_DIVISION = 16;

const OVolumeSwitch ovolumeSW0 = 0;
const OVolumeSwitch ovolumeSW1 = 1;
const OVolumeSwitch ovolumeSW2 = 2;
const OVolumeSwitch ovolumeSW3 = 3;

const int orobotdesignNAME_MAX = 31;     ///< characters of a robot design's name, without the final 0
const int odesignkeywordNAME_MAX = 127;  ///< characters of a design database key, without the final 0
const int oserviceNAME_MAX = 127;        ///< characters of a service's name, without the final 0
const int ovrPATH_MAX = 127;             ///< characters of a primitive's locator, without the final 0

/// An entry point of an object.
struct OServiceEntry {
  OID oid;
  Selector selector;

  /// Identifies no entry.
  OServiceEntry() : selector(UNDEF) {}
  OServiceEntry(const OID& object, Selector entry) : oid(object), selector(entry) {}

  void Set(const OID& object, Selector entry) {
    oid = object;
    selector = entry;
  }
  OID GetOID() const { return oid; }
  Selector GetSelector() const { return selector; }

  bool IsValid() const { return oid.IsValid() && selector != UNDEF; }
  void MakeInvalid() { *this = OServiceEntry(); }
};

inline bool operator==(const OServiceEntry& a, const OServiceEntry& b) {
  return a.oid == b.oid && a.selector == b.selector;
}
inline bool operator!=(const OServiceEntry& a, const OServiceEntry& b) {
  return !(a == b);
}
inline bool operator<(const OServiceEntry& a, const OServiceEntry& b) {
  return a.oid < b.oid || (a.oid == b.oid && a.selector < b.selector);
}

#endif  // OPENR_OPENR_H
