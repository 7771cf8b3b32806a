"""What aibo_calibrate_walk makes of where odometry and the user say that a robot has walked."""
import importlib.machinery
import importlib.util
import math
import unittest
from pathlib import Path
from unittest import mock

PROGRAM = Path(__file__).resolve().parents[2] / 'aibo_driver/tools/aibo_calibrate_walk'
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

    def test_asks_until_it_gets_a_number(self):
        with mock.patch('builtins.input', side_effect=['', '1 m', 'nan', ' 0,95 ']), mock.patch('builtins.print'):
            self.assertEqual(program.ask('How far'), 0.95)

    def test_steers_until_odometry_says_that_it_is_far_enough_and_then_stops(self):
        robot = program.Robot.__new__(program.Robot)
        robot.pose, robot.turned, steered = (2.0, 1.0, math.pi / 2), 0.5, []

        def steer(x=0.0, y=0.0, turn=0.0):
            steered.append((x, y, turn))
            robot.pose = (robot.pose[0], robot.pose[1] + x, robot.pose[2])

        robot.steer = steer
        with mock.patch.object(program.time, 'sleep'):
            way = robot.drive((0.25, 0, 0), lambda way: way.x / 1.0)
        self.assertEqual(steered, [(0.25, 0, 0)] * 4 + [(0.0, 0.0, 0.0)])
        self.assertAlmostEqual(way.x, 1.0)
        self.assertAlmostEqual(way.y, 0.0)

    def test_a_robot_that_does_not_walk_is_no_calibration(self):
        robot = program.Robot.__new__(program.Robot)
        robot.pose, robot.turned, robot.steer = (0.0, 0.0, 0.0), 0.0, mock.Mock()
        with mock.patch.object(program, 'PATIENCE', 0), self.assertRaisesRegex(program.Problem, 'does not walk on'):
            robot.drive((0.1, 0, 0), lambda way: way.x)
        robot.steer.assert_called_with()


if __name__ == '__main__':
    unittest.main()
