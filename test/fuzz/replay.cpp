/// @file replay.cpp
/// Runs a fuzz target on the files or folders given. Linked with a target instead of libFuzzer.

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "fuzz_input.h"

namespace {

namespace fs = std::filesystem;

int replay(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  // In memory of exactly this size, so that a sanitizer sees reads behind the end.
  const Bytes input(content.begin(), content.end());
  std::cout << file.string() << std::endl;  // flushed: the last one printed is the one that failed
  return LLVMFuzzerTestOneInput(input.data(), input.size());
}

int replayAll(const fs::path& path) {
  if (!fs::is_directory(path)) {
    replay(path);
    return 1;
  }
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    count += replayAll(entry.path());
  }
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    int count = 0;
    for (int i = 1; i < argc; ++i) {
      count += replayAll(argv[i]);
    }
    std::cout << count << " inputs\n";
    return count > 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "replay: " << error.what() << '\n';
    return 1;
  }
}
