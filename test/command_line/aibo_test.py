"""The program aibo as its users and their scripts see it: exit status, files, JSON; with servers of both versions, with
none, with one that is busy, and with one that is hostile."""
import itertools
import json
import math
import os
import re
import select
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import time
import unittest
import wave
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
AIBO = os.environ["AIBO"]
RCSERVER = os.environ["AIBO_RCSERVER"]
STICK = Path(RCSERVER).parents[2] / "share/aibo_driver/memory_stick"
NOD = PROJECT / "aibo_rcserver/memory_stick/OPEN-R/MW/DATA/P/NOD.MTN"
DONE, FAILED, WRONG_USAGE, UNREACHABLE = range(4)
CONTROL = re.compile(rb"[\x00-\x09\x0b-\x1f\x7f]")


def environment():
    return {name: value for name, value in os.environ.items() if name != "AIBO_HOST"}


def run(*words, port, folder="."):
    return subprocess.run([AIBO, "--port", str(port), *map(str, words)], capture_output=True, timeout=120, cwd=folder,
                          env=environment(), check=False)


def start(*words, port, stderr=subprocess.PIPE, **options):
    return subprocess.Popen([AIBO, "--port", str(port), *words], env=environment(), stdout=subprocess.PIPE,
                            stderr=stderr, **options)


def complaints(process):
    """What it wrote, but for a connection that a busy computer has lost."""
    return [line for line in process.stderr.read().splitlines() if b"No connection to the robot" not in line]


class SimulatedRobot:
    def __init__(self, *options, port=0, console=None):
        options += ("--no-console",) if console is None else ("--console-port", str(console))
        self.process = subprocess.Popen([RCSERVER, "--port", str(port), *options], stdout=subprocess.PIPE, text=True)
        for line in self.process.stdout:
            if found := re.match(r"Console on [\d.]+:(\d+)", line):
                self.console_port = int(found[1])
            if found := re.match(r"RCServer listening on [\d.]+:(\d+)", line):
                self.port = int(found[1])
                break
        self.reader = threading.Thread(target=self.process.stdout.read, daemon=True)
        self.reader.start()

    def ask(self, command):
        """The robot's answer at its console."""
        with socket.create_connection(("127.0.0.1", self.console_port), timeout=60) as console:
            console.sendall(command.encode() + b"\n")
            lines = (line.split() for line in console.makefile())  # the robot's own messages come there, too
            answer = next(line for line in lines if line[:2] == ["ok:", command.split()[0]])
        return " ".join(answer[len(command.split()) + 1:])

    def wait_for_change(self, question, process):
        """Asks at the console until the answer is another one, while the process runs."""
        before, limit = self.ask(question), time.monotonic() + 60
        while self.ask(question) == before:
            assert process.poll() is None and time.monotonic() < limit

    def end(self):
        self.process.kill()
        self.process.wait()
        self.reader.join()
        self.process.stdout.close()


def version2_frame(kind, payload, number=0, identifier=0):
    return struct.pack(">cBHI", kind, identifier, number, len(payload)) + payload


class ScriptedServer:
    """Serves each client by `serve`, which gets its socket; then the connection ends."""

    def __init__(self, serve, address="127.0.0.1"):
        self.socket = socket.create_server((address, 0))
        self.port = self.socket.getsockname()[1]
        self.serve = serve
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        while True:
            try:
                client = self.socket.accept()[0]
            except OSError:
                return
            with client:
                try:
                    self.serve(client)
                except OSError:
                    pass

    def end(self):
        self.socket.close()


def says_hello(server, names=b"", flood=None, answers=None, until=None, heard=None):
    """A server of version 2 with a name, which lists motions of these names, tells its motors and its camera, and
    refuses everything else. What `flood` makes of a number comes without end. `answers` has, for a kind of request, its
    replies in turn, each with what is pushed then; the last one comes again and again. None is the usual reply, b"-" is
    none, and ## stands for the number of the first order to move. The connection ends after requests of the kinds
    `until`. `heard` gets the kind, id and payload of each request."""
    hello = b"robot=ERS-7\nserver=%s\nframe_number=4294967000\ncapabilities=H F W J V T O I L K G P N %s\nlimits=\n" % (
        server, b" ".join(answers or ()))

    numbers = itertools.count()

    def serve(client):
        client.recv(2, socket.MSG_WAITALL)
        client.sendall(b"x\x02\x00\x00")
        is_greeted = False
        kinds = b""
        order = b"##"
        while True:
            if flood and is_greeted and not select.select([client], [], [], 0)[0]:
                client.sendall(b"".join(flood(next(numbers)) for _ in range(100)))
                continue
            if len(header := client.recv(8, socket.MSG_WAITALL)) < 8:
                return
            is_greeted = True
            kind, identifier, number, size = struct.unpack(">cBHI", header)
            asked = client.recv(size, socket.MSG_WAITALL)
            kinds += kind
            if heard is not None:
                heard.append((kind, identifier, asked))
            if order == b"##" and (kind in b"JEP" or kind == b"S" and any(asked[4:])):
                order = struct.pack(">H", number)
            if until and kinds.endswith(until):
                return
            left = (answers or {}).get(kind, [[None]])
            payload, *pushed = left.pop(0) if len(left) > 1 else left[0]
            payload = {b"H": hello, b"N": names, b"O": b"\1", b"G": asked or b"\1"}.get(kind) if payload is None else payload
            if payload != b"-":
                client.sendall(version2_frame(b"e", b"\0\0no " + kind, number) if payload is None else
                               version2_frame(kind.lower(), payload.replace(b"##", order), number, identifier))
            client.sendall(b"".join(version2_frame(pushed_kind, content.replace(b"##", order), *rest)
                                    for pushed_kind, content, *rest in pushed))
    return serve


def measured(frame=4294967295, **groups):
    """Pushed telemetry: the values of some joints (J) and sensors (S) by their identifiers."""
    values = [struct.pack(">cBxxi", group.encode(), *item) for group in groups for item in groups[group].items()]
    return b"t", struct.pack(">IHxx", frame, len(values)) + b"".join(values)


