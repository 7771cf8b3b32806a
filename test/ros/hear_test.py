"""aibo_hear gives what a robot hears to a program that plays it."""
import importlib.machinery
import importlib.util
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from aibo_driver.msg import Sound

PROGRAM = Path(__file__).resolve().parents[2] / 'aibo_driver/tools/aibo_hear'
loader = importlib.machinery.SourceFileLoader('aibo_hear', str(PROGRAM))
aibo_hear = importlib.util.module_from_spec(importlib.util.spec_from_loader('aibo_hear', loader))
loader.exec_module(aibo_hear)


def sound(samples, rate=16000, channels=1, missing=0):
    return Sound(samples=samples, samples_per_second=rate, channels=channels, missing=missing)


class HearTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.play_with('dd', 'status=none', 'of=' + str(self.folder / '{rate}-{channels}'))

    def play_with(self, *words):
        patch = mock.patch.object(aibo_hear, 'PLAYER', words)
        patch.start()
        self.addCleanup(patch.stop)

    def heard(self, *sounds):
        """What the players got: a list of samples for each format, by "RATE-CHANNELS"."""
        ear = aibo_hear.Ear()
        for each in sounds:
            ear.hear(each)
        ear.end()
        self.assertIsNone(ear.problem)
        return {path.name: list(memoryview(path.read_bytes()).cast('h')) for path in self.folder.iterdir()}

    def test_plays_silence_for_what_is_missing(self):
        self.assertEqual(self.heard(sound([1, -2]), sound([3], missing=2), sound([4], missing=1)),
                         {'16000-1': [1, -2, 0, 0, 3, 0, 4]})
        self.assertEqual(self.heard(sound([1, -2], channels=2, missing=1))['16000-2'], [0, 0, 1, -2])

    def test_starts_another_player_for_another_format(self):
        self.assertEqual(self.heard(sound([1]), sound([2, 3], channels=2), sound([5, 6], channels=2),
                                    sound([4, 7], rate=8000, channels=2)),
                         {'16000-1': [1], '16000-2': [2, 3, 5, 6], '8000-2': [4, 7]})

    def test_hears_the_microphone_until_it_ends(self):
        with mock.patch.object(aibo_hear.rospy, 'init_node') as node, \
                mock.patch.object(aibo_hear.rospy, 'Subscriber') as subscriber, \
                mock.patch.object(aibo_hear.rospy, 'spin', lambda: subscriber.call_args[0][2](sound([7]))), \
                mock.patch.object(aibo_hear.sys, 'argv', ['aibo_hear']), \
                self.assertRaises(SystemExit) as end:
            aibo_hear.main()
        self.assertIsNone(end.exception.code)
        node.assert_called_once_with('aibo_hear')
        self.assertEqual(subscriber.call_args[0][:2], ('microphone', Sound))
        subscriber.return_value.unregister.assert_called_once()
        self.assertEqual(list(memoryview((self.folder / '16000-1').read_bytes()).cast('h')), [7])

    def test_says_why_its_player_plays_nothing(self):
        for player, why in (('false', 'aibo_hear: false has ended. Does this computer have a sound card?'),
                            ('no-such-player', 'alsa-utils')):
            self.play_with(player)
            ear = aibo_hear.Ear()
            with mock.patch.object(aibo_hear.rospy, 'signal_shutdown') as shut_down:  # it would end this program's rospy
                while not ear.problem:
                    ear.hear(sound([1]))
                ear.hear(sound([1]))
            ear.end()
            shut_down.assert_called_once()
            self.assertIn(why, ear.problem)


if __name__ == '__main__':
    unittest.main()
