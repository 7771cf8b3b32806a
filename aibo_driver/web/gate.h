/// @file gate.h
#ifndef AIBO_DRIVER_WEB_GATE_H
#define AIBO_DRIVER_WEB_GATE_H

#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace aibo_driver::web {

/// What a browser asks for: the page, or a WebSocket.
using Request = boost::beast::http::request<boost::beast::http::empty_body>;

struct Verdict {
  unsigned status;         ///< of HTTP: 200 for the page, 101 for the WebSocket; others refuse
  std::string text;        ///< why it is refused, for a person
  std::string set_cookie;  ///< what the browser has to keep, or empty
};

/// Decides who may see and move the robot.
///
/// A browser obeys any page, so a stranger's page may ask, too, even by a name that the stranger lets point to this
/// computer. So the browser must have been sent to the server's address, and only the page from here may open the
/// WebSocket. Beyond this computer, a code is needed, too. It comes with the link once, and then as a cookie.
class Gate {
 public:
  /// @param address the address that the server listens on; if others can reach it, the gate makes a code
  /// @throw std::invalid_argument this is no address by which a browser can reach a server
  Gate(const std::string& address, std::uint16_t port);

  /// @return what to answer to this request
  Verdict judge(const Request& request) const;

  /// The address of the page, with the code.
  std::string link() const;

 private:
  bool mayEnter(const Request& request) const;

  std::vector<std::string> hosts_;  ///< the hosts under which a browser may ask for the page
  std::string code_;                ///< empty if everybody on this computer may enter
  std::string cookie_;
};

/// A text that nobody can guess.
/// @throw std::exception the system has no random numbers
std::string randomText();

}  // namespace aibo_driver::web

#endif  // AIBO_DRIVER_WEB_GATE_H
