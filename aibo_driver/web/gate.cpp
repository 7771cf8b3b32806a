#include "web/gate.h"

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/uuid/random_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <sstream>
#include <stdexcept>

namespace aibo_driver::web {
namespace {

namespace http = boost::beast::http;

constexpr std::uint16_t kPortOfHttp = 80;  // which browsers leave out
const std::string kPage = "/";
const std::string kLink = "/?code=";
const std::string kSocket = "/ws";

boost::asio::ip::address parsed(const std::string& address) {
  boost::system::error_code error;
  const auto result = boost::asio::ip::make_address(address, error);
  if (error || result.is_unspecified()) {
    throw std::invalid_argument("~web_address is '" + address +
                                "'; it must be an address of this computer, such as 192.168.1.5");
  }
  return result;
}

// The time that it takes is the same for every text of the right length, so that nobody can find the secret letter by
// letter.
bool isSecret(const std::string& secret, const std::string& text) {
  volatile int difference = text.size() == secret.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(secret.size(), text.size()); ++i) {
    difference = difference | (text[i] ^ secret[i]);
  }
  return difference == 0;
}

}  // namespace

Gate::Gate(const std::string& address, std::uint16_t port) {
  const boost::asio::ip::address ip = parsed(address);
  hosts_.push_back(ip.is_v6() ? "[" + address + "]" : address);
  if (ip.is_loopback()) {
    hosts_.emplace_back("localhost");
  } else {
    code_ = randomText();
    cookie_ = "aibo_code_" + std::to_string(port) + "=" + code_;  // browsers send it to all ports
  }
  for (std::string& host : hosts_) {
    host += port == kPortOfHttp ? "" : ":" + std::to_string(port);
  }
}

Verdict Gate::judge(const Request& request) const {
  const std::string asked(request[http::field::host]);
  const std::string origin(request[http::field::origin]);
  const std::string target(request.target());
  const bool is_upgrade = boost::beast::websocket::is_upgrade(request);
  const auto is_asked_for = [&asked](const std::string& host) { return boost::iequals(host, asked); };
  if (std::none_of(hosts_.begin(), hosts_.end(), is_asked_for)) {
    return {403, "This page has another address: " + hosts_.front(), ""};
  }
  const bool is_from_here = boost::iequals("http://" + asked, origin);
  if (!is_from_here && (is_upgrade || !origin.empty())) {
    return {403, "Only the page from here may ask for this.", ""};
  }
  if (request.method() != http::verb::get) {
    return {405, "Only GET is known here.", ""};
  }
  const bool has_code = boost::starts_with(target, kLink);
  if (is_upgrade ? target != kSocket : target != kPage && !has_code) {
    return {404, "There is nothing here. The page is at /.", ""};
  }
  if (!code_.empty() && !mayEnter(request)) {
    return {403, "This page needs the whole link that aibo_web printed when it started. Each start has a new one.", ""};
  }
  const bool has_to_keep = has_code && !code_.empty();
  return {is_upgrade ? 101U : 200U, "",
          has_to_keep ? cookie_ + "; HttpOnly; SameSite=Strict; Path=/; Max-Age=31536000" : ""};
}

std::string Gate::link() const {
  return "http://" + hosts_.front() + (code_.empty() ? kPage : kLink + code_);
}

bool Gate::mayEnter(const Request& request) const {
  if (isSecret(kLink + code_, std::string(request.target()))) {
    return true;
  }
  std::istringstream cookies{std::string(request[http::field::cookie])};
  for (std::string cookie; std::getline(cookies >> std::ws, cookie, ';');) {
    if (isSecret(cookie_, cookie)) {
      return true;
    }
  }
  return false;
}

std::string randomText() {
  return to_string(boost::uuids::random_generator()());
}

}  // namespace aibo_driver::web
