"""Do the robot's sources compile against Sony's headers? Tried with this computer's compiler: the SDK's is not needed.

What it cannot say: whether GCC 3.3.6 accepts them, too, and whether they link.
"""
import re
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from . import sdk as sony
from .objects import SOURCES, robot_objects, shared_sources
from .problem import Problem, raise_any

OPENR_FOLDERS = ("OPEN_R/include/MCOOP", "OPEN_R/include/R4000", "OPEN_R/include")
FROM_ELSEWHERE = {"def.h", "entry.h", "jpeglib.h", "jerror.h"}  # stubgen2, libjpeg


def check(sdk):
    """Raises Problems with all sources that do not compile."""
    sony.check_for_headers(sdk)
    with tempfile.TemporaryDirectory() as folder:
        with ThreadPoolExecutor() as pool:
            raise_any(problem for found in pool.map(list, _jobs(sdk, Path(folder))) for problem in found)


def _jobs(sdk, folder):
    """One for each file: yields its problems, when it is asked for them."""
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
        raise Problem(f"stubgen2 does not take {robot_object.stub_cfg}: {done.stderr.strip()}",
                      "Each service and extra entry has its form; the Programmer's Guide has it.")
    return folder / (robot_object.name + "Stub.cc")


def _compile(sdk, source, includes):
    """Warnings are left to the builds for Linux: here, many would be about longword, which has 64 bits on this one.

    -fpermissive: RCRegion.h declares operator new for an unsigned int, which size_t is on the robot, but not here.
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
    """This computer has headers that the robot's C library has not: <strings.h>, for instance."""
    for name in re.findall(r"^\s*#\s*include\s*<([^>]+)>", path.read_text(), re.MULTILINE):
        folders = [sdk / "mipsel-linux/include", *(sdk / "include" / "c++").glob("*"),
                   *(sdk / "lib/gcc-lib").glob("*/*/include"), *(sdk / folder for folder in OPENR_FOLDERS)]
        if name not in FROM_ELSEWHERE and not any((folder / name).is_file() for folder in folders):
            yield Problem(f"{path} includes <{name}>, which the SDK does not have.",
                          "Is the same name declared by another header? If the SDK lacks its C library's headers, "
                          "they are in mipsel-linux/include.")
