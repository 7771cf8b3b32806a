"""The commands in README.md, CONTRIBUTING.md and docs/ work as they are written: those in blocks of `sh`, and indented
lines that begin with one of our programs or ROS'. So do the programs in docs/python.md. They run with a simulated
robot, its driver, and a second simulated robot for the command line. A comment before a block, which readers of the
page do not see, names commands that cannot run in a test, and why:

    <!-- not run (scripts/demo): a reason -->    commands that begin with this
    <!-- not run: a reason -->                   all commands of the block
"""
import contextlib
import importlib.util
import io
import itertools
import os
import re
import select
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import wave
from pathlib import Path

import roslaunch.arg_dump
import roslaunch.config
import roslaunch.xmlloader
import rosservice

PROJECT = Path(__file__).resolve().parents[2]
PAGES = [PROJECT / 'README.md', PROJECT / 'CONTRIBUTING.md'] + sorted((PROJECT / 'docs').glob('*.md'))
MEMORY_STICK = PROJECT / 'aibo_rcserver/memory_stick'

NOT_RUN = re.compile(r'<!-- not run(?: \(([^)]+)\))?: (.+) -->')
INDENTED = re.compile(r' {4,}(aibo |rosrun |roslaunch |rosservice |rostopic |rosbag |scripts/)')
# Commands that run until Ctrl-C.
ENDLESS = re.compile(r'rostopic echo(?! .*-n \d| -b)|rostopic pub -r|aibo_remote_control|aibo_monitor|rosbag record|aibo (watch|listen)(?! .*--seconds)')

# What the pages leave to the reader.
REPLACED = {'192.168.1.20': '127.0.0.1', '192.168.7.2': '127.0.0.1', 'ROBOT': '127.0.0.1', '/home/me': '$PWD',
            '--seconds 60': '--seconds 2', '--seconds 10': '--seconds 2'}

PATIENCE = 60  # s, for one command; a safety net


class Command:
    def __init__(self, page, line, text):
        self.place = '%s:%d' % (page.relative_to(PROJECT), line)
        self.text = text
        self.program = text.split()[0]
        self.run = text
        for old, new in REPLACED.items():
            self.run = self.run.replace(old, new)


def commands_in(page):
    """The commands of a page that have to work."""
    commands, skipped, language, text = [], [], None, ''
    for number, line in enumerate(page.read_text(encoding='utf-8').splitlines(), 1):
        if line.startswith('```'):
            language = None if language is not None else line[3:]
            skipped = skipped if language is not None else []
            continue
        marker = NOT_RUN.search(line)
        if marker:
            skipped.append(marker.group(1) or '')
        is_command = language == 'sh' or (language is None and (INDENTED.match(line) or text))
        if not is_command:
            skipped = skipped if line.startswith((' ', '<!--')) or not line else []
            continue
        text += line.strip()
        if text.endswith('\\'):
            text = text[:-1]
            continue
        if text and not text.startswith('#') and not any(text.startswith(begin) for begin in skipped):
            commands.append(Command(page, number, text))
        text = ''
    return commands


COMMANDS = [command for page in PAGES for command in commands_in(page)]


def kept_port(test):
    """A port that nobody else gets: a socket is bound to it, beside that of the program that listens there."""
    place = socket.socket()
    test.addClassCleanup(place.close)
    place.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    place.bind(('127.0.0.1', 0))
    return place.getsockname()[1]


