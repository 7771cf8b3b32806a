"""What aibo_calibrate_walk makes of where odometry and the user say that a robot has walked."""
import importlib.machinery
import importlib.util
import math
import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

PROJECT = Path(__file__).resolve().parents[2]
PROGRAM = PROJECT / 'aibo_driver/tools/aibo_calibrate_walk'
sys.path.append(str(PROJECT / 'aibo_rcserver/host_files'))
loader = importlib.machinery.SourceFileLoader('aibo_calibrate_walk', str(PROGRAM))
program = importlib.util.module_from_spec(importlib.util.spec_from_loader('aibo_calibrate_walk', loader))
loader.exec_module(program)
Way = program.Way


def arc(length, direction, curve):
    """Where a robot is that has walked an arc, worked out in small steps."""
    x = y = 0.0
    steps = 10000
    for i in range(steps):
        heading = direction + (i + 0.5) / steps * length * curve
        x += length / steps * math.cos(heading)
        y += length / steps * math.sin(heading)
    return Way(x, y, length * curve)


STRAIGHT = {'ahead': Way(1.0, 0.0, 0.0), 'left': Way(0.0, 0.5, 0.0), 'turn': Way(0.0, 0.0, 12.6)}


class CalibrateWalkTest(unittest.TestCase):
    def test_finds_each_number(self):
        real = {'ahead': arc(0.9, 0.1, -0.8), 'left': Way(y=0.4), 'turn': Way(turn=13.86)}
        found = program.calibration(program.USUAL, STRAIGHT, real)
        self.assertEqual(found, {'walk_scale': 0.9, 'walk_side_scale': 0.8, 'walk_turn_scale': 1.1,
                                 'walk_direction': 0.1, 'walk_curve': -0.8})

    def test_a_robot_that_is_calibrated_well_keeps_its_calibration(self):
        before = {'walk_scale': 0.9, 'walk_side_scale': 0.8, 'walk_turn_scale': 1.1, 'walk_direction': 0.1,
                  'walk_curve': -0.8}
        said = {'ahead': arc(1.03, -0.05, 0.3), 'left': Way(0.02, 0.51, 0.1), 'turn': Way(0.1, 0.1, 12.7)}
        found = program.calibration(before, said, said)
        for name, value in before.items():
            self.assertAlmostEqual(found[name], value, 6)

    def test_says_which_number_cannot_be_right(self):
        real = {**STRAIGHT, 'left': Way(y=50)}  # centimetres
        with self.assertRaisesRegex(program.Problem, 'walk_side_scale would be 100.* in metres'):
            program.calibration(program.USUAL, STRAIGHT, real)

    @staticmethod
    def odometry(x, y, yaw):
        odom = program.Odometry()
        odom.pose.pose.position.x, odom.pose.pose.position.y = x, y
        odom.pose.pose.orientation.z, odom.pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        return odom

    def test_steers_by_cmd_vel_and_hears_odom(self):
        with mock.patch.object(program.rospy, 'Publisher') as publisher, \
                mock.patch.object(program.rospy, 'Subscriber') as subscriber:
            program.Robot()
        self.assertEqual([each.call_args[0][:2] for each in (publisher, subscriber)],
                         [('cmd_vel', program.Twist), ('odom', program.Odometry)])

    def test_hears_turns_beyond_half_a_circle(self):
        robot = program.Robot.__new__(program.Robot)
        robot.pose, robot.turned = None, 0.0
        for step in range(41):  # two full turns and a little more, from a place and a direction
            robot.hear(self.odometry(2, 1, 2 + 0.32 * step))
            if step == 0:
                begin = (robot.pose, robot.turned)
        way = robot.way_since(begin)
        self.assertAlmostEqual(way.turn, 12.8)
        self.assertAlmostEqual(math.hypot(way.x, way.y), 0)
        robot.hear(self.odometry(2 + math.cos(2) - 0.1 * math.sin(2), 1 + math.sin(2) + 0.1 * math.cos(2), 2))
        way = robot.way_since(begin)
        self.assertAlmostEqual(way.x, 1)
        self.assertAlmostEqual(way.y, 0.1)
        self.assertAlmostEqual(way.turn, 4 * math.pi, msg='it has turned back a little')

    def test_drives_and_asks_for_each_way(self):
        drives, said_and_done = [], []
        answers = iter(['', '0.95', '-0.1', '9', '', '0.45', '', '-18'])
        robot = mock.Mock()

        def drive(velocity, part_done):
            drives.append((velocity, [part_done(way) for way in (Way(x=0.5), Way(y=0.5), Way(turn=math.pi))]))
            said_and_done.append('drives')
            return len(drives)

        def answer(question):
            said_and_done.append('waits' if 'Press Enter to begin' in question else 'asks')
            return next(answers)
        robot.drive = drive
        with mock.patch('builtins.input', side_effect=answer), mock.patch('builtins.print'):
            said, real = program.measure(robot)
        self.assertEqual(drives, [((0.1, 0, 0), [0.5, 0, 0]), ((0, 0.05, 0), [0, 1, 0]), ((0, 0, 0.5), [0, 0, 0.25])])
        self.assertEqual(' '.join(said_and_done), 'waits drives asks asks asks waits drives asks waits drives asks')
        self.assertEqual(said, {'ahead': 1, 'left': 2, 'turn': 3})
        self.assertEqual((real['ahead'].x, real['ahead'].y), (0.95, -0.1))
        self.assertAlmostEqual(real['ahead'].turn, math.pi / 20)
        self.assertEqual((real['left'].x, real['left'].y), (0, 0.45))
        self.assertAlmostEqual(real['turn'].turn, 3.9 * math.pi)

    def run_program(self, parameters, *arguments):
        """What becomes of the parameters of a driver after a walk of 0.9 m instead of 1 m."""
        robot, self.said = mock.Mock(), []
        with mock.patch.object(program, 'Robot', return_value=robot), \
                mock.patch.object(program, 'measure', return_value=(STRAIGHT, {**STRAIGHT, 'ahead': Way(0.9)})), \
                mock.patch.object(program.rospy, 'init_node'), mock.patch('builtins.print', self.said.append), \
                mock.patch.object(program.rospy, 'resolve_name', lambda name: '/aibo/' + name), \
                mock.patch.object(program.rospy, 'get_param', lambda name, usual: parameters.get(name, usual)), \
                mock.patch.object(program.sys, 'argv', ['aibo_calibrate_walk', *arguments, '__ns:=aibo']):
            program.main()
        robot.await_odometry.assert_called_once()

    def test_writes_what_the_driver_can_read(self):
        with tempfile.TemporaryDirectory() as folder:
            parameters = {'~driver': 'dog', 'dog/guard': False, 'dog/walk_scale': 0.8, 'aibo_driver/walk_scale': 2.0}
            os.mkdir(folder + '/.ros')
            Path(folder + '/.ros/walk_calibration.yaml').write_text('of: an earlier day\n', encoding='utf-8')
            with mock.patch.dict(os.environ, ROS_HOME=folder + '/.ros'):
                self.run_program(parameters)
            text = Path(folder + '/.ros/walk_calibration.yaml').read_text(encoding='utf-8')
            self.assertEqual(program.yaml.safe_load(text), {**program.USUAL, 'walk_scale': 0.72})
            for size in range(1, len(text) - 1):
                with self.assertRaises(program.yaml.YAMLError, msg='half of it is no calibration'):
                    program.yaml.safe_load(text[:size])
            with self.assertRaises(OSError):
                self.run_program(parameters, folder + '/missing/a.yaml')
            self.assertEqual((os.listdir(folder), os.listdir(folder + '/.ros')), (['.ros'], ['walk_calibration.yaml']))
            self.assertIn('walk_scale: 0.72 (was 0.8)', self.said[0], 'the measurement is not lost')

    def test_needs_a_driver_that_does_not_guard_the_walk(self):
        with self.assertRaisesRegex(program.Problem, '/aibo/aibo_driver guards the walk. Start it with guard:=false'):
            self.run_program({}, '/nowhere/a.yaml')

    def test_steers_until_odometry_says_that_it_is_far_enough(self):
        robot = program.Robot.__new__(program.Robot)
        robot.pose, robot.turned, steered = (2.0, 1.0, math.pi / 2), 0.5, []

        def steer(x=0.0, y=0.0, turn=0.0):
            steered.append((x, y, turn))
            robot.pose = (robot.pose[0], robot.pose[1] + x, robot.pose[2])

        def wait(seconds):
            clock[0] += 3  # longer than its patience in all
            if seconds == program.STANDS_AFTER:
                robot.pose = (robot.pose[0], robot.pose[1] + 0.05, robot.pose[2])

        robot.steer, clock = steer, [0]
        with mock.patch.object(program.time, 'sleep', wait), \
                mock.patch.object(program.time, 'monotonic', lambda: clock[0]):
            way = robot.drive((0.25, 0, 0), lambda way: way.x / 1.0)
        self.assertEqual(steered, [(0.25, 0, 0)] * 4 + [(0.0, 0.0, 0.0)])
        self.assertAlmostEqual(way.x, 1.05)
        self.assertAlmostEqual(way.y, 0.0)
        self.assertAlmostEqual(way.turn, 0.0, msg='what it has turned before does not count')

    def test_a_robot_that_does_not_walk_is_no_calibration(self):
        robot = program.Robot.__new__(program.Robot)
        robot.pose, robot.turned, robot.steer = (0.0, 0.0, 0.0), 0.0, mock.Mock()
        with mock.patch.object(program, 'PATIENCE', 0), self.assertRaisesRegex(program.Problem, 'does not walk on'):
            robot.drive((0.1, 0, 0), lambda way: way.x)
        robot.steer.assert_called_with()
        with mock.patch.object(program.time, 'sleep', side_effect=KeyboardInterrupt), \
                mock.patch.object(program.rospy, 'is_shutdown', lambda: False), self.assertRaises(KeyboardInterrupt):
            robot.drive((0.1, 0, 0), lambda way: way.x)
        robot.steer.assert_called_with()


if __name__ == '__main__':
    unittest.main()
