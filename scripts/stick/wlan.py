"""The robot's WLAN settings: WLANCONF.TXT. The SDK's Installation Guide, section 3.2.2, describes each line."""
import ipaddress
import re
from typing import NamedTuple

from . import Problem
from .settings import lines_in

HOST_NAME = "AIBO"
UNUSED_KEY = "AIBO2"  # if there is no encryption; Sony's examples have no empty key
NETWORK = "1"         # APMODE: an access point, or a network between two computers (IBSS)
DEMO = "0"            # Sony's Ad Hoc Demo Mode, which alone uses CHANNEL

# What each line may say, and the same in words; None if wlan_conf() checks the line.
VALUES = {
    "HOSTNAME": (r"(?=.*[A-Za-z])[0-9A-Za-z]{1,8}", "up to 8 letters and digits, with at least one letter"),
    "USE_DHCP": ("[01]", "0 or 1"),
    "ETHER_IP": None, "ETHER_NETMASK": None, "IP_GATEWAY": None, "DNS_SERVER_1": None, "DNS_DEFDNAME": None,
    "ESSID": None,
    "WEPENABLE": ("[01]", "0 or 1"),
    "WEPKEY": None,
    "APMODE": ("[012]", "1 (an access point, or a network between two computers), 2 (the robot finds out) or 0 (Sony's "
                        "Ad Hoc Demo Mode)"),
    "CHANNEL": ("[1-9]|1[01]", "1 to 11"),
}


class Wlan(NamedTuple):
    """The settings of a WLAN. A setting that was not given is None."""
    essid: str
    ip: str = None
    netmask: str = None
    gateway: str = None
    wep_key: str = None


def wlan_conf(wlan):
    """The text of WLANCONF.TXT, with Sony's line ends. Raises Problem if the robot could not use a setting."""
    lines = {"HOSTNAME": HOST_NAME, **_address_lines(wlan), "ESSID": _essid(wlan.essid), **_wep_lines(wlan.wep_key),
             "APMODE": NETWORK, "CHANNEL": "3"}
    return "".join(f"{name}={value}\r\n" for name, value in lines.items())


class WlanConf:
    """A WLANCONF.TXT. `problems` has a Problem for each line that the robot could not use."""

    def __init__(self, path):
        self._path = path
        self._values = {}   # by name
        self._numbers = {}  # of the lines
        self.problems = [*self._wrong_lines(), *self._wrong_wlan()]

    @property
    def is_demo(self):
        return self._values.get("APMODE") == DEMO

    def _wrong_lines(self):
        for number, line in enumerate(lines_in(self._path), 1):
            if not line.strip() or line.lstrip().startswith("#"):
                continue
            name, has_value, value = (part.strip(" \t") for part in line.partition("="))
            if not has_value:  # it may hold the key, so it is not shown
                yield self._problem(number, "it is not NAME=VALUE.",
                                    "Correct it, or begin it with # to make it a comment.")
            elif name not in VALUES:
                yield self._problem(number, f"the robot has no setting {name!r}.",
                                    f"Is it misspelt? There are {', '.join(VALUES)}.")
            elif name in self._values:
                yield self._problem(number, f"{name} appears a second time.", "Take out one of the lines.")
            else:
                self._values[name], self._numbers[name] = value, number
                if VALUES[name] and not re.fullmatch(VALUES[name][0], value):
                    yield self._problem(number, f"{name} cannot be {value!r}.", f"It is {VALUES[name][1]}.")

    def _wrong_wlan(self):
        get = self._values.get
        with_dhcp = get("USE_DHCP") == "1"
        if "ESSID" not in self._values:
            yield self._problem(None, "there is no line ESSID=NAME.", "Add the name of the robot's network.")
            return
        try:
            wlan_conf(Wlan(
                essid=get("ESSID"),
                ip=None if with_dhcp else get("ETHER_IP", ""),
                netmask=None if with_dhcp else get("ETHER_NETMASK", ""),
                gateway=None if with_dhcp else get("IP_GATEWAY", ""),
                wep_key=get("WEPKEY", "") if get("WEPENABLE") == "1" else None,
            ))
        except Problem as problem:
            yield self._problem(self._numbers.get(problem.setting), *problem.args, *problem.advice)
        if self.is_demo and "CHANNEL" not in self._values:
            yield self._problem(self._numbers["APMODE"], "APMODE=0 needs a line CHANNEL=N.", "Channels are 1 to 11.")

    def _problem(self, number, what, *advice):
        return Problem(f"{self._path}{f', line {number}' if number else ''}: {what}", *advice)


