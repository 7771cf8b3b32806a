#include "web/page_server.h"

#include <stdexcept>
#include <utility>

#include "web/page_connection.h"

namespace aibo_driver::web {
namespace {

using boost::asio::ip::tcp;
using Error = boost::system::error_code;

tcp::acceptor listen(boost::asio::io_context& context, const std::string& address, std::uint16_t port) {
  Gate(address, port);  // complains about the address
  try {
    return {context, {boost::asio::ip::make_address(address), port}};
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error("the page cannot be served at " + address + ", port " + std::to_string(port) + ": " +
                             error.code().message() + ". Set ~web_address to an address of this computer, and " +
                             "~web_port to a free port, or to 0 to take any");
  }
}

Frame frameOf(std::string bytes, bool is_text) {
  return {std::make_shared<const std::string>(std::move(bytes)), is_text};
}

}  // namespace

PageServer::PageServer(boost::asio::io_context& context, const std::string& address, std::uint16_t port,
                       PageListener& listener)
    : acceptor_(listen(context, address, port)),
      gate_(address, acceptor_.local_endpoint().port()),
      listener_(listener) {
  accept();
}

// The connections are limited, so this process has descriptors enough.
void PageServer::accept() {
  acceptor_.async_accept([this](Error error, tcp::socket socket) {
    if (!error) {
      const auto connection = std::make_shared<PageConnection>(std::move(socket), *this);
      newest_.push_back(connection);
      connection->readRequest();
    }
    if (newest_.size() > kMostPages) {
      const auto oldest = newest_.front().lock();
      newest_.pop_front();
      if (oldest && oldest->waits()) {
        oldest->close();
      }
    }
    accept();
  });
}

Page PageServer::enter(const std::shared_ptr<PageConnection>& connection) {
  pages_[++last_page_] = connection;
  return last_page_;
}

void PageServer::leave(Page page) {
  if (pages_.erase(page) > 0) {
    listener_.closed(page);
  }
}

void PageServer::showPicture(std::string jpeg) {
  sendToAll(kPicture, frameOf(std::move(jpeg), false));
}

void PageServer::show(const std::string& kind, std::string text) {
  sendToAll(kind, texts_[kind] = frameOf(std::move(text), true));
}

void PageServer::tell(Page page, const std::string& kind, std::string bytes, bool is_text) {
  if (const auto found = pages_.find(page); found != pages_.end()) {
    found->second->send(kind, frameOf(std::move(bytes), is_text));
  }
}

void PageServer::sendToAll(const std::string& kind, const Frame& frame) {
  for (const auto& [page, connection] : pages_) {
    connection->send(kind, frame);
  }
}

std::string PageServer::nameOf(Page page) const {
  const auto found = pages_.find(page);
  return found == pages_.end() ? "" : found->second->name();
}

}  // namespace aibo_driver::web
