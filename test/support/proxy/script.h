/// @file script.h
/// What a user tells a proxy, in words.
#ifndef TEST_SUPPORT_PROXY_SCRIPT_H
#define TEST_SUPPORT_PROXY_SCRIPT_H

#include <stdexcept>
#include <string>

#include "support/proxy/fault_proxy.h"

namespace test_support {

/// A line that means nothing; the text says why.
class ScriptError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All lines there are, for people.
extern const char* const kScriptHelp;

/// A fault in words: ACTION[:VALUE][@PLACE][>server], as kScriptHelp tells.
/// @throw ScriptError
Fault parseFault(const std::string& words);

/// Carries out lines, one after the other.
class Script {
 public:
  explicit Script(FaultProxy* proxy) : proxy_(proxy) {}

  /// @throw ScriptError, std::system_error
  void carryOut(const std::string& line);

 private:
  FaultProxy* const proxy_;
  Conditions conditions_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_SCRIPT_H
