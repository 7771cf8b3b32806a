#include <sstream>

#include "simulator/openr_host/stub_generator/stub.h"

namespace openr_host {
namespace {

const char kOrigin[] = "// Written by openr_stub_generator from stub.cfg: change that instead.\n";

/// The source of a lambda that calls the object's function, or "nullptr".
std::string callOf(const StubConfiguration& stub, const std::string& function, const std::string& argument) {
  if (function.empty()) {
    return "nullptr";
  }
  return "[](OObject& object, " + argument + " argument) { static_cast<" + stub.object_name + "&>(object)." + function +
         "(argument); }";
}

/// `const Selector NAME[] = {0, 1, 2};`
void writeSelectors(std::ostream& out, const std::string& name, std::size_t count) {
  out << "\nconst Selector " << name << "[] = {";
  for (std::size_t i = 0; i < count; ++i) {
    out << (i == 0 ? "" : ", ") << i;
  }
  out << "};\n";
}

void writeIndexes(std::ostream& out, const std::string& prefix, const std::vector<StubService>& services) {
  int index = 0;
  for (const auto& service : services) {
    out << "const int " << prefix << service.name.service << " = " << index++ << ";\n";
  }
}

void writeServices(std::ostream& out, const StubConfiguration& stub, const std::string& member,
                   const std::vector<StubService>& services, const std::string& connection_event,
                   const std::string& data_event) {
  for (const auto& service : services) {
    out << "  description." << member << ".push_back({\"" << service.name.text() << "\",\n      "
        << callOf(stub, service.connection_function, "const " + connection_event + "&") << ",\n      "
        << callOf(stub, service.data_function, "const " + data_event + "&") << "});\n";
  }
}

}  // namespace

std::string writeDef(const StubConfiguration& stub) {
  std::ostringstream out;
  out << kOrigin << "#ifndef DEF_H\n#define DEF_H\n\n"
      << "const int numOfSubject = " << stub.subjects.size() << ";\n"
      << "const int numOfObserver = " << stub.observers.size() << ";\n\n";
  writeIndexes(out, "sbj", stub.subjects);
  out << "\n";
  writeIndexes(out, "obs", stub.observers);
  out << "\n#endif  // DEF_H\n";
  return out.str();
}

std::string writeEntry(const StubConfiguration& stub) {
  std::ostringstream out;
  out << kOrigin << "#ifndef ENTRY_H\n#define ENTRY_H\n\n#include <OPENR/OPENR.h>\n\n";
  int index = 0;
  for (const auto& function : stub.extra_functions) {
    out << "const int entry" << function << " = " << index++ << ";\n";
  }
  writeSelectors(out, "Entry_Notify", stub.observers.size());
  if (!stub.extra_functions.empty()) {
    writeSelectors(out, "Extra_Entry", stub.extra_functions.size());
  }
  out << "\n#endif  // ENTRY_H\n";
  return out.str();
}

std::string writeDescriptionHeader(const StubConfiguration& stub) {
  const std::string guard = stub.object_name + "_STUB_H";
  std::ostringstream out;
  out << kOrigin << "#ifndef " << guard << "\n#define " << guard << "\n\n"
      << "#include \"simulator/openr_host/object_description.h\"\n\n"
      << "/// Describes the object " << stub.object_name << " for MachineOptions::catalog.\n"
      << "openr_host::ObjectDescription describe" << stub.object_name << "();\n\n"
      << "#endif  // " << guard << "\n";
  return out.str();
}

std::string writeDescription(const StubConfiguration& stub, int priority) {
  std::ostringstream out;
  out << kOrigin << "#include \"" << stub.object_name << "_stub.h\"\n\n#include \"" << stub.object_name << ".h\"\n\n"
      << "openr_host::ObjectDescription describe" << stub.object_name << "() {\n"
      << "  openr_host::ObjectDescription description;\n"
      << "  description.name = \"" << stub.object_name << "\";\n"
      << "  description.priority = " << priority << ";\n";
  writeServices(out, stub, "subjects", stub.subjects, "OControlEvent", "OReadyEvent");
  writeServices(out, stub, "observers", stub.observers, "OConnectEvent", "ONotifyEvent");
  for (const auto& function : stub.extra_functions) {
    out << "  description.extra_entries.push_back(\n      " << callOf(stub, function, "ANTENVMSG") << ");\n";
  }
  out << "  description.create = [] { return std::make_unique<" << stub.object_name << ">(); };\n"
      << "  return description;\n}\n\n"
      << "#ifdef OPENR_OBJECT_LIBRARY\n"
      << "extern \"C\" __attribute__((visibility(\"default\"))) void describeLoadedObject("
      << "openr_host::ObjectDescription* description) {\n"
      << "  *description = describe" << stub.object_name << "();\n}\n#endif\n";
  return out.str();
}

}  // namespace openr_host