def _essid(essid):
    if not re.fullmatch(r"[!-~]{1,32}", essid):
        raise Problem(f"the network's name {essid!r} cannot be used by the robot.",
                      "It must have 1 to 32 letters, digits and symbols of ASCII, without spaces.", setting="ESSID")
    return essid


def _address_lines(wlan):
    if wlan.ip is None:
        if wlan.netmask is not None or wlan.gateway is not None:
            raise Problem("--netmask and --gateway need --ip.",
                          "Give the robot's address, too, or leave all of them out; then the robot uses DHCP.")
        return {"USE_DHCP": "1"}
    address = _address(wlan.ip, "the robot's address", "ETHER_IP")
    network = _network(address, wlan.netmask or "255.255.255.0")
    gateway = address if wlan.gateway is None else _address(wlan.gateway, "the gateway", "IP_GATEWAY")  # as in the guide
    if gateway not in network:
        raise Problem(f"the gateway {gateway} is not in the robot's network, {network}.",
                      "Use the address of the access point's computer, or leave it out if there is none.",
                      setting="IP_GATEWAY")
    return {"USE_DHCP": "0", "ETHER_IP": address, "ETHER_NETMASK": network.netmask, "IP_GATEWAY": gateway,
            "DNS_SERVER_1": gateway}


def _address(text, what, setting):
    try:
        address = ipaddress.IPv4Address(text)
    except ValueError:
        raise Problem(f"{what} {text!r} is not an address.", "It has four numbers, such as 192.168.7.2.",
                      setting=setting) from None
    if address.is_loopback or address.is_multicast or address.is_unspecified or address.is_reserved:
        raise Problem(f"{what} {address} cannot be used.", "Use one such as 192.168.7.2.", setting=setting)
    return address


def _network(address, netmask):
    """The network of this address. A valid netmask has all ones before the zeros."""
    octets = re.fullmatch(r"(\d+)\.(\d+)\.(\d+)\.(\d+)", netmask)
    bits = "".join(f"{int(octet):08b}" for octet in octets.groups()) if octets else ""
    if not re.fullmatch(r"(?=.{32}$)1+0{2,}", bits):
        raise Problem(f"{netmask!r} is not a netmask.", "For most networks it is 255.255.255.0.",
                      setting="ETHER_NETMASK")
    network = ipaddress.IPv4Network((address, bits.count("1")), strict=False)
    if address in (network.network_address, network.broadcast_address):
        raise Problem(f"{address} is the first or last address of {network}, which no robot may have.",
                      "Use one in between.", setting="ETHER_IP")
    return network


def _wep_lines(key):
    if key is None:
        return {"WEPENABLE": "0", "WEPKEY": UNUSED_KEY}
    digits = re.fullmatch(r"(?:0x)?([0-9A-Fa-f]{10}|[0-9A-Fa-f]{26})", key)
    if digits:
        return {"WEPENABLE": "1", "WEPKEY": "0x" + digits.group(1)}
    if re.fullmatch(r"[0-9A-Za-z]{5}|[0-9A-Za-z]{13}", key):
        return {"WEPENABLE": "1", "WEPKEY": key}
    raise Problem(f"the WEP key has {len(key)} characters, or some that are not allowed.",
                  "It must have 5 or 13 letters and digits, or 10 or 26 hexadecimal digits.", setting="WEPKEY")
