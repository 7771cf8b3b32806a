#include "command_line/output.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "command_line/interruption.h"
#include "files/files.h"
#include "text/plain_text.h"

namespace aibo_driver::command_line {
namespace {

void write(std::FILE* stream, const void* data, std::size_t size) {
  if (std::fwrite(data, 1, size, stream) != size || std::fflush(stream) != 0) {
    if (errno == EINTR && interruption() != 0) {
      throw Interrupted("interrupted");  // nobody has read for some time
    }
    throw OutputException(std::string("cannot write to the standard output: ") + std::strerror(errno));
  }
}

/// True if bytes written to the file come out of the standard output, as with /dev/stdout.
bool isStandardOutput(const std::string& file) {
  struct stat named {};
  struct stat standard {};
  return file == "-" || (::stat(file.c_str(), &named) == 0 && ::fstat(STDOUT_FILENO, &standard) == 0 &&
                         named.st_dev == standard.st_dev && named.st_ino == standard.st_ino);
}

}  // namespace

void Output::result(const std::string& words, const Json& json) {
  const std::string line = (json_ ? json.text() : text::plainText(words)) + "\n";
  write(results_to_stderr_ ? stderr : stdout, line.data(), line.size());
}

void Output::note(const std::string& words) {
  std::fprintf(stderr, "%s\n", text::plainText(words).c_str());
}

void Output::bytes(const std::vector<std::uint8_t>& bytes) {
  write(stdout, bytes.data(), bytes.size());
}

std::string Output::picture(const std::string& file, const std::vector<std::uint8_t>& jpeg) {
  std::error_code error;
  const bool is_device = std::filesystem::is_other(file, error);
  if (file != "-" && !is_device) {
    return files::saveJpeg("/", file.empty() ? file : std::filesystem::absolute(file).string(), jpeg);
  }
  if (isStandardOutput(file)) {
    leaveStandardOutputToBytes();
  }
  if (is_device) {
    files::replaceFile(file, {jpeg.begin(), jpeg.end()});
  } else {
    bytes(jpeg);
  }
  return file;
}

}  // namespace aibo_driver::command_line
