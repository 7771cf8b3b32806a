/// @file replace_file.h
/// Writes files that users of this computer keep. A file is whole or as it was: on any error, and if the program is
/// killed or the power fails. replace_file.py does the same for programs in Python.
///
/// The content is written to a file `.aibo_part.NUMBER` in the same folder, which then takes the name of the old one.
/// Signals to the thread that writes have to wait until this is done. If a program is killed, the next one that writes
/// to the folder removes what it has left: a program that is alive holds a lock (flock) on its file. All functions may
/// be called by several threads and programs at once; the last one to end wins.
#ifndef AIBO_RCSERVER_HOST_FILES_REPLACE_FILE_H
#define AIBO_RCSERVER_HOST_FILES_REPLACE_FILE_H

#include <stdexcept>
#include <string>

namespace host_files {

/// Thrown if a file cannot be written. The text says why, without the file's name: "No space left on device".
class Unwritable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file. A new file gets the usual permissions. An old file keeps its own, but its owner and group become the
/// writer's.
/// @param path the path of the file. A symbolic link is followed and stays. Anything but a regular file, such as a pipe
///   or /dev/null, is opened and written to, and so is the standard output under any name, such as /dev/stdout
/// @throw Unwritable there is no such folder, permission is missing, the old file is write-protected, the disk is full,
///   ...
void replaceFile(const std::string& path, const std::string& content);

/// Writes a file in an open folder. It replaces whatever has this name, even a link or a pipe, but not a folder.
/// @param folder a descriptor of the folder, which may have been opened with O_PATH
/// @param name the name, without a slash
/// @throw Unwritable see above
void replaceFile(int folder, const std::string& name, const std::string& content);

}  // namespace host_files

#endif  // AIBO_RCSERVER_HOST_FILES_REPLACE_FILE_H