class TestCase(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="aibo tést."))
        self.addCleanup(shutil.rmtree, self.folder)

    def server(self, serve, *address):
        server = ScriptedServer(serve, *address)
        self.addCleanup(server.end)
        return server.port

    def robot_with(self, settings, *options, **console):
        """A robot with these lines in its RCSERVER.CFG."""
        stick = self.folder / "stick"
        shutil.copytree(STICK, stick)
        (stick / "OPEN-R/MW/CONF/RCSERVER.CFG").write_text(settings)
        robot = SimulatedRobot("--memory-stick", stick, *options, **console)
        self.addCleanup(robot.end)
        return robot

    def aibo(self, *words, status=DONE, port=None):
        """Runs a command. In any case, nothing that a terminal obeys comes out, and a failure is reported once."""
        result = run(*words, port=port or self.robot.port, folder=self.folder)
        self.assertEqual(result.returncode, status, (words, result.stdout, result.stderr))
        self.assertNotRegex(result.stderr, CONTROL)
        result.errors = result.stderr.decode()
        if status != DONE and "doctor" not in words:
            problem = result.errors.splitlines()[-1].split("aibo: ", 1)[1]
            said = json.loads(result.stdout or "{}")
            self.assertEqual(said, {"error": problem, "status": status} if "--json" in words else {})
        return result

    def text(self, *words, status=DONE, **options):
        """What a command says on the standard output; if it is done, it says nothing else."""
        result = self.aibo(*words, status=status, **options)
        self.assertEqual(result.errors if status == DONE else "", "")
        return result.stdout.decode()

    def json(self, *words, **options):
        return json.loads(self.text("--json", *words, **options))

    def examined(self):
        """The report of a short examination. On a busy computer, the stream is slow, and doctor says so. If the robot was
        silent for so long that there is none, it is examined again."""
        for _ in range(10):
            result = run("--json", "doctor", "--seconds", "1.2", port=self.robot.port)
            report = json.loads(result.stdout)
            if report["stream"]:
                break
        self.assertGreaterEqual(report["stream"]["seconds"], 1.2)
        self.assertEqual(result.returncode, DONE if report["good"] else FAILED, result)
        return report


class OnBothVersions:
    """What a server of 2006 can do, too."""

    def test_takes_a_picture(self):
        picture = self.json("picture", "-o", "a.jpg")
        content = (self.folder / "a.jpg").read_bytes()
        self.assertEqual(picture, {"file": f"{self.folder}/a.jpg", "width": 208, "height": 160, "bytes": len(content)})
        self.assertEqual(content[:3], b"\xff\xd8\xff")

    def test_writes_a_picture_to_a_pipe(self):
        result = self.aibo("picture", "-o", "/dev/stdout")
        self.assertEqual((result.stdout[:3], result.stdout[-2:]), (b"\xff\xd8\xff", b"\xff\xd9"))
        self.assertIn(f"208x160 pixels, {len(result.stdout)} bytes: /dev/stdout\n", result.errors)

    def test_gives_a_picture_a_name(self):
        def now():
            return time.strftime("aibo_%Y%m%d_%H%M%S", time.gmtime(time.time() + 9 * 3600))
        begin = now()
        subprocess.run([AIBO, "--port", str(self.robot.port), "picture"], cwd=self.folder, timeout=120, check=True,
                       stdout=subprocess.DEVNULL, env={**environment(), "TZ": "Here-9"})
        name, = os.listdir(self.folder)
        self.assertTrue(begin <= name[:-len("_123.jpg")] <= now(), name)

    def test_replaces_nothing_but_jpegs(self):
        (self.folder / "a.jpg").write_text("precious")
        self.assertIn("not a JPEG", self.aibo("picture", "-o", "a.jpg", status=FAILED).errors)
        self.assertIn("that does not name a file", self.aibo("picture", "-o", "", status=FAILED).errors)
        self.assertEqual((self.folder / "a.jpg").read_text(), "precious")

    def test_moves_joints_until_they_have_arrived(self):
        joints = self.json("move", "head_pan=20deg", "tail_pan=-0.2rad", "--speed", "120deg/s")["joints"]
        self.assertEqual([joint["name"] for joint in joints], ["head_pan", "tail_pan"])
        for joint, wanted in zip(joints, (0.349, -0.2)):
            self.assertAlmostEqual(joint["position"], wanted, delta=0.05)  # as near as the robot calls it done
            self.assertFalse(joint["clamped"])
        self.assertAlmostEqual(self.position("head_pan"), 0.349, delta=0.03)  # and they stay

    def position(self, name):
        joint = next(joint for joint in self.json("joints")["joints"] if joint["name"] == name)
        self.assertTrue(joint["lowest"] - 0.05 <= joint["position"] <= joint["highest"] + 0.05, joint)
        return joint["position"]

    def test_moves_joints_as_slowly_as_asked(self):
        self.json("move", "head_pan=0deg", "tail_pan=0deg", "--speed", "120deg/s")
        for target, option in ((20, ["--duration", 1.5]), (0, ["--speed", "14deg/s"])):
            begin = time.monotonic()
            said = self.text("move", f"head_pan={target}deg", "tail_pan=10deg", *option)
            self.assertGreater(time.monotonic() - begin, 1.4, option)
            self.assertRegex(said, r"^head_pan is at -?\d+\.\d degrees\ntail_pan is at \d+\.\d degrees\n$")

    def test_says_which_joint_does_not_follow(self):
        self.robot.ask("jam head_pan")
        self.addCleanup(self.robot.ask, "free head_pan")
        jammed = self.aibo("move", "head_pan=40deg", "tail_pan=5deg", "--speed", "170deg/s", status=FAILED)
        self.assertRegex(jammed.errors, self.JAMMED)

    def test_says_what_was_clamped(self):
        result = self.aibo("--json", "move", "tail_pan=1deg", "mouth=30deg", "head_tilt=-15deg", "--speed", "120deg/s")
        joint = json.loads(result.stdout)["joints"][1]
        self.assertTrue(joint["clamped"])
        self.assertAlmostEqual(joint["target"], -0.052, delta=0.01)  # 3 degrees
        for note in ("mouth cannot go to 30.0 degrees, beyond the joint's limit: it goes to -3.0 degrees.\n",
                     "head_tilt cannot go to -15.0 degrees, where another joint or the body is in its way: it goes to "):
            self.assertIn(note, result.errors)

    def test_moves_nothing_if_one_joint_is_misspelt(self):
        before = self.position("tail_tilt")
        self.assertIn("the ERS-7 has no joint 'nose': `aibo joints` lists them",
                      self.aibo("move", "tail_tilt=50deg", "nose=1deg", status=WRONG_USAGE).errors)
        self.assertAlmostEqual(self.position("tail_tilt"), before, delta=0.01)

    def test_shows_sensors(self):
        sensors = {sensor["name"]: sensor for sensor in self.json("sensors")["sensors"]}
        self.assertEqual(len(sensors), 18)
        self.assertTrue(sensors["paw_left_front"]["pressed"])
        self.assertIsNone(sensors["range_near"]["pressed"])
        self.assertTrue(0.5 < sensors["battery"]["value"] <= 1 and 0 < sensors["temperature"]["value"] < 60, sensors)

    def test_plays_a_motion_for_a_time(self):
        begin = time.monotonic()
        played = self.aibo("--json", "play", "wag", "--times", "50", "--seconds", "1")
        self.assertGreater(time.monotonic() - begin, 1)
        self.assertEqual((json.loads(played.stdout)["to_its_end"], played.errors), (False, ""))
        self.assertIn("NONE.MTN", self.aibo("play", "none", status=FAILED).errors)
        self.aibo("play", "../../x", status=WRONG_USAGE)

    def test_uploads_and_deletes_only_what_is_allowed(self):
        self.aibo("upload", NOD, "wave", status=FAILED)
        self.assertIn("not a motion", self.aibo("upload", PROJECT / "package.xml", "wave", status=FAILED).errors)
        self.aibo("upload", NOD, "con", status=WRONG_USAGE)
        self.aibo("delete", "nod", status=FAILED)

    def test_watches_the_stream(self):
        lines = list(map(json.loads, self.aibo("--json", "watch", "--seconds", "1.4").stdout.splitlines()))
        for line in lines:
            self.assertEqual((line["connected"], line["problem"]), (True, ""))
            self.assertGreater(line["stream"]["bytes"], 1000 * line["stream"]["pictures"])
        first, rest = (line["stream"]["seconds"] for line in lines)
        self.assertTrue(first >= 1 and first + rest >= 1.4, lines)

    def test_pipes_the_stream_to_a_player(self):
        result = self.aibo("watch", "--seconds", "1", "--play")
        self.assertEqual(result.stdout[:3], b"\xff\xd8\xff")
        self.assertIn("pictures/s", result.errors)

    def test_examines_the_way_to_the_robot(self):
        report = self.examined()
        self.assertEqual({finding["topic"] for finding in report["findings"]} -
                         {"allows"}, {"server", "battery", "stream", "gaps"})
        self.assertEqual((report["host"], report["port"]), ("127.0.0.1", self.robot.port))
        texts = {finding["topic"]: finding["text"] for finding in report["findings"]}
        self.assertRegex(texts["server"], self.SERVER)
        gap = report["stream"]["longest_gap"]
        self.assertEqual(texts["gaps"], f"the longest time without a picture was {1000 * gap:.0f} ms")
        self.assertEqual([finding["good"] for finding in report["findings"] if finding["topic"] == "gaps"], [gap < 0.5])

    def test_ctrl_c_ends_watching(self):
        with start("watch", port=self.robot.port) as watch:
            watch.stdout.readline()
            watch.send_signal(signal.SIGINT)
            self.assertEqual((watch.wait(60), complaints(watch)), (DONE, []))

    def test_ctrl_c_stops_a_joint(self):
        self.aibo("move", "head_pan=0deg", "tail_pan=-9deg", "--speed", "170deg/s")
        with start("move", "tail_pan=40deg", "head_pan=80deg", "--speed", "5deg/s", port=self.robot.port) as move:
            self.robot.wait_for_change("joint head_pan", move)  # 16 s of movement
            move.send_signal(signal.SIGINT)
            self.assertEqual(move.wait(60), 130)
            move.communicate()
        before = self.position("head_pan")
        self.assertLess(before, 1)
        self.assertAlmostEqual(self.position("head_pan"), before, delta=0.01)

    def test_a_reader_that_goes_ends_it_without_a_word(self):
        with start("watch", port=self.robot.port, restore_signals=False) as watch:  # Python ignores SIGPIPE
            watch.stdout.readline()
            watch.stdout.close()
            self.assertEqual(watch.wait(60), -signal.SIGPIPE)
            self.assertEqual(complaints(watch), [])

    def test_a_full_disk_is_said(self):
        with open("/dev/full", "wb") as full:
            result = subprocess.run([AIBO, "--port", str(self.robot.port), "joints"], stdout=full,
                                    stderr=subprocess.PIPE, timeout=120, check=False)
        self.assertEqual(result.returncode, FAILED)
        self.assertIn(b"No space left", result.stderr)


