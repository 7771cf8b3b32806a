#include "host_files/gzip.h"

#include <zlib.h>

#include <new>
#include <vector>

#include "host_files/regular_file.h"

namespace host_files {

bool isGzipped(const std::string& bytes) {
  return bytes.compare(0, 2, "\x1f\x8b") == 0;
}

std::string unpacked(std::string bytes, std::size_t longest) {
  if (!isGzipped(bytes)) {
    if (bytes.size() > longest) {
      throw Unreadable("it has more than the " + std::to_string(longest) + " bytes allowed");
    }
    return bytes;
  }
  constexpr int kOnlyGzip = 16;  // zlib wants this added to the size of the window
  constexpr std::size_t kPart = 65536;
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  if (inflateInit2(&stream, MAX_WBITS + kOnlyGzip) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string content;
  int result = Z_OK;
  while (result == Z_OK && content.size() <= longest) {
    const std::size_t size = content.size();
    content.resize(size + kPart);
    stream.next_out = reinterpret_cast<Bytef*>(&content[size]);
    stream.avail_out = kPart;
    result = inflate(&stream, Z_NO_FLUSH);
    content.resize(content.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (content.size() > longest) {
    throw Unreadable("unpacked, it has more than the " + std::to_string(longest) + " bytes allowed");
  }
  if (result != Z_STREAM_END) {
    throw Unreadable("it is gzipped, but damaged or cut off");
  }
  if (stream.avail_in > 0) {
    throw Unreadable("it is gzipped, and has bytes after its end");
  }
  return content;
}

std::string readUnpacked(const std::string& path, std::size_t longest) {
  const std::vector<unsigned char> bytes = readRegularFile(path, longest);
  return unpacked({bytes.begin(), bytes.end()}, longest);
}

}  // namespace host_files
