/// @file page_connection.h
#ifndef AIBO_DRIVER_WEB_PAGE_CONNECTION_H
#define AIBO_DRIVER_WEB_PAGE_CONNECTION_H

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "system/rate_limit.h"
#include "web/page_server.h"

namespace aibo_driver::web {

/// A browser's connection, which asks for the page, or opens a WebSocket for a page that was loaded before.
class PageConnection : public std::enable_shared_from_this<PageConnection> {
 public:
  PageConnection(boost::asio::ip::tcp::socket socket, PageServer& server)
      : server_(&server), stream_(std::move(socket)) {}

  void readRequest();

  /// From now on, the server hears nothing more.
  void close();

  /// True if it has not passed the gate yet.
  bool waits() const { return server_ != nullptr && page_ == 0; }

  /// A name for other people, such as "page 2 (192.168.1.7)".
  std::string name() const;

  /// Sends the newest frame of each kind, in the order of the kinds.
  void send(const std::string& kind, const Frame& frame);

 private:
  using Error = boost::system::error_code;

  boost::beast::tcp_stream& tcpStream() { return stream_.next_layer(); }
  void answer();
  void respond(const Verdict& verdict);
  void open();
  void read();
  void receive();
  void write();

  PageServer* server_;  ///< null when the connection is closed
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::beast::flat_buffer buffer_;
  boost::beast::http::request_parser<boost::beast::http::empty_body> request_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
  std::string address_;
  Page page_ = 0;  ///< 0 before it has passed the gate
  aibo_system::RateLimit limit_{PageServer::kMostTexts};
  std::map<std::string, Frame> waiting_;  ///< what waits to be sent, by its kind
  std::optional<Frame> sent_;             ///< what is being sent
  bool awaits_sight_ = false;             ///< the page has not shown the last picture yet
};

}  // namespace aibo_driver::web

#endif  // AIBO_DRIVER_WEB_PAGE_CONNECTION_H
