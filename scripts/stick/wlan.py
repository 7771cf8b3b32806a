"""The robot's WLAN settings: WLANCONF.TXT. The SDK's Installation Guide, section 3.2.2, describes each line."""
import ipaddress
import re
from typing import NamedTuple

from . import Problem

HOST_NAME = "AIBO"
UNUSED_KEY = "AIBO2"  # if there is no encryption; Sony's examples have no empty key


class Wlan(NamedTuple):
    """A setting that was not given is None."""
    essid: str
    ip: str = None
    netmask: str = None
    gateway: str = None
    wep_key: str = None
    channel: str = None


def wlan_conf(wlan):
    """The text of WLANCONF.TXT, with Sony's line ends. Raises Problem if the robot could not use a setting."""
    lines = {"HOSTNAME": HOST_NAME, **_address_lines(wlan), "ESSID": _essid(wlan.essid), **_wep_lines(wlan.wep_key),
             **_channel_lines(wlan.channel)}
    return "".join(f"{name}={value}\r\n" for name, value in lines.items())


def parse_wlan_conf(text):
    """The settings in a WLANCONF.TXT. Raises Problem if there is no ESSID."""
    lines = dict(re.findall(r"^[ \t]*(\w+)[ \t]*=[ \t]*(.*?)[ \t\r]*$", text, re.MULTILINE))
    if "ESSID" not in lines:
        raise Problem("there is no line ESSID=NAME.", "Add the name of the robot's network.")
    with_dhcp = lines.get("USE_DHCP", "0") == "1"
    return Wlan(
        essid=lines["ESSID"],
        ip=None if with_dhcp else lines.get("ETHER_IP", ""),
        netmask=None if with_dhcp else lines.get("ETHER_NETMASK", ""),
        gateway=None if with_dhcp else lines.get("IP_GATEWAY", ""),
        wep_key=lines.get("WEPKEY", "") if lines.get("WEPENABLE", "0") == "1" else None,
        channel=lines.get("CHANNEL", "") if lines.get("APMODE", "1") == "0" else None,
    )


def _essid(essid):
    if not re.fullmatch(r"[!-~]{1,32}", essid):
        raise Problem(f"the network's name '{essid}' cannot be used by the robot.",
                      "It must have 1 to 32 letters, digits and symbols of ASCII, without spaces.")
    return essid


def _address_lines(wlan):
    if wlan.ip is None:
        if wlan.netmask is not None or wlan.gateway is not None:
            raise Problem("--netmask and --gateway need --ip.",
                          "Give the robot's address, too, or leave all of them out; then the robot uses DHCP.")
        return {"USE_DHCP": "1"}
    address = _address(wlan.ip, "the robot's address")
    network = _network(address, wlan.netmask or "255.255.255.0")
    gateway = _address(wlan.gateway, "the gateway") if wlan.gateway is not None else address  # as in the guide
    if gateway not in network:
        raise Problem(f"the gateway {gateway} is not in the robot's network, {network}.",
                      "Use the address of the access point's computer, or leave it out if there is none.")
    return {"USE_DHCP": "0", "ETHER_IP": address, "ETHER_NETMASK": network.netmask, "IP_GATEWAY": gateway,
            "DNS_SERVER_1": gateway}


def _address(text, what):
    try:
        address = ipaddress.IPv4Address(text)
    except ValueError:
        raise Problem(f"{what} '{text}' is not an address.", "It has four numbers, such as 192.168.7.2.") from None
    if address.is_loopback or address.is_multicast or address.is_unspecified or address.is_reserved:
        raise Problem(f"{what} {address} cannot be used.", "Use one such as 192.168.7.2.")
    return address


def _network(address, netmask):
    """The network of this address. A valid netmask has all ones before the zeros."""
    octets = re.fullmatch(r"(\d+)\.(\d+)\.(\d+)\.(\d+)", netmask)
    bits = "".join(f"{int(octet):08b}" for octet in octets.groups()) if octets else ""
    if not re.fullmatch(r"(?=.{32}$)1+0{2,}", bits):
        raise Problem(f"'{netmask}' is not a netmask.", "For most networks it is 255.255.255.0.")
    network = ipaddress.IPv4Network((address, bits.count("1")), strict=False)
    if address in (network.network_address, network.broadcast_address):
        raise Problem(f"{address} is the first or last address of {network}, which no robot may have.",
                      "Use one in between.")
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
                  "It must have 5 or 13 letters and digits, or 10 or 26 hexadecimal digits.")


def _channel_lines(channel):
    if channel is None:
        return {"APMODE": "1", "CHANNEL": "3"}  # access points set the channel
    if not re.fullmatch(r"[1-9]|1[01]", channel):
        raise Problem(f"the robot has no channel '{channel}'.", "Its channels are 1 to 11.")
    return {"APMODE": "0", "CHANNEL": channel}
