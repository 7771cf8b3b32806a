/// @file gzip.h
#ifndef TEST_SUPPORT_GZIP_H
#define TEST_SUPPORT_GZIP_H

#include <zlib.h>

#include <string>

namespace test_support {

/// The bytes as a gzipped file has them.
inline std::string gzipped(std::string bytes) {
  constexpr int kGzip = 16;  // added to the size of the window
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS + kGzip, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_GZIP_H
