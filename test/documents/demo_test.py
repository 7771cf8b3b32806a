"""scripts/demo shows pictures, saves one, and says what did not start. What it starts is ended with it."""
import json
import os
import pty
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / 'scripts'

# Stands for each program that scripts/demo starts. It notes its name, arguments and environment, and then does what
# PLAY says for this name: Python statements.
PROGRAM = '''#!/usr/bin/python3
import json, os, signal, subprocess, sys, time
from pathlib import Path
name, home = os.path.basename(sys.argv[0]), Path(%(home)r)
with open(home / 'log', 'a') as log:
    log.write(json.dumps([name, sys.argv[1:], dict(os.environ)]) + '\\n')
times = sum(json.loads(line)[0] == name for line in open(home / 'log'))
exec((home / 'plays' / name).read_text())
'''

PLAYS = {
    'install_dependencies': '',
    'build': '',
    # roslaunch says which nodes there are and which it has started, prints what they say, and ends at Ctrl-C.
    'roslaunch': '''
signal.signal(signal.SIGINT, lambda *_: ((home / 'interrupted').touch(), sys.exit(0)))
print('NODES\\n  /\\n    aibo_rcserver (aibo_driver/aibo_rcserver)\\n  /aibo/\\n    aibo_driver (aibo_driver/aibo_driver_node)')
for name in ('master', 'rosout-1', 'aibo_rcserver-2', 'aibo_driver-3'):
    print('process[' + name + ']: started with pid [1]')
print('a node says something', flush=True)
while True:
    signal.pause()
''',
    # The monitor ends when a file says how.
    'rosrun': '''
signal.signal(signal.SIGINT, lambda *_: sys.exit(0))
while not (home / 'monitor').exists():
    time.sleep(0.02)
sys.exit(int((home / 'monitor').read_text()))
''',
    # The first picture is not there yet.
    'rosservice': '''
if times == 1:
    sys.exit('no picture yet')
text = sys.argv[3].split("save_to: '")[1][:-2].replace("''", "'")
Path(text).write_bytes(bytes(1234))
print("success: True")
(home / 'end').write_text('0')
(home / 'end').rename(home / 'monitor')
''',
    'Xvfb': '''
os.write(3, b'77\\n')
signal.pause()
''',
    # Only the second screenshot has a picture in it.
    'import': "Path(sys.argv[-1]).write_text('shot')",
    'convert': '''
print(3001 if times > 1 else 3000) if sys.argv[-1] == 'info:' else Path(sys.argv[-1]).write_text('trimmed')
''',
}


