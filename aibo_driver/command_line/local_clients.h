/// @file local_clients.h
#ifndef AIBO_DRIVER_COMMAND_LINE_LOCAL_CLIENTS_H
#define AIBO_DRIVER_COMMAND_LINE_LOCAL_CLIENTS_H

#include <string>
#include <vector>

namespace aibo_driver::command_line {

/// The other programs of this computer that are connected to a port of a robot, found in Linux's /proc. A robot does
/// not say who its client is. Most often it is a driver on the same computer.
/// @param address an IPv4 address in numbers; for anything else the result is empty
/// @return each program once, for example "aibo_driver_node (process 4711)"; "a program of another user" if /proc does
/// not say more
std::vector<std::string> localClients(const std::string& address, int port);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_LOCAL_CLIENTS_H
