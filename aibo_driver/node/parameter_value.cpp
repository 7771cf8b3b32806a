#include "node/parameter_value.h"

#include <cmath>
#include <sstream>

#include "text/plain_text.h"

namespace aibo_driver::node {

using XmlRpc::XmlRpcValue;

double numberIn(XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeInt:
      return static_cast<int>(value);
    case XmlRpcValue::TypeDouble:
      return value;
    default:
      return NAN;
  }
}

std::string describeRefusal(const std::string& name, XmlRpcValue value, const std::string& allowed) {
  std::string given;
  if (value.getType() == XmlRpcValue::TypeString) {
    given = "the text '" + text::plainLine(static_cast<std::string>(value)) + "'";
  } else {
    std::ostringstream written;
    value.write(written);
    given = text::plainLine(written.str());
  }
  return "Parameter " + name + " is " + given + "; it must be " + allowed + ".";
}

}  // namespace aibo_driver::node
