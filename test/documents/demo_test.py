"""scripts/demo refuses what it cannot do before it installs or builds anything."""
import subprocess
import unittest
from pathlib import Path

DEMO = Path(__file__).resolve().parents[2] / 'scripts/demo'


class DemoTest(unittest.TestCase):
    def run_demo(self, *options):
        return subprocess.run([DEMO, *options], capture_output=True, timeout=60, check=False, text=True)

    def test_says_what_is_wrong_with_its_options(self):
        for options, problem in ((['--fast'], "there is no option '--fast'"),
                                 (['--seconds'], '--seconds needs a value'),
                                 (['--seconds', '1.5'], "--seconds takes a whole number, not '1.5'"),
                                 (['--images', '/nowhere'], "there is no folder '/nowhere'"),
                                 (['--images', '/', '--robot', 'aibo'], '--images is for the simulated robot'),
                                 (['--still', '--walk'], '--still and --walk exclude each other'),
                                 (['--walk', '--images', '/'], "--walk needs the camera's room")):
            with self.subTest(options):
                ended = self.run_demo(*options)
                self.assertEqual(ended.returncode, 1)
                self.assertIn(problem, ended.stderr)
                self.assertIn('scripts/demo --help lists the options', ended.stderr)

    def test_help_has_all_options(self):
        ended = self.run_demo('--help')
        self.assertEqual((ended.returncode, ended.stderr), (0, ''))
        for option in ('--seconds', '--robot', '--images', '--screenshot', '--still', '--walk', '--no-rviz', '--help'):
            self.assertIn(option + ' ', ended.stdout)


if __name__ == '__main__':
    unittest.main()