class CommandsTest(unittest.TestCase):
    """Starts everything once."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix='aibo_commands_'))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.robot_ports = [kept_port(cls), kept_port(cls)]
        cls.make_files()
        master = kept_port(cls)
        programs = Path(os.environ['BUILD_FOLDER']) / 'devel/lib/aibo_driver'
        # In a new build folder, catkin's environment does not have our messages yet.
        sys.path.insert(0, os.environ['PYTHON_MESSAGES'])
        os.environ.update(
            PYTHONPATH='%s:%s' % (sys.path[0], os.environ.get('PYTHONPATH', '')), PWD=str(cls.folder),
            ROS_MASTER_URI='http://127.0.0.1:%d' % master, ROS_IP='127.0.0.1', ROS_HOME=str(cls.folder),
            HOME=str(cls.folder), QT_QPA_PLATFORM='offscreen', PATH='%s:%s' % (programs, os.environ['PATH']))
        cls.console_port = kept_port(cls)
        for port, console in zip(cls.robot_ports, (['--console-port', str(cls.console_port)], ['--no-console'])):
            cls.start(['aibo_rcserver', '--port', str(port), *console, '--memory-stick', 'stick%d' % port])
        cls.start(['roslaunch', '-p', str(master), 'patient.launch'])
        cls.wait_for_driver()
        cls.record()

    @classmethod
    def make_files(cls):
        """The files that the pages name, and memory sticks that allow everything."""
        motions = PROJECT / 'aibo_rcserver/motion_tool/motions'
        shutil.copy(motions / 'NOD.txt', cls.folder / 'hello.txt')
        shutil.copy(MEMORY_STICK / 'OPEN-R/MW/DATA/P/NOD.MTN', cls.folder / 'HELLO.MTN')
        shutil.copy(PROJECT / 'config/colors/pink_ball.yaml', cls.folder / 'blue.yaml')
        for name in ('bark.wav', 'bark.ogg'):  # the driver knows a file's kind by its content
            with wave.open(str(cls.folder / name), 'wb') as sound:
                sound.setparams((1, 2, 16000, 0, 'NONE', ''))
                sound.writeframes(bytes(6400))
        # A busy computer may be silent for longer than a robot. No command needs more pictures a second.
        (cls.folder / 'patient.launch').write_text('''
            <launch>
              <param name="/aibo/aibo_driver/read_timeout" value="20.0"/>
              <include file="%s/launch/aibo.launch">
                <arg name="port" value="%d"/> <arg name="picture_folder" value="%s"/>
                <arg name="frame_rate" value="5"/> <arg name="telemetry_rate" value="10"/>
              </include>
            </launch>''' % (PROJECT, cls.robot_ports[0], cls.folder))
        for port in cls.robot_ports:
            stick = cls.folder / ('stick%d' % port)
            shutil.copytree(MEMORY_STICK, stick)
            settings = stick / 'OPEN-R/MW/CONF/RCSERVER.CFG'
            settings.write_text(re.sub(r'(?m)^(ALLOW_\w+)=no', r'\1=yes', settings.read_text()))

    @classmethod
    def start(cls, command):
        process = subprocess.Popen(command, cwd=cls.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.addClassCleanup(cls.end, process)

    @staticmethod
    def end(process):
        process.send_signal(signal.SIGINT)
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    @classmethod
    def wait_for_driver(cls):
        connected = cls.shell('until rostopic echo -n 1 /aibo/camera/camera_info > camera_info.txt; do sleep 0.2; done')
        output, _ = connected.communicate(timeout=PATIENCE)
        assert connected.returncode == 0, output

    @classmethod
    def record(cls):
        topics = ('/aibo/camera/image_raw/compressed', '/aibo/joint_states', '/aibo/link_quality')
        recorded = cls.shell('rosbag record --duration 3 -O walk.bag '
                             + ' '.join('/recorded{0} /recorded{0}:={0}'.format(topic) for topic in topics))
        output, _ = recorded.communicate(timeout=PATIENCE)
        assert recorded.returncode == 0, output

    @classmethod
    def shell(cls, text):
        functions = 'aibo() { command aibo --port %d "$@"; }' % cls.robot_ports[1]
        if PROJECT / 'build' in Path(os.environ['BUILD_FOLDER']).parents:
            functions += '; rosrun() { "${@:2}"; }'  # rosrun leaves out this folder, where builds with sanitizers are
        return subprocess.Popen(['bash', '-c', 'set -o pipefail; %s; %s' % (functions, text)], cwd=cls.folder,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                start_new_session=True)

    def test_scripts_know_their_options(self):
        for command in filter(lambda each: each.program.startswith('scripts/'), COMMANDS):
            help_text = subprocess.run([str(PROJECT / command.program), '--help'], capture_output=True, text=True,
                                       check=True).stdout
            for option in re.findall(r'(?<=\s)--[a-z][\w-]*', command.text.split(' #')[0]):
                with self.subTest(place=command.place, command=command.text):
                    self.assertIn(option, help_text)

    def test_launch_files_have_their_arguments(self):
        for command in filter(lambda each: each.program == 'roslaunch', COMMANDS):
            with self.subTest(place=command.place, command=command.text):
                text = command.text.replace('$PWD', str(self.folder)).replace('$HOME', str(self.folder))
                package, name, *arguments = shlex.split(text, comments=True)[1:]
                self.assertEqual(package, 'aibo_driver')
                path = str(PROJECT / 'launch' / name)
                for argument in arguments:
                    self.assertIn(argument.split(':=')[0], roslaunch.arg_dump.get_args([path]))
                roslaunch.xmlloader.XmlLoader(resolve_anon=False).load(
                    path, roslaunch.config.ROSLaunchConfig(), argv=arguments)

    def test_the_others_end_well(self):
        commands = self.for_shell(endless=False)
        for command in (each for each in commands if each.program != 'rostopic'):
            if command.program == 'rosservice' and '|' not in command.run:
                with self.subTest(place=command.place, command=command.text):
                    self.assertNotIn('success: False', self.call(command.run))
            else:
                self.expect_good_end(command, self.shell(command.run))
        self.call('rosservice call /aibo/stand')  # after the last of these, the robot lies
        # rostopic pub waits for three seconds after its work, so all of them run at once.
        for command, process in [(each, self.shell(each.run)) for each in commands if each.program == 'rostopic']:
            self.expect_good_end(command, process)

    @staticmethod
    def call(text):
        """rosservice without a process of its own, which would compute far longer than the call.

        A busy computer may deliver a call only when it is too old for the driver. Then it is made again.
        """
        answer = 'too old'
        end = time.monotonic() + PATIENCE
        while 'too old' in answer and time.monotonic() < end:
            with contextlib.redirect_stdout(io.StringIO()) as output:
                rosservice.rosservicemain(shlex.split(os.path.expandvars(text), comments=True))
            answer = output.getvalue()
        return answer

    def expect_good_end(self, command, process):
        self.addCleanup(self.kill, process)
        with self.subTest(place=command.place, command=command.text):
            output, _ = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 0, output)
            self.assertNotIn('success: False', output)

    def start_python(self, page, what):
        """Starts the first program in Python of a page that has these words in it."""
        programs = re.findall(r'^```python\n(.*?)^```', (PROJECT / page).read_text(encoding='utf-8'),
                              re.MULTILINE | re.DOTALL)
        program = next(each for each in programs if what in each)
        process = subprocess.Popen([sys.executable, '-c', program], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, start_new_session=True)
        self.addCleanup(self.kill, process)
        return process

    def test_the_action_in_python_plays_a_motion(self):
        output, _ = self.start_python('docs/python.md', 'SimpleActionClient').communicate(timeout=PATIENCE)
        # A machine that stalls for half a second loses the connection, and the robot's motion ends.
        self.assertRegex(output, 'It was played to its end|the connection to the robot was lost')

    def test_the_robot_thanks_for_a_pat(self):
        process = self.start_python('docs/python.md', 'likes_pats')
        end = time.monotonic() + PATIENCE
        with socket.create_connection(('127.0.0.1', self.console_port)) as console:
            hand = itertools.cycle((b'press back_middle\n', b'release back_middle\n'))
            while not select.select([process.stdout], [], [], 0.5)[0]:
                self.assertLess(time.monotonic(), end, 'it says nothing')
                console.sendall(next(hand))
        self.assertEqual(process.stdout.readline(), 'Thank you!\n')

    @unittest.skipUnless(importlib.util.find_spec('cv2'), 'OpenCV is not installed')
    def test_opencv_finds_edges(self):
        self.start_python('docs/python.md', 'cv2')
        edges = self.shell('rostopic echo -n 1 /aibo/edges/compressed')
        self.addCleanup(self.kill, edges)
        self.assertIn('format: "jpeg"', edges.communicate(timeout=PATIENCE)[0])

    def test_pictures_of_a_recording_become_files(self):
        output, _ = self.start_python('docs/recordings.md', '').communicate(timeout=PATIENCE)
        self.assertTrue((self.folder / '000000.jpg').is_file(), output)
        self.assertEqual((self.folder / '000000.jpg').read_bytes()[:2], b'\xff\xd8')

    def test_those_without_an_end_keep_running(self):
        running = [(command, self.shell(command.run)) for command in self.for_shell(endless=True)]
        for _, process in running:
            self.addCleanup(self.kill, process)
        time.sleep(4)  # a command that is wrong ends sooner
        for command, process in running:
            with self.subTest(place=command.place, command=command.text):
                self.assertIsNone(process.poll(), process.stdout.read() if process.poll() is not None else '')

    @staticmethod
    def for_shell(endless):
        return [command for command in COMMANDS
                if command.program != 'roslaunch' and not command.program.startswith('scripts/')
                and bool(ENDLESS.search(command.text)) == endless]

    @staticmethod
    def kill(process):
        """Ends the command and what it has started."""
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.stdout.close()
        process.wait()


if __name__ == '__main__':
    unittest.main()
