/// @file OPENR.h
/// The elementary types and status values of OPEN-R.
///
/// This folder holds headers with the names and data layouts of Sony's OPEN-R SDK 1.1.5, written anew from its
/// documentation, so that one source compiles for the robot with the SDK and for Linux with these. They keep to C++98.
/// Everything declared here belongs to the one thread that runs the machine (openr_host/machine.h).
#ifndef OPENR_OPENR_H
#define OPENR_OPENR_H

#include <stddef.h>

typedef unsigned char byte;
typedef signed char sbyte;
typedef unsigned short word;
typedef signed short sword;
typedef unsigned int longword;
typedef signed int slongword;

typedef longword OStatus;         ///< result of a call
typedef longword OID;             ///< number of an object
typedef longword OPrimitiveID;    ///< number of an opened joint, sensor, LED, camera...
typedef longword MemoryRegionID;  ///< number of a piece of memory shared with the system
typedef longword ODataType;       ///< kind of data in a vector
typedef longword Selector;        ///< number of an entry point of an object

const OStatus oSUCCESS = 0;
const OStatus oFAIL = 2;
const OStatus oINVALID_ARG = 4;
const OStatus oNOT_FOUND = 6;
const OStatus oINVALID_PRIMITIVE_ID = 4096;
const OStatus oGAIN_DISABLED = 4108;               ///< the joint is commanded while its gain is off
const OStatus oALERT_JOINT_UNCONTROLLABLE = 8192;  ///< the joint cannot follow what it is told

const OID oidUNDEF = 0;
/// Names an `Extra` entry of an object: Extra_Entry[entryNAME] of its entry.h.
struct OServiceEntry {
  OID oid;
  Selector selector;

  OServiceEntry() : oid(oidUNDEF), selector(0xffffffffU) {}
  OServiceEntry(OID object, Selector entry) : oid(object), selector(entry) {}
  void Set(OID object, Selector entry) {
    oid = object;
    selector = entry;
  }
  OID GetOID() const { return oid; }
  Selector GetSelector() const { return selector; }
};

inline bool operator==(const OServiceEntry& a, const OServiceEntry& b) {
  return a.oid == b.oid && a.selector == b.selector;
}
inline bool operator!=(const OServiceEntry& a, const OServiceEntry& b) {
  return !(a == b);
}

const OPrimitiveID oprimitiveID_UNDEF = 0xffffffffU;  ///< in a call that takes it: all opened primitives
const MemoryRegionID memoryRegionID_UNDEF = 0;

#endif  // OPENR_OPENR_H
