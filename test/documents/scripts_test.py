"""The scripts know their options, and refuse others before they install or build anything."""
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]

# These two only note with which words they were started, in a project without anything else.
NOTE = '#!/bin/sh\necho "${0##*/} $*" >> "${0%/*}/../log"; [ "${0##*/}" != build ]\n'

REFUSED = {
    'lint --fast': "no option '--fast'", 'package --fast': "no option '--fast'", 'physics --fast': "no option '--fast'",
    'mips --fast': "no option '--fast'",
    'soak --minutes': '--minutes needs a number', 'soak --seed 3 --fast': "no option '--fast'",
    'soak --sanitize memory': "no sanitizer 'memory'", 'fuzz': '--seconds needs',
    'fuzz --seconds 0': '--seconds needs', 'fuzz --seconds 2 none': "no target 'none'",
    'benchmark --quick fast': "no option or benchmark 'fast'", 'pictures fleet none': "no picture 'none'",
    'openr_object': 'which folder?', 'openr_object --fast': "no option '--fast'",
    'openr_object /usr /etc': "two folders, '/usr' and '/etc'", 'openr_object /none': "no folder '/none'",
    'try_release --packages trixie': 'give a release and a folder', 'try_release trixie /usr': '/usr exists',
    'container --fast': "no option '--fast'", 'demo --fast': "no option '--fast'",
    'demo --seconds': '--seconds needs a value', 'demo --seconds 1.5': "a whole number, not '1.5'", 'demo --images /nowhere': "no folder '/nowhere'",
    'demo --images / --robot aibo': '--images is for the simulated robot',
    'demo --still --walk': '--still and --walk exclude each other', 'demo --walk --images /': "needs the camera's room"}

STARTED = {
    'soak --seed 3 --sanitize thread': ['build tests soak', '--tests --sanitize thread all aibo_soak'],
    'fuzz --seconds 2 hello picture': ['build tests fuzz', '--tests --sanitize fuzz fuzz_hello fuzz_picture'],
    'sanitize thread -R x': ['build tests rviz wlan physics', '--tests --sanitize thread all tests'],
    'faults --only hostile': ['build tests', '--tests aibo_fault_campaign fault_rostest'],
    'test -R x': ['build tests rviz wlan physics', '--tests all tests'],
    'faults --only loss': ['build tests', '--tests aibo_fault_campaign']}


class ScriptsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name)
        shutil.copytree(PROJECT / 'scripts', self.home / 'scripts')
        shutil.copytree(PROJECT / 'test/fuzz/targets', self.home / 'test/fuzz/targets')
        for name in ('install_dependencies', 'build'):
            (self.home / 'scripts' / name).write_text(NOTE)

    def run_script(self, words):
        script, *options = words.split()
        return subprocess.run([self.home / 'scripts' / script, *options], capture_output=True, timeout=60, check=False,
                              text=True)

    def test_refuse_what_they_do_not_know(self):
        for words, problem in REFUSED.items():
            with self.subTest(words):
                ended = self.run_script(words)
                self.assertEqual((ended.returncode, ended.stdout), (1, ''))
                self.assertIn(problem, ended.stderr)
        self.assertFalse((self.home / 'log').exists())

    def test_install_and_build_what_they_need(self):
        for words, (installed, built) in STARTED.items():
            with self.subTest(words):
                self.assertEqual(self.run_script(words).returncode, 1)
                self.assertEqual((self.home / 'log').read_text(), f'install_dependencies {installed}\nbuild {built}\n')
            (self.home / 'log').unlink()


if __name__ == '__main__':
    unittest.main()
