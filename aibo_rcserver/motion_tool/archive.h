/// @file archive.h
/// Archives of motions (ODA), as Sony's samples have them.
#ifndef AIBO_RCSERVER_MOTION_TOOL_ARCHIVE_H
#define AIBO_RCSERVER_MOTION_TOOL_ARCHIVE_H

#include <string>
#include <vector>

namespace motion_tool {

/// One file in an archive.
struct ArchivedFile {
  std::string name;     ///< as in the archive, any bytes
  std::string type;     ///< four letters: OMTN is a motion, WAVE a sound
  std::string content;  ///< its bytes
};

/// True if the bytes begin as an archive does.
bool isArchive(const std::string& bytes);

/// Reads an archive. All integers are little-endian:
///
///     header     64 bytes: ODAR, uint16 major version, uint16 minor version, uint32 number of files, uint32 size of an
///                entry (144), zeros
///     entries    for each file: its type, 128 bytes for its name, uint32 offset of its content in the archive, uint32
///                size of its content, uint32 that is not used
///     contents
///
/// @throw std::runtime_error it is not an archive, something in it lies beyond its end, or its files overlap; the
///   message says what
std::vector<ArchivedFile> readArchive(const std::string& bytes);

/// The name for such a file on a disk: letters, digits, `-` and `_` of its name, everything else replaced by `_`, then
/// `.mtn` for a motion, `.wav` for a sound, or `.bin`. It never leads to another folder, and begins neither with a dot
/// nor with a `-`. Names of an archive that differ may become the same.
std::string fileNameOf(const ArchivedFile& file);

/// Writes all files to a folder, which is made if it is not there.
/// @param overwrite files that are there already are replaced, links to files included
/// @throw std::runtime_error a file is there already and may not be overwritten, or two files of the archive have the
///   same fileNameOf(): nothing is written then. Or a file cannot be written. The message names it
void unpack(const std::vector<ArchivedFile>& files, const std::string& folder, bool overwrite);

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_ARCHIVE_H
