"""Tests scripts/memory_stick with a fake SDK: what it writes, and what it says when something is wrong. Works on a copy of
the project, in which tests may break things."""
import gzip
import multiprocessing
import os
import re
import runpy
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SHARED = tempfile.TemporaryDirectory()  # of all tests


def copy_project(copy):
    for name in ("scripts", "aibo_rcserver"):
        shutil.copytree(str(PROJECT / name), str(copy / name), ignore=shutil.ignore_patterns("__pycache__"))


COPY = Path(SHARED.name).resolve() / "project"
SCRIPT = COPY / "scripts/memory_stick"
copy_project(COPY)
sys.path.insert(0, str(SCRIPT.parent))
runpy.run_path(str(SCRIPT))  # loads its modules
import fake_program as fake  # noqa: E402
import fake_sdk  # noqa: E402
from stick import Problem, binary, debian, sdk as sony  # noqa: E402
from stick.link import merge, relocations_by_section  # noqa: E402
from stick.wlan import Wlan, wlan_conf  # noqa: E402


def files_of(folder):
    """The files, except for what was built, and when each was last changed."""
    return {path: path.stat().st_ctime_ns for path in folder.rglob("*")
            if path.is_file() and ".build" not in path.parts}


class Workshop(unittest.TestCase):
    """A copy of the project, a fake SDK, libjpeg, and an empty folder for the stick. What a test has changed is made again
    for the next one."""
    made = {COPY: files_of(COPY)}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()
        memory = tempfile.TemporaryDirectory(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)  # for speed
        self.addCleanup(memory.cleanup)
        self.stick = Path(memory.name) / "stick"
        self.project, self.sdk, self.libjpeg = COPY, COPY.with_name("sdk"), COPY.with_name("jpeg-6b")
        shutil.rmtree(str(self.project / ".build/robot"), ignore_errors=True)
        (self.sdk / "log").unlink(missing_ok=True)
        for shared, make in ((self.project, copy_project), (self.sdk, fake_sdk.make_sdk),
                             (self.libjpeg, fake_sdk.make_libjpeg)):
            if self.made.get(shared) != files_of(shared):
                shutil.rmtree(str(shared), ignore_errors=True)
                make(shared)
                self.made[shared] = files_of(shared)

    def run_script(self, *arguments):
        """Runs it in a fork, because Python needs longer to start and to load the modules than the script to check."""
        with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
            def run():
                os.dup2(output.fileno(), 1)
                os.dup2(errors.fileno(), 2)
                sys.argv = [str(SCRIPT), *map(str, arguments)]
                runpy.run_path(str(SCRIPT), run_name="__main__")

            fork = multiprocessing.get_context("fork").Process(target=run)
            fork.start()
            fork.join()
            output.seek(0)
            errors.seek(0)
            return subprocess.CompletedProcess(arguments, fork.exitcode, output.read(), errors.read())

    def make_stick(self, *options):
        return self.run_script("--sdk", self.sdk, "--libjpeg", self.libjpeg, "--output", self.stick, *options)

    def make_stick_with_few_programs(self):
        path = self.folder / "path"
        path.mkdir()
        for name in ("sh", "gzip"):
            (path / name).symlink_to(shutil.which(name))
        with unittest.mock.patch.dict(os.environ, PATH=str(path)):
            return self.make_stick()

    def expect_stick(self, *options):
        done = self.make_stick(*options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def expect_failure(self, done, what, advice):
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(what, done.stderr)
        self.assertIn(advice, done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def wlan_conf(self):
        return (self.stick / "OPEN-R/SYSTEM/CONF/WLANCONF.TXT").read_bytes().decode()


class AStick(Workshop):
    def test_has_system_programs_motions_and_settings(self):
        self.expect_stick("--essid", "AIBO")
        sources = self.project / "aibo_rcserver/memory_stick"
        programs = re.findall(r"^\w+ +(\w+\.BIN) ", (sources / "programs/objects.txt").read_text(), re.MULTILINE)
        self.assertIn("RCSERVER.BIN", programs)
        written, ours, sonys = ({str(path.relative_to(root)) for path in (root / "OPEN-R").rglob("*") if path.is_file()}
                                for root in (self.stick, sources, self.sdk / "OPEN_R/MS_ERS7/WCONSOLE/memprot"))
        self.assertEqual(written, ours | sonys | {"OPEN-R/MW/OBJS/" + name for name in programs}
                         | {"OPEN-R/SYSTEM/CONF/WLANCONF.TXT"})
        self.assertIn("for ERS-7", (self.stick / "OPEN-R/VERSION.txt").read_text())
        self.assertIn("/MS/OPEN-R/MW/OBJS/RCSERVER.BIN", (self.stick / "OPEN-R/MW/CONF/OBJECT.CFG").read_text())
        with gzip.open(str(self.stick / "OPEN-R/MW/OBJS/RCSERVER.BIN")) as program:
            self.assertEqual(program.read(4), b"\x7fELF")
        log = [line.split() for line in (self.sdk / "log").read_text().splitlines()]
        link = next(line for line in log if line[0] == "mkbin" and "RCServer.bin" in line)
        self.assertIn(str(self.project / "aibo_rcserver/memory_stick/programs/RCServer.ocf"), link)
        self.assertIn("RCServer.bin", [Path(line[-1]).name for line in log if line[0] == "mipsel-linux-strip"])

    def test_for_the_ers210_has_its_system(self):
        self.expect_stick("--model", "ERS-210")
        self.assertIn("for ERS-210", (self.stick / "OPEN-R/VERSION.txt").read_text())

    def test_has_helpers_in_a_lower_scheduling_class_than_rcserver(self):
        """The upper four bits of a priority: an object never runs while one of a higher class does (guide, 3.1)."""
        classes = {ocf.stem: int(ocf.read_text().split()[4]) // 16
                   for ocf in (self.project / "aibo_rcserver/memory_stick/programs").glob("*.ocf")}
        self.assertEqual(classes, {"RCServer": 8, "PictureEncoder": 7, "FileKeeper": 7})

    def test_has_a_further_program_for_a_few_lines(self):
        sources = self.project / "aibo_rcserver"
        for name, line in (("memory_stick/programs/objects.txt", "Echo  ECHO.BIN  echo\n"),
                           ("memory_stick/OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/ECHO.BIN\n"),
                           ("memory_stick/OPEN-R/MW/CONF/CONNECT.CFG", "Echo.Out.byte.S Echo.In.byte.O\n")):
            with (sources / name).open("a") as file:
                file.write(line)
        (sources / "memory_stick/programs/Echo.ocf").write_text("object Echo 3072 16384 128 cache tlb user\n")
        (sources / "echo").mkdir()
        (sources / "echo/Echo.cc").write_text("")
        (sources / "echo/stub.cfg").write_text(
            "// Any comment.\nObjectName : Echo\nService : \"Echo.Out.byte.S\", null, null\n"
            "Service : \"Echo.In.byte.O\", null, null\n")
        self.expect_stick()
        self.assertTrue((self.stick / "OPEN-R/MW/OBJS/ECHO.BIN").is_file())
        self.assertTrue((self.project / ".build/robot/Echo/EchoStub.cc").is_file())
        self.assertTrue((self.project / ".build/robot/RCServer/RCServerStub.cc").is_file())

    def test_keeps_its_owners_settings_and_motions(self):
        self.expect_stick("--essid", "FIRST")
        mine = {"MW/CONF/RCSERVER.CFG": "ALLOW_UPLOAD=yes\n", "MW/DATA/P/MINE.MTN": "mine"}
        for name, text in mine.items():
            (self.stick / "OPEN-R" / name).write_text(text)
        said = self.expect_stick()
        for name, text in mine.items():
            self.assertEqual((self.stick / "OPEN-R" / name).read_text(), text)
        self.assertIn("ESSID=FIRST\r\n", self.wlan_conf())
        self.assertIn("WLANCONF.TXT was not changed", said)

    def test_without_a_network_takes_sonys_and_says_so(self):
        said = self.expect_stick()
        self.assertFalse((self.stick / "OPEN-R/SYSTEM/CONF/WLANCONF.TXT").exists())
        self.assertIn("There is no WLANCONF.TXT: the robot takes Sony's settings", said)


class TheNetwork(Workshop):
    def test_with_a_fixed_address(self):
        self.expect_stick("--essid", "AIBO", "--ip", "192.168.7.2", "--netmask", "255.255.252.0", "--gateway", "192.168.4.1",
                          "--wep-key", "Example4Robot")
        self.assertEqual(self.wlan_conf(),
                         "HOSTNAME=AIBO\r\nUSE_DHCP=0\r\nETHER_IP=192.168.7.2\r\nETHER_NETMASK=255.255.252.0\r\n"
                         "IP_GATEWAY=192.168.4.1\r\nDNS_SERVER_1=192.168.4.1\r\nESSID=AIBO\r\nWEPENABLE=1\r\n"
                         "WEPKEY=Example4Robot\r\nAPMODE=1\r\nCHANNEL=3\r\n")

    def test_has_a_key_that_only_its_owner_can_read(self):
        conf = self.stick / "OPEN-R/SYSTEM/CONF/WLANCONF.TXT"
        conf.parent.mkdir(parents=True)
        conf.write_text("ESSID=OLD\r\n")
        conf.chmod(0o644)
        self.expect_stick("--essid", "AIBO", "--wep-key", "Example4Robot")
        self.assertEqual(conf.stat().st_mode & 0o777, 0o600)
        self.assertIn("WEPKEY=Example4Robot", self.wlan_conf())

    def test_has_the_settings_that_were_asked_for(self):
        for wlan, lines in ((Wlan("home!"), ("HOSTNAME=AIBO", "USE_DHCP=1", "ESSID=home!", "WEPENABLE=0", "APMODE=1")),
                            (Wlan("AIBO", ip="10.0.1.100"), ("USE_DHCP=0", "IP_GATEWAY=10.0.1.100", "APMODE=1")),
                            (Wlan("AIBO", wep_key="AIBO2"), ("WEPENABLE=1", "WEPKEY=AIBO2")),
                            (Wlan("AIBO", wep_key="0123456789"), ("WEPENABLE=1", "WEPKEY=0x0123456789")),
                            (Wlan("AIBO", wep_key="0xfedcba9876"), ("WEPENABLE=1", "WEPKEY=0xfedcba9876")),
                            (Wlan("AIBO", wep_key="0123456789abcdef0123456789"),
                             ("WEPENABLE=1", "WEPKEY=0x0123456789abcdef0123456789"))):
            self.assertLessEqual(set(lines), set(wlan_conf(wlan).split("\r\n")))

    def test_that_cannot_be_is_refused_with_what_to_do(self):
        for setting, what, advice in (
                ({"essid": ""}, "the network's name '' cannot be", "1 to 32 letters"),
                ({"essid": "x" * 33}, "cannot be used by the robot", "1 to 32 letters"),
                ({"essid": "my home"}, "'my home' cannot be", "without spaces"),
                ({"wep_key": "AIBO"}, "the WEP key has 4 characters", "5 or 13 letters"),
                ({"wep_key": "AIB-2"}, "the WEP key has 5 characters, or", "5 or 13 letters"),
                ({"wep_key": "012345678g"}, "the WEP key has 10 characters", "10 or 26"),
                ({"netmask": "255.255.255.0"}, "--gateway need --ip", "DHCP"),
                ({"ip": "192.168.7"}, "address '192.168.7' is not an address", "four numbers"),
                ({"ip": "127.0.0.1"}, "127.0.0.1 cannot be", "192.168.7.2"),
                ({"ip": "0.0.0.0"}, "0.0.0.0 cannot be", ""), ({"ip": "224.0.0.1"}, "224.0.0.1 cannot be", ""),
                ({"ip": "240.0.0.1"}, "240.0.0.1 cannot be", ""),
                ({"ip": "192.168.7.0"}, "first or last address of 192.168.7.0/24", ""),
                ({"ip": "192.168.7.255"}, "first or last address of 192.168.7.0/24", "in between"),
                ({"ip": "192.168.7.2", "netmask": "255.0.255.0"}, "'255.0.255.0' is not a netmask", "255.255.255.0"),
                ({"ip": "192.168.7.2", "gateway": "192.168.8.1"}, "not in the robot's network", "access point's computer")):
            with self.subTest(setting), self.assertRaises(Problem) as refusal:
                wlan_conf(Wlan(**{"essid": "AIBO", **setting}))
            self.assertIn(what, refusal.exception.args[0])
            self.assertIn(advice, " ".join(refusal.exception.advice))

    def test_is_checked_before_anything_is_written(self):
        self.expect_failure(self.make_stick("--ip", "192.168.7.2"), "WLAN options need --essid", "Add it")
        self.expect_failure(self.make_stick("--essid", "my home"), "'my home' cannot be", "without spaces")
        self.assertFalse(self.stick.exists())


class AnIncompleteSdk(Workshop):
    def test_is_told_what_it_lacks(self):
        system = "OPEN_R/MS_ERS7/WCONSOLE/memprot/OPEN-R/"
        for path, what, advice in (
                ("bin/mipsel-linux-strip", "lacks the cross compiler: bin/mipsel-linux-strip", "GCC 3.3"),
                ("bin/cc1plus", "bin/cc1plus does not run on this computer", "--compiler debian"),
                ("OPEN_R/lib/libOPENR.a", "lacks OPEN-R's libraries: OPEN_R/lib/libOPENR.a", "OPEN_R_SDK-1.1.5"),
                ("OPEN_R/include/MCOOP/ant.h", "lacks OPEN-R's headers: OPEN_R/include/MCOOP/ant.h", "Unpack"),
                ("OPEN_R/bin/mkbin", "lacks OPEN-R's Perl programs: OPEN_R/bin/mkbin", "Unpack"),
                (system + "APERIOS.GZ", "is not whole: OPEN-R/APERIOS.GZ is not there", "OBJS"),
                (system + "SYSTEM/OBJS/IPSTACK.BIN", "is not whole: OPEN-R/SYSTEM/OBJS/IPSTACK.BIN is not", "OBJS")):
            with self.subTest(path=path):
                (self.sdk / path).rename(self.folder / "taken_away")
                self.expect_failure(self.make_stick(), what, advice)
                (self.folder / "taken_away").rename(self.sdk / path)
        self.expect_stick()

    def test_on_a_computer_without_the_programs_that_it_needs(self):
        self.expect_failure(self.make_stick_with_few_programs(), "there is no perl on this computer", "install make")

    def test_whose_tools_do_not_run_here(self):
        tool = self.sdk / "bin/mipsel-linux-gcc"
        tool.write_text("#!/bin/sh\necho 'GLIBC_2.38 not found' >&2\nexit 1\n")
        self.expect_failure(self.make_stick(), "mipsel-linux-gcc does not run on this computer: GLIBC_2.38 not found",
                            "libc6:i386")

    def test_that_is_not_there(self):
        for arguments in ((), ("--sdk", self.folder, "--libjpeg", self.libjpeg, "--output", self.stick)):
            self.expect_failure(self.run_script(*arguments), "OPEN-R SDK", "has withdrawn it")


class ABuild(Workshop):
    def test_needs_libjpeg_6b(self):
        (self.libjpeg / "jpeglib.h").write_text("#define JPEG_LIB_VERSION  80\n")
        self.expect_failure(self.make_stick(), "is not from libjpeg 6b", "jpegsrc.v6b.tar.gz")
        (self.libjpeg / "jpeglib.h").unlink()
        self.expect_failure(self.make_stick(), "no sources of libjpeg", "jpegsrc.v6b.tar.gz")

    def test_that_fails_says_so_and_writes_no_stick(self):
        (self.sdk / "undefined").write_text("         U jpeg_read_header\n")
        self.expect_failure(self.make_stick(), "RCServer: the symbols above are defined nowhere", "the build failed")
        (self.libjpeg / "jutils.c").unlink()
        self.expect_failure(self.make_stick(), "the build failed", "No rule to make target")
        self.assertFalse(self.stick.exists())

    def test_that_makes_a_faulty_or_unusual_program_says_so_and_writes_no_stick(self):
        whole = (self.sdk / "program").read_bytes()
        for old, new, fault in ((b"mCOOP", b"other", ".SnapShotHdr describes no OPEN-R object"),
                                (struct.pack("<I", 0x1005), struct.pack("<I", 5), "its flags are 0x5")):
            (self.sdk / "program").write_bytes(whole.replace(old, new, 1))
            self.expect_failure(self.make_stick(), fault, "Do not start it on a robot")
            self.assertFalse(self.stick.exists())

    def test_refuses_paths_that_make_and_the_shell_would_carry_out(self):
        plain = self.sdk
        for name in ("my sdk", "$(id)", "`id`", ";id", "a'b", "a#b"):
            self.sdk = self.folder / name
            plain.rename(self.sdk)
            self.expect_failure(self.make_stick(), "there is a space in" if " " in name else
                                "which make and Sony's tools cannot handle", "symbolic link")
            self.sdk.rename(plain)

    def test_needs_a_place_to_write_to(self):
        self.stick = self.folder / "not_mounted" / "stick"
        self.expect_failure(self.make_stick(), "there is no folder", "Is the stick mounted?")
        self.expect_failure(self.run_script("--sdk", self.sdk), "a stick needs --sdk, --libjpeg and --output", "--help")


class Verification(Workshop):
    """Verification of a stick with one problem."""

    def setUp(self):
        super().setUp()
        if Verification.whole_stick is None:  # built once
            self.expect_stick("--essid", "AIBO", "--ip", "192.168.7.2")
            Verification.whole_stick = tempfile.TemporaryDirectory()
            self.addClassCleanup(Verification.whole_stick.cleanup)
            shutil.copytree(str(self.stick), Verification.whole_stick.name + "/stick")
        else:
            shutil.copytree(Verification.whole_stick.name + "/stick", str(self.stick))
        self.open_r = self.stick / "OPEN-R"

    whole_stick = None

    def verify(self):
        return self.run_script("--verify", self.stick)

    def expect_problem(self, path, content, what, advice):
        """Changes a file, or removes it if content is None; expects the problem, and none after the change is undone."""
        file = self.open_r / path
        before = file.read_bytes() if file.exists() else None
        file.unlink() if content is None else file.write_bytes(content)
        self.expect_failure(self.verify(), what, advice)
        file.unlink() if before is None else file.write_bytes(before)
        self.assertEqual(self.verify().returncode, 0)

    def test_of_a_folder_that_is_not_a_stick(self):
        self.expect_failure(self.run_script("--verify", self.folder), "there is no folder OPEN-R", "is mounted")

    def test_of_an_empty_one_names_all_that_it_lacks(self):
        shutil.rmtree(str(self.open_r))
        self.open_r.mkdir()
        said = self.verify()
        for what in ("is not whole: /MS/OPEN-R/APERIOS.GZ is not there", "/MS/OPEN-R/BOOTPARA is not there",
                     "OBJECT.CFG names no program", "CONNECT.CFG is missing"):
            self.expect_failure(said, what, "write the stick again")

    def test_of_the_system(self):
        noise = fake_sdk.system_file("another", 8_000)
        for path, content, fault in (
                ("APERIOS.GZ", None, "is not there"), ("APERIOS.GZ", b"x", "has 1 bytes, Sony's has 400000"),
                ("BOOTPARA", None, "is not there"), ("SYSTEM/OBJS/IPSTACK.BIN", None, "is not there"),
                ("SYSTEM/OBJS/IPSTACK.BIN", b"x", "has 1 bytes, Sony's has 2000 to 200000"),
                ("SYSTEM/OBJS/IPSTACK.BIN", noise[:-1], "does not look like Sony's"),
                ("SYSTEM/OBJS/IPSTACK.BIN", b"<html>Not found" * 800, "does not look like Sony's")):
            self.expect_problem(path, content, f"is not whole: /MS/OPEN-R/{path} {fault}", "write the stick again")

    def test_says_which_revision_of_the_system_it_has(self):
        version = self.open_r / "VERSION.txt"
        self.assertIn("that of the SDK 1.1.5 r5.", self.verify().stdout)
        version.write_text(version.read_text().replace("r5", "r3"))
        said = self.verify().stdout
        self.assertIn("An ERS-7M3 needs r4 or later; r5 is recommended", said)
        self.assertIn("since r5: its WLAN", said)
        self.assertNotIn("r3: its EEPROM", said)
        version.write_text(version.read_text().replace("ERS-7", "ERS-210"))
        self.assertNotIn("M3", self.verify().stdout)
        version.unlink()
        self.assertIn("The revision of Sony's system is not known", self.verify().stdout)

    def test_of_names(self):
        for name in ("mine.mtn", "NINELETTR.MTN", "A.MTN2", "A.B.C", "OH NO.MTN"):
            self.expect_problem("MW/DATA/P/" + name, b"", name + ": the robot does not support such names", "Rename it")

    def test_of_programs(self):
        program = "MW/OBJS/RCSERVER.BIN"
        elf = gzip.decompress((self.open_r / program).read_bytes())
        self.expect_problem(program, None, "OBJECT.CFG names /MS/OPEN-R/MW/OBJS/RCSERVER.BIN", "take the line out")
        self.expect_problem(program, elf, "not packed by gzip", "Build it again")
        self.expect_problem(program, gzip.compress(elf)[:-100], "is not whole", "Build it again")
        self.expect_problem(program, gzip.compress(elf.replace(b"mCOOP", b"other")), "describes no OPEN-R object",
                            "Build it again")
        self.expect_problem(program, gzip.compress(elf[:99_000]), "has 99000 bytes unpacked", "linked with OPEN-R's")
        self.expect_problem(program, gzip.compress(elf + bytes(4_000_000)), "bytes unpacked", "stripped")

    def test_of_object_cfg(self):
        self.expect_problem("MW/CONF/OBJECT.CFG", b"# nothing\n", "names no program", "write the stick again")
        self.expect_problem("MW/CONF/OBJECT.CFG", None, "names no program", "write the stick again")
        self.expect_problem("MW/CONF/OBJECT.CFG", b"/MS/OPEN-R/MW/OBJS/RCSERVER.BIN\n/MS/OPEN-R/MW/OBJS/FILES.BIN\n",
                            "does not name ENCODER.BIN: PictureEncoder would not run",
                            "Add the line /MS/OPEN-R/MW/OBJS/ENCODER.BIN")

    def test_of_connect_cfg(self):
        path = "MW/CONF/CONNECT.CFG"
        effector = b"OVirtualRobotComm.Effector.OCommandVectorData.O"
        self.expect_problem(path, None, "CONNECT.CFG is missing", "write the stick again")
        self.expect_problem(path, b"# first\nRCServer.Efector.OCommandVectorData.S " + effector,
                            "line 2: there is no service RCServer.Efector.OCommandVectorData.S", "misspelt")
        whole = (self.open_r / path).read_text()
        self.expect_problem(path, "".join(line for line in whole.splitlines(True) if "PictureJob" not in line).encode(),
                            "does not connect PictureEncoder.Job.PictureJob.O", "write the stick again")
        self.expect_problem(path, b"RCServer.Effector.OCommandVectorData.S\n", "line 1: a line needs two services",
                            "write the stick again")
        self.expect_problem(path, b"OVirtualRobotComm.Sensor.OSensorFrameVectorData.S " + effector,
                            "have different data types", "the same")

    def test_of_rcserver_cfg(self):
        """What the robot's own reader says; settings_test.cpp has its rules."""
        path, ignored = "MW/CONF/RCSERVER.CFG", "only 127.0.0.1 may connect"
        for content, line in ((b"ALLOW_UPLOAD=maybe\r\n", "line 1: it is neither yes nor no"),
                              ("ALLOW_UPLOAD=yes\x1b\n".encode("utf-16"), "line 1: it has a character that is not ASCII")):
            self.expect_problem(path, content, f"{self.stick}: OPEN-R/MW/CONF/RCSERVER.CFG, {line}", ignored)
        self.expect_problem("MW/CONF/RCSERVER.TXT", b"", "RCSERVER.TXT, which is not read", ignored)
        (self.open_r / path).unlink()
        os.mkfifo(self.open_r / path)
        self.expect_failure(self.verify(), "RCSERVER.CFG cannot be read", ignored)

    def test_of_files_by_other_editors(self):
        """The same files with the marks of Notepad and DOS, and with Latin-1 in a comment."""
        for path in ("MW/CONF/OBJECT.CFG", "MW/CONF/CONNECT.CFG", "SYSTEM/CONF/WLANCONF.TXT"):
            file = self.open_r / path
            before = file.read_bytes().replace(b"\r\n", b"\n")
            for content, is_marked in ((b"\xef\xbb\xbf" + before.replace(b"\n", b"\r\n"), True),
                                       (before.rstrip() + b"\x1a", True),
                                       (b"# f\xfcr\x85\x0c G\xe4ste\n" + before, False)):
                file.write_bytes(content)
                said = self.verify()
                self.assertEqual((said.returncode, said.stderr), (0, ""))
                self.assertEqual(f"{path} has a byte order mark or DOS' end of file" in said.stdout, is_marked)
            file.write_bytes(before)

    def test_of_the_network(self):
        """Installation Guide, 3.2.2."""
        path = "SYSTEM/CONF/WLANCONF.TXT"
        self.expect_problem(path, b"HOSTNAME=AIBO\n", "WLANCONF.TXT: there is no line ESSID=NAME", "Add the name")
        for line, what, advice in (
                (b"WEPENABLE=1\nWEPKEY=short1", "line 5: the WEP key has 6 characters", "5 or 13"),
                (b"ETHER_IP=192.168.7.2\nIP_GATEWAY=192.168.8.1", "line 5: the gateway 192.168.8.1", "access point's"),
                (b"ESSID=SECOND", "line 4: ESSID appears a second time", "Take out"),
                (b"USEDHCP = 1", "line 4: the robot has no setting 'USEDHCP'", "USE_DHCP"),
                (b"\xef\xbb\xbfWEPENABLE=0", "line 4: the robot has no setting '\\ufeffWEPENABLE'", "misspelt"),
                (b"WEPKEY: Secret", "line 4: it is not NAME=VALUE", "begin it with #"),
                (b"HOSTNAME=12345", "line 4: HOSTNAME cannot be '12345'", "at least one letter"),
                (b"WEPENABLE=yes", "line 4: WEPENABLE cannot be 'yes'", "0 or 1"),
                (b"APMODE=3", "line 4: APMODE cannot be '3'", "between two computers"),
                (b"APMODE=0\nCHANNEL=12", "line 5: CHANNEL cannot be '12'", "1 to 11"),
                (b"APMODE=0", "line 4: APMODE=0 needs a line CHANNEL=N", "1 to 11")):
            dhcp = b"USE_DHCP=0" if b"ETHER" in line else b"USE_DHCP=1"
            self.expect_problem(path, b"# mine\nESSID=AIBO\n" + dhcp + b"\n" + line, "WLANCONF.TXT, " + what, advice)

    def test_says_that_the_demo_mode_is_not_what_linux_calls_ad_hoc(self):
        conf = self.open_r / "SYSTEM/CONF/WLANCONF.TXT"
        for mode, is_noted in ((0, True), (1, False), (2, False)):
            conf.write_text(f"ESSID=AIBO\nUSE_DHCP=1\nAPMODE={mode}\nCHANNEL=3\n")
            said = self.verify()
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertEqual("Ad Hoc Demo Mode. An access point and a network" in said.stdout, is_noted)


class AProgram(unittest.TestCase):
    """One without a fault, and each fault alone."""

    def finished(self, relocated=fake.RELOCATED, **contents):
        return merge(fake.linked(**contents), fake.tables(fake.sections(**contents), relocated))

    def expect(self, fault, finished):
        """This fault alone."""
        found = list(binary.Program(finished).problems())
        self.assertEqual(len(found), 1, found)
        self.assertIn(fault, found[0])

    def test_without_a_fault(self):
        program = binary.Program(self.finished(), fake.linked(), relocations_by_section(fake.linked()))
        self.assertEqual((list(program.problems()), program.unusual), ([], []))

    def test_that_is_none(self):
        finished = self.finished()
        for fault, program in (("it is not a whole ELF file", b"text"), ("it is not a whole ELF file", finished[:1000]),
                               ("it is not a program for the robot", fake.elf([]).replace(b"\2\0\x08\0", b"\2\0\x03\0", 1)),
                               ("it has no section .SnapShotHdr, .ObletDependencyDescr", fake.linked()),
                               (".SnapShotHdr describes no OPEN-R object", finished.replace(b"mCOOP", b"other"))):
            self.expect(fault, program)
        for offset, word, fault in (
                (36, 0x50001005, "its flags are 0x50001005"), (36, 0x1001, "its flags are 0x1001"),  # MIPS32, no CPIC
                (36, 0x2005, "its flags are 0x2005"),  # another ABI
                (52 + 2 * 32 + 8, 0xe0000000, "it must have two segments")):
            changed = bytearray(finished)
            struct.pack_into("<I", changed, offset, word)
            self.expect(fault, bytes(changed))
        self.expect("instructions of newer processors than the robot's: 0xc0",
                    self.finished(text=fake.code(0x7c431800)))  # ext

    def test_that_is_unusual_has_no_fault(self):
        """A RoboCup team's program, which its robots ran, had such flags and a function with such a frame."""
        finished = bytearray(self.finished(text=fake.code(0x27bd0000 | -20000 & 0xffff)))
        struct.pack_into("<I", finished, 36, 0x0005)
        program = binary.Program(bytes(finished))
        self.assertEqual(list(program.problems()), [])
        self.assertEqual(program.unusual, ["its flags are 0x5, which do not name the ABI",
                                           "a function needs 20000 bytes of a stack of 32768"])

    def test_with_a_wrong_header(self):
        for faulty, fault in (({"entry": 0x10400000}, "the entry point 0x10000000 is outside of .text"),
                              ({"count": 6}, ".RelEntry counts 6 relocated words, .RelDataEntry has another number")):
            program = binary.Program(merge(fake.linked(), fake.tables(fake.sections(), **faulty)))
            self.assertIn(fault, list(program.problems()))

    def test_with_words_that_the_loader_would_spoil(self):
        words = ".RelDataEntry names words that are not addresses in this program: "
        for places, fault in (((0x400010,), "0x10 is outside of all sections"),
                              (tuple(range(0x400010, 0x400024, 4)), "0x10 is outside of all sections with data, "),
                              ((fake.BSS_AT,), f"{fake.BSS_AT - fake.BASE:#x} is outside"),
                              ((fake.DATA_AT + 4,), f"{fake.DATA_AT + 4 - fake.BASE:#x} holds 0x7"),
                              ((fake.DATA_AT,), "")):  # twice
            self.expect(words + fault, self.finished(fake.RELOCATED + places))
        self.expect(words, self.finished(data=fake.words(fake.RODATA_AT, 7, 0, fake.BASE + 0x1000000)))

    def test_with_addresses_that_the_loader_would_leave(self):
        self.expect(f".RelDataEntry leaves out words of .got: {fake.GOT_AT + 8 - fake.BASE:#x}",
                    self.finished(tuple(place for place in fake.RELOCATED if place != fake.GOT_AT + 8)))
        self.expect(f".ctors has words that are not relocated addresses of functions: {fake.TEXT_AT:#x}",
                    self.finished(tuple(place for place in fake.RELOCATED if place != fake.CTORS_AT + 4)))

    def test_without_the_marks_around_its_constructors(self):
        for ctors in (fake.words(0, fake.TEXT_AT, 0), fake.words(-1, fake.TEXT_AT, 7)):
            self.expect(".ctors does not begin with -1 and end with 0", self.finished(ctors=ctors))
        self.expect(".dtors does not begin with -1 and end with 0", self.finished(dtors=fake.words(-1, 7)))

    def test_whose_code_depends_on_its_address(self):
        wrong_gp = fake.words(*fake.set_gp(fake.TEXT_AT, fake.GP + 0x60), 0x27bdffe0).ljust(fake.TEXT_SIZE, b"\0")
        self.expect("functions compute a gp other than", self.finished(text=wrong_gp))
        self.expect("no function sets gp", self.finished(text=fake.words(0x27bdffe0).ljust(fake.TEXT_SIZE, b"\0")))
        absolute = "code uses addresses that the loader does not adapt: 0xc0"
        self.expect(absolute, self.finished(text=fake.code(0x3c020040, 0x24420100)))  # lui v0,0x40; addiu v0,v0,0x100
        self.expect(absolute, self.finished(text=fake.code(0x3c020040, 0, 0x8c420100)))  # lw v0,0x100(v0)
        self.expect(absolute, self.finished(text=fake.code(0x0c10002c)))  # jal
        a_number = self.finished(text=fake.code(0x3c020040, 0x34420100))  # lui, ori
        self.assertEqual(list(binary.Program(a_number).problems()), [])


class DebiansCompiler(Workshop):
    def test_is_taken_where_the_sdk_has_none(self):
        self.assertEqual(sony.choose_compiler(self.sdk, None), "sdk")
        self.assertEqual(sony.choose_compiler(self.sdk, "debian"), "debian")
        shutil.rmtree(str(self.sdk / "bin"))
        self.assertEqual(sony.choose_compiler(self.sdk, None), "debian")

    def test_needs_the_c_library_and_says_all_that_is_missing(self):
        shutil.rmtree(str(self.sdk / "bin"))
        said = self.make_stick_with_few_programs()
        self.expect_failure(said, "lacks the C library, GNU's newlib: mipsel-linux/lib/libc-.a", "newlib 1.10 to 1.15")
        self.expect_failure(said, "lacks libgcc.a", "instructions that the robot's processor does not know")
        self.expect_failure(said, "Debian's cross compiler is not on this computer", "install_dependencies stick")

    def test_gets_headers_and_a_runtime_that_work(self):
        program = self.folder / "runtime_test"
        subprocess.run(["g++", "-std=gnu++98", "-Wall", "-Werror", "-nostdinc++", f"-I{debian.RUNTIME}/include",
                        "-fno-exceptions", "-fno-rtti", "-nodefaultlibs", "-o", str(program),
                        str(Path(__file__).with_name("runtime_test.cc")), str(debian.RUNTIME / "runtime.cc"), "-lc",
                        "-lgcc"], check=True)
        done = subprocess.run([str(program)], stdout=subprocess.PIPE, universal_newlines=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (0, "text -5 7 0x1a\n"))

    @unittest.skipIf(shutil.which(debian.PREFIX + "g++") is None, "needs scripts/install_dependencies stick")
    def test_links_a_program_that_works_wherever_it_lies(self):
        """A small program goes through all steps of mkbin, with a table of the kind that gensnap makes. Where QEMU is,
        it is placed as the robot does it, and run."""
        tools = self.folder / "tools"
        with unittest.mock.patch.object(debian, "_convert"), unittest.mock.patch.object(debian, "_make_runtime"):
            debian.prepare(self.sdk, tools)
        source = self.folder / "small.cc"
        source.write_text("""
            struct Base { virtual int get() const = 0; };
            struct Two : Base { virtual int get() const; Two(); int number; };
            int constructed;
            Two::Two() : number(2) { ++constructed; }
            int Two::get() const { return number; }
            extern "C" void __cxa_pure_virtual() {}
            extern void (*_ctors_end[])();
            Two two;
            const Base* const all[] = {&two, 0};
            extern "C" int PrologueEntry(int index) {  // like OPEN-R's InitGlobals(), it runs the constructors
              for (int i = -2; index == 1 && _ctors_end[i] != (void (*)())-1; --i) _ctors_end[i]();
              switch (index) {
                case 1: return 70 + constructed; case 2: return two.get(); case 3: return 9; case 4: return 27;
                case 5: return 3; default: return all[index - 6]->get();
              }
            }""")

        def run(*command):
            subprocess.run([str(word) for word in command], check=True, cwd=str(self.folder))

        run(tools / "bin/mipsel-linux-g++", "-O2", "-c", "-o", "small.o", source)
        for output, assembler in (("crtbegin.o", "begin.S"), ("crtend.o", "end.S")):
            run(tools / "bin/mipsel-linux-gcc", "-c", "-o", tools / "lib" / output, debian.RUNTIME / assembler)
        script = tools / "mipsel-linux/lib/ldscripts/elf32ltsmip.xbn"
        (self.folder / "defsym").write_text("_ctors_end = ADDR(.ctors) + SIZEOF(.ctors);")
        objects = ["-T", script, "-T", "defsym", "-e", "PrologueEntry", tools / "lib/crtbegin.o", "small.o",
                   tools / "lib/crtend.o"]
        run(tools / "bin/ld", "-o", "small.nosnap.elf", *objects)
        run(tools / "bin/ld", "-r", "-o", "small.rel.elf", *objects)
        linked, relocations = ((self.folder / f"small.{name}.elf").read_bytes() for name in ("nosnap", "rel"))
        program, places = self.sections_and_addresses(linked, relocations)
        entry = binary.ELFFile(binary.io.BytesIO(linked)).header["e_entry"]
        (self.folder / "small.snap.elf").write_bytes(fake.tables(program, places, entry=entry))
        run(tools / "bin/ld", "-T", "ldscript-merge", "-o", "small.bin", "small.nosnap.elf", "small.snap.elf")
        finished = binary.Program((self.folder / "small.bin").read_bytes(), linked, relocations)
        self.assertEqual(list(finished.problems()), [])
        if shutil.which("qemu-mipsel"):
            self.run_placed(entry - fake.BASE)

    def run_placed(self, entry):
        place = self.folder / "place"
        subprocess.run([debian.PREFIX + "gcc", "-static", "-o", str(place), str(Path(__file__).with_name("place.c"))],
                       check=True)
        program = binary.ELFFile(binary.io.BytesIO((self.folder / "small.bin").read_bytes()))
        segment, table = program.get_segment(1), program.get_section_by_name(".RelDataEntry")
        for address in (0x20000000, 0x30405000):
            numbers = (segment["p_filesz"], segment["p_memsz"], table["sh_offset"], table["sh_size"], entry, address)
            done = subprocess.run(["qemu-mipsel", str(place), str(self.folder / "small.bin"),
                                   *map("{:x}".format, numbers)], stdout=subprocess.PIPE, universal_newlines=True, timeout=60, check=False)
            self.assertEqual(done.stdout.split(), ["71", "2", "9", "27", "3", "2"], done)

    @staticmethod
    def sections_and_addresses(linked, relocations):
        """What gensnap reads: the sections as in fake_program, and the places of R_MIPS_32 and of all words of .got."""
        elf, tables = binary.ELFFile(binary.io.BytesIO(linked)), binary.ELFFile(binary.io.BytesIO(relocations))
        placed = {section.name: section for section in elf.iter_sections()
                  if section["sh_flags"] & 2 and section["sh_type"] != "SHT_REL"}
        program = [(name, fake.NOBITS if section["sh_type"] == "SHT_NOBITS" else fake.PROGBITS, 0, section["sh_addr"],
                    section["sh_size"] if section["sh_type"] == "SHT_NOBITS" else section.data())
                   for name, section in placed.items()]
        places = [placed[table.name[4:]]["sh_addr"] + relocation["r_offset"]
                  for table in tables.iter_sections("SHT_REL") if table.name[4:] in placed
                  for relocation in table.iter_relocations() if relocation["r_info_type"] == fake.R_MIPS_32]
        got = placed[".got"]
        return program, places + list(range(got["sh_addr"], got["sh_addr"] + got["sh_size"], 4))


class TheSources(unittest.TestCase):
    robot = subprocess.run(["make", "-s", "-C", str(PROJECT / "aibo_rcserver/memory_stick/programs"), "sources"],
                           stdout=subprocess.PIPE, universal_newlines=True, check=True).stdout.split()

    def test_are_the_same_for_the_robot_and_for_linux(self):
        """ROBOT_SOURCES is a file in which CMake lists the sources that it builds for the robot, one per line."""
        linux = Path(os.environ["ROBOT_SOURCES"]).read_text().split()
        self.assertGreater(len(self.robot), 30)
        self.assertEqual(sorted(self.robot), sorted(linux))

    def test_include_only_what_the_robots_c_library_and_sonys_headers_have(self):
        """Linux has more, such as <strings.h>. Of newlib, these have been used so far."""
        openr = PROJECT / "aibo_rcserver/simulator/openr_host/sdk"
        known = {str(path.relative_to(openr)) for path in openr.rglob("*.h")}.union(
            "def.h entry.h jerror.h jpeglib.h algorithm ctype.h dirent.h limits.h math.h setjmp.h stdarg.h stddef.h "
            "stdio.h stdlib.h string.h".split())
        folders = {Path(source).parent for source in self.robot}
        for path in (path for folder in sorted(folders) for path in (*folder.glob("*.cc"), *folder.glob("*.h"))):
            included = re.findall(r"^\s*#\s*include\s*<([^>]+)>", path.read_text(), re.MULTILINE)
            self.assertEqual(set(included) - known, set(), path)


if __name__ == "__main__":
    unittest.main()
