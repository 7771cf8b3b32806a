"""A file is whole or as it was, whichever of our two writers writes it: aibo_mtn, or replace_file.py."""
import fcntl
import os
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOM = Path(__file__).resolve().parents[2] / 'aibo_rcserver'
MOTION = ROOM / 'motion_tool/motions/NOD.txt'


def make_motion():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.environ['AIBO_MTN'], MOTION, folder + '/a.mtn'], check=True)
        return Path(folder, 'a.mtn').read_bytes()


CONTENT = make_motion()


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / 'a.mtn'

    def files(self):
        return sorted(os.listdir(self.folder))


class Writer:
    """What both have to do; `writer` is the command."""

    def write(self, file, **options):
        return subprocess.run([*self.writer, str(file)], input=CONTENT, check=False,
                              **{'capture_output': True, **options})

    def expect_written(self, file, **options):
        ended = self.write(file, **options)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return ended

    def test_a_new_file_has_the_usual_permissions(self):
        self.expect_written(self.file, preexec_fn=lambda: os.umask(0o027))
        self.assertEqual((self.file.read_bytes(), self.file.stat().st_mode & 0o7777), (CONTENT, 0o640))
        self.assertEqual(self.files(), ['a.mtn'])

    def test_an_old_file_keeps_its_permissions(self):
        self.file.write_text('old')
        self.file.chmod(0o604)
        self.expect_written(self.file)
        self.assertEqual((self.file.read_bytes(), self.file.stat().st_mode & 0o7777), (CONTENT, 0o604))

    def test_a_link_is_followed_and_stays(self):
        (self.folder / 'other').mkdir()
        (self.folder / 'other/old').write_text('old')
        for link, target in (('a', 'other/old'), ('b', 'other/new'), ('c', 'b'), ('d', self.folder / 'other/d')):
            (self.folder / link).symlink_to(target)
            self.expect_written(self.folder / link)
            self.assertTrue((self.folder / link).is_symlink())
            self.assertEqual((self.folder / link).read_bytes(), CONTENT)
        self.assertEqual(sorted(os.listdir(self.folder / 'other')), ['d', 'new', 'old'])

    def test_pipes_and_devices_are_written_as_such(self):
        self.assertEqual(self.expect_written('/dev/stdout').stdout, CONTENT)
        self.expect_written('/dev/null')
        self.assertTrue(Path('/dev/null').is_char_device())
        os.mkfifo(self.file)
        with subprocess.Popen(['cat', self.file], stdout=subprocess.PIPE) as reader:
            self.expect_written(self.file)
            self.assertEqual(reader.communicate()[0], CONTENT)
        self.assertTrue(self.file.is_fifo())

    def test_a_redirected_standard_output_keeps_what_is_in_it(self):
        self.file.write_text('old')
        with open(self.file, 'ab') as output:
            self.expect_written('/dev/stdout', capture_output=False, stdout=output)
        self.assertEqual(self.file.read_bytes(), b'old' + CONTENT)

    def test_what_cannot_be_written_stays_and_nothing_is_left(self):
        # A limit on the size of files acts like a full disk. SIGXFSZ stays ignored, as in Python.
        full_disk = dict(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (10, 10)), restore_signals=False)
        self.file.write_text('old')
        rows = [(self.file, full_disk, 'File too large'), (self.folder / 'b', full_disk, 'File too large'),
                (self.folder / 'none/a', {}, 'No such file'), (self.folder, {}, 'Is a directory')]
        if os.geteuid() != 0:
            (self.folder / 'protected').write_text('old')
            (self.folder / 'protected').chmod(0o444)
            rows.append((self.folder / 'protected', {}, 'Permission denied'))
        before = self.files()
        for file, options, why in rows:
            ended = self.write(file, **options)
            self.assertEqual(ended.returncode, 1)
            self.assertRegex(ended.stderr.decode(), f'{file} cannot be written: .*{why}')
        self.assertEqual((self.file.read_text(), self.files()), ('old', before))

    def test_removes_what_a_killed_writer_has_left(self):
        for part in ('.aibo_part.1', '.aibo_part.2'):
            (self.folder / part).write_text('half')
        with open(self.folder / '.aibo_part.1', 'ab') as part:
            fcntl.flock(part, fcntl.LOCK_EX)
            self.expect_written(self.file)
        self.assertEqual(self.files(), ['.aibo_part.1', 'a.mtn'])


class InCpp(Writer, Folder):
    writer = [os.environ['AIBO_MTN'], str(MOTION)]


class InPython(Writer, Folder):
    writer = [sys.executable, '-B', str(ROOM / 'host_files/replace_file.py')]

    # files_test.cpp tests the same in C++.
    def test_a_signal_waits_until_the_file_is_whole(self):
        program = ('import os, sys, replace_file as room; sync = os.fsync\n'
                   'os.fsync = lambda file: (sync(file), os.kill(os.getpid(), int(sys.argv[1])))\n'
                   'room.replace_file(sys.argv[2], b"new")')
        for signal, content, left in ((9, 'old', 1), (15, 'new', 0), (2, 'new', 0)):
            self.file.write_text('old')
            subprocess.run([sys.executable, '-B', '-c', program, str(signal), str(self.file)], check=False,
                           cwd=ROOM / 'host_files', stderr=subprocess.DEVNULL)
            self.assertEqual((self.file.read_text(), len(self.files())), (content, 1 + left))


if __name__ == '__main__':
    unittest.main()