class Version1(OnBothVersions, TestCase):
    SERVER = "^speaks version 1 of the protocol"
    JAMMED = "move joint 2: the joint does not follow its commands"

    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot("--protocol-version", "1", console=0)
        cls.addClassCleanup(cls.robot.end)

    def test_says_what_such_a_server_cannot_do(self):
        for words in (["motions"], ["stand"], ["sit"], ["rest"], ["walk", "forward=5cm/s"], ["motors", "on"],
                      ["picture", "--resolution", "52x40"]):
            with self.subTest(words):
                self.assertIn("version 1", self.aibo(*words, status=FAILED).errors)
        self.assertIn("set its camera", self.aibo("picture", "--gain", "high", status=FAILED).errors)

    def test_plays_for_ten_seconds_because_it_does_not_know_the_end(self):
        begin = time.monotonic()
        played = self.aibo("play", "wag", "--times", "50")
        self.assertGreater(time.monotonic() - begin, 10)
        self.assertIn("it is stopped after 10 s", played.errors)
        self.assertEqual(played.stdout, b"WAG.MTN was played, and stopped when its time was over.\n")

    def test_stops_motions(self):
        self.assertEqual(self.json("stop"), {"stopped": True, "holds": False})

    def test_does_not_know_how_old_pictures_are_and_how_many_are_lost(self):
        stream = json.loads(self.aibo("--json", "watch", "--seconds", "1").stdout.splitlines()[0])["stream"]
        self.assertEqual((stream["age"], stream["worst_age"], stream["loss"]), (None, None, None))


