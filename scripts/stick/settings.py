"""RCSERVER.CFG, read by the robot's own code, and the text of other files that people edit."""
import os
import re
import subprocess

from . import Problem
from .objects import PROJECT, SOURCES

READER = PROJECT / ".build" / "read_settings"
READER_SOURCES = [SOURCES / "memory_stick/read_settings.cpp", *sorted((SOURCES / "rcserver/settings").glob("*.cc")),
                  SOURCES / "objects/HostSettings.cc", SOURCES / "protocol/text.cc",
                  SOURCES / "host_files/regular_file.cpp"]
READER_FOLDERS = ("memory_stick", "rcserver/settings", "objects", "protocol", "host_files")
BYTE_ORDER_MARK = b"\xef\xbb\xbf"


def lines_in(path):
    """The lines of a text file, without what editors add around them: as protocol::textInFile() on the robot."""
    data = path.read_bytes()
    if data.startswith(BYTE_ORDER_MARK):
        data = data[len(BYTE_ORDER_MARK):]
    return re.split("\r\n|\r|\n", data.rstrip(b" \t\r\n\x1a").decode(errors="replace"))


def has_marks(path):
    """True if an editor has put a byte order mark or DOS' end of file (0x1a) into the file, if it is there."""
    data = path.read_bytes() if path.is_file() else b""
    return data.startswith(BYTE_ORDER_MARK) or data.rstrip().endswith(b"\x1a")


def settings_problems(stick):
    """Yields a Problem for each fault that the robot would find in RCSERVER.CFG, or in the names of files beside it."""
    newest = max(path.stat().st_mtime for folder in READER_FOLDERS for path in (SOURCES / folder).iterdir())
    if not READER.is_file() or READER.stat().st_mtime < newest:
        _build_reader()
    done = subprocess.run([str(READER), str(stick)], stdout=subprocess.PIPE, check=True)
    for fault in done.stdout.decode(errors="replace").splitlines():
        yield Problem(f"{stick}: {fault.replace('RCServer: ', '', 1)}.",
                      "Correct it: until then, the robot ignores the whole file, and only 127.0.0.1 may connect.")


def _build_reader():
    whole = READER.with_suffix(f".{os.getpid()}")
    command = ["g++", "-w", f"-I{SOURCES}", f"-I{SOURCES / 'simulator/openr_host/sdk'}", "-o", str(whole),
               *map(str, READER_SOURCES)]
    try:
        READER.parent.mkdir(exist_ok=True)
        subprocess.run(command, check=True)
        whole.replace(READER)
    except (OSError, subprocess.CalledProcessError) as error:
        raise Problem(f"RCSERVER.CFG cannot be checked, because the robot's reader of it was not built: {error}",
                      f"Is g++ installed, and may you write to {READER.parent}?") from error
