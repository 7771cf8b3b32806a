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
GENERATE_STUB = PROJECT / "aibo_rcserver" / "simulator" / "openr_host" / "generate_stub"
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
        self.output += self.process.stdout.read()  # communicate() would lose what readline() has buffered
        return self.process.wait(LIMIT)

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

    def test_the_example_nods_when_its_head_is_touched(self):
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

    def test_finds_sonys_headers_and_the_folders_of_the_makefile(self):
        folder = self.work / "source"
        shutil.copytree(str(EXAMPLE), str(folder))
        (folder / "include").mkdir()
        (folder / "include" / "Depth.h").write_text("const int DEPTH = 1;\n")
        (folder / "Nodder" / "Makefile").write_text("CXXFLAGS = -O2 -I. -I../include -I$(OPENRSDK_ROOT)/include\n")
        (folder / "Nodder" / "Extra.cc").write_text(
            '#include <Depth.h>\nvoid extra() { list<int> a(DEPTH + OUR, stricmp("A", "a")); cout << a.size() << endl; }\n')
        options = {"CXXFLAGS": "-DOUR=1", "LIBS": "-Wl,-soname,from_libs"}
        subprocess.run([str(SCRIPT), "--build", str(folder)], stdout=subprocess.DEVNULL, timeout=LIMIT, check=True,
                       env={**os.environ, **options, "OPENR_WORK": str(self.work / "work")})
        self.assertIn(b"from_libs", (self.work / "work/source/MS/OPEN-R/MW/OBJS/NODDER.BIN").read_bytes())

    def test_an_object_that_does_not_return_can_be_ended(self):
        nodder = self.work / "source" / "Nodder" / "Nodder.cc"
        shutil.copytree(str(EXAMPLE), str(nodder.parents[1]))
        source = nodder.read_text()
        for loop, reason in (("for (;;) {}", "an object does not return"),
                             ("while (getchar() != 'y') {}", "an object waits for input"),
                             ("char c; while (!(cin >> c)) {}", "an object waits for input")):
            nodder.write_text(source.replace("BeginNod();", 'OSYSPRINT(("loops\\n")); ' + loop, 1))
            robot = Robot(nodder.parents[1], self.work / "work")
            self.addCleanup(robot.kill)
            robot.ask("press head_touch")
            robot.wait_for("loops\n")
            self.assertEqual(robot.stop(), 1)
            self.assertIn(reason, robot.output)

    def fail_to_run(self, folder, *more):
        run = subprocess.run([str(SCRIPT), str(folder), *more], env={**os.environ, "OPENR_WORK": str(self.work)},
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             universal_newlines=True, timeout=LIMIT, check=False)
        self.assertNotEqual(run.returncode, 0)
        return run.stdout

    def test_mistakes_are_explained(self):
        self.assertIn("there is no folder '/none'", self.fail_to_run("/none"))
        (self.work / "my objects").mkdir()
        self.assertIn("my objects' has a space in it", self.fail_to_run(self.work / "my objects"))
        broken = self.work / "source" / "broken"
        shutil.copytree(str(EXAMPLE), str(broken))
        (broken / "Nodder" / "My part.cc").touch()
        self.assertIn("/Nodder/My part.cc' has a space in it", self.fail_to_run(broken))
        (broken / "Nodder" / "My part.cc").unlink()
        self.assertIn("there is no stub.cfg in '/none'", self.fail_to_run(broken, "OTHER.BIN=/none"))
        (broken / "MS" / "OPEN-R" / "MW" / "CONF" / "OBJECT.CFG").write_text("/MS/OPEN-R/MW/OBJS/OTHER.BIN\n")
        self.assertIn("OTHER.BIN is neither on the memory stick", self.fail_to_run(broken))
        for source, is_about_headers in (("#include <Missing.h>\n", True), ("Missing missing;\n", False)):
            (broken / "Nodder" / "Nodder.cc").write_text(source)
            output = self.fail_to_run(broken)
            self.assertIn("NODDER.BIN cannot be built", output)
            self.assertIs("If the header is Sony's" in output, is_about_headers)
        self.assertIn("MINE.BIN cannot be built", self.fail_to_run(broken, f"MINE.BIN={broken / 'Nodder'}"))
        stub = broken / "Nodder" / "stub.cfg"
        stub.write_text(stub.read_text().replace("Nodder", "NodderOfHeads", 1))
        self.assertIn("NODDEROF.BIN cannot be built", self.fail_to_run(broken))
        (broken / "Nodder" / "Makefile").write_text("install:\n\tcp nod.bin ../MS/OPEN-R/MW/OBJS/NODDING.BIN\n")
        self.assertIn("NODDING.BIN cannot be built", self.fail_to_run(broken))
        (broken / "Nodder" / "stub.cfg").unlink()
        self.assertIn("there is no object in", self.fail_to_run(broken))