class Version2(OnBothVersions, TestCase):
    SERVER = " on an ERS-7, version 2 of the protocol$"
    JAMMED = "the movement could not go on: .*head_pan"

    @classmethod
    def setUpClass(cls):
        cls.robot = SimulatedRobot(console=0)
        cls.addClassCleanup(cls.robot.end)

    def test_plays_a_motion_to_its_end(self):
        answer = self.json("play", "nod")
        self.assertEqual((answer["motion"], answer["to_its_end"], answer["changes"]), ("NOD.MTN", True, ""))
        slow = self.aibo("--json", "play", "nod", "--speed", "20deg/s")
        changes = json.loads(slow.stdout)["changes"]
        self.assertIn("too fast", changes)
        self.assertEqual(slow.errors, f"NOD.MTN plays differently than in its file: {changes}.\n")

    def test_stands_walks_and_rests(self):
        self.assertEqual(self.json("stand"), {"posture": "stand"})
        walked = self.aibo("--json", "walk", "forward=5m/s", "left=-50cm/s", "turn=50deg/s", "--seconds", "0.5",
                           "--unguarded")
        self.assertEqual(json.loads(walked.stdout), {"walked": True, "forward": 0.164, "left": -0.016, "turn": 0.028})
        self.assertEqual(walked.errors, "The robot cannot walk with forward=5.000m/s left=-0.500m/s turn=0.873rad/s: "
                                        "it walks with forward=0.164m/s left=-0.016m/s turn=0.028rad/s.\n")
        self.assertEqual(self.json("rest"), {"posture": "rest"})
        self.assertIn("motors are off", self.aibo("move", "head_pan=1deg", status=FAILED).errors)
        self.assertIn("motors are off", self.aibo("walk", "forward=5cm/s", status=FAILED).errors)
        self.assertEqual(self.json("motors", "on"), {"motors": True})
        self.assertEqual(self.json("stop"), {"stopped": True, "holds": True})
        self.json("stand")

    def test_ctrl_c_ends_a_walk(self):
        with start("walk", "forward=2cm/s", "--seconds", "60", port=self.robot.port) as walk:
            self.robot.wait_for_change("where", walk)
            walk.send_signal(signal.SIGINT)
            self.assertEqual((walk.wait(60), walk.communicate()[1]), (130, b"aibo: the walk was interrupted\n"))
        self.json("stand")

    def test_sigterm_ends_a_motion(self):
        with start("play", "wag", "--times", "300", port=self.robot.port) as play:
            self.robot.wait_for_change("joint tail_pan", play)
            play.send_signal(signal.SIGTERM)
            self.assertEqual((play.wait(60), play.communicate()[1]), (128 + signal.SIGTERM, b"aibo: interrupted\n"))

    def test_says_what_it_has_done(self):
        for words, said in ((["motors", "on"], "The motors are on: the joints hold."), (["sit"], "The robot sits."),
                            (["rest"], "The robot lies, and its motors are off."), (["stand"], "The robot stands."),
                            (["motors", "off"], "The motors are off: the joints can be moved by hand."),
                            (["stop"], "The robot holds."), (["stand"], "The robot stands."),
                            (["motions"], "LIE.MTN\nNOD.MTN\nSIT.MTN\nWAG.MTN"),
                            (["play", "nod", "--times", 2], "NOD.MTN was played to its end.")):
            self.assertEqual(self.text(*words), said + "\n")
        self.assertRegex(self.text("joints"), r"(?ms)\A {23}degrees   limits\nneck_tilt +-\d+\.\d   -75 to 0$.*"
                                              r"^tail_tilt +\d+\.\d   5 to 60$")
        picture = self.text("picture", "-o", "a.jpg", "-q", 40, "--resolution", "104x80")
        self.assertRegex(picture, rf"^104x80 pixels, \d+ bytes: {self.folder}/a.jpg\n$")

    def test_shows_sensors_in_their_units(self):
        for event, undone in (("press chin", "release chin"), ("press head_touch", "release head_touch"),
                              ("battery 18", "battery 90")):
            self.robot.ask(event)
            self.addCleanup(self.robot.ask, undone)
        end = time.monotonic() + 60
        while "battery                     0.180 \n" not in (words := self.text("sensors")):  # it looks now and then
            self.assertLess(time.monotonic(), end)
        for line in (r"chin +1\.000 on", r"head_touch +\d+\.000 touched", r"back_front +\d\.000 ", r"range_near +\S+ m",
                     r"acceleration_up_down +-?9\.\d+ m/s\^2", r"temperature +\S+ degrees Celsius"):
            self.assertRegex(words, f"(?m)^{line}$")
        report = self.examined()
        self.assertIn({"topic": "battery", "good": False, "text": "18 % charged", "advice": "Charge it soon."},
                      report["findings"])
        self.assertFalse(report["good"])


class Example(TestCase):
    def run_example(self, *arguments):
        return subprocess.run([os.environ["LOOK_AND_WALK"], *arguments], timeout=120, check=False, capture_output=True,
                              text=True)

    def test_says_what_it_needs(self):
        ended = self.run_example("127.0.0.1")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("usage: look_and_walk HOST ", ended.stderr)

    def test_takes_a_picture_looks_and_walks(self):
        self.robot = SimulatedRobot(console=0)
        self.addCleanup(self.robot.end)
        picture = self.folder / "a.jpg"
        taken = self.run_example("127.0.0.1", str(picture), str(self.robot.port))
        self.assertEqual((taken.returncode, taken.stdout), (0, f"{picture} has {picture.stat().st_size} bytes\n"))
        self.assertEqual(picture.read_bytes()[:2], b"\xff\xd8")
        self.assertAlmostEqual(float(self.robot.ask("joint head_pan")), math.degrees(0.5), delta=3)
        self.assertGreater(float(self.robot.ask("where").split()[0]), 0.1)


class WithPermission(TestCase):
    def test_motions_are_stored_and_deleted(self):
        self.robot = self.robot_with("ALLOW_UPLOAD=yes\nALLOW_DELETE=yes\nALLOW_PICTURES=yes\nALLOW_SHUT_DOWN=yes\n"
                                     "ALLOW_REBOOT=yes\n")
        self.assertEqual(self.json("upload", NOD), {"motion": "NOD.MTN", "bytes": NOD.stat().st_size})
        self.assertEqual(self.json("upload", NOD, "wave")["motion"], "WAVE.MTN")
        self.assertIn("WAVE.MTN", self.json("motions")["motions"])
        self.assertEqual(self.text("upload", NOD, "wave"), f"WAVE.MTN is on the robot, {NOD.stat().st_size} bytes.\n")
        self.assertEqual(self.text("delete", "wave"), "WAVE.MTN was deleted from the robot.\n")
        self.assertNotIn("WAVE.MTN", self.json("motions")["motions"])
        allows = next(f for f in self.examined()["findings"] if f["topic"] == "allows")
        self.assertEqual(allows["text"], "upload, delete, pictures, shut down, reboot")


