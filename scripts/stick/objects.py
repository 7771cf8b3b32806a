"""This project's programs for the robot, from memory_stick/programs/objects.txt and each stub.cfg."""
import re
from pathlib import Path
from typing import NamedTuple

PROJECT = Path(__file__).resolve().parents[2]
SOURCES = PROJECT / "aibo_rcserver"
PROGRAMS = SOURCES / "memory_stick" / "programs"
STICK_FILES = SOURCES / "memory_stick" / "OPEN-R"


class RobotObject(NamedTuple):
    """One program, an OPEN-R object."""
    name: str
    file: str
    folder: str

    def services(self):
        """The services in its stub.cfg, such as RCServer.Image.OFbkImageVectorData.O.

        Like Sony's stubgen2, this ignores lines without a keyword, so comments may have any form.
        """
        stub = (SOURCES / self.folder / "stub.cfg").read_text()
        return re.findall(r'^\s*Service\s*:\s*"([^"]+)"', stub, re.MULTILINE)


def robot_objects():
    lines = (line.split("#")[0].split() for line in (PROGRAMS / "objects.txt").read_text().splitlines())
    return [RobotObject(*line[:3]) for line in lines if line and line[1] != "-"]
