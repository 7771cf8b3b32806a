/// @file refusal.h
#ifndef TEST_SUPPORT_REFUSAL_H
#define TEST_SUPPORT_REFUSAL_H

#include <string>

namespace test_support {

/// What an exception of this kind says that a function throws; empty if it throws none.
template <typename Exception, typename Function>
std::string refusalOf(const Function& function) {
  try {
    function();
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace test_support

#endif  // TEST_SUPPORT_REFUSAL_H
