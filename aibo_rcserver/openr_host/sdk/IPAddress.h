/// @file IPAddress.h
/// Internet addresses and ports.
#ifndef OPENR_IPADDRESS_H
#define OPENR_IPADDRESS_H

#include <OPENR/OPENR.h>

typedef longword IPAddress;  ///< version 4; 127.0.0.1 is 0x7f000001
typedef word Port;

const IPAddress IP_ADDR_ANY = 0;

#endif  // OPENR_IPADDRESS_H
