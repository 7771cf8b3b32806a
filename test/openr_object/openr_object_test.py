"""Builds objects with scripts/openr_object, and runs them on the simulated robot."""

import os
import pathlib
import re
import shutil
import socket
import subprocess
import tempfile
import time
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = PROJECT / "scripts" / "openr_object"
EXAMPLE = PROJECT / "aibo_rcserver" / "example"
LIMIT = 300  # seconds, in case of an error


class Robot:
    """A simulated robot with the objects of a folder."""

    def __init__(self, folder, work):
        self.process = subprocess.Popen(
            [str(SCRIPT), str(folder), "--", "--console-port", "0"], env={**os.environ, "OPENR_WORK": str(work)},
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        self.output = ""
        port = self.wait_for(r"Console on 127\.0\.0\.1:(\d+)\n").group(1)
        self.console = socket.create_connection(("127.0.0.1", int(port)), LIMIT)
        self.answers = self.console.makefile()

    def wait_for(self, pattern):
        while not re.search(pattern, self.output):
            line = self.process.stdout.readline()
            if not line:
                raise AssertionError("the robot has ended:\n" + self.output)
            self.output += line
        return re.search(pattern, self.output)

    def ask(self, line):
        self.console.sendall(line.encode() + b"\n")
        while True:
            answer = self.answers.readline()
            if answer.startswith(("ok: ", "error: ")):
                return answer.strip()

    def joint(self, name):
        return float(self.ask("joint " + name).split()[-1])

    def wait_until(self, condition):
        end = time.monotonic() + LIMIT
        while not condition():
            if time.monotonic() > end:
                raise AssertionError("it did not happen:\n" + self.output)
            time.sleep(0.02)

    def stop(self):
        self.console.close()
        self.answers.close()
        self.process.terminate()
        self.output += self.process.communicate(timeout=LIMIT)[0]
        return self.process.returncode

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class OpenrObjectTest(unittest.TestCase):
    def setUp(self):
        self.work = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.work)

    def nod(self, robot):
        self.assertEqual(robot.ask("press head_touch"), "ok: press head_touch")
        robot.wait_until(lambda: robot.joint("head_tilt") < -5)
        robot.ask("release head_touch")
        robot.wait_until(lambda: robot.joint("head_tilt") > 9.5)

    def test_the_example_nods_whenever_its_head_is_touched_and_writes_to_the_stick(self):
        nods = self.work / "example" / "MS" / "NODS.TXT"
        for run in range(2):  # a second program begins anew
            robot = Robot(EXAMPLE, self.work)
            self.addCleanup(robot.kill)
            for count in ("1\n", "2\n"):
                self.nod(robot)
                robot.wait_until(lambda: nods.exists() and nods.read_text() == count)
            self.assertEqual(robot.stop(), 0)
            self.assertIn("Nodder: nod 2\n", robot.output)
            self.assertNotIn("RCServer", robot.output)

    def fail_to_run(self, folder, *more):
        run = subprocess.run([str(SCRIPT), str(folder), *more], env={**os.environ, "OPENR_WORK": str(self.work)},
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             universal_newlines=True, timeout=LIMIT, check=False)
        self.assertNotEqual(run.returncode, 0)
        return run.stdout

    def test_mistakes_are_explained(self):
        self.assertIn("there is no folder '/none'", self.fail_to_run("/none"))
        broken = self.work / "source" / "broken"
        shutil.copytree(str(EXAMPLE), str(broken))
        self.assertIn("there is no stub.cfg in '/none'", self.fail_to_run(broken, "OTHER.BIN=/none"))
        (broken / "MS" / "OPEN-R" / "MW" / "CONF" / "OBJECT.CFG").write_text("/MS/OPEN-R/MW/OBJS/OTHER.BIN\n")
        self.assertIn("OTHER.BIN is neither on the memory stick", self.fail_to_run(broken))
        (broken / "Nodder" / "Nodder.cc").write_text("#include <Missing.h>\n")
        self.assertIn("NODDER.BIN cannot be built", self.fail_to_run(broken))
        (broken / "Nodder" / "stub.cfg").unlink()
        self.assertIn("there is no object in", self.fail_to_run(broken))


if __name__ == "__main__":
    unittest.main()
