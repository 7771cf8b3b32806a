"""Checks that the user's copy of Sony's OPEN-R SDK has everything for building a stick."""
import importlib.util
import re
import shutil
import subprocess
import zlib
from typing import NamedTuple

from . import Problem, debian
from .settings import lines_in

WHAT_IT_IS = (
    "Programs for the robot cannot be built without Sony's OPEN-R SDK 1.1.5: OPEN_R_SDK-1.1.5-r5.tar.gz has OPEN-R's",
    "headers and libraries, and the robot's system. Sony has withdrawn it; owners keep copies. It needs GNU's newlib",
    "and libgcc beside it, and GNU's compiler of that time or Debian's of today: docs/on_robot.md says which.",
    "This project may not distribute any of it. When you have it, use --sdk /usr/local/OPEN_R_SDK, or wherever it is.",
)

MODELS = {"ERS-7": "MS_ERS7", "ERS-210": "MS_ERS200"}


class Part(NamedTuple):
    """A part of the SDK from one of Sony's downloads."""
    name: str
    advice: str
    paths: tuple


COMPILER = Part(
    "the cross compiler",
    "Unpack or build GNU's tools for the SDK (GCC 3.3, binutils 2.15, newlib 1.15) under the same folder, or take "
    "Debian's compiler: --compiler debian.",
    tuple("bin/mipsel-linux-" + tool for tool in ("gcc", "g++", "ar", "nm", "strip", "readelf")),
)
C_LIBRARY = Part(
    "the C library, GNU's newlib",
    "Sony's archive does not have it, nor does Debian for this processor. Unpack a copy of the SDK that owners keep, "
    "with the folders mipsel-linux and lib, or build newlib 1.10 to 1.15 for mipsel-linux under the same folder.",
    ("mipsel-linux/include/string.h", *("mipsel-linux/lib/" + name for name in debian.NEWLIB)),
)
INCOMPLETE = "Unpack the whole SDK archive (OPEN_R_SDK-1.1.5): this copy of it is incomplete."
LIBRARIES = Part(
    "OPEN-R's libraries", INCOMPLETE,
    tuple(f"OPEN_R/lib/lib{name}.a" for name in ("ObjectComm", "OPENR", "Internet", "antMCOOP", "apsys", "mcoopstub",
                                                 "OFSpub")),
)
HEADERS = Part(
    "OPEN-R's headers", INCOMPLETE,
    tuple("OPEN_R/include/" + name for name in ("OPENR/OObject.h", "MCOOP/ant.h", "TCPEndpointMsg.h")),
)
PROGRAMS = Part(
    "OPEN-R's Perl programs", INCOMPLETE,
    tuple("OPEN_R/bin/" + name for name in ("stubgen2", "mkbin", "gensnap")),
)

# Sony's system is encrypted, so its files cannot be unpacked. In all revisions seen, they have whole blocks of 8 bytes,
# cannot be compressed, and have sizes well within these bounds.
SYSTEM_FILES = {"OPEN-R/APERIOS.GZ": (400_000, 700_000), "OPEN-R/APERINIT.GZ": (20_000, 50_000),
                "OPEN-R/BOOTPARA": (100, 1_000)}
SYSTEM_OBJECT = (2_000, 200_000)


def choose_compiler(sdk, wanted):
    """Returns `wanted` or, if that is None, the SDK's compiler if it is there, otherwise Debian's."""
    return wanted or ("sdk" if (sdk / COMPILER.paths[1]).is_file() else "debian")


def build_problems(sdk, model, compiler):
    """Yields a Problem for everything missing for this compiler and a stick of that model."""
    if not (sdk / "OPEN_R").is_dir():
        yield Problem(f"there is no OPEN-R SDK in {sdk}: the folder OPEN_R is missing.", *WHAT_IT_IS)
        return
    own = compiler == "sdk"
    problems = [problem for part in (COMPILER if own else C_LIBRARY, LIBRARIES, HEADERS, PROGRAMS)
                for problem in _missing(sdk, part)]
    problems += _system_problems(system_folder(sdk, model)) + _missing_programs("perl", "make", "gzip", "g++")
    problems += missing_pyelftools()
    if own:
        problems += [] if any(_missing(sdk, COMPILER)) else _compiler_problems(sdk)
    else:
        problems += _debian_problems(sdk)
    yield from problems


def missing_pyelftools():
    """A list with a Problem if the library that reads programs is missing."""
    if importlib.util.find_spec("elftools") is None:
        return [Problem("this Python has no module elftools, which reads programs.",
                        "apt-get install python3-pyelftools; and start this script with Debian's python3.")]
    return []


def system_folder(sdk, model):
    """Sony's part of a stick: the system with memory protection, WLAN and console."""
    return sdk / "OPEN_R" / MODELS[model] / "WCONSOLE" / "memprot" / "OPEN-R"


def files_named_in(configuration):
    """The files that one of OPEN-R's .CFG files names, as paths from the top of the stick."""
    lines = (line.split("#")[0] for line in lines_in(configuration))
    return [name for line in lines for name in re.findall(r"/MS/(\S+)", line)]


