"""Builds the programs and writes the memory stick."""
import gzip
import os
import re
import subprocess
import sys

from . import Problem, debian, raise_any, sdk as sony
from .binary import Program
from .objects import PROGRAMS, SOURCES, STICK_FILES, robot_objects

sys.path.append(str(SOURCES / "host_files"))
from replace_file import replace_file  # noqa: E402


def libjpeg_problems(libjpeg):
    """Yields a Problem unless the folder has the sources of libjpeg 6b."""
    advice = ("Unpack jpegsrc.v6b.tar.gz (https://www.ijg.org/files/) and give its folder, jpeg-6b.",
              "Newer versions are refused: only 6b has been tried with the robot's compiler.")
    header = libjpeg / "jpeglib.h"
    if not header.is_file() or not (libjpeg / "jmemnobs.c").is_file():
        yield Problem(f"there are no sources of libjpeg in {libjpeg}: jpeglib.h and jmemnobs.c are missing.", *advice)
    elif not re.search(r"define\s+JPEG_LIB_VERSION\s+62\b", header.read_text(errors="replace")):
        yield Problem(f"{header} is not from libjpeg 6b.", *advice)


def path_problems(*paths):
    """Yields a Problem for each path that make or Sony's tools cannot handle."""
    for path in (*paths, PROGRAMS):
        if odd := re.search(r"[^\w./+@,=~-]", str(path)):  # make and the shell would execute $(...)
            yield Problem(f"there is {'a space' if odd[0].isspace() else repr(odd[0])} in {path}, which make and Sony's "
                          "tools cannot handle.",
                          "Use a path of letters, digits and ./_+@,=~-; a symbolic link will do.")


def build(sdk, libjpeg, build_dir, compiler):
    """Builds all programs from scratch, in case old ones are from another SDK, and checks them. Returns their files."""
    print(f"Building in {build_dir} with {'the compiler of the SDK' if compiler == 'sdk' else debian.version()}",
          flush=True)
    tools = sdk
    if compiler == "debian":
        tools = build_dir.with_name(build_dir.name + "_tools")
        debian.prepare(sdk, tools)
    make = ["make", "--silent", "--no-print-directory", "-C", str(PROGRAMS), f"OPENRSDK_ROOT={tools}",
            f"LIBJPEG={libjpeg}", f"BUILD={build_dir}"]
    try:
        subprocess.run(make + ["clean"], check=True)
        subprocess.run(make + [f"-j{os.cpu_count() or 1}"], check=True)
    except subprocess.CalledProcessError as error:
        raise Problem("the build failed; see the first message above.",
                      "'No rule to make target' means that the file it names is missing.") from error
    programs = [build_dir / robot_object.file for robot_object in robot_objects()]
    raise_any(problem for robot_object, program in zip(robot_objects(), programs)
              for problem in _faults(program, build_dir / robot_object.name / robot_object.name))
    return programs


def _faults(path, linked_as):
    """Yields a Problem for each fault of a program. mkbin has left `linked_as`.nosnap.elf and .rel.elf."""
    linked, relocations = (linked_as.with_name(linked_as.name + end) for end in (".nosnap.elf", ".rel.elf"))
    program = Program(gzip.decompress(path.read_bytes()),
                      *(file.read_bytes() if file.is_file() else None for file in (linked, relocations)))
    for what in [*program.problems(), *program.unusual]:
        yield Problem(f"{path}: {what}.",
                      "Do not start it on a robot; build it again, and report the fault if it comes back.")


def write(sdk, model, programs, wlan_conf, output):
    """Writes the stick, but keeps the owner's RCSERVER.CFG, WLANCONF.TXT and motions.

    Returns notes for the owner, one line each.
    """
    open_r = output / "OPEN-R"
    try:
        _copy_folder(sony.system_folder(sdk, model), open_r)
        _copy_folder(STICK_FILES / "MW", open_r / "MW", keep=("RCSERVER.CFG",))
        (open_r / "MW" / "OBJS").mkdir(exist_ok=True)
        for program in programs:
            replace_file(open_r / "MW" / "OBJS" / program.name, program.read_bytes())
        notes = _write_wlan_conf(open_r / "SYSTEM" / "CONF" / "WLANCONF.TXT", wlan_conf)
        os.sync()
    except OSError as error:
        raise Problem(f"the memory stick cannot be written: {error}",
                      "Is it in the reader and mounted? Is it full, or write-protected by its small switch?") from error
    return notes


def _copy_folder(source, target, keep=()):
    for path in sorted(source.rglob("*")):
        copy = target / path.relative_to(source)
        if path.is_dir():
            copy.mkdir(parents=True, exist_ok=True)
        elif path.name not in keep or not copy.exists():
            copy.parent.mkdir(parents=True, exist_ok=True)
            replace_file(copy, path.read_bytes())


def _write_wlan_conf(path, text):
    if text is not None:
        # The file has the WEP key, so on a disk only its owner may read it. A memory stick has no permissions.
        replace_file(path, text.encode("ascii"), 0o600)
        return []
    if path.exists():
        return [f"{path} was not changed."]
    return ["There is no WLANCONF.TXT: the robot takes Sony's settings from WLANDFLT.TXT. --essid writes one."]