class WithSound(TestCase):
    """A robot that hears 1000 in its left ear and -1000 in its right one."""

    def setUp(self):
        super().setUp()
        self.write("heard.wav", struct.pack("<hh", 1000, -1000) * 16000 * 60, channels=2)

    def start(self, settings="ALLOW_MICROPHONE=yes\n"):
        self.robot = self.robot_with(settings, "--microphone", self.folder / "heard.wav", "--speaker",
                                     self.folder / "played.wav")

    def write(self, name, samples, channels=1):
        with wave.open(str(self.folder / name), "wb") as file:
            file.setparams((channels, 2, 16000, 0, "NONE", ""))
            file.writeframes(samples)

    def install_speech(self):
        """A program in place of espeak-ng, which keeps the text."""
        program = self.folder / "bin/espeak-ng"
        program.parent.mkdir()
        program.write_text(f"#!/bin/sh\necho \"$*\" > '{self.folder}/options'\ncat > '{self.folder}/text'\ncat '{self.folder}/bark.wav' > \"$5\"\n")
        program.chmod(0o755)
        path = os.environ["PATH"]
        self.addCleanup(os.environ.__setitem__, "PATH", path)
        os.environ["PATH"] = f"{program.parent}:{path}"

    def test_records_what_the_robot_hears_also_the_second_time(self):
        self.start()
        for name, channels in (("a.wav", 2), ("b.wav", 1)):
            heard = self.json("listen", name, "--seconds", "0.5", *(["--mono"] if channels == 1 else []))
            with wave.open(str(self.folder / name)) as file:
                self.assertEqual((file.getnchannels(), file.getsampwidth(), file.getframerate()), (channels, 2, 16000))
                self.assertGreaterEqual(file.getnframes(), 8000)
                self.assertGreaterEqual(heard["seconds"], 0.5)
                end = struct.pack("<hh", 1000, -1000) if channels == 2 else bytes(4)
                self.assertEqual(file.readframes(8000)[-4:], end)
        self.assertIn("File exists", self.aibo("listen", "a.wav", "--seconds", "0.5", status=FAILED).errors)

    def test_ctrl_c_ends_listening(self):
        self.start()
        with start("listen", "a.wav", port=self.robot.port, cwd=self.folder) as listen:
            while not (self.folder / "a.wav").exists() or (self.folder / "a.wav").stat().st_size < 40000:
                self.assertIsNone(listen.poll())
            listen.send_signal(signal.SIGINT)
            self.assertEqual(listen.wait(60), DONE)
            with wave.open(str(self.folder / "a.wav")) as file:
                heard = file.getnframes() / 16000
            self.assertEqual(listen.communicate()[0].decode(), f"a.wav has {heard:.1f} s of sound.\n")

    def test_shows_the_level(self):
        self.start()
        heard = self.aibo("--json", "listen", "--seconds", "1.5")
        levels = re.findall("level (.*) dB", heard.errors)
        self.assertEqual(set(levels), {"-30"})
        self.assertLessEqual(len(levels), json.loads(heard.stdout)["seconds"], "once a second")

    def test_is_deaf_unless_the_owner_allows_it_to_hear(self):
        self.start("")
        self.assertIn("ALLOW_MICROPHONE=yes", self.aibo("listen", "a.wav", "--seconds", "1", status=FAILED).errors)
        self.assertFalse((self.folder / "a.wav").exists())

    def test_plays_and_says_to_the_end_and_again(self):
        self.start()
        self.write("bark.wav", struct.pack("<h", 500) * 4000)
        self.install_speech()
        for words in (["play-sound", "bark.wav", "--volume", "3"], ["say", "--", "--stdin", "$(reboot)"],
                      ["play-sound", "bark.wav"]):
            self.assertTrue(self.json(*words)["to_its_end"], words)
        self.assertEqual((self.folder / "text").read_text(), "--stdin $(reboot)")
        self.json("say", "--voice", "de", "Guten", "Morgen")
        self.assertIn(" -v de ", " " + (self.folder / "options").read_text())
        self.assertEqual((self.folder / "text").read_text(), "Guten Morgen")
        self.assertIn("missing.wav", self.aibo("play-sound", "missing.wav", status=FAILED).errors)
        self.assertIn("no WAV, FLAC or Ogg", self.aibo("play-sound", "text", status=FAILED).errors)

    def test_ctrl_c_stops_a_sound(self):
        self.start()
        self.write("long.wav", struct.pack("<h", 500) * 16000 * 60)
        with start("play-sound", "long.wav", port=self.robot.port, cwd=self.folder) as play:
            while (self.folder / "played.wav").stat().st_size < 8000:
                self.assertIsNone(play.poll())
            play.send_signal(signal.SIGINT)
            self.assertEqual(play.wait(60), 130)
            play.communicate()
        self.assertLess((self.folder / "played.wav").stat().st_size, 16000 * 2 * 30)

    def test_a_sound_that_the_robot_ends_has_failed(self):
        self.write("bark.wav", bytes(1000))
        heard = []
        port = self.server(says_hello(b"", heard=heard, answers={
            b"A": [[b"\2"], [struct.pack(">I", 9000), (b"a", struct.pack(">BxxxIII", 3, 100, 0, 0), 0, 2)]]}))
        self.assertIn("aibo: The robot has ended it: no more samples came for 2 s.\n",
                      self.aibo("play-sound", "bark.wav", "--volume", 2, port=port, status=FAILED).errors)
        self.assertEqual([request for request in heard if request[0] == b"A"][0], (b"A", 3, b"\2"), "the volume")

    def test_a_robot_without_sound_is_said(self):
        port = self.server(says_hello(b"RCServer"))
        self.write("bark.wav", bytes(4000))
        for words, said in ((["listen"], "has no sound"), (["play-sound", "bark.wav"], "refused to play sound")):
            self.assertIn(said, self.aibo(*words, port=port, status=FAILED).errors)


class Lost(TestCase):
    @staticmethod
    def second(watch, connected):
        """The next second of such a kind."""
        while line := watch.stdout.readline():
            if (second := json.loads(line))["connected"] == connected:
                return second
        raise AssertionError("watch has ended")

    def test_watching_goes_on_when_the_robot_is_back(self):
        robot = SimulatedRobot()
        with start("--json", "watch", port=robot.port) as watch:
            try:
                self.second(watch, True)
                robot.end()
                self.assertRegex(self.second(watch, False)["problem"], r"(refused|closed) the connection\. [A-Z].*[.?]$")
                robot = SimulatedRobot(port=robot.port)
                streams = [self.second(watch, True)["stream"] for _ in range(3)]
                self.assertLess(min(stream["age"] or 9 for stream in streams), 0.9, "its clock has begun again")
            finally:
                watch.kill()
                robot.end()

    def test_what_waits_for_a_robot_that_is_lost_ends_and_says_so(self):
        heard = b"a", struct.pack(">IHBx", 10, 512, 2) + bytes(2048), 0, 1
        answers = {b"T": [[b"\0\4", measured(J={joint: -900 * joint for joint in Answered.JOINTS}, S={66: 870000})]], b"V": [[b""]],
                   b"A": [[struct.pack(">BBH", 1, 2, 16000), heard]], **dict.fromkeys((b"E", b"O", b"S", b"U", b"M", b"D"), [[None]])}

        def robot(until):
            return self.server(says_hello(b"", answers=answers, until=until))
        lost = [((until, *words), start(*words, port=robot(until), cwd=self.folder)) for until, *words in (
            (b"T", "doctor"), (b"W", "doctor"), (b"T", "sensors"), (b"T", "joints"),
            (b"T", "move", "mouth=0deg"), (b"J", "move", "mouth=0deg"), (b"E", "stand"), (b"P", "play", "nod"),
            (b"S", "walk", "forward=1cm/s"), (b"O", "motors", "on"), (b"I", "stop"), (b"A", "listen"),
            (b"AH", "listen", "a.wav"), (b"F", "picture", "-o", "b.jpg"), (b"N", "motions"), (b"U", "upload", str(NOD)),
            (b"D", "delete", "nod"))]
        for words, command in lost:
            with self.subTest(words), command:
                said = b"".join(command.communicate())
                self.assertEqual(command.returncode, UNREACHABLE, said)
                self.assertEqual(said.count(b"closed the connection"), 1, said)
                self.assertEqual(b"battery" in said, words == (b"W", "doctor"))
        self.assertEqual(os.listdir(self.folder), ["a.wav"])
        with wave.open(str(self.folder / "a.wav")) as file:
            self.assertEqual(file.getnframes(), 512)


