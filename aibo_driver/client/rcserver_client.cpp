#include "aibo_driver/rcserver_client.h"

#include "aibo_driver/exceptions.h"

namespace aibo_driver {

class RcServerClient::Implementation {};

RcServerClient::RcServerClient(const ClientOptions&, Callbacks) : implementation_(new Implementation) {}
RcServerClient::~RcServerClient() {}
void RcServerClient::start() {}
void RcServerClient::stop() noexcept {}
void RcServerClient::setStreaming(bool) {}
void RcServerClient::setJpegQuality(int) {}
bool RcServerClient::streaming() const {
  return false;
}
PicturePtr RcServerClient::takePicture(int, std::chrono::milliseconds, bool*) {
  throw NetworkException("no connection");
}
ConnectionStatus RcServerClient::status() const {
  return ConnectionStatus();
}
ClientStatistics RcServerClient::statistics() const {
  return ClientStatistics();
}

}  // namespace aibo_driver
