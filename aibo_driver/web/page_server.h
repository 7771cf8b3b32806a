/// @file page_server.h
#ifndef AIBO_DRIVER_WEB_PAGE_SERVER_H
#define AIBO_DRIVER_WEB_PAGE_SERVER_H

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <deque>
#include <map>
#include <memory>
#include <string>

#include "web/gate.h"
#include "web/steering.h"

namespace aibo_driver::web {

/// The content of page.html. NONCE stands for a word that is new each time.
std::string pageHtml();

/// What is sent to a page: a text, or a JPEG.
struct Frame {
  std::shared_ptr<const std::string> bytes;
  bool is_text;
};

/// What the server tells about its pages.
class PageListener {
 public:
  virtual ~PageListener() = default;
  virtual void opened(Page page) = 0;
  virtual void received(Page page, const std::string& text) = 0;
  virtual void closed(Page page) = 0;
};

class PageConnection;

/// Serves the page over HTTP, and the WebSocket over which an open page talks. All functions belong to the thread that
/// runs the io_context. The server must not end before that thread.
///
/// A page gets a picture when it has shown the one before, and then the newest. So a slow one gets fewer pictures, and
/// never older ones.
class PageServer {
 public:
  /// The most pages, and the most connections that have not passed the gate. When another one comes, the oldest of
  /// these has to go, so nobody can keep others out.
  static constexpr std::size_t kMostPages = 16;

  /// A page that sends more texts or more bytes in one of them is closed.
  static constexpr std::size_t kMostBytes = 4096;
  static constexpr int kMostTexts = 200;  // a second

  /// The kind of showPicture(), which comes after all others.
  static constexpr const char* kPicture = "~";

  /// @param port 0: any free port
  /// @throw std::exception nobody could reach the page; the message says what to change
  PageServer(boost::asio::io_context& context, const std::string& address, std::uint16_t port, PageListener& listener);

  /// The address of the page, for people who may see it.
  std::string link() const { return gate_.link(); }

  bool hasPages() const { return !pages_.empty(); }

  /// Shows a picture on all pages.
  void showPicture(std::string jpeg);

  /// Shows a text on all pages, now and when they open.
  /// @param kind of all texts of a kind, only the newest counts
  void show(const std::string& kind, std::string text);

  /// Tells one page something: a text, or a JPEG.
  void tell(Page page, const std::string& kind, std::string bytes, bool is_text = true);

  /// A name for other people; empty if the page is closed.
  std::string nameOf(Page page) const;

 private:
  friend class PageConnection;

  void accept();
  void sendToAll(const std::string& kind, const Frame& frame);

  // For the connections.
  Page enter(const std::shared_ptr<PageConnection>& connection);
  void leave(Page page);

  boost::asio::ip::tcp::acceptor acceptor_;
  const Gate gate_;
  PageListener& listener_;
  std::deque<std::weak_ptr<PageConnection>> newest_;  ///< the connections that came last
  std::map<Page, std::shared_ptr<PageConnection>> pages_;
  Page last_page_ = 0;
  std::map<std::string, Frame> texts_;  ///< the newest of each kind
};

}  // namespace aibo_driver::web

#endif  // AIBO_DRIVER_WEB_PAGE_SERVER_H
