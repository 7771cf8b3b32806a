/// @file DNSEndpointMsg.h
/// Messages to a DNS endpoint, which finds addresses and names of hosts (OPEN-R SDK Internet Protocol Version4,
/// chapters 4 and 9). On Linux, this computer's resolver and its settings answer. An endpoint does one thing at a time.
#ifndef OPENR_DNSENDPOINTMSG_H
#define OPENR_DNSENDPOINTMSG_H

#include <IPAddress.h>
#include <ant.h>

enum DNSEndpointError {
  DNS_SUCCESS = 0,
  DNS_FAIL = 1,
  DNS_HOST_NOT_FOUND = 2,
  DNS_TRY_AGAIN = 3,    ///< no server has answered
  DNS_NO_RECOVERY = 4,  ///< a server has answered with an error
  DNS_NO_DATA = 5,      ///< the host has no address
  DNS_CONNECTION_CLOSED = 6,
  DNS_CONNECTION_BUSY = 7,
  DNS_INDEX_INVALID = 8,
  DNS_BUFFER_INVALID = 9,
  DNS_OPERATION_INVALID = 10,  ///< there is no such endpoint
  DNS_OPERATION_UNKNOWN = 11
};

#define MAXNS 3

/// Characters in a name, including the final 0.
#define MAXDNAME 100

class DNSEndpointBaseMsg : public antEnvMsg {
 public:
  antModuleRef module;
  DNSEndpointError error;

 protected:
  DNSEndpointBaseMsg(antOperation asked, const antModuleRef& endpoint)
      : antEnvMsg(asked), module(endpoint), error(DNS_FAIL) {}
};

/// Tells the addresses of the servers.
class DNSEndpointGetServerAddressesMsg : public DNSEndpointBaseMsg {
 public:
  explicit DNSEndpointGetServerAddressesMsg(const antModuleRef& endpoint)
      : DNSEndpointBaseMsg(antOperation_DNSGetServerAddresses, endpoint), nscount(0) {}

  int32 nscount;  ///< in the answer: 0..MAXNS
  IPAddress addrList[MAXNS];
};

/// Tells the domain that is added to names without a final dot.
class DNSEndpointGetDefaultDomainNameMsg : public DNSEndpointBaseMsg {
 public:
  explicit DNSEndpointGetDefaultDomainNameMsg(const antModuleRef& endpoint)
      : DNSEndpointBaseMsg(antOperation_DNSGetDefaultDomainName, endpoint) {
    name[0] = '\0';
  }

  char name[MAXDNAME];
};

/// The base of questions about a host.
class DNSEndpointHostMsg : public DNSEndpointBaseMsg {
 public:
  char name[MAXDNAME];
  IPAddress server_address;  ///< in the answer: the first of the servers
  IPAddress host_address;    ///< the host's first address
  int n_address;             ///< in the answer: how many addresses it has
  int n_alias;               ///< 0 on Linux

 protected:
  DNSEndpointHostMsg(antOperation asked, const antModuleRef& endpoint, const char* host, const IPAddress& address)
      : DNSEndpointBaseMsg(asked, endpoint), host_address(address), n_address(0), n_alias(0) {
    strncpy(name, host, MAXDNAME - 1);
    name[MAXDNAME - 1] = '\0';
  }
};

/// Finds a host's addresses.
class DNSEndpointGetHostByNameMsg : public DNSEndpointHostMsg {
 public:
  DNSEndpointGetHostByNameMsg(const antModuleRef& endpoint, const char* host)
      : DNSEndpointHostMsg(antOperation_DNSGetHostByName, endpoint, host, IPAddress()) {}
};

/// Finds a host's name.
class DNSEndpointGetHostByAddrMsg : public DNSEndpointHostMsg {
 public:
  DNSEndpointGetHostByAddrMsg(const antModuleRef& endpoint, const IPAddress& address)
      : DNSEndpointHostMsg(antOperation_DNSGetHostByAddr, endpoint, "", address) {}
};

/// Closes the endpoint. An unfinished question is first answered with DNS_CONNECTION_CLOSED.
class DNSEndpointCloseMsg : public DNSEndpointBaseMsg {
 public:
  explicit DNSEndpointCloseMsg(const antModuleRef& endpoint) : DNSEndpointBaseMsg(antOperation_DNSClose, endpoint) {}
};

#endif  // OPENR_DNSENDPOINTMSG_H