class Flooded(TestCase):
    """By a robot that sends without end what a command keeps."""
    FLOODS = {
        "ends of motions": lambda i: version2_frame(b"i", b"\x01\x03\0\0M%d.MTN\n" % i + 250 * b"why "),
        "reports": lambda i: version2_frame(b"e", b"\0\x03%d " % i + 250 * b"why "),
        "measurements": lambda i: version2_frame(b"t", struct.pack(">IHHcBHi", 4 * i, 1, 0, b"J", i % 256, 0, 0)),
        # Requests have the numbers from 1 on, and few are made.
        "answers to nothing": lambda i: version2_frame(b"n", 250 * b"A.MTN\n", 30000 + i % 30000)}
    FRAMES = 100000
    MOST = 40 * 1024  # KB; without a flood it is 19 MB

    @unittest.skipIf("ASAN_OPTIONS" in os.environ, "a sanitizer keeps freed memory for a while")
    def test_a_command_keeps_little_of_a_flood(self):
        for name, make in self.FLOODS.items():
            with self.subTest(name):
                self.assertLess(self.peak_memory_of_watch(make), self.MOST)

    def peak_memory_of_watch(self, make):
        sent = threading.Event()

        def flood(number):
            if number == self.FRAMES:
                sent.set()
            return make(number)
        server = ScriptedServer(says_hello(b"hostile", flood=flood, answers={b"W": [[b"\1\0\0\1"]]}))
        self.addCleanup(server.end)
        with subprocess.Popen([AIBO, "--port", str(server.port), "watch"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, env=environment()) as watch:
            self.assertTrue(sent.wait(300))
            watch.send_signal(signal.SIGINT)
            usage = os.wait4(watch.pid, 0)[2]
            watch.returncode = 0
        return usage.ru_maxrss


class Unreachable(TestCase):
    @staticmethod
    def own_address():
        """The port of a robot's console is fixed, so the address is one that no other test has."""
        return "127.1.%d.%d" % divmod(os.getpid() % 65536, 256)

    def test_nobody_there(self):
        with socket.socket() as reserved:
            reserved.bind(("127.0.0.1", 0))
            port = reserved.getsockname()[1]
            error = self.json("joints", port=port, status=UNREACHABLE)
            self.assertIn("refused the connection", error["error"])
            self.assertIn("AIBO_HOST", error["error"])
            self.assertEqual(error["status"], UNREACHABLE)
            report = self.json("doctor", port=port, status=UNREACHABLE)
            self.assertEqual(report["findings"],
                             [{"topic": "port", "good": False, "text": error["error"], "advice": ""}])
            address = self.own_address()
            with socket.create_server((address, 59000)):
                report = self.json("doctor", address, port=port, status=UNREACHABLE)
            self.assertIn("the robot is on, but RCServer is not running", report["findings"][-1]["advice"])

    def test_a_robot_that_does_not_answer(self):
        address = self.own_address()
        with socket.socket() as full, socket.create_server((address, 59000)):
            full.bind((address, 0))
            full.listen(0)  # Linux keeps one connection more than that, and ignores those that come after it
            with socket.create_connection(full.getsockname()):
                finding, = self.json("--timeout", "0.3", "doctor", address, port=full.getsockname()[1],
                                     status=UNREACHABLE)["findings"]
        self.assertEqual((finding["topic"], finding["good"]), ("port", False))
        self.assertIn("did not answer within 300 ms. Is the robot switched on", finding["text"])
        self.assertIn("is its switch WIRELESS, under the stomach cover, on?", finding["advice"])

    def test_a_wrong_name(self):
        finding, = self.json("doctor", "no.such.host.invalid", port=1, status=UNREACHABLE)["findings"]
        self.assertEqual((finding["topic"], finding["good"]), ("name", False))
        self.assertIn("cannot be looked up", finding["text"])

    def test_a_robot_that_somebody_else_has(self):
        turned_away = []

        def turn_away(client):
            client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            turned_away.append(client)
        port = self.server(turn_away)
        self.assertIn("Is another client connected?", self.aibo("joints", port=port, status=UNREACHABLE).errors)
        self.assertLess(len(turned_away), 6, "it does not try for long")
        finding, = self.json("doctor", port=port, status=UNREACHABLE)["findings"]
        self.assertEqual((finding["topic"], finding["good"]), ("server", False))
        self.assertIn(f"`ss -tp dport = :{port}` lists the programs of this computer", finding["advice"])
        self.assertIn("ALLOWED_ADDRESSES", finding["advice"])
        users = iter((turn_away, turn_away, says_hello(b"RCServer", b"NOD.MTN")))  # the robot is free a moment later
        self.assertEqual(self.text("motions", port=self.server(lambda client: next(users)(client))), "NOD.MTN\n")

    def test_a_robot_whose_settings_leave_this_computer_out(self):
        robot = self.robot_with("ALLOWED_ADDRESSES=10.0.0.1\n", "--bind", self.own_address(), console=59000)
        finding, = self.json("--timeout", "60", "doctor", self.own_address(), port=robot.port,
                             status=UNREACHABLE)["findings"]
        self.assertEqual(finding["advice"],
                         "The robot's console says why: ALLOWED_ADDRESSES in RCSERVER.CFG does not name it")

    def test_something_else_that_listens(self):
        port = self.server(lambda client: client.sendall(b"SSH-2.0-OpenSSH_9.2\r\n") or client.recv(1000))
        errors = self.aibo("joints", port=port, status=UNREACHABLE).errors
        self.assertIn("does not speak the RCServer's protocol", errors)
        self.assertNotIn("AIBO_HOST", errors)
        self.assertEqual(errors.count("\n"), 1, "it is said once")

    def test_control_characters_of_a_robot_never_reach_the_terminal(self):
        for name in (b"RCServer \x1b[2J", b"RCServer \xc2\x9b2J", b"RCServer \xe2\x80\xae"):
            with self.subTest(name):
                port = self.server(says_hello(name))
                for words in (["motions"], ["--json", "doctor", "--seconds", "1"], ["doctor", "--seconds", "1"]):
                    result = run(*words, port=port)
                    self.assertEqual(result.returncode, UNREACHABLE)
                    self.assertNotRegex(result.stdout + result.stderr, rb"\x1b|\xc2\x9b|\xe2\x80\xae")

    def test_file_names_of_a_robot_never_become_paths(self):
        for name in (b"../../EVIL.MTN", b"\x1b[2J.MTN"):
            result = run("motions", port=self.server(says_hello(b"RCServer", name)), folder=self.folder)
            self.assertNotRegex(result.stdout + result.stderr, rb"\x1b")
            self.assertEqual(os.listdir(self.folder), [])


class Answered(TestCase):
    """Robots whose answers differ from those of the simulated one."""
    JOINTS = [*range(1, 5), 51, 52, *(leg + joint for leg in (10, 20, 30, 40) for joint in range(1, 4))]

    def test_a_robot_that_measures_less(self):
        def start_with(report, *words):
            return start("--json", *words, port=self.server(says_hello(b"", answers={b"T": [[b"\0\4", report]]})))
        some = measured(J={2: 100000, 51: -200000}, S={67: 29000000, 6: 12000000})
        charge = measured(S={66: 870000})
        failing = {"where its joints are, so none was moved": start_with(some, "move", "head_pan=1deg"),
                   "its joints: does its server": start_with(charge, "joints")}
        joints, sensors = (start_with(some, command) for command in ("joints", "sensors"))
        for problem, command in failing.items():
            with command:
                self.assertIn("aibo: the robot does not report " + problem, command.communicate()[1].decode())
                self.assertEqual(command.returncode, FAILED)
        with joints, sensors:
            self.assertEqual([(joint["name"], joint["position"]) for joint in json.load(joints.stdout)["joints"]],
                             [("head_pan", 0.1), ("tail_pan", -0.2)])
            self.assertEqual(json.load(sensors.stdout), {"robot": "ERS-7", "sensors": [
                {"name": "back_rear", "value": 12, "unit": "", "pressed": False},
                {"name": "temperature", "value": 29, "unit": "degrees Celsius", "pressed": None}]})

    def test_a_walk_that_the_robot_ends_is_told_with_its_reason(self):
        for words, left, turn, wanted, is_guarded in (
                (["left=-50cm/s"], -100, 0, "left=-0.500m/s turn=0.000rad/s", 1),
                (["turn=0.5rad/s", "--unguarded"], 0, 70, "left=0.000m/s turn=0.500rad/s", 0)):
            heard = []
            port = self.server(says_hello(b"", heard=heard, answers={b"S": [
                [bytes(8)], [struct.pack(">hhh", 0, 2 * left, 2 * turn) + b"##"],
                [struct.pack(">hhh", 0, left, turn) + b"##"], [None],
                [bytes(8), (b"i", b"\2\3##walk\nthe floor ends ahead")]]}))
            self.assertEqual(self.aibo("walk", *words, "--seconds", 9, port=port, status=FAILED).errors,
                             f"The robot cannot walk with forward=0.000m/s {wanted}: it walks with "
                             f"forward=0.000m/s left={left / 1000:.3f}m/s turn={turn / 1000:.3f}rad/s.\n"
                             "aibo: the walk could not go on: the floor ends ahead\n")
            self.assertEqual({guard for kind, guard, asked in heard if kind == b"S" and any(asked[4:])}, {is_guarded})

    def test_a_stream_with_few_or_lost_pictures_is_bad(self):
        self.robot = SimulatedRobot("--encode-time", "45")
        self.addCleanup(self.robot.end)
        stream = next(finding for finding in self.examined()["findings"] if finding["topic"] == "stream")
        self.assertFalse(stream["good"], stream)
        self.assertIn("Bring the robot nearer", stream["advice"])
        jpeg = self.aibo("picture", "-q", "1", "-o", "-").stdout
        port = self.server(says_hello(
            b"", flood=lambda i: version2_frame(b"f", struct.pack(
                ">IIHHBBH", (2 * i - 999) % 2**32, 8 * i, 208, 160, 1, 0, 0) + jpeg),  # every second image
            answers={b"T": [[b"\0\4", measured(S={66: 876000})]], b"W": [[b"\1\0\0\1"]]}))
        report = self.json("doctor", "--seconds", "1", port=port, status=FAILED)
        *_, battery, stream, _ = report["findings"]
        self.assertEqual(battery, {"topic": "battery", "good": True, "text": "88 % charged", "advice": ""})
        self.assertGreater(report["stream"]["loss"], 0.4)
        self.assertFalse(stream["good"])

    def test_a_robot_that_falls_silent_is_bad(self):
        robot = SimulatedRobot()
        self.addCleanup(robot.end)
        with start("doctor", "--seconds", "60", port=robot.port) as doctor:
            while b"battery" not in (line := doctor.stdout.readline()):
                self.assertRegex(line, rb"^ok   ")
            robot.process.send_signal(signal.SIGSTOP)
            bad, advice, end = doctor.stdout.read().splitlines()
            self.assertRegex(bad, rb"^BAD  server    127.0.0.1:\d+ sent nothing for 500 ms")
            self.assertEqual(advice.strip(), b"Is the robot within reach of its WLAN?")
            self.assertEqual(end, b"See the lines that begin with BAD.")
            self.assertEqual(doctor.wait(60), UNREACHABLE)

    def test_says_how_a_movement_has_ended(self):
        for how, words in ((1, "was replaced"), (2, "was stopped"), (3, "could not go on"), (4, "ended because"),
                           (9, "ended in a way that")):
            port = self.server(says_hello(b"", answers={b"E": [[b"", (b"i", bytes((3, how)) + b"##sit\nwhy")]]}))
            self.assertRegex(self.aibo("sit", port=port, status=FAILED).errors, f"^aibo: sit {words}.*: why\n$")

    def test_a_robot_without_a_battery_sensor_is_well(self):
        self.robot = SimulatedRobot("--robot", "ERS-210")
        self.addCleanup(self.robot.end)
        self.assertNotIn("battery", [finding["topic"] for finding in self.examined()["findings"]])

    def test_the_second_ctrl_c_waits_for_no_robot(self):
        heard = []
        port = self.server(says_hello(b"", answers={b"P": [[b""], [b"-"]]}, heard=heard))
        with start("play", "nod", "--times", "3", port=port) as play:
            for order in (b"P", 0, b"\0\3NOD.MTN"), (b"P", 0, b"\0\0NOD.MTN"):  # to play, and to stop
                while order not in [(kind, identifier, asked[4 * (kind == b"P"):]) for kind, identifier, asked in heard]:
                    self.assertIsNone(play.poll())
                    time.sleep(0.01)
                play.send_signal(signal.SIGINT)
            self.assertEqual(play.wait(60), -signal.SIGINT)

    def test_joints_move_at_29_degrees_a_second_unless_told_otherwise(self):
        for words, speed in ([], 0.5), (["--speed", "90deg/s"], math.pi / 2):
            heard = []
            telemetry = measured(J={joint: -900 * joint for joint in self.JOINTS})
            port = self.server(says_hello(b"", heard=heard, until=b"J", answers={b"T": [[b"\0\4", telemetry]],
                                                                                 b"V": [[b""]]}))
            self.aibo("move", "head_pan=30deg", *words, port=port, status=UNREACHABLE)
            limit, = (asked for kind, _, asked in heard if kind == b"V")
            self.assertAlmostEqual(struct.unpack(">i", limit[-4:])[0], 1e6 * speed, delta=10)

    def test_motors_that_stay_as_they_are(self):
        for wish, state in (("on", "off"), ("off", "on")):
            port = self.server(says_hello(b"RCServer", answers={b"O": [[bytes([state == "on"])]]}))
            self.assertIn(f"its motors are still {state}", self.aibo("motors", wish, port=port, status=FAILED).errors)

    def test_a_picture_has_the_settings_that_were_asked_for(self):
        robot = SimulatedRobot()
        self.addCleanup(robot.end)
        pictures = [self.aibo("picture", "-q", quality, "-o", "-", port=robot.port).stdout for quality in (90, 30)]
        for words, settings in ((["--white-balance", "outdoor", "--gain", "high", "--shutter", "slow"], 0b011110),
                                (["--white-balance", "indoor", "--gain", "low"], 0b100101),
                                (["--white-balance", "auto", "--shutter", "fast", "--auto-exposure"], 0b11111011)):
            frames = [struct.pack(">IIHHBBH", 1, 1, 208, 160, 85, 0, bits) + jpeg
                      for bits, jpeg in zip((0b101011, settings), pictures)]
            port = self.server(says_hello(b"", answers={b"F": [[frame] for frame in frames]}))
            self.assertEqual(self.aibo("picture", *words, "-o", "-", port=port).stdout, pictures[1], words)

    def test_sound_that_is_missing_is_counted_and_becomes_silence(self):
        def heard(frame, sample):
            return b"a", struct.pack(">IHBx", frame, 896, 1) + struct.pack(">h", sample) * 896, 0, 1
        port = self.server(says_hello(b"RCServer", answers={
            b"A": [[struct.pack(">BBH", 1, 1, 16000), heard(10, 5), heard(67, 6), heard(124, 7)]]}))
        self.assertEqual(self.text("listen", "a.wav", "--mono", "--seconds", "0.15", port=port),
                         "a.wav has 0.2 s of sound, with 2 gaps.\n")
        with wave.open(str(self.folder / "a.wav")) as file:
            self.assertEqual(file.readframes(19000), (bytes(2 * 50 * 128)).join(
                number * 896 for number in (b"\5\0", b"\6\0", b"\7\0")))
        self.assertEqual(self.json("listen", "--mono", "--seconds", "0.15", port=port), {"seconds": 0.168, "gaps": 2})


class WrongUsage(TestCase):
    def test_is_refused_before_anything_is_sent(self):
        for words in ([], ["fly"], ["move"], ["move", "head_pan"], ["move", "head_pan=30"], ["motors", "maybe"],
                      ["walk", "forward=0.4mm/s"], ["walk", "up=1m/s"],
                      ["walk", "turn=1rad/s", "turn=2rad/s"], ["move", "mouth=0deg", "mouth=1deg"], ["walk", "up=1rad/s"], ["doctor", "10.0.0.1/x"],
                      ["--host", "10.0.0.1/x", "joints"], ["watch", "--shutter", "x"], ["picture", "--gain", "loud"],
                      ["picture", "--white-balance", "x"], ["picture", "-q", "0"], ["picture", "-q", "101"],
                      ["picture", "-q", "x"], ["picture", "--resolution", "1x1"],
                      ["watch", "--every", "0"], ["watch", "--seconds", "-1"], ["watch", "--seconds", "604801"],
                      ["joints", "--fast"], ["--port", "70000", "joints"], ["doctor", "--seconds", "nan"],
                      ["play", "nod", "--seconds", "soon"], ["play", "nod", "--seconds", "3601"],
                      ["move", "mouth=0deg", "--duration", "61"], ["walk", "forward=1cm/s", "--seconds", "61"],
                      ["listen", "--seconds", "0"], ["doctor", "--seconds", "601"], ["joints", "--timeout", "61"],
                      ["play", "nod", "--times", "0"], ["play-sound", "missing.wav", "--volume", "4"],
                      ["say", "hello", "--volume", "-1"], ["move", "mouth=0deg", "--speed", "0.5deg/s"],
                      ["move", "mouth=0deg", "--speed", "172deg/s"], ["play", "nod", "--speed", "5deg/s"],
                      ["play", "nod", "--speed", "1146deg/s"], ["\x1b[2J"], ["--json", "fly"]):
            with self.subTest(words):
                result = subprocess.run([AIBO, *words], capture_output=True, timeout=60, env=environment(),
                                        check=False)
                self.assertEqual(result.returncode, WRONG_USAGE, result)
                self.assertTrue(result.stderr.startswith(b"aibo: "), result.stderr)
                self.assertNotRegex(result.stderr, CONTROL)
                self.assertEqual(result.stdout != b"", "--json" in words)

    def test_help_is_no_wrong_usage_unless_there_is_none(self):
        def done(*words):
            result = subprocess.run([AIBO, *words], capture_output=True, timeout=60, check=False, text=True,
                                    env={**os.environ, "AIBO_HOST": "no/robot"})
            self.assertEqual((result.returncode, result.stderr), (DONE, ""))
            return result.stdout
        self.assertEqual(done("--help"), done("help"))
        self.assertRegex(done("help"), r"(?m)^Options of all commands:\n  --host NAME ")
        about = done("help", "move")
        self.assertEqual(done("move", "--help"), about)
        self.assertEqual(json.loads(done("--json", "move", "--help"))["help"] + "\n", about)
        self.assertIn("usage: aibo move JOINT=ANGLE...", about)
        self.assertRegex(about, r"(?m)^  aibo move head_pan=30deg +looks to the left$")
        self.assertRegex(about, r"(?m)^Options of move:\n  --duration S ")
        self.assertRegex(done("--version"), r"^aibo \d+\.\d+\.\d+\n$")
        result = subprocess.run([AIBO, "help", "fly"], capture_output=True, timeout=60, check=False)
        self.assertEqual(result.returncode, WRONG_USAGE)
        self.assertIn(b"there is no command 'fly'", result.stderr)


class Documents(unittest.TestCase):
    """Help, completion and docs/command_line.md have the same commands and options."""
    OPTION = re.compile(r"--[a-z][a-z-]+")

    @staticmethod
    def text(*words):
        return subprocess.run([AIBO, *words], capture_output=True, timeout=60, check=True, text=True).stdout

    def test_the_document_has_all_commands_and_their_options(self):
        commands = re.findall(r"^  ([a-z-]+) +\S", self.text("help").split("Options")[0], re.MULTILINE)
        document = (PROJECT / "docs/command_line.md").read_text(encoding="utf-8")
        options = set()
        for command in commands:
            about = self.text("help", command)
            options.update(self.OPTION.findall(about))
            self.assertLessEqual(max(map(len, about.split("\nExamples:\n")[0].splitlines())), 80)
            self.assertRegex(document, rf"`{command}\b")
        self.assertLessEqual(set(self.OPTION.findall(document)), options)

    def test_bash_completes_commands_and_options(self):
        script = 'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _aibo "$1"; echo "${COMPREPLY[*]}"'
        completion = PROJECT / "aibo_driver/command_line/completion.bash"
        for words, completed in ((["mo"], "move motions motors"), (["watch", "--s"], "--seconds --shutter"),
                                 (["--host", "x", "move", "--d"], "--duration"), (["help", "doc"], "doctor"),
                                 (["joints", "mo"], "")):
            said = subprocess.run(["bash", "-c", script, completion, AIBO, *words], capture_output=True, timeout=60,
                                  check=True, text=True).stdout
            self.assertEqual(said, completed + "\n")

    def test_no_library_of_ros_is_linked(self):
        libraries = subprocess.run(["ldd", AIBO], capture_output=True, timeout=60, check=True, text=True).stdout
        self.assertNotRegex(libraries, r"libros|roscpp|xmlrpcpp")


if __name__ == "__main__":
    unittest.main()
