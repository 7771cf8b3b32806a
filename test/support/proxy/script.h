/// @file script.h
/// Commands to a fault proxy as text.
#ifndef TEST_SUPPORT_PROXY_SCRIPT_H
#define TEST_SUPPORT_PROXY_SCRIPT_H

#include <stdexcept>
#include <string>

#include "support/proxy/fault_proxy.h"

namespace test_support {

/// A line is not understood; the text says why.
class ScriptError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Describes all commands.
extern const char* const kScriptHelp;

/// Reads a fault: ACTION[:VALUE][@PLACE][>server], see kScriptHelp.
/// @throw ScriptError
Fault parseFault(const std::string& words);

/// Carries out commands, line by line.
class Script {
 public:
  explicit Script(FaultProxy* proxy) : proxy_(proxy) {}

  /// @throw ScriptError, std::system_error
  void carryOut(const std::string& line);

 private:
  bool changeConditions(const std::string& command, const std::string& first, const std::string& second);
  bool act(const std::string& command, const std::string& argument);

  FaultProxy* const proxy_;
  Conditions conditions_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_SCRIPT_H
