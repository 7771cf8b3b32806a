"""Checks that a memory stick has everything that the robot is configured to start."""
import gzip
import re
import zlib

from . import Problem, sdk as sony
from .binary import Program
from .objects import robot_objects
from .settings import has_marks, lines_in, settings_problems
from .wlan import WlanConf

# OPEN-R's own services: Programmer's Guide, Level2 Reference Guide.
SYSTEM_SERVICES = {
    "OVirtualRobotComm.Effector.OCommandVectorData.O",
    "OVirtualRobotComm.Sensor.OSensorFrameVectorData.S",
    "OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S",
    "OVirtualRobotAudioComm.Mic.OSoundVectorData.S",
    "OVirtualRobotAudioComm.Speaker.OSoundVectorData.O",
}

# With all libraries, Sony's smallest sample has 665 KB, and FileKeeper 250 KB with Debian's compiler.
MIN_PROGRAM_SIZE = 100_000
MAX_PROGRAM_SIZE = 4_000_000
MAX_STICK_SIZE = 8_000_000  # Sony's smaller programmable stick

WLANCONF = "SYSTEM/CONF/WLANCONF.TXT"
READ_BY_SONY = ("MW/CONF/OBJECT.CFG", "MW/CONF/CONNECT.CFG", "MW/CONF/DESIGNDB.CFG", WLANCONF)

WRITE_AGAIN = "Let scripts/memory_stick write the stick again."


def problems_of(stick):
    """Yields a Problem for everything that is wrong with a stick."""
    open_r = stick / "OPEN-R"
    if not open_r.is_dir():
        yield Problem(f"there is no folder OPEN-R in {stick}.", "Give the folder in which the stick is mounted.")
        return
    yield from _system_problems(open_r)
    yield from _name_problems(open_r)
    yield from _object_problems(open_r)
    yield from _connection_problems(open_r)
    yield from settings_problems(stick)
    if (open_r / WLANCONF).is_file():
        yield from WlanConf(open_r / WLANCONF).problems
    size = sum(path.stat().st_size for path in open_r.rglob("*") if path.is_file())
    if size > MAX_STICK_SIZE:
        yield Problem(f"{open_r} has {size} bytes; Sony's smallest stick holds 8 MB.",
                      "Remove motions and programs that are not needed.")


def notes_on(stick):
    """Notes for the owner of a stick without problems, one line each."""
    open_r = stick / "OPEN-R"
    notes = sony.notes_on_revision(open_r)
    if (open_r / WLANCONF).is_file() and WlanConf(open_r / WLANCONF).is_demo:
        notes.append("APMODE=0 is Sony's Ad Hoc Demo Mode. An access point and a network between two computers, which "
                     "Linux calls ad hoc, need APMODE=1.")
    notes += [f"{open_r / name} has a byte order mark or DOS' end of file. Nobody knows whether Sony's system skips "
              "it: save the file without it." for name in READ_BY_SONY if has_marks(open_r / name)]
    return notes


def _system_problems(open_r):
    for fault in sony.faulty_system_files(open_r):
        yield Problem(f"the robot's system is not whole: /MS/{fault}.", WRITE_AGAIN)


def _name_problems(open_r):
    """The robot supports names with 8 characters and 3 after a dot. Sony's own files are not checked."""
    for path in sorted((open_r / "MW").rglob("*")) + sorted((open_r / "SYSTEM" / "CONF").glob("*")):
        if not re.fullmatch(r"[A-Z0-9_-]{1,8}(\.[A-Z0-9_-]{1,3})?", path.name):
            yield Problem(f"{path}: the robot does not support such names.",
                          "Rename it: up to 8 capital letters, digits, - and _, then up to 3 after a dot.")


def _object_problems(open_r):
    names = _programs_to_start(open_r)
    if not names:
        yield Problem(f"{open_r}/MW/CONF/OBJECT.CFG names no program.", WRITE_AGAIN)
        return
    for robot_object in robot_objects():
        if f"OPEN-R/MW/OBJS/{robot_object.file}" not in names:
            yield Problem(f"OBJECT.CFG does not name {robot_object.file}: {robot_object.name} would not run.",
                          f"Add the line /MS/OPEN-R/MW/OBJS/{robot_object.file}.")
    for name in names:
        path = open_r.parent / name
        if path.is_file():
            yield from _program_problems(path)
        else:
            yield Problem(f"OBJECT.CFG names /MS/{name}, which is not there.",
                          "Build and copy it, or take the line out of OBJECT.CFG.")


def _programs_to_start(open_r):
    configuration = open_r / "MW" / "CONF" / "OBJECT.CFG"
    return sony.files_named_in(configuration) if configuration.is_file() else []


def _program_problems(path):
    build_again = "Build it again."
    try:
        with gzip.open(str(path)) as packed:
            program = packed.read(MAX_PROGRAM_SIZE + 1)
    except (OSError, EOFError, zlib.error) as error:
        yield Problem(f"{path} is not whole, or not packed by gzip: {error}", build_again)
        return
    if not MIN_PROGRAM_SIZE <= len(program) <= MAX_PROGRAM_SIZE:
        yield Problem(f"{path} has {len(program)} bytes unpacked (or more); {MIN_PROGRAM_SIZE} to {MAX_PROGRAM_SIZE} "
                      "are expected.",
                      "Is it linked with OPEN-R's libraries, and stripped?")
        return
    for what in Program(program).problems():
        yield Problem(f"{path}: {what}.", build_again)


def _connection_problems(open_r):
    configuration = open_r / "MW" / "CONF" / "CONNECT.CFG"
    if not configuration.is_file():
        yield Problem(f"{configuration} is missing.", WRITE_AGAIN)
        return
    ours = [service for robot_object in robot_objects() for service in robot_object.services()]
    known = SYSTEM_SERVICES.union(ours)
    connected = set()
    for number, line in enumerate(lines_in(configuration), 1):
        words = line.split("#")[0].split()
        if words and not words[0].startswith("["):
            connected.update(words)
            yield from _line_problems(f"CONNECT.CFG, line {number}", words, known, _has_foreign_programs(open_r))
    for service in ours:
        if service not in connected:
            yield Problem(f"CONNECT.CFG does not connect {service}.", WRITE_AGAIN)


def _line_problems(where, words, known, has_foreign_programs):
    if len(words) != 2 or not words[0].endswith(".S") or not words[1].endswith(".O"):
        yield Problem(f"{where}: a line needs two services: a subject's (.S) and an observer's (.O).", WRITE_AGAIN)
        return
    if words[0].split(".")[-2] != words[1].split(".")[-2]:
        yield Problem(f"{where}: {words[0]} and {words[1]} have different data types.",
                      "The part before .S and .O must be the same.")
    for service in words:
        if service not in known and not has_foreign_programs:
            yield Problem(f"{where}: there is no service {service}; no stub.cfg declares it.",
                          "Is it misspelt? aibo_rcserver/*/stub.cfg and Sony's documents list the services.")


def _has_foreign_programs(open_r):
    """True if there are programs such as Sony's POWERMON.BIN, whose services are unknown here."""
    ours = {robot_object.file for robot_object in robot_objects()}
    return any(name.split("/")[-1] not in ours for name in _programs_to_start(open_r))
