"""Checks that Sony's OPEN-R SDK, which the user provides, has everything that building a stick needs."""
import re
import shutil
import subprocess
from typing import NamedTuple

from .problem import Problem, raise_any

WHAT_IT_IS = (
    "Programs for the robot cannot be built without Sony's OPEN-R SDK 1.1.5: it has the cross compiler (GCC 3.3.6,",
    "binutils 2.15, newlib 1.15), the headers and libraries of OPEN-R, and the robot's system.",
    "Sony offered it to owners free of charge and has withdrawn it; Aibo owners keep it in archives of their own.",
    "This project may not distribute any of it. When you have it, use --sdk /usr/local/OPEN_R_SDK, or wherever it is.",
)

MODELS = {"ERS-7": "MS_ERS7", "ERS-210": "MS_ERS200"}


class Part(NamedTuple):
    """A part of the SDK that comes from one of Sony's downloads."""
    name: str
    advice: str
    paths: tuple


COMPILER = Part(
    "the cross compiler",
    "Unpack or build the SDK's toolchain (GCC 3.3.6, binutils 2.15, newlib 1.15) under the same folder.",
    tuple("bin/mipsel-linux-" + tool for tool in ("gcc", "g++", "ar", "nm", "strip", "readelf")),
)
LIBRARIES = Part(
    "OPEN-R's libraries",
    "Unpack the whole SDK archive (OPEN_R_SDK-1.1.5): this copy of it is incomplete.",
    tuple(f"OPEN_R/lib/lib{name}.a" for name in ("ObjectComm", "OPENR", "Internet", "antMCOOP", "apsys", "mcoopstub")),
)
HEADERS = Part(
    "OPEN-R's headers",
    "Unpack the whole SDK archive (OPEN_R_SDK-1.1.5): this copy of it is incomplete.",
    tuple("OPEN_R/include/" + name for name in ("OPENR/OObject.h", "MCOOP/ant.h", "TCPEndpointMsg.h")),
)
STUB_GENERATOR = Part("OPEN-R's Perl programs", HEADERS.advice, ("OPEN_R/bin/stubgen2",))
LINKER = Part("OPEN-R's Perl programs", HEADERS.advice, ("OPEN_R/bin/mkbin", "OPEN_R/bin/gensnap"))
C_HEADERS = Part("the C library's headers", COMPILER.advice, ("mipsel-linux/include/string.h",))


def check_for_build(sdk, model):
    """Raises Problems for everything that `sdk` lacks for building and for a stick of that model."""
    _check_folder(sdk)
    missing = [problem for part in (COMPILER, LIBRARIES, HEADERS, STUB_GENERATOR, LINKER)
               for problem in _missing(sdk, part)]
    raise_any(missing + _missing_system(system_folder(sdk, model)) + _missing_programs("perl", "make", "gzip"))
    _check_compiler_runs(sdk)


def check_for_headers(sdk):
    """Raises Problems for everything that `sdk` lacks for a check of the headers alone."""
    _check_folder(sdk)
    raise_any([problem for part in (HEADERS, STUB_GENERATOR, C_HEADERS) for problem in _missing(sdk, part)] +
              _missing_programs("perl", "g++"))


def system_folder(sdk, model):
    """Sony's part of a stick: the system with memory protection, wireless LAN and console."""
    return sdk / "OPEN_R" / MODELS[model] / "WCONSOLE" / "memprot" / "OPEN-R"


def files_named_in(configuration):
    """The files on the stick that one of OPEN-R's .CFG files names, as paths from the top of the stick."""
    lines = (line.split("#")[0] for line in configuration.read_text(errors="replace").splitlines())
    return [name for line in lines for name in re.findall(r"/MS/(\S+)", line)]


def missing_system_files(open_r):
    """Missing files that the system's own .CFG files name, as paths from the top of the stick."""
    named = [name for configuration in sorted((open_r / "SYSTEM" / "CONF").glob("*.CFG"))
             for name in files_named_in(configuration) if name.endswith(".BIN")]
    return [name for name in named if not (open_r.parent / name).is_file()]


def _check_folder(sdk):
    if not (sdk / "OPEN_R").is_dir():
        raise Problem(f"there is no OPEN-R SDK in {sdk}: the folder OPEN_R is missing.", *WHAT_IT_IS)


def _missing(sdk, part):
    paths = [path for path in part.paths if not (sdk / path).is_file()]
    if paths:
        yield Problem(f"{sdk} lacks {part.name}: {_some(paths)}.", part.advice)


def _some(names):
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")


def _missing_programs(*names):
    """Perl is needed for Sony's own programs."""
    return [Problem(f"there is no {name} on this computer.", f"apt-get install {name}")
            for name in names if shutil.which(name) is None]


def _missing_system(open_r):
    missing = missing_system_files(open_r) if (open_r / "APERIOS.GZ").is_file() else ["OPEN-R/APERIOS.GZ"]
    if not missing:
        return []
    return [Problem(f"the robot's system in {open_r.parent} lacks {_some(missing)}.",
                    "Unpack the SDK's archives again: some copies lack the folders called OBJS.")]


def _check_compiler_runs(sdk):
    for tool in COMPILER.paths:
        _run(sdk / tool, "--version")
    for driver, compiler in (("gcc", "cc1"), ("g++", "cc1plus")):
        path = _run(sdk / f"bin/mipsel-linux-{driver}", f"-print-prog-name={compiler}").strip()
        if "/" not in path:  # the driver prints just the name if it does not find the program
            raise Problem(f"mipsel-linux-{driver} does not find {compiler}, the compiler itself.", COMPILER.advice)
        _run(path, "--version")
    _run(sdk / "OPEN_R/bin/mkbin", "--help")


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
                   "If it needs a newer GLIBC, use a container with a newer Debian, or build the toolchain from "
                   "source.")
