// Makes the sources that belong to an object from its stub.cfg. Called by openr_generate_stub.cmake.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "openr_host/stub_generator/stub_writer.h"

namespace {

void writeFile(const std::string& name, const std::string& text) {
  std::ofstream file(name);
  if (!(file << text << std::flush)) {
    throw std::runtime_error(name + ": cannot be written");
  }
}

void generate(const std::string& stub_file, const std::string& folder) {
  std::ifstream text(stub_file);
  if (!text) {
    throw std::runtime_error(stub_file + ": cannot be read");
  }
  const auto stub = openr_host::StubConfiguration::parse(text, stub_file);
  writeFile(folder + "/def.h", openr_host::writeDef(stub));
  writeFile(folder + "/entry.h", openr_host::writeEntry(stub));
  writeFile(folder + "/" + stub.object_name + "_stub.h", openr_host::writeDescriptionHeader(stub));
  writeFile(folder + "/" + stub.object_name + "_stub.cc", openr_host::writeDescription(stub));
}

}  // namespace

int main(int argc, char* argv[]) {
  if (argc != 3) {
    std::cerr << "usage: openr_stub_generator STUB.CFG FOLDER\n"
                 "Writes def.h, entry.h, OBJECTNAME_stub.h and OBJECTNAME_stub.cc into FOLDER.\n";
    return EXIT_FAILURE;
  }
  try {
    generate(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
