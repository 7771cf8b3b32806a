"""Tests that the programs accept the files of config/wlan, and that these files agree with each other and docs/wlan.md."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
CONFIG = PROJECT / "config" / "wlan"
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"  # missing in the PATH of ordinary users

sys.path.insert(0, str(PROJECT / "scripts"))
from stick.wlan import Wlan, wlan_conf  # noqa: E402


def path_of(program):
    path = shutil.which(program, path=PATH)
    if path is None:
        raise AssertionError(f"there is no {program}: scripts/install_dependencies wlan installs it.")
    return path


def run(program, *arguments):
    return subprocess.run([path_of(program), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          universal_newlines=True, check=False)


def check_nft(rules):
    """Even to check rules, nft wants to be root; ordinary users are root in a namespace of their own."""
    if run("nft", "list", "tables").returncode == 0:
        return run("nft", "-c", "-f", rules)
    return run("unshare", "-rn", path_of("nft"), "-c", "-f", rules)


def check_dnsmasq(configuration):
    return run("dnsmasq", "--test", "-C", configuration)


STARTING = "interface state UNINITIALIZED->"


def check_hostapd(configuration):
    """hostapd has no option to check a file. Without a radio (driver=none), it starts after accepting all lines."""
    with tempfile.TemporaryDirectory() as folder:
        without_radio = Path(folder, "hostapd.conf")
        without_radio.write_text(configuration.read_text().replace("driver=nl80211", "driver=none"))
        command = [path_of("hostapd"), str(without_radio)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True) as hostapd:
            said = ""
            for line in hostapd.stdout:
                said += line
                if STARTING in line:
                    hostapd.kill()
        return subprocess.CompletedProcess(command, 0 if STARTING in said else 1, said)


class EachProgram(unittest.TestCase):
    """Each program accepts its file and refuses an unknown word, because a check that accepts everything proves nothing."""

    def test_takes_its_file(self):
        for check, name, nonsense in (
                (check_nft, "aibo.nft", "table inet aibo { chain input { iifname nowhere dropp } }\n"),
                (check_dnsmasq, "dnsmasq.conf", "dhcp-rang=192.168.7.2\n"),
                (check_hostapd, "hostapd.conf", "wep_key5=0123456789\n")):
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                done = check(CONFIG / name)
                self.assertEqual(done.returncode, 0, done.stdout)
                wrong = Path(folder, name)
                wrong.write_text((CONFIG / name).read_text() + nonsense)
                self.assertNotEqual(check(wrong).returncode, 0)


class TheFiles(unittest.TestCase):
    def setUp(self):
        self.hostapd = dict(re.findall(r"^(\w+)=(.*)$", (CONFIG / "hostapd.conf").read_text(), re.MULTILINE))
        self.dnsmasq = (CONFIG / "dnsmasq.conf").read_text()
        self.nft = (CONFIG / "aibo.nft").read_text()

    def stick(self):
        """The lines of WLANCONF.TXT that the command in docs/wlan.md writes."""
        command = re.search(r"scripts/memory_stick ([^`]*?--essid[^`]*?)\n\n", (PROJECT / "docs/wlan.md").read_text())
        options = dict(re.findall(r"--(essid|ip|gateway|wep-key) (\S+)", command.group(1)))
        options["wep_key"] = options.pop("wep-key")
        return dict(line.split("=") for line in wlan_conf(Wlan(**options)).split())

    def test_mean_the_same_network_as_the_stick(self):
        stick = self.stick()
        self.assertEqual(stick["ESSID"], self.hostapd["ssid"])
        self.assertEqual(f'"{stick["WEPKEY"]}"', self.hostapd["wep_key0"])
        self.assertEqual(stick["APMODE"], "1")
        self.assertIn(f"dhcp-range={stick['ETHER_IP']},{stick['ETHER_IP']},{stick['ETHER_NETMASK']},", self.dnsmasq)
        self.assertIn(f"option:router,{stick['IP_GATEWAY']}\n", self.dnsmasq)
        self.assertIn(f"define robot = {stick['ETHER_IP']}\n", self.nft)
        self.assertIn(int(self.hostapd["channel"]), range(1, 12))
        self.assertEqual(self.hostapd["hw_mode"], "b")
        self.assertEqual(self.hostapd["max_num_sta"], "1")
        self.assertIn(f"interface={self.hostapd['interface']}\n", self.dnsmasq)
        self.assertIn(f'define robot_wlan = "{self.hostapd["interface"]}"\n', self.nft)


if __name__ == "__main__":
    unittest.main()
