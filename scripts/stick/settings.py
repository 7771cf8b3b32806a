"""RCSERVER.CFG, read by the robot's own code, and the text of other files that people edit."""
import re
import subprocess
import tempfile

from . import Problem
from .objects import SOURCES

READER_SOURCES = [SOURCES / "memory_stick/read_settings.cpp", *sorted((SOURCES / "rcserver/settings").glob("*.cc")),
                  SOURCES / "objects/HostSettings.cc", SOURCES / "protocol/text.cc",
                  SOURCES / "host_files/regular_file.cpp"]
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
    """Yields a Problem for each fault that the robot would find in RCSERVER.CFG, and in the names beside it."""
    with tempfile.TemporaryDirectory() as folder:
        reader = f"{folder}/read_settings"
        command = ["g++", "-w", f"-I{SOURCES}", f"-I{SOURCES / 'simulator/openr_host/sdk'}", "-o", reader,
                   *map(str, READER_SOURCES)]
        try:
            subprocess.run(command, check=True)
            done = subprocess.run([reader, str(stick)], stdout=subprocess.PIPE, check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            raise Problem(f"RCSERVER.CFG cannot be checked, because the robot's reader of it was not built: {error}",
                          "apt-get install g++") from error
    for fault in done.stdout.decode(errors="replace").splitlines():
        yield Problem(f"{stick}: {fault.replace('RCServer: ', '', 1)}.",
                      "Correct it: until then, the robot ignores the whole file, and only 127.0.0.1 may connect.")
