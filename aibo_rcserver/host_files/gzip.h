/// @file gzip.h
/// Gzipped files, as the memory sticks of Sony's software have them.
#ifndef AIBO_RCSERVER_HOST_FILES_GZIP_H
#define AIBO_RCSERVER_HOST_FILES_GZIP_H

#include <cstddef>
#include <string>

namespace host_files {

/// True if the bytes begin like a gzipped file.
bool isGzipped(const std::string& bytes);

/// Unpacks bytes once. If they are not gzipped, they are returned as they are.
/// @param longest the most bytes that the result may have, because a few gzipped bytes could fill any memory
/// @throw Unreadable (regular_file.h) the gzipped bytes are damaged or cut off or have more after their end, or the
///   result would be longer
std::string unpacked(std::string bytes, std::size_t longest);

/// Reads a file by readRegularFile(), and unpacks it if it is gzipped.
/// @param longest the most bytes that the file may have, gzipped and unpacked
/// @throw Unreadable see readRegularFile() and unpacked()
std::string readUnpacked(const std::string& path, std::size_t longest);

}  // namespace host_files

#endif  // AIBO_RCSERVER_HOST_FILES_GZIP_H
