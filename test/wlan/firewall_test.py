"""Tests the rules of config/wlan/aibo.nft with three hosts, each a network namespace: a robot, an office computer, and the
driver's computer between them, which forwards what the rules let through.

No packet overtakes another on the same way. So a packet that has not arrived before a later one was dropped, and no test
waits for time to pass.
"""
import ctypes
import os
import shutil
import socket
import subprocess
import sys
import unittest
from contextlib import contextmanager
from pathlib import Path

RULES = Path(__file__).resolve().parents[2] / "config" / "wlan" / "aibo.nft"
SKIPPED = 77
TIMEOUT = 60  # only a failing test waits this long
CLONE_NEWNET = 0x40000000
LIBC = ctypes.CDLL(None, use_errno=True)

ROBOT, COMPUTER = "192.168.7.2", "192.168.7.1"
OFFICE, COMPUTER_IN_OFFICE = "192.168.1.9", "192.168.1.5"


def run(*command, given=None):
    """Runs a command, with this text as its input, and returns its output."""
    environment = {**os.environ, "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}  # missing in the PATH of ordinary users
    return subprocess.run(command, input=given, check=True, stdout=subprocess.PIPE, universal_newlines=True,
                          env=environment).stdout


class Host:
    """A network namespace: a new one, or that of this process."""

    def __init__(self, new):
        self._before = os.open("/proc/self/ns/net", os.O_RDONLY)
        if new and LIBC.unshare(CLONE_NEWNET) != 0:
            raise OSError(ctypes.get_errno(), "unshare")
        self._space = os.open("/proc/self/ns/net", os.O_RDONLY)
        self._keeper = subprocess.Popen(["cat"], stdin=subprocess.PIPE)  # ip refers to a namespace by a process in it
        LIBC.setns(self._before, CLONE_NEWNET)

    @property
    def pid(self):
        return str(self._keeper.pid)

    @contextmanager
    def here(self):
        LIBC.setns(self._space, CLONE_NEWNET)
        try:
            yield
        finally:
            LIBC.setns(self._before, CLONE_NEWNET)

    def run(self, *command):
        with self.here():
            run(*command)

    def udp(self, address="0.0.0.0", port=0):
        with self.here():
            endpoint = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            endpoint.bind((address, port))
            endpoint.settimeout(TIMEOUT)
            return endpoint

    def listen(self, port):
        with self.here():
            return socket.create_server(("0.0.0.0", port))

    def close(self):
        self._keeper.stdin.close()
        self._keeper.wait()
        os.close(self._space)
        os.close(self._before)


def arrived(endpoint):
    """The packets that have arrived so far, without waiting."""
    messages = []
    endpoint.setblocking(False)
    try:
        while True:
            messages.append(endpoint.recv(100))
    except BlockingIOError:
        return messages
    finally:
        endpoint.settimeout(TIMEOUT)


class TheRules(unittest.TestCase):
    def setUp(self):
        self.computer, self.robot, self.office = Host(new=False), Host(new=True), Host(new=True)
        for host in (self.computer, self.robot, self.office):
            self.addCleanup(host.close)
        self.addCleanup(run, "ip", "link", "delete", "lan0")
        self.addCleanup(run, "ip", "link", "delete", "wlan1")
        self.addCleanup(run, "nft", "flush", "ruleset")
        self.connect("wlan1", COMPUTER, self.robot, ROBOT)
        self.connect("lan0", COMPUTER_IN_OFFICE, self.office, OFFICE)
        self.at_robot = self.robot.udp(ROBOT, 5000)
        self.at_computer = self.computer.udp("0.0.0.0", 5000)
        self.at_office = self.office.udp(OFFICE, 5000)
        for endpoint in (self.at_robot, self.at_computer, self.at_office):
            self.addCleanup(endpoint.close)

    def connect(self, link, address, host, host_address):
        run("ip", "link", "add", link, "type", "veth", "peer", "name", "eth0", "netns", host.pid)
        run("ip", "address", "add", address + "/24", "dev", link)
        run("ip", "link", "set", link, "up")
        host.run("ip", "address", "add", host_address + "/24", "dev", "eth0")
        host.run("ip", "link", "set", "eth0", "up")
        host.run("ip", "route", "add", "default", "via", address)

    def driver_and_robot_talk(self):
        with self.computer.udp() as driver:
            driver.sendto(b"driver", (ROBOT, 5000))
            message, address = self.at_robot.recvfrom(100)
            while message != b"driver":
                message, address = self.at_robot.recvfrom(100)
            self.at_robot.sendto(b"answer", address)
            self.assertEqual(driver.recv(100), b"answer")

    def test_let_the_driver_connect_to_the_robot(self):
        run("nft", "-f", str(RULES))
        with self.robot.listen(54321) as server, socket.create_connection((ROBOT, 54321), timeout=TIMEOUT) as driver:
            connection, _ = server.accept()
            connection.sendall(b"picture")
            self.assertEqual(driver.recv(7), b"picture")
            connection.close()

    def test_let_the_robot_ping_the_computer(self):
        run("nft", "-f", str(RULES))
        with self.robot.here():
            ping = socket.socket(socket.AF_INET, socket.SOCK_RAW, socket.IPPROTO_ICMP)
        with ping:
            ping.settimeout(TIMEOUT)
            ping.connect((COMPUTER, 0))
            ping.send(b"\x08\0\xf7\xff\0\0\0\0")  # an echo request with its checksum
            while ping.recv(100)[20] != 0:  # behind the header of IP: the reply
                pass

    def expect_dropped(self, send, received):
        """Without the rules, the packet arrives."""
        send(b"packet")
        self.assertEqual(received(), [b"packet"])
        run("nft", "-f", str(RULES))
        send(b"packet")
        self.assertEqual(received(), [])

    def test_let_the_robot_reach_nobody_else(self):
        with self.robot.udp() as robot:
            self.expect_dropped(lambda packet: robot.sendto(packet, (OFFICE, 5000)), self.what_office_gets)

    def test_let_nobody_else_reach_the_robot(self):
        self.expect_dropped(lambda packet: self.at_office.sendto(packet, (ROBOT, 5000)), self.what_robot_gets)

    def test_let_the_robot_call_nothing_on_the_computer(self):
        for address in (COMPUTER, COMPUTER_IN_OFFICE):
            run("nft", "flush", "ruleset")
            with self.robot.udp() as robot:
                self.expect_dropped(lambda packet: robot.sendto(packet, (address, 5000)), self.what_computer_gets)

    def test_let_pictures_by_udp_in_if_the_line_is_used(self):
        line = "ip saddr $robot udp dport 32768-60999 accept"
        rules = RULES.read_text()
        self.assertIn("# " + line, rules)
        with self.robot.udp() as robot, self.computer.udp(port=32769) as driver:
            for text, expected in ((rules, []), (rules.replace("# " + line, line), [b"picture"])):
                run("nft", "-f", "-", given=text)
                robot.sendto(b"picture", (COMPUTER, 32769))
                self.driver_and_robot_talk()
                self.assertEqual(arrived(driver), expected)

    def test_let_the_robot_ask_for_its_address(self):
        run("nft", "-f", str(RULES))
        dhcp = self.computer.udp("0.0.0.0", 67)
        with dhcp, self.robot.udp("0.0.0.0", 68) as robot:
            robot.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
            robot.sendto(b"discover", ("255.255.255.255", 67))
            self.assertEqual(dhcp.recv(100), b"discover")

    def test_can_be_loaded_again(self):
        loaded = []
        for _ in range(2):
            run("nft", "-f", str(RULES))
            loaded.append(run("nft", "list", "ruleset"))
        self.assertEqual(*loaded)

    def test_keep_off_the_radio_what_is_for_everybody(self):
        with self.computer.udp() as driver:
            driver.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
            driver.sendto(b"to all", ("192.168.7.255", 5000))
            run("nft", "-f", str(RULES))
            self.assertRaises(PermissionError, driver.sendto, b"to all", ("192.168.7.255", 5000))

    def what_office_gets(self):
        self.driver_and_robot_talk()
        self.at_computer.sendto(b"end", (OFFICE, 5000))
        return list(iter(lambda: self.at_office.recv(100), b"end"))

    def what_computer_gets(self):
        self.driver_and_robot_talk()
        return arrived(self.at_computer)

    def what_robot_gets(self):
        with self.office.udp() as office:  # takes the same way as far as the computer
            office.sendto(b"end", (COMPUTER_IN_OFFICE, 5000))
            while self.at_computer.recv(100) != b"end":
                pass
        self.at_computer.sendto(b"end", (ROBOT, 5000))
        return list(iter(lambda: self.at_robot.recv(100), b"end"))


def is_possible():
    """Runs in a namespace of its own, in which the kernel must allow forwarding and filtering, and support veth."""
    try:
        Path("/proc/sys/net/ipv4/ip_forward").write_text("1")
        run("ip", "link", "add", "probe0", "type", "veth", "peer", "name", "probe1")
        run("ip", "link", "delete", "probe0")
        return True
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"skipped: {error}")
        return False


def main():
    if sys.argv[1:] != ["--inside"]:
        unshare = shutil.which("unshare")
        if subprocess.run([unshare, "-rn", "true"], check=False).returncode != 0:
            print("skipped: this user may not make network namespaces (unshare -rn)")
            sys.exit(SKIPPED)
        os.execv(unshare, [unshare, "-rn", sys.executable, "-B", os.path.abspath(__file__), "--inside"])
    if not is_possible():
        sys.exit(SKIPPED)
    run("ip", "link", "set", "lo", "up")
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # packets sent by two processors may overtake each other
    unittest.main(argv=sys.argv[:1])


if __name__ == "__main__":
    main()