def faulty_system_files(open_r):
    """What is wrong with Sony's files, in a list: those to boot from, and those that its .CFG files name."""
    named = [name for configuration in sorted((open_r / "SYSTEM" / "CONF").glob("*.CFG"))
             for name in files_named_in(configuration) if name.endswith(".BIN")]
    sizes = {**SYSTEM_FILES, **{name: SYSTEM_OBJECT for name in named}}
    return [f"{name} {fault}" for name, (least, most) in sizes.items()
            for fault in _faults_of(open_r.parent / name, least, most)]


def _faults_of(path, least, most):
    if not path.is_file():
        yield "is not there"
        return
    data = path.read_bytes()
    if not least <= len(data) <= most:
        yield f"has {len(data)} bytes, Sony's has {least} to {most}"
    elif len(data) % 8 != 0 or len(zlib.compress(data)) < 0.95 * len(data):
        yield "does not look like Sony's: it is cut off, or another file"


def revision(open_r):
    """The revision of the SDK 1.1.5, such as 5, or None if VERSION.txt does not tell."""
    version = open_r / "VERSION.txt"
    found = re.search(r"SDK 1\.1\.5 r(\d+)", version.read_text(errors="replace")) if version.is_file() else None
    return int(found.group(1)) if found else None


def notes_on_revision(open_r):
    """Notes for the owner about this revision (CHANGES_E.txt of the SDK), one line each."""
    number = revision(open_r)
    if number is None:
        return ["The revision of Sony's system is not known: VERSION.txt does not name it."]
    changes = ((2, "the robot switches itself off less often when a motor works hard, and locks its battery while it "
                   "starts"),
               (3, "its EEPROM is safe when it has to stop at once"), (4, "it knows the ERS-7M3"),
               (5, "its WLAN is better tuned"))
    lacks = [f"r{since}: {what}" for since, what in changes if since > number]
    notes = [f"The robot's system is that of the SDK 1.1.5 r{number}."]
    if lacks and "ERS-7" in (open_r / "VERSION.txt").read_text(errors="replace"):
        notes += ["An ERS-7M3 needs r4 or later; r5 is recommended. Since " + "; since ".join(lacks) + "."]
    return notes


def _missing(sdk, part):
    paths = [path for path in part.paths if not (sdk / path).is_file()]
    if paths:
        yield Problem(f"{sdk} lacks {part.name}: {_some(paths)}.", part.advice)


def _some(names):
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")


def _missing_programs(*names):
    """A Problem for each program that is not on this computer, such as Perl, which Sony's own programs need."""
    return [Problem(f"there is no {name} on this computer.", f"apt-get install {name}")
            for name in names if shutil.which(name) is None]


def _system_problems(open_r):
    faults = faulty_system_files(open_r)
    if not faults:
        return []
    return [Problem(f"the robot's system in {open_r.parent} is not whole: {_some(faults)}.",
                    "Unpack the SDK's archives again: some copies lack the folders called OBJS, or have them elsewhere "
                    "(docs/on_robot.md).")]


def _debian_problems(sdk):
    problems = []
    if any(shutil.which(debian.PREFIX + name) is None for name in ("gcc", "g++", "ld", "ar", "strip")):
        problems.append(Problem("Debian's cross compiler is not on this computer.",
                                "scripts/install_dependencies stick, or: apt-get install g++-mipsel-linux-gnu"))
    if debian.libgcc(sdk) is None:
        problems.append(Problem(f"{sdk} lacks libgcc.a, in lib/gcc-lib/mipsel-linux/VERSION.", C_LIBRARY.advice,
                                "Debian's libgcc has instructions that the robot's processor does not know."))
    return problems


def _compiler_problems(sdk):
    try:
        for tool in COMPILER.paths:
            _run(sdk / tool, "--version")
        for driver, compiler in (("gcc", "cc1"), ("g++", "cc1plus")):
            path = _run(sdk / f"bin/mipsel-linux-{driver}", f"-print-prog-name={compiler}").strip()
            if "/" not in path:  # if the driver does not find the program, it prints just the name
                raise Problem(f"mipsel-linux-{driver} does not find {compiler}, the compiler itself.", COMPILER.advice)
            _run(path, "--version")
    except Problem as problem:
        return [problem]
    return []


def _run(program, option):
    try:
        done = subprocess.run([str(program), option], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, check=False)
    except OSError as error:
        raise _cannot_run(program, error) from error
    if done.returncode != 0:
        raise _cannot_run(program, (done.stderr.strip() or f"exit status {done.returncode}").splitlines()[0])
    return done.stdout


def _cannot_run(program, why):
    return Problem(f"{program} does not run on this computer: {why}",
                   "A program for 32-bit Linux needs: dpkg --add-architecture i386; apt-get update; "
                   "apt-get install libc6:i386.",
                   "If it needs a newer GLIBC, use a container with a newer Debian, build GNU's tools again, or take "
                   "Debian's: --compiler debian.")
