/// @file page_viewer.h
#ifndef BENCHMARK_DRIVER_PAGE_VIEWER_H
#define BENCHMARK_DRIVER_PAGE_VIEWER_H

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstdint>
#include <string>
#include <thread>

namespace driver_benchmark {

/// A browser that shows the page of aibo_web, as quickly as possible.
class PageViewer {
 public:
  /// @param port on 127.0.0.1
  /// @throw boost::system::system_error the page is not served
  explicit PageViewer(unsigned short port) {
    const std::string host = "127.0.0.1:" + std::to_string(port);
    socket_.next_layer().connect({boost::asio::ip::make_address("127.0.0.1"), port});
    socket_.set_option(boost::beast::websocket::stream_base::decorator(
        [&](auto& request) { request.set(boost::beast::http::field::origin, "http://" + host); }));
    socket_.handshake(host, "/ws");
    socket_.binary(true);
    thread_ = std::thread([this] { show(); });
  }

  ~PageViewer() {
    boost::system::error_code ignored;
    socket_.next_layer().shutdown(boost::asio::ip::tcp::socket::shutdown_both, ignored);
    thread_.join();
  }

  /// How many pictures it has shown.
  std::uint64_t count() const { return count_; }

 private:
  // A page gets the next picture when it says, by an empty message, that it has shown the one before.
  void show() {
    boost::system::error_code error;
    for (boost::beast::flat_buffer frame; !error; frame.clear()) {
      socket_.read(frame, error);
      if (!error && socket_.got_binary()) {
        ++count_;
        socket_.write(boost::asio::const_buffer(), error);
      }
    }
  }

  boost::asio::io_context context_;
  boost::beast::websocket::stream<boost::asio::ip::tcp::socket> socket_{context_};
  std::atomic<std::uint64_t> count_{0};
  std::thread thread_;
};

}  // namespace driver_benchmark

#endif  // BENCHMARK_DRIVER_PAGE_VIEWER_H
