"""The window of aibo_sliders, without ROS and without a display. Skipped where Qt is missing."""

import importlib.machinery
import importlib.util
import os
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
os.environ['QT_QPA_PLATFORM'] = 'offscreen'
try:
    from PyQt5.QtWidgets import QApplication, QPushButton
except ImportError:
    sys.exit(77)


def load():
    loader = importlib.machinery.SourceFileLoader('aibo_sliders', os.path.join(ROOT, 'aibo_driver/tools/aibo_sliders'))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader('aibo_sliders', loader))
    loader.exec_module(module)
    return module


aibo_sliders = load()
APP = QApplication([])
LIMITS = {'head_pan': (-1.5, 1.5), 'mouth': (-1.0, -0.05)}


class SlidersTest(unittest.TestCase):
    def setUp(self):
        self.sent = []
        self.window = aibo_sliders.Sliders(LIMITS, self.sent.append)
        self.window.timer.stop()  # the tests send

    def measure(self, **positions):
        self.window.measured.emit(positions)
        self.window.send_changes()

    def move(self, name, position):
        self.window.sliders[name].slider.setValue(round(position * aibo_sliders.STEPS_PER_RADIAN))
        self.window.send_changes()

    def shown(self, name):
        return self.window.sliders[name].slider.value() / aibo_sliders.STEPS_PER_RADIAN

    def test_sliders_begin_where_the_joints_are_and_command_nothing(self):
        self.measure(head_pan=0.4, mouth=-0.6, left_ear=0.0)
        self.assertAlmostEqual(self.shown('head_pan'), 0.4)
        self.assertAlmostEqual(self.shown('mouth'), -0.6)
        self.assertEqual(self.sent, [])

    def test_a_slider_waits_for_the_measurement_of_its_joint(self):
        self.measure(head_pan=0.4)
        self.assertTrue(self.window.sliders['head_pan'].slider.isEnabled())
        self.assertFalse(self.window.sliders['mouth'].slider.isEnabled())

    def test_a_slider_that_is_moved_commands_its_joint_once(self):
        self.measure(head_pan=0.4, mouth=-0.6)
        self.move('head_pan', 0.5)
        self.window.send_changes()
        self.assertEqual(self.sent, [{'head_pan': 0.5}])

    def test_a_slider_follows_its_joint_but_not_while_the_joint_is_on_its_way(self):
        self.measure(head_pan=0.4)
        self.measure(head_pan=0.3)
        self.assertAlmostEqual(self.shown('head_pan'), 0.3)
        self.move('head_pan', 1.0)
        self.measure(head_pan=0.5)
        self.assertAlmostEqual(self.shown('head_pan'), 1.0)
        self.window.sliders['head_pan'].follow_from = 0
        self.measure(head_pan=0.9)
        self.assertAlmostEqual(self.shown('head_pan'), 0.9)
        self.assertEqual(self.sent, [{'head_pan': 1.0}])

    def test_there_is_nothing_that_moves_many_joints_at_once(self):
        self.assertEqual(self.window.findChildren(QPushButton), [])

    def test_the_limits_are_those_of_the_robots_model(self):
        with open(os.path.join(ROOT, 'urdf/ers7.urdf')) as urdf:
            limits = aibo_sliders.read_limits(urdf.read())
        self.assertEqual(len(limits), 18)
        self.assertAlmostEqual(limits['head_pan'][1], 1.5359, 3)
        self.assertNotIn('left_ear', limits)


if __name__ == '__main__':
    unittest.main()
