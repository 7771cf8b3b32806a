"""Compiles the robot's sources with Sony's headers and this computer's compiler instead of the SDK's.

It cannot check whether GCC 3.3.6 accepts them, or whether they link.
"""
import re
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from . import Problem, raise_any, sdk as sony
from .objects import SOURCES, robot_objects, shared_sources

OPENR_FOLDERS = ("OPEN_R/include/MCOOP", "OPEN_R/include/R4000", "OPEN_R/include")
FROM_ELSEWHERE = {"def.h", "entry.h", "jpeglib.h", "jerror.h"}  # stubgen2, libjpeg


def check(sdk):
    """Raises Problems for all sources that do not compile."""
    sony.check_for_headers(sdk)
    with tempfile.TemporaryDirectory() as folder:
        with ThreadPoolExecutor() as pool:
            raise_any(problem for found in pool.map(list, _jobs(sdk, Path(folder))) for problem in found)


def _jobs(sdk, folder):
    """Yields a generator of Problems for each file."""
    for robot_object in robot_objects() + [shared_sources()]:
        own = folder / robot_object.name
        own.mkdir()
        includes = [own, SOURCES, SOURCES / robot_object.folders[0]]
        if robot_object.file != "-":
            stub = _make_stub(sdk, robot_object, own)
            yield _compile(sdk, stub, includes)
        for source in robot_object.sources():
            yield _compile(sdk, source, includes)
        for path in robot_object.sources() + robot_object.headers():
            yield _unknown_headers(sdk, path)


def _make_stub(sdk, robot_object, folder):
    done = subprocess.run([str(sdk / "OPEN_R/bin/stubgen2"), str(robot_object.stub_cfg)], cwd=str(folder),
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, universal_newlines=True, check=False)
    if done.returncode != 0:
        raise Problem(f"stubgen2 does not accept {robot_object.stub_cfg}: {done.stderr.strip()}",
                      "The Programmer's Guide describes the form of services and extra entries.")
    return folder / (robot_object.name + "Stub.cc")


def _compile(sdk, source, includes):
    """Warnings are off, because many would be about longword, which has 64 bits here. The Linux builds show them.

    -fpermissive is for RCRegion.h, whose operator new takes an unsigned int: size_t on the robot, but not here.
    """
    arguments = ["g++", "-std=gnu++98", "-fsyntax-only", "-w", "-fpermissive"]
    arguments += [f"-I{folder}" for folder in includes]
    for folder in OPENR_FOLDERS:
        arguments += ["-isystem", str(sdk / folder)]
    done = subprocess.run(arguments + [str(source)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          universal_newlines=True, check=False)
    if done.returncode != 0:
        yield Problem(f"{source} does not compile with Sony's headers:",
                      *[line for line in done.stdout.splitlines() if "error" in line][:3])


def _unknown_headers(sdk, path):
    """Finds headers that the robot's C library lacks, such as <strings.h>."""
    for name in re.findall(r"^\s*#\s*include\s*<([^>]+)>", path.read_text(), re.MULTILINE):
        folders = [sdk / "mipsel-linux/include", *(sdk / "include" / "c++").glob("*"),
                   *(sdk / "lib/gcc-lib").glob("*/*/include"), *(sdk / folder for folder in OPENR_FOLDERS)]
        if name not in FROM_ELSEWHERE and not any((folder / name).is_file() for folder in folders):
            yield Problem(f"{path} includes <{name}>, which the SDK does not have.",
                          "Does another header declare the same names? The SDK keeps its C library's headers in "
                          "mipsel-linux/include; are they there?")
