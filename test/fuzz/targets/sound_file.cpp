// Sound files that anybody may have made: WAV, FLAC and Ogg.
#include <sys/mman.h>
#include <unistd.h>

#include "files/files.h"
#include "fuzz_input.h"
#include "host_files/file_descriptor.h"
#include "sound/source.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  host_files::FileDescriptor file(::memfd_create("sound", MFD_CLOEXEC));
  require(::write(file.get(), data, size) == static_cast<ssize_t>(size), "memory can be written");
  ::lseek(file.get(), 0, SEEK_SET);
  try {
    const auto source = aibo_driver::sound::readSound(std::move(file), "sound");
    constexpr std::size_t kPiece = 2048;
    constexpr int kMostPieces = 100;  // 13 s
    bool is_at_end = false;
    for (int i = 0; i < kMostPieces && !is_at_end; ++i) {
      const std::size_t count = source(kPiece).size();
      require(count <= kPiece, "no more is read than was asked for");
      is_at_end = count < kPiece;
    }
    require(!is_at_end || source(1).empty(), "after the end, there is nothing");
  } catch (const aibo_driver::files::FileException& error) {
    require(std::string(error.what()).find("cannot be played") != std::string::npos, "a refusal says why");
  }
  return 0;
}
