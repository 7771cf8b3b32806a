"""This project's programs for the robot, from memory_stick/programs/objects.txt and each stub.cfg."""
import re
from pathlib import Path
from typing import NamedTuple

PROJECT = Path(__file__).resolve().parents[2]
SOURCES = PROJECT / "aibo_rcserver"
PROGRAMS = SOURCES / "memory_stick" / "programs"
STICK_FILES = SOURCES / "memory_stick" / "OPEN-R"


class RobotObject(NamedTuple):
    """One program, an OPEN-R object. The entry `shared`, with the file "-", is code that all of them link."""
    name: str
    file: str
    folders: list

    @property
    def stub_cfg(self):
        return SOURCES / self.folders[0] / "stub.cfg"

    def sources(self):
        return sorted(source for folder in self.folders for source in (SOURCES / folder).rglob("*.cc"))

    def headers(self):
        return sorted(header for folder in self.folders for header in (SOURCES / folder).rglob("*.h"))


def _table():
    lines = (line.split("#")[0].split() for line in (PROGRAMS / "objects.txt").read_text().splitlines())
    return [RobotObject(line[0], line[1], line[2:]) for line in lines if line]


def robot_objects():
    return [row for row in _table() if row.file != "-"]


def shared_sources():
    return next(row for row in _table() if row.name == "shared")


def services(stub_cfg):
    """The services in a stub.cfg, such as RCServer.Image.OFbkImageVectorData.O.

    Like Sony's stubgen2, this ignores lines without a keyword, so comments may have any form.
    """
    return re.findall(r'^\s*Service\s*:\s*"([^"]+)"', stub_cfg.read_text(), re.MULTILINE)
