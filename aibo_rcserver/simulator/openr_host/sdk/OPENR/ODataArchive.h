/// @file ODataArchive.h
/// Kinds of files in an archive of motions, lights and sounds. The calls that read such archives are not provided.
#ifndef OPENR_ODATAARCHIVE_H
#define OPENR_ODATAARCHIVE_H

#include <Types.h>

/// The first four characters of the file, the first one in the lowest byte.
typedef longword ODataArchiveMagic;
const ODataArchiveMagic odamagicUNDEF = 0xffffffffU;
const ODataArchiveMagic odamagicODAR = 0x5241444fU;  ///< "ODAR", an archive
const ODataArchiveMagic odamagicOMTN = 0x4e544d4fU;  ///< "OMTN", a motion
const ODataArchiveMagic odamagicWAVE = 0x45564157U;  ///< "WAVE", a sound

#endif  // OPENR_ODATAARCHIVE_H
