/// @file ODataArchive.h
/// Kinds of files in an archive of motions, lights and sounds. No calls read such archives.
#ifndef OPENR_ODATAARCHIVE_H
#define OPENR_ODATAARCHIVE_H

#include <Types.h>

/// A file's first four characters, the first one in the lowest byte.
typedef longword ODataArchiveMagic;
const ODataArchiveMagic odamagicUNDEF = 0xffffffffU;
const ODataArchiveMagic odamagicODAR = 0x5241444fU;  ///< "ODAR", an archive
const ODataArchiveMagic odamagicOMTN = 0x4e544d4fU;  ///< "OMTN", a motion
const ODataArchiveMagic odamagicWAVE = 0x45564157U;  ///< "WAVE", a sound

#endif  // OPENR_ODATAARCHIVE_H
