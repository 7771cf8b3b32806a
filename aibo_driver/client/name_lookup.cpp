#include "client/name_lookup.h"

#include <netdb.h>

#include <cstring>
#include <future>
#include <thread>
#include <utility>

#include "system/event.h"

namespace aibo_client {

NameLookupResult resolveWithSystem(const std::string& host, int port) {
  addrinfo hints = {};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* list = nullptr;
  NameLookupResult result;
  const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &list);
  if (error != 0) {
    result.problem = ::gai_strerror(error);
    return result;
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(list, &::freeaddrinfo);
  for (const addrinfo* entry = list; entry != nullptr; entry = entry->ai_next) {
    SocketAddress address = {};
    address.size = entry->ai_addrlen;
    std::memcpy(&address.storage, entry->ai_addr, entry->ai_addrlen);
    result.addresses.push_back(address);
  }
  return result;
}

struct NameLookup::Lookup {
  std::string host;
  int port;
  aibo_system::Event finished{};
  std::future<NameLookupResult> result{};
};

NameLookup::NameLookup(Resolver resolver) : resolver_(std::move(resolver)) {}

void NameLookup::start(const std::string& host, int port) {
  if (lookup_ && lookup_->host == host && lookup_->port == port) {
    return;
  }
  const std::shared_ptr<Lookup> lookup(new Lookup{host, port});
  std::packaged_task<NameLookupResult()> task([=, resolver = resolver_] { return resolver(host, port); });
  lookup->result = task.get_future();
  std::thread([lookup, task = std::move(task)]() mutable {
    task();
    lookup->finished.raise();
  }).detach();
  lookup_ = lookup;
}

int NameLookup::descriptor() const {
  return lookup_->finished.descriptor();
}

NameLookupResult NameLookup::take() {
  return std::exchange(lookup_, nullptr)->result.get();
}

}  // namespace aibo_client
