/// @file tcp_connection.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_CONNECTION_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_CONNECTION_H

namespace openr_host {

/// Makes a connected socket send at once, and notice within about 2 s that the other side has vanished.
/// @return false if the kernel cannot
bool configureTcpConnection(int socket);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_TCP_CONNECTION_H
