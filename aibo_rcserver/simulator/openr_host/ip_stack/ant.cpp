#include <ant.h>

#include <cstring>

#include "simulator/openr_host/ip_stack/ip_stack.h"
#include "simulator/openr_host/system.h"

antStackRef::antStackRef(const char* name) : is_ip_stack_(std::strcmp(name, "IPStack") == 0) {}

antError antEnvMsg::Call(const antStackRef& stack, size_t size) {
  return stack.IsIPStack() ? openr_host::System::current().ipStack().call(*this, size) : ANT_FAIL;
}

antError antEnvMsg::Send(const antStackRef& stack, const OID& object, Selector entry, size_t size) {
  openr_host::System& system = openr_host::System::current();
  if (!stack.IsIPStack() || !system.hasEntry(object, entry)) {
    return ANT_FAIL;
  }
  return system.ipStack().send(*this, size, object, entry);
}