class StepsTest(unittest.TestCase):
    """Its steps, in a project in which all programs are only played."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name)
        self.place = self.home / "Anna's pictures"
        for name in ('scripts', 'plays', 'bin', '.build/devel', self.place, 'tmp'):
            (self.home / name).mkdir(parents=True)
        for name in ('demo', 'lib.sh'):
            shutil.copy(SCRIPTS / name, self.home / 'scripts')
        (self.home / '.build/devel/setup.bash').write_text(f'PATH={self.home}/bin:$PATH\n')
        for name, play in PLAYS.items():
            self.play(name, play)
            program = self.home / ('scripts' if name in ('install_dependencies', 'build') else 'bin') / name
            program.write_text(PROGRAM % {'home': str(self.home)})
            program.chmod(0o755)

    def play(self, name, play):
        (self.home / 'plays' / name).write_text(play)

    def start(self, *options, display=''):
        environment = {**os.environ, 'DISPLAY': display, 'TMPDIR': str(self.home / 'tmp'), 'ROS_NAMESPACE': 'other'}
        return subprocess.Popen([self.home / 'scripts/demo', *options], cwd=self.place, env=environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def demo(self, *options, status=0, display=''):
        """What it prints, and then what it complains about."""
        with self.start(*options, display=display) as demo:
            out, errors = demo.communicate(timeout=120)
        self.assertEqual(demo.returncode, status, out + errors)
        self.check_that_nothing_is_left()
        return out if status == 0 else errors

    def check_that_nothing_is_left(self):
        self.assertEqual(list((self.home / 'tmp').iterdir()), [])
        left = [path for path in Path('/proc').glob('[0-9]*/environ')
                if f'AIBO_DEMO={self.home}'.encode() in self.content(path)]
        self.assertEqual(left, [])

    @staticmethod
    def content(path):
        try:
            return path.read_bytes()
        except OSError:  # it has ended, or belongs to somebody else
            return b''

    def started(self, name):
        """The arguments of each start of a program, and its last environment."""
        lines = [json.loads(line) for line in (self.home / 'log').read_text().splitlines()]
        chosen = [(arguments, environment) for program, arguments, environment in lines if program == name]
        return [arguments for arguments, _ in chosen], chosen[-1][1] if chosen else None

    def launched(self):
        """The arguments of demo.launch, by name, without the ports, which have to be numbers of their own."""
        (port, file, *words), environment = self.started('roslaunch')[0][0], self.started('roslaunch')[1]
        self.assertEqual(file, str(self.home / 'launch/demo.launch'))
        self.assertEqual(environment['ROS_MASTER_URI'], 'http://127.0.0.1:' + port.split('=')[1])
        arguments = dict(word.split(':=') for word in words)
        self.assertEqual(arguments.pop('web'), 'true')
        names = ('web_port',) if 'host' in arguments else ('web_port', 'port', 'console_port')
        ports = {port.split('=')[1], *(arguments.pop(name) for name in names)}
        self.assertEqual(len(ports), 1 + len(names))
        return arguments

    def test_shows_pictures_saves_one_and_ends_all(self):
        out = self.demo('--seconds', '3', '--still')
        self.assertEqual(self.started('install_dependencies')[0], [['build']])
        self.assertEqual(self.started('build')[0], [['aibo_demo']])
        self.assertEqual(self.launched(), {'still': 'true', 'walk': 'false', 'images': '', 'picture_folder': str(self.place)})
        monitor, environment = self.started('rosrun')
        self.assertEqual(monitor, [['aibo_driver', 'aibo_monitor', '_seconds:=3', '_first_picture_timeout:=60']])
        self.assertEqual((environment['ROS_NAMESPACE'], environment['ROS_IP']), ('aibo', '127.0.0.1'))
        self.assertEqual(self.started('rosservice')[1].get('ROS_NAMESPACE'), None)
        self.assertEqual(self.started('rosservice')[0][0][:2], ['call', '/aibo/take_picture'])
        self.assertIn(f'take_picture saved {self.place}/picture.jpg: 1234 bytes\n', out)
        for words in ('Starting the simulated ERS-7', environment['ROS_MASTER_URI'], 'Start: 2 nodes in', 'Stopping\n'):
            self.assertIn(words, out)
        self.assertTrue((self.home / 'interrupted').exists())

    def test_connects_to_a_robot(self):
        out = self.demo('--robot', 'aibo.local', '--walk')
        self.assertIn('Starting the driver for the robot at aibo.local', out)
        self.assertEqual(self.launched(), {'still': 'false', 'walk': 'true', 'simulation': 'false', 'host': 'aibo.local',
                                           'picture_folder': str(self.place)})

    def test_shows_photographs_and_rviz(self):
        (self.place / 'photos').mkdir()
        self.play('roslaunch', "if times > 1:\n  sys.exit('rviz was closed, or crashed')\n" + PLAYS['roslaunch'])
        self.play('rosservice', "while 'view.launch' not in (home / 'log').read_text():\n    time.sleep(0.02)\n" +
                  PLAYS['rosservice'])
        self.demo('--images', 'photos', display=':0')
        self.assertEqual(self.launched(), {'still': 'false', 'walk': 'false', 'images': str(self.place / 'photos'),
                                           'picture_folder': str(self.place)})
        self.assertEqual(self.started('roslaunch')[0][1:], [[str(self.home / 'launch/view.launch')]])
        self.assertEqual(self.started('install_dependencies')[0], [['build', 'rviz']])
        self.assertEqual(self.started('build')[0], [['aibo_demo_with_rviz']])

    def test_saves_a_screenshot_without_a_display(self):
        out = self.demo('--screenshot', 'shot.png')
        self.assertIn('screenshot: shot.png\n', out)
        self.assertEqual((self.place / 'shot.png').read_text(), 'trimmed')
        self.assertEqual(self.started('install_dependencies')[0], [['build', 'rviz', 'screenshot']])
        views, environment = self.started('roslaunch')
        self.assertEqual(views[1], [str(self.home / 'launch/view.launch')])
        self.assertEqual((environment['DISPLAY'], environment['LIBGL_ALWAYS_SOFTWARE']), (':77', '1'))
        self.assertEqual(len(self.started('import')[0]), 2)
        self.play('roslaunch', "if times > 3:\n  sys.exit('no rviz')\n" + PLAYS['roslaunch'])
        self.play('convert', 'print(3000)')
        self.assertIn('rviz ended by itself', self.demo('--screenshot', 'shot.png', status=1))

    def test_says_what_did_not_start(self):
        self.play('rosservice', "sys.exit('no picture yet')")
        (self.home / 'monitor').write_text('1')
        errors = self.demo(status=1)
        for words in ('a node says something', 'no picture came.', 'docs/troubleshooting.md'):
            self.assertIn(words, errors)
        (self.home / 'monitor').unlink()
        self.play('roslaunch', "sys.exit('no such file')")
        errors = self.demo(status=1)
        self.assertIn('no such file\n', errors)
        self.assertIn('the nodes did not start, or stopped by themselves', errors)
        self.play('build', 'sys.exit(1)')
        (self.home / 'log').unlink()
        self.demo(status=1)
        self.assertEqual(self.started('roslaunch')[0], [])

    def test_ends_when_a_node_does_not_start(self):
        for line, said in (('ERROR: cannot launch node of type [aibo_driver/aibo_room]: Cannot locate node',
                            'cannot launch node of type [aibo_driver/aibo_room]'),
                           ('\x1b[31m[aibo_room-4] process has died [pid 7, exit code 1, cmd x].\x1b[0m',
                            '[aibo_room-4] process has died')):
            self.play('roslaunch', PLAYS['roslaunch'].replace("print('a node says something'", f'print({line!r}'))
            self.assertIn(f'a node did not start, or has ended with an error: {said}', self.demo(status=1))

    def test_ctrl_c_ends_it_at_any_time(self):
        self.play('rosservice', "(home / 'asked').touch()\nsys.exit('no picture yet')")
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(self.place)
            os.execve(self.home / 'scripts/demo', ['demo'], {**os.environ, 'DISPLAY': '', 'TMPDIR': str(self.home / 'tmp')})
        self.addCleanup(os.close, terminal)
        out = b''
        while not (self.home / 'asked').exists():
            self.assertEqual(os.waitpid(child, os.WNOHANG)[0], 0)
        os.write(terminal, b'\3')
        try:
            while data := os.read(terminal, 1000):
                out += data
        except OSError:  # the terminal of a program that has ended
            pass
        self.assertEqual(os.WEXITSTATUS(os.waitpid(child, 0)[1]), 130)
        self.assertIn(b'Stopping\r\n', out)
        self.assertTrue((self.home / 'interrupted').exists())
        self.check_that_nothing_is_left()

    def test_ends_what_does_not_want_to_end(self):
        self.play('roslaunch', "subprocess.Popen(['setsid', 'sleep', '1000'])\n" + PLAYS['roslaunch'])
        self.play('rosrun', 'signal.signal(signal.SIGINT, signal.SIG_IGN)\nsignal.pause()')
        with self.start() as demo:
            while 'take_picture saved' not in (line := demo.stdout.readline()):
                self.assertTrue(line)
            demo.send_signal(signal.SIGTERM)
            demo.communicate(timeout=120)
        self.assertEqual(demo.returncode, 143)
        self.check_that_nothing_is_left()


if __name__ == '__main__':
    unittest.main()
