"""aibo_joy publishes what a joystick reports. A pipe stands for the joystick."""
import importlib.machinery
import importlib.util
import os
import unittest
from pathlib import Path
from unittest import mock

PROGRAM = Path(__file__).resolve().parents[2] / 'aibo_driver/tools/aibo_joy'
loader = importlib.machinery.SourceFileLoader('aibo_joy', str(PROGRAM))
aibo_joy = importlib.util.module_from_spec(importlib.util.spec_from_loader('aibo_joy', loader))
loader.exec_module(aibo_joy)

AXIS, BUTTON, INIT = 2, 1, 0x80  # as in <linux/joystick.h>


class JoyTest(unittest.TestCase):
    def setUp(self):
        reading, self.writing = os.pipe()
        self.joystick = os.fdopen(reading, 'rb', buffering=0)
        self.addCleanup(self.joystick.close)
        patch = mock.patch.object(aibo_joy.rospy, 'is_shutdown', lambda: False)
        patch.start()
        self.addCleanup(patch.stop)
        for number in range(2):
            self.report(0, AXIS | INIT, number)
            self.report(0, BUTTON | INIT, number)

    def report(self, value, kind, number):
        os.write(self.writing, aibo_joy.EVENT.pack(0, value, kind, number))

    def published(self, steps=()):
        """What is published, as (axes, buttons). The joystick is pulled out after the steps, each of which is a function
        that is called after the next message."""
        messages, steps = [], list(steps) + [lambda: os.close(self.writing)]

        def publish(state):
            messages.append(([round(axis, 3) for axis in state.axes], list(state.buttons)))
            if steps:
                steps.pop(0)()
        aibo_joy.read(self.joystick, publish)
        return messages

    def test_publishes_each_change_with_the_signs_of_ros(self):
        self.report(-32767, AXIS, 0)  # left
        self.report(16384, AXIS, 1)  # down
        self.report(1, BUTTON, 1)
        self.report(0, BUTTON, 1)  # a short press is not lost
        self.report(-32768, AXIS, 1)
        self.assertEqual(self.published([lambda: None] * 4), [
            ([1, 0], [0, 0]), ([1, -0.5], [0, 0]), ([1, -0.5], [0, 1]), ([1, -0.5], [0, 0]), ([1, 1], [0, 0]),
            ([0, 0], [0, 0])])

    def test_repeats_20_times_a_second_until_the_joystick_is_gone_and_lets_go_then(self):
        press = [lambda: self.report(1, BUTTON, 0)]
        with mock.patch.object(aibo_joy.select, 'select', wraps=aibo_joy.select.select) as waiting:
            self.assertEqual(self.published(press + [lambda: None] * 2), [
                ([0, 0], [0, 0]), ([0, 0], [1, 0]), ([0, 0], [1, 0]), ([0, 0], [1, 0]), ([0, 0], [0, 0])])
        self.assertEqual({call.args[3] for call in waiting.call_args_list}, {1 / 20})


if __name__ == '__main__':
    unittest.main()
