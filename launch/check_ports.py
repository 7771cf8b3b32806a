"""Ends roslaunch before it starts anything if the simulated robot cannot have its ports: the driver would connect to the
robot of whoever has them. Prints a value for a parameter, because only parameters run commands."""
import os
import socket
import sys

for port in sys.argv[1:]:
    try:
        socket.create_server(('127.0.0.1', int(port))).close()
    except OSError as error:
        sys.exit(f'The simulated robot cannot have port {port}: {os.strerror(error.errno)}. Does another simulated robot run? End '
                 'it, or choose other ports, such as port:=54322 console_port:=59001.')
print('free')