class StubTest(unittest.TestCase):
    """That what is generated is right shows in RCServer and the example, which are made from it."""

    # Every setting once, in the form of the OPEN-R SDK Programmer's Guide, 2.3.
    SAMPLE = """ObjectName : SampleObject
NumOfOSubject : 1
NumOfOObserver : 2

Service : "SampleObject.Func1.char.S", null , Ready ()
Service : "SampleObject.Func2.int.O", Connect (), Notify ()
Service : "SampleObject.Func3.Data.O", null , Control ()
Extra : UpdatePowerStatus()
Extra : SendCont()
"""

    def generate(self, text):
        with tempfile.TemporaryDirectory() as folder:
            stub = pathlib.Path(folder, "stub.cfg")
            stub.write_text(text)
            run = subprocess.run([str(GENERATE_STUB), str(stub), folder], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, universal_newlines=True, check=False)
            description = "".join(path.read_text() for path in pathlib.Path(folder).glob("*_stub.cc"))
            return description if run.returncode == 0 else run.stderr.replace(folder + "/", "")

    def test_every_setting_is_read(self):
        description = self.generate(self.SAMPLE)
        for part in ("describeSampleObject()", '{"SampleObject.Func1.char.S", nullptr, ', ".Ready(", ".Connect(",
                     ".Notify(", ".Control(", ".UpdatePowerStatus(", ".SendCont("):
            self.assertIn(part, description)

    def test_other_lines_are_comments(self):
        description = self.generate(
            "//\r\n// An object: with a remark\r\n\r\n  ObjectName : Walker // its class\r\n"
            'NumOfSubject : 1\r\nNumOfObserver : 1\r\n# Service : "Walker.Old.Data.O", null, null\r\nanything\r\n'
            'Service : "Walker.Legs.OCommandVectorData.S", null, Ready()\r\n'
            'Service : "Walker.Dummy.DoNotConnect.O" , null , null \r\n')
        self.assertIn('{"Walker.Dummy.DoNotConnect.O", nullptr, nullptr}', description)
        self.assertNotIn("Walker.Old", description)

    def test_what_is_wrong_is_named_with_file_and_line(self):
        for old, new, problem in (
                ("Connect (), Notify ()", "Connect ()\n, Notify ()", "stub.cfg:6: .*on this line"),
                ("SendCont()", "SendCont ()", "stub.cfg:9: expected a function"),
                ("NumOfOObserver : 2", "NumOfOObserver : 3", "stub.cfg:3: NumOfOObserver is 3.*are 2 services"),
                ("NumOfOSubject : 1", "NumOfOSubject : 0", 'stub.cfg:2: .*"SampleObject.Dummy.DoNotConnect.S"'),
                ("NumOfOSubject : 1", "NumOfOSubject : one", "stub.cfg:2: expected a number"),
                ("NumOfOSubject : 1\n", "", "no line NumOfOSubject"),
                ("Notify ()", "Notify", "stub.cfg:6: expected a function"),
                ("Func2.int.O", "Func2.O", "stub.cfg:6: expected"),
                ("ObjectName : SampleObject", "ObjectName :", "stub.cfg:1: .*found ''"),
                ("ObjectName", "Name", "no line ObjectName"),
                ("Func3", "Func2", "stub.cfg:7: a second service Func2"),
                ("SendCont", "UpdatePowerStatus", "stub.cfg:9: a second Extra"),
                ("Extra", "ObjectName : A\nExtra", "stub.cfg:8: a second ObjectName")):
            self.assertRegex(self.generate(self.SAMPLE.replace(old, new, 1)), problem)


if __name__ == "__main__":
    unittest.main()
