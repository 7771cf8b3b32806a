#include "web/page_connection.h"

#include <boost/algorithm/string/replace.hpp>
#include <boost/asio/buffer.hpp>
#include <chrono>
#include <utility>

namespace aibo_driver::web {
namespace {

namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using boost::asio::ip::tcp;

constexpr std::chrono::seconds kTimeForRequest{5};
constexpr std::chrono::seconds kSilence{10};  // a page that is alive answers pings
constexpr std::uint32_t kMostBytesOfHeader = 8192;

// The page needs nothing from elsewhere, and a text that somebody smuggled into it would have no rights.
std::string policy(const std::string& host, const std::string& nonce) {
  return "default-src 'none'; img-src blob: data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
         "connect-src 'self' ws://" +
         host + "; script-src 'nonce-" + nonce + "'; style-src 'nonce-" + nonce + "'";
}

}  // namespace

void PageConnection::readRequest() {
  request_.header_limit(kMostBytesOfHeader);
  request_.body_limit(0);
  tcpStream().expires_after(kTimeForRequest);
  http::async_read(tcpStream(), buffer_, request_,
                   [self = shared_from_this()](Error error, std::size_t) { error ? self->close() : self->answer(); });
}

void PageConnection::close() {
  if (PageServer* server = std::exchange(server_, nullptr)) {
    Error ignored;
    tcpStream().socket().close(ignored);
    server->leave(page_);
  }
}

std::string PageConnection::name() const {
  return "page " + std::to_string(page_) + " (" + address_ + ")";
}

void PageConnection::send(const std::string& kind, const Frame& frame) {
  waiting_[kind] = frame;
  write();
}

void PageConnection::answer() {
  if (server_ == nullptr) {
    return;
  }
  Error error;
  address_ = tcpStream().socket().remote_endpoint(error).address().to_string();
  tcpStream().socket().set_option(tcp::no_delay(true), error);
  const Verdict verdict = server_->gate_.judge(request_.get());
  if (verdict.status != 101) {
    respond(verdict);
  } else if (server_->pages_.size() >= PageServer::kMostPages) {
    respond({503, "Too many pages are open.", ""});
  } else {
    open();
  }
}

void PageConnection::respond(const Verdict& verdict) {
  const bool is_page = verdict.status == 200;
  const std::string nonce = randomText();
  response_.result(verdict.status);
  response_.set(http::field::content_type, is_page ? "text/html; charset=utf-8" : "text/plain; charset=utf-8");
  response_.set(http::field::cache_control, "no-store");
  response_.set("Content-Security-Policy",
                is_page ? policy(std::string(request_.get()[http::field::host]), nonce) : "default-src 'none'");
  response_.set("X-Frame-Options", "DENY");
  response_.set("X-Content-Type-Options", "nosniff");
  response_.set("Referrer-Policy", "no-referrer");
  response_.set("Cross-Origin-Resource-Policy", "same-origin");
  if (!verdict.set_cookie.empty()) {
    response_.set(http::field::set_cookie, verdict.set_cookie);
  }
  response_.keep_alive(false);
  response_.body() = is_page ? boost::replace_all_copy(pageHtml(), "NONCE", nonce) : verdict.text + "\n";
  response_.prepare_payload();
  http::async_write(tcpStream(), response_, [self = shared_from_this()](Error, std::size_t) { self->close(); });
}

void PageConnection::open() {
  page_ = server_->enter(shared_from_this());
  tcpStream().expires_never();
  stream_.set_option(websocket::stream_base::timeout{kTimeForRequest, kSilence, true});
  stream_.read_message_max(PageServer::kMostBytes);
  stream_.auto_fragment(false);
  stream_.async_accept(request_.get(), [self = shared_from_this()](Error error) {
    if (error) {
      self->close();
    } else if (self->server_ != nullptr) {
      self->buffer_.clear();
      self->waiting_ = self->server_->texts_;
      self->server_->listener_.opened(self->page_);
      self->read();
    }
  });
}

void PageConnection::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
    constexpr std::chrono::milliseconds kPeriod{1000 / PageServer::kMostTexts};
    if (error || !self->limit_.admit(std::chrono::steady_clock::now(), kPeriod).is_admitted) {
      self->close();
    } else if (self->server_ != nullptr) {
      self->receive();
      self->read();
    }
  });
}

void PageConnection::receive() {
  const std::string text = boost::beast::buffers_to_string(buffer_.data());
  buffer_.consume(buffer_.size());
  if (stream_.got_text()) {
    server_->listener_.received(page_, text);
  } else {
    awaits_sight_ = false;
    write();
  }
}

void PageConnection::write() {
  if (server_ == nullptr || !stream_.is_open() || sent_ || waiting_.empty()) {
    return;
  }
  const bool is_picture = waiting_.begin()->first == PageServer::kPicture;
  if (is_picture && std::exchange(awaits_sight_, true)) {
    return;
  }
  sent_ = waiting_.extract(waiting_.begin()).mapped();
  stream_.binary(!sent_->is_text);
  stream_.async_write(boost::asio::buffer(*sent_->bytes), [self = shared_from_this()](Error error, std::size_t) {
    self->sent_.reset();
    error ? self->close() : self->write();
  });
}

}  // namespace aibo_driver::web
