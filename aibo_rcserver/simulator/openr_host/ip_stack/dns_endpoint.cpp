#include "simulator/openr_host/ip_stack/dns_endpoint.h"

#include <netdb.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

namespace openr_host {
namespace {

DNSEndpointError dnsErrorOf(int error) {
  switch (error) {
    case 0:
      return DNS_SUCCESS;
    case EAI_NONAME:
      return DNS_HOST_NOT_FOUND;
    case EAI_AGAIN:
      return DNS_TRY_AGAIN;
    case EAI_FAIL:
      return DNS_NO_RECOVERY;
    case EAI_NODATA:
      return DNS_NO_DATA;
    default:
      return DNS_FAIL;
  }
}

void copyName(const std::string& name, char (&out)[MAXDNAME]) {
  out[name.copy(out, MAXDNAME - 1)] = '\0';
}

/// This computer's settings.
struct Settings {
  std::vector<IPAddress> servers;  ///< up to MAXNS
  std::string domain;
};

Settings readSettings() {
  Settings settings;
  std::ifstream file("/etc/resolv.conf");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string keyword;
    std::string value;
    words >> keyword >> value;
    const IPAddress address(value.c_str());
    if (keyword == "nameserver" && address != IP_ADDR_ANY && settings.servers.size() < MAXNS) {
      settings.servers.push_back(address);
    } else if ((keyword == "search" || keyword == "domain") && settings.domain.empty()) {
      settings.domain = value;
    }
  }
  return settings;
}

}  // namespace

void DnsEndpoint::answer(DNSEndpointBaseMsg& message) {
  message.error = DNS_SUCCESS;
  if (message.operation == antOperation_DNSGetServerAddresses) {
    auto& answer = static_cast<DNSEndpointGetServerAddressesMsg&>(message);
    const auto servers = readSettings().servers;
    answer.nscount = static_cast<int32>(servers.size());
    std::copy(servers.begin(), servers.end(), answer.addrList);
  } else if (message.operation == antOperation_DNSGetDefaultDomainName) {
    copyName(readSettings().domain, static_cast<DNSEndpointGetDefaultDomainNameMsg&>(message).name);
  } else {
    asking_.end(DNS_CONNECTION_CLOSED);
    is_closed_ = true;
  }
}

void DnsEndpoint::askForHost(const Envelope& message) {
  if (asking_) {
    openr_host::answer<DNSEndpointHostMsg>(deliver_, message, DNS_CONNECTION_BUSY);
    return;
  }
  asking_.begin(message);
  found_ = std::make_shared<Found>();
  found_->name = asking_->name;
  found_->address = asking_->host_address;
  found_->done = FileDescriptor(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  std::thread([operation = asking_->operation, found = found_] {
    find(operation, found.get());
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = write(found->done.get(), &one, sizeof(one));
  }).detach();
}

void DnsEndpoint::find(antOperation operation, Found* found) {
  if (operation == antOperation_DNSGetHostByAddr) {
    const sockaddr_in host = SocketAddress(found->address, 0).system();
    char name[NI_MAXHOST] = "";
    found->error = dnsErrorOf(getnameinfo(reinterpret_cast<const sockaddr*>(&host), sizeof(host), name, sizeof(name),
                                          nullptr, 0, NI_NAMEREQD));
    found->name = name;
    found->addresses = found->error == DNS_SUCCESS ? 1 : 0;
    return;
  }
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  wanted.ai_flags = AI_CANONNAME;
  addrinfo* hosts = nullptr;
  // A dot at the end means that no domain is to be added. /etc/hosts has names without it.
  std::string name = found->name;
  name.erase(name.find_last_not_of('.') + 1);
  found->error = dnsErrorOf(getaddrinfo(name.c_str(), nullptr, &wanted, &hosts));
  for (const addrinfo* host = hosts; host != nullptr; host = host->ai_next) {
    if (found->addresses++ == 0) {
      sockaddr_in address{};
      std::memcpy(&address, host->ai_addr, sizeof(address));  // a pointer need not be aligned for it
      found->address = SocketAddress(address).address;
      found->name = host->ai_canonname != nullptr ? host->ai_canonname : found->name;
    }
  }
  if (hosts != nullptr) {
    freeaddrinfo(hosts);
  }
}

void DnsEndpoint::finish() {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto size = read(found_->done.get(), &count, sizeof(count));  // the thread's writing is over
  const auto servers = readSettings().servers;
  copyName(found_->name, asking_->name);
  asking_->host_address = found_->address;
  asking_->server_address = servers.empty() ? IPAddress() : servers.front();
  asking_->n_address = found_->addresses;
  asking_.end(found_->error);
}

void DnsEndpoint::addTo(PollSet& poll_set) {
  if (asking_) {
    poll_set.add(found_->done.get(), POLLIN, [this] { finish(); });
  }
}

}  // namespace openr_host
