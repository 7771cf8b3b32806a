/// @file replay.cpp
/// Runs a fuzz target on the files or folders given. Linked with a target instead of libFuzzer.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "fuzz_input.h"

namespace {

namespace fs = std::filesystem;

void replay(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  // In memory of exactly this size, so that a sanitizer sees reads behind the end.
  const Bytes input(content.begin(), content.end());
  std::cout << file.string() << std::endl;  // flushed: the last one printed is the one that failed
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

}  // namespace

int main(int argc, char** argv) {
  int count = 0;
  for (int i = 1; i < argc; ++i) {
    std::vector<fs::path> files = {argv[i]};
    if (fs::is_directory(argv[i])) {
      files.assign(fs::directory_iterator(argv[i]), fs::directory_iterator());
    }
    std::for_each(files.begin(), files.end(), replay);
    count += static_cast<int>(files.size());
  }
  std::cout << count << " inputs\n";
  return count > 0 ? 0 : 1;
}
