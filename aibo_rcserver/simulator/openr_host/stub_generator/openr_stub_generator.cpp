// Generates sources from an object's stub.cfg, for openr_generate_stub.cmake.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "simulator/openr_host/stub_generator/stub.h"

namespace {

void writeFile(const std::string& name, const std::string& text) {
  std::ofstream file(name);
  if (!(file << text << std::flush)) {
    throw std::runtime_error(name + ": cannot be written");
  }
}

void generate(const std::string& stub_file, int priority, const std::string& folder, const std::string& public_folder) {
  std::ifstream text(stub_file);
  if (!text) {
    throw std::runtime_error(stub_file + ": cannot be read");
  }
  const auto stub = openr_host::readStub(text, stub_file);
  writeFile(folder + "/def.h", openr_host::writeDef(stub));
  writeFile(folder + "/entry.h", openr_host::writeEntry(stub));
  writeFile(folder + "/" + stub.object_name + "_stub.cc", openr_host::writeDescription(stub, priority));
  writeFile(public_folder + "/" + stub.object_name + "_stub.h", openr_host::writeDescriptionHeader(stub));
}

}  // namespace

int main(int argc, char* argv[]) {
  if (argc != 5) {
    std::cerr << "usage: openr_stub_generator STUB.CFG PRIORITY FOLDER PUBLIC_FOLDER\n"
                 "Writes def.h, entry.h and OBJECTNAME_stub.cc into FOLDER, OBJECTNAME_stub.h into PUBLIC_FOLDER.\n";
    return EXIT_FAILURE;
  }
  try {
    generate(argv[1], std::stoi(argv[2]), argv[3], argv[4]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
