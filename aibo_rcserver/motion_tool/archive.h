/// @file archive.h
/// Archives of motions (ODA), as Sony's samples and its software for the ERS-7 have them.
#ifndef AIBO_RCSERVER_MOTION_TOOL_ARCHIVE_H
#define AIBO_RCSERVER_MOTION_TOOL_ARCHIVE_H

#include <string>
#include <vector>

namespace motion_tool {

struct ArchivedFile {
  std::string name;  ///< the name in the archive; any bytes
  std::string content;
};

/// True if the bytes begin like an archive.
bool isArchive(const std::string& bytes);

/// Reads an archive, and unpacks those of its files that are gzipped. All integers are little-endian:
///
///     header     64 bytes: ODAR, uint16 major version, uint16 minor version, uint32 number of files,
///                uint32 size of an entry (144), zeros
///     entries    for each file: type, 128 bytes for the name, uint32 offset of the content in the archive,
///                uint32 size of the content, uint32 unused
///     contents
///
/// The type proves nothing: placeholders of eight or no bytes have the type of a motion.
///
/// @throw std::runtime_error the bytes are not an archive; it is cut off; its files overlap; a file of it cannot be
///   unpacked; its files would have more than 64 MiB in all
std::vector<ArchivedFile> readArchive(const std::string& bytes);

/// A safe file name: letters, digits, `-` and `_` stay, everything else becomes `_`; then comes `.mtn` for a motion,
/// `.wav` for a sound, or `.bin`, by the beginning of the content. The name neither leads to another folder nor begins
/// with a dot or `-`. Two files of an archive may get the same name.
std::string fileNameOf(const ArchivedFile& file);

/// Writes all files to a folder, and makes the folder if necessary.
/// @param overwrite replace existing files, including links
/// @throw std::runtime_error a file cannot be written; or a file already exists or two files would get the same name,
///   and nothing was written
void unpack(const std::vector<ArchivedFile>& files, const std::string& folder, bool overwrite);

}  // namespace motion_tool

#endif  // AIBO_RCSERVER_MOTION_TOOL_ARCHIVE_H
