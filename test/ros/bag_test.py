"""aibo_bag lists, cuts and exports recordings, and says what is wrong with those that cannot be used."""
import contextlib
import csv
import hashlib
import importlib.machinery
import importlib.util
import io
import os
import resource
import signal
import sys
import tempfile
import time
import unittest
import warnings
from pathlib import Path
from unittest import mock

import genpy
import rosbag
from sensor_msgs.msg import CompressedImage, JointState

from aibo_driver.msg import Connection, LinkQuality, RobotState

PROGRAM = Path(__file__).resolve().parents[2] / 'aibo_driver/tools/aibo_bag'
loader = importlib.machinery.SourceFileLoader('aibo_bag', str(PROGRAM))
aibo_bag = importlib.util.module_from_spec(importlib.util.spec_from_loader('aibo_bag', loader))
loader.exec_module(aibo_bag)

BEGIN = 1032146825.75  # 2002-09-16 03:27:05 UTC
JPEG = bytes.fromhex('ffd8ffe0') + bytes(1000)  # aibo_bag does not look into it


class BagTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.set_zone('Here-9:30')

    def set_zone(self, zone):
        """That of the user."""
        self.addCleanup(time.tzset)
        patch = mock.patch.dict(os.environ, TZ=zone)
        patch.start()
        self.addCleanup(patch.stop)
        time.tzset()

    def path(self, name):
        return str(self.folder / name)

    def record(self, name='walk.bag', robots=('/aibo',), pictures=True):
        """Ten seconds, with ten measurements and pictures a second."""
        with rosbag.Bag(self.path(name), 'w') as bag:
            bag.write('/diagnostics', RobotState(), genpy.Time.from_sec(BEGIN + 5))  # of all robots
            for robot in robots:
                self.latch(bag, robot + '/connection', Connection(text='connected'), 0)
                self.latch(bag, robot + '/robot_state', RobotState(stopped_by='/anna'), 0)
                self.latch(bag, robot + '/robot_state', RobotState(stopped_by='/bert'), 4)
                for i in range(100):
                    stamp = genpy.Time.from_sec(BEGIN + i / 10)
                    joints = JointState(name=['head_pan', 'mouth'], velocity=[0.5, -0.125],
                                        position=[i / 100, -(1 + robots.index(robot)) / 10])
                    joints.header.stamp = stamp - genpy.Duration(0, 20000000)  # it took time to arrive
                    bag.write(robot + '/joint_states', joints, stamp)
                    if pictures:
                        picture = CompressedImage(data=JPEG + bytes([i]))
                        bag.write(robot + '/camera/image_raw/compressed', picture, stamp)
                    if i % 10 == 0:
                        link = LinkQuality(pictures_per_second=29.9 - i, pictures_per_second_asked=30 + i,
                                           age=(1 + i) / 1000, longest_age=(40 + i) / 1000, lost=(125 + i) / 1000)
                        bag.write(robot + '/link_quality', link, stamp)
        return self.path(name)

    @staticmethod
    def latch(bag, topic, message, seconds):
        header = {'topic': topic, 'type': message._type, 'md5sum': message._md5sum,
                  'message_definition': message._full_text, 'latching': '1'}
        bag.write(topic, message, genpy.Time.from_sec(BEGIN + seconds), connection_header=header)

    @staticmethod
    def run_program(*arguments, **environment):
        """The exit status, and what it prints to both streams."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), warnings.catch_warnings(), \
                mock.patch.dict(os.environ, environment), mock.patch.object(sys, 'argv', ['aibo_bag', *arguments]):
            # unittest shows such warnings, and with Python 3.13 one is about a file that rosbag leaves open.
            warnings.simplefilter('ignore', ResourceWarning)
            try:
                aibo_bag.main()
            except SystemExit as end:
                print(end.code, file=err)
                return 2 if end.code == 2 else 1, out.getvalue(), err.getvalue()
        return 0, out.getvalue(), err.getvalue()

    def succeed(self, *arguments, **environment):
        status, out, err = self.run_program(*arguments, **environment)
        self.assertEqual((status, err), (0, ''))
        return out

    def fail_with(self, text, *arguments, **environment):
        status, out, err = self.run_program(*arguments, **environment)
        self.assertEqual(status, 1, out)
        self.assertIn('aibo_bag: ', err)
        self.assertIn(text, err)
        self.assertEqual([file.name for file in self.folder.rglob('*.part')], [])

    def test_lists_what_is_in_it(self):
        lines = self.succeed('list', self.record()).splitlines()
        size = os.path.getsize(self.path('walk.bag')) / 1e6
        self.assertEqual(lines[0], 'walk.bag: 0:09 from 2002-09-16 12:57:05, robot /aibo, %.1f MB' % size)
        self.assertRegex('\n'.join(lines), r'\n +100 +10\.1/s  /aibo/camera/image_raw/compressed\n')

    def test_a_part_begins_with_what_was_latched(self):
        out = self.succeed('cut', self.record(), self.path('part.bag'), '--from', '0:04.75', '--to', '6')
        self.assertIn('part.bag', out)
        with rosbag.Bag(self.path('part.bag')) as bag:
            self.assertEqual((bag.get_start_time(), bag.get_end_time()), (BEGIN + 4.75, BEGIN + 6))
            messages = list(bag.read_messages('/aibo/robot_state', return_connection_header=True))
            self.assertEqual([each.message.stopped_by for each in messages], ['/bert'])
            self.assertIn(messages[0].connection_header['latching'], ('1', b'1'))
            self.assertEqual(bag.get_message_count('/aibo/connection'), 1, 'that of each topic')
            self.assertEqual(bag.get_message_count('/aibo/joint_states'), 13)
        self.assertIn('0:01', self.succeed('list', self.path('part.bag')), 'a part can be used again')
        self.succeed('joints', self.path('part.bag'), self.path('part.csv'), '--from', '0.5')
        with open(self.path('part.csv'), encoding='utf-8') as file:
            self.assertEqual(len(file.readlines()), 1 + 8)

    def test_pictures_are_the_robots_own(self):
        self.succeed('jpegs', self.record(), self.path('pictures'), '--from', '8.05')
        files = sorted(self.folder.joinpath('pictures').iterdir())
        self.assertEqual([file.name for file in files], ['%08.3f_%06d.jpg' % (8.1 + i / 10, i + 1) for i in range(19)])
        self.assertEqual(files[3].read_bytes(), JPEG + bytes([84]))

    def test_a_film_has_the_pace_of_the_pictures(self):
        recorder = self.folder / 'ffmpeg'
        recorder.write_text('#!/bin/sh\necho "$*" > "$0.words"\nfor last; do :; done\ncat > "$last"\n')
        recorder.chmod(0o755)
        self.succeed('mp4', self.record(), self.path('walk.mp4'), '--from', '1.05', '--to', '2',
                     PATH='%s:%s' % (self.folder, os.environ['PATH']))
        film = Path(self.path('walk.mp4')).read_bytes()
        shown = [film[i + len(JPEG)] for i in range(0, len(film), len(JPEG) + 1)]
        self.assertEqual(shown, [i for i in range(11, 20) for _ in range(3)] + [20])
        words = (self.folder / 'ffmpeg.words').read_text()
        self.assertRegex(words, r' -f mjpeg -framerate 30 -i - .* -f mp4 \S+/walk\.mp4\.part$')

    def test_a_film_needs_ffmpeg(self):
        walk = self.record()
        self.fail_with('sudo apt install ffmpeg', 'mp4', walk, self.path('walk.mp4'), PATH='/nonexistent')
        program, search = self.folder / 'ffmpeg', '%s:%s' % (self.folder, os.environ['PATH'])
        for text, problem in (('echo "no such encoder" >&2', 'ffmpeg failed: no such encoder'),
                              ('head -c 1000000 /dev/zero >&2\ncat > /dev/null', 'ffmpeg failed')):
            program.write_text('#!/bin/sh\n%s\nexit 1\n' % text)
            program.chmod(0o755)
            self.fail_with(problem, 'mp4', walk, self.path('walk.mp4'), PATH=search)

    def test_joints_are_a_table(self):
        self.succeed('joints', self.record(), self.path('walk.csv'))
        with open(self.path('walk.csv'), encoding='utf-8', newline='') as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 100)
        self.assertEqual(rows[25], {'time': '2.500', 'stamp': '1032146828.230000', 'head_pan': '0.25', 'mouth': '-0.1',
                                    'head_pan_speed': '0.5', 'mouth_speed': '-0.125'})

    def test_a_joint_that_was_not_measured_is_left_empty(self):
        with rosbag.Bag(self.path('one.bag'), 'w') as bag:  # a robot of version 1 measures one after the other
            for i, name in enumerate(('mouth', 'head_pan')):
                joints = JointState(name=[name], position=[i], velocity=[i / 8])
                bag.write('/aibo/joint_states', joints, genpy.Time.from_sec(BEGIN + i))
        self.succeed('joints', self.path('one.bag'), self.path('one.csv'), '--from', '0:01')
        with open(self.path('one.csv'), encoding='utf-8', newline='') as file:
            self.assertEqual(list(csv.DictReader(file)),
                             [{'time': '1.000', 'stamp': '0.000000', 'mouth': '', 'head_pan': '1.0', 'mouth_speed': '',
                               'head_pan_speed': '0.125'}])

    def test_a_plot_has_each_figure_in_its_unit(self):
        axes, figure = [mock.Mock(), mock.Mock(), mock.Mock()], mock.Mock()
        figure.savefig = lambda path, **_: Path(path).touch()
        pyplot = mock.Mock(subplots=mock.Mock(return_value=(figure, axes)))
        with mock.patch.dict(sys.modules, {'matplotlib': mock.Mock(pyplot=pyplot), 'matplotlib.pyplot': pyplot}):
            self.succeed('plot', self.record(), self.path('walk.png'), '--from', '2', '--to', '3')
        drawn = [[call[0] for call in axis.step.call_args_list] for axis in axes]
        self.assertEqual([len(lines) for lines in drawn], [2, 2, 1])
        self.assertEqual([axis.set_ylabel.call_args[0][0] for axis in axes], ['pictures/s', 'age in ms', 'lost in %'])
        for (times, values), expected in zip(sum(drawn, []), ([9.9, -0.1], [50, 60], [60, 70], [21, 31], [14.5, 15.5])):
            self.assertEqual(times, [2, 3])
            self.assertEqual([round(value, 4) for value in values], expected)
        self.assertEqual([[call[1].get('label') for call in axis.step.call_args_list] for axis in axes],
                         [['came', 'asked'], ['longest', 'mean'], [None]])

    def test_a_plot_needs_matplotlib(self):
        with mock.patch.dict(sys.modules, {'matplotlib': None}):
            self.fail_with('sudo apt install python3-matplotlib', 'plot', self.record(), self.path('walk.png'))

    def test_one_of_several_robots_is_chosen(self):
        both = self.record(robots=('/left', '/lefty', '/team/right'))
        self.fail_with('/left, /lefty, /team/right. Choose one with --robot', 'joints', both, self.path('a.csv'))
        self.assertIn('robot /left, /lefty, /team/right,', self.succeed('list', both))
        self.fail_with('has these robots', 'joints', both, self.path('a.csv'), '--robot', 'middle')
        self.succeed('joints', both, self.path('a.csv'), '--robot', 'team/right')
        self.assertIn(',-0.3,', Path(self.path('a.csv')).read_text(encoding='utf-8'))
        self.fail_with('has these robots', 'cut', both, self.path('a.bag'), '--robot', 'middle')
        self.succeed('cut', both, self.path('one.bag'), '--robot', 'left')
        self.succeed('cut', both, self.path('all.bag'))
        for name, robots in (('one.bag', '/left, 0.'), ('all.bag', '/left, /lefty, /team/right, 0.')):
            listed = self.succeed('list', self.path(name))
            self.assertIn('robot ' + robots, listed)
            self.assertIn(' /diagnostics\n', listed)

    def test_nothing_is_overwritten(self):
        walk = self.record()
        self.fail_with('walk.bag exists already', 'cut', walk, walk, '--to', '5')
        Path(self.path('walk.csv.part')).write_text('left by a program that was killed')
        self.succeed('joints', walk, self.path('walk.csv'))
        self.fail_with('walk.csv exists already', 'joints', walk, self.path('walk.csv'))
        self.succeed('jpegs', walk, self.path('pictures'))
        self.fail_with('/0000.000_000001.jpg exists already', 'jpegs', walk, self.path('pictures'))

    def test_what_cannot_be_used_is_explained(self):
        self.folder.joinpath('text.bag').write_text('This is no bag.')
        rosbag.Bag(self.path('empty.bag'), 'w').close()
        self.record('blind.bag', pictures=False)
        for command, bag, output, text in (
                ('list', 'none.bag', (), 'No such file'), ('list', 'text.bag', (), 'text.bag is no bag'),
                ('list', 'empty.bag', (), 'empty.bag is empty'), ('list', '', (), 'Is a directory'),
                ('jpegs', 'blind.bag', ('a',), 'has no /aibo/camera/image_raw/compressed'),
                ('mp4', 'blind.bag', ('a.mp4',), 'has no /aibo/camera/image_raw/compressed'),
                ('cut', 'blind.bag', ('a.bag', '--from', '20'), 'nothing was recorded in this time'),
                ('joints', 'blind.bag', ('a.csv', '--from', '20'), 'in this time. The bag is 0:09 long')):
            with self.subTest(command=command, bag=bag):
                words = (self.path(output[0]), *output[1:]) if output else ()
                self.fail_with(text, command, self.path(bag), *words)
                self.assertFalse(output and os.path.exists(self.path(output[0])))

    def test_times_are_seconds_or_minutes_and_seconds(self):
        for text, seconds in (('7', 7), ('0:12', 12), ('61:05.5', 3665.5), ('00:00', 0)):
            self.assertEqual(aibo_bag.seconds_in(text), seconds)
        bag = self.record()
        for text in ('1:xx', '1:-1', '-0:30', '1::2', ':', '', 'nan', 'inf', 2000 * '9', '--to=65'):
            status, _, err = self.run_program('cut', bag, self.path('a.bag'), '--from=' + text)
            self.assertEqual((status, "'%s' is no time" % text in err), (2, True), text)
        status, _, err = self.run_program('cut', bag, self.path('a.bag'), '--from', '1:05', '--to', '65')
        self.assertEqual((status, '--to must be after --from' in err), (2, True))

    def test_a_bag_without_a_robot_is_explained(self):
        for name, topic in (('other.bag', '/turtle/pose'), ('same.bag', '/aibo/joint_states')):
            with rosbag.Bag(self.path(name), 'w') as bag:
                bag.write(topic, RobotState(), genpy.Time.from_sec(BEGIN))
        self.assertIn(', no robot, ', self.succeed('list', self.path('other.bag')))
        self.fail_with('no robot, but only the topics /turtle/pose', 'joints', self.path('other.bag'), self.path('a'))
        self.fail_with('is of the type aibo_driver/RobotState, not sensor_msgs/JointState', 'joints',
                       self.path('same.bag'), self.path('a'))

    def test_a_bag_that_was_cut_off_can_be_repaired(self):
        walk = Path(self.record())
        walk.write_bytes(walk.read_bytes()[:100000])
        self.fail_with('rosbag reindex', 'list', str(walk))

    def test_damage_is_said(self):
        walk = Path(self.record())
        data = bytearray(walk.read_bytes())
        data[60000:80000] = b'\xff' * 20000
        walk.write_bytes(data)
        self.fail_with('damaged', 'joints', str(walk), self.path('a.csv'))

    def record_as(self, topic, kind, definition, data=bytes(64)):
        """A bag whose message has a definition of its own."""
        md5sum = hashlib.md5(definition.encode()).hexdigest()  # rosbag remembers the types that it has made
        with rosbag.Bag(self.path('strange.bag'), 'w') as bag:
            bag.write(topic, (kind, data, md5sum, JointState), genpy.Time.from_sec(BEGIN), raw=True,
                      connection_header={'topic': topic, 'type': kind, 'md5sum': md5sum,
                                         'message_definition': definition})
        return self.path('strange.bag')

    def test_a_bag_runs_no_code(self):
        code = '__import__("pathlib").Path("%s").touch()' % self.path('done')
        joints = 'sensor_msgs/JointState'
        for kind, definition in ((joints, 'string %s; A=x' % code), (joints, 'uint8 %s;A=1' % code.replace(' ', '')),
                                 (joints, 'string \r  %s\r  A=x' % code), (joints, 'bool A=%s' % code),
                                 ('a/B:\n  %s\nclass C' % code, 'uint8 a'),
                                 (joints, 'b/B b\n%s\nMSG: b/B:\r  %s\rclass C\nuint8 a' % (80 * '=', code))):
            bag = self.record_as('/aibo/joint_states', kind, definition)
            for command in ('joints', 'cut'):
                with self.subTest(command=command, kind=kind, definition=definition):
                    self.fail_with('', command, bag, self.path('output'))
                    self.assertFalse(os.path.exists(self.path('done')))
            os.remove(bag)

    def test_constants_and_their_comments_are_possible(self):
        definition = 'uint8 A = 1\nfloat32 \tB=-1e3 # =(\nstring C=(d"e) = f\n# g = h()\nstring[] name\r\n' \
                     'float64[] position\nfloat64[] velocity\ni/J header\n%s\nMSG: i/J\ntime stamp\n' % (80 * '=')
        bag = self.record_as('/aibo/joint_states', 'sensor_msgs/JointState', definition)
        self.assertEqual(self.run_program('joints', bag, self.path('joints.csv'))[0], 0)

    def test_messages_of_another_version_are_named(self):
        bag = self.record_as('/aibo/joint_states', 'sensor_msgs/JointState', 'uint8 data')
        self.fail_with('another version', 'joints', bag, self.path('joints.csv'))

    def test_a_terminal_obeys_nothing_of_a_bag(self):
        bag = self.record_as('/\x1b[2J\x07/joint_states', 'std_msgs/UInt8', 'uint8 data')
        self.assertIn('/?[2J?/joint_states', self.succeed('list', bag))
        self.fail_with('/?[2J?', 'jpegs', bag, self.path('pictures'), '--robot', '/\x1b[2J\x07')

    def test_a_film_does_not_wait_for_days(self):
        picture = mock.Mock(data=JPEG)
        with self.assertRaisesRegex(aibo_bag.Problem, '2:00.*60:00|60:00.*0:02'):
            list(aibo_bag.film([(1, picture), (2, picture), (3602.5, picture)], 30))
        self.assertEqual(len(list(aibo_bag.film([(0, picture), (3000, picture), (6000, picture)], 0.01))), 61,
                         'a long film is no pause')

    def test_a_full_disk_leaves_no_half_a_file(self):
        walk = self.record()
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # then writing fails, as on a full disk
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
        self.addCleanup(resource.setrlimit, resource.RLIMIT_FSIZE, before)
        for command, output in (('cut', 'a.bag'), ('joints', 'a.csv')):
            self.fail_with('File too large', command, walk, self.path(output))
            self.assertFalse(os.path.exists(self.path(output)))


if __name__ == '__main__':
    unittest.main()
