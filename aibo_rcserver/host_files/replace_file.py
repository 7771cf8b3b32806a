"""Writes files that users of this computer keep, as replace_file.h describes.

    python3 replace_file.py FILE      writes its standard input
"""
import contextlib
import errno
import fcntl
import os
import random
import signal
import stat
import sys

PART_PREFIX = '.aibo_part.'


def replace_file(path, content, mode=None):
    """Writes bytes to a file. If this fails, the file stays as it was, and OSError is raised.

    path -- a symbolic link is followed and stays; what is not a regular file, such as a pipe, is opened and written,
            and so is the standard output under any name
    mode -- the file's permissions less the umask; by default, an old file keeps its own
    """
    try:
        old = os.stat(path)
    except FileNotFoundError:
        old = None
    if old and (not stat.S_ISREG(old.st_mode) or _is_standard_output(old)):
        with open(path, 'ab') as device:
            device.write(content)
        return
    held = signal.pthread_sigmask(signal.SIG_BLOCK, signal.valid_signals())
    try:
        if old and not os.access(path, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        kept_mode = old.st_mode & 0o777 if old and mode is None else None
        _replace(os.path.realpath(path), content, 0o666 if mode is None else mode, kept_mode)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from error
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, held)


def _is_standard_output(status):
    with contextlib.suppress(OSError):  # it is closed
        return os.path.samestat(status, os.fstat(1))
    return False


def _replace(path, content, new_mode, kept_mode):
    folder = os.path.dirname(path)
    _remove_leftovers(folder)
    part, descriptor = _new_part(folder, new_mode if kept_mode is None else 0o600)  # private until it has the mode
    try:
        with open(descriptor, 'wb') as file:
            if kept_mode not in (None, stat.S_IMODE(os.fstat(descriptor).st_mode)):
                os.fchmod(descriptor, kept_mode)
            file.write(content)
            file.flush()
            os.fsync(descriptor)
            os.rename(part, path)
    except BaseException:
        os.unlink(part)
        raise
    with contextlib.suppress(OSError), _opened(folder, os.O_RDONLY) as opened:
        os.fsync(opened)


def _new_part(folder, mode):
    while True:
        part = os.path.join(folder, PART_PREFIX + str(random.getrandbits(32)))
        descriptor = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            is_taken = os.fstat(descriptor).st_nlink == 0
        except BlockingIOError:
            is_taken = True
        except OSError:
            is_taken = False  # there are no locks here
        if not is_taken:
            return part, descriptor
        os.close(descriptor)  # another program thought that the new file was left over, and removed it


def _remove_leftovers(folder):
    with contextlib.suppress(PermissionError):
        for part in (os.path.join(folder, name) for name in os.listdir(folder) if name.startswith(PART_PREFIX)):
            with contextlib.suppress(OSError), _opened(part, os.O_WRONLY | os.O_NOFOLLOW | os.O_NONBLOCK) as opened:
                fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
                os.unlink(part)


@contextlib.contextmanager
def _opened(path, flags):
    descriptor = os.open(path, flags)
    try:
        yield descriptor
    finally:
        os.close(descriptor)


if __name__ == '__main__':
    try:
        replace_file(sys.argv[1], sys.stdin.buffer.read())
    except OSError as error:
        sys.exit(f'{sys.argv[1]} cannot be written: {error.strerror}')
