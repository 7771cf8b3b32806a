"""Debian's cross compiler for MIPS instead of the SDK's, which is GNU's of 2004.

The project's Makefile and Sony's mkbin and gensnap look for tools below one folder. prepare() makes such a folder:
links to Sony's and newlib's files, their archives in a form for today's linker, programs that call Debian's tools with
OPEN-R's options, and this project's runtime instead of the C++ library.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .objects import SOURCES
from . import Problem

RUNTIME = SOURCES / "memory_stick" / "debian"
PREFIX = "mipsel-linux-gnu-"
NEWLIB = ("libc-.a", "libm.a", "libnosys.a")

# Makes a MIPS I program for any address, with newlib's headers. Without these options, GCC calls functions that only
# its own target's C library has: sincos(), and those that check the stack.
COMPILE = ("-nostdinc -isystem {runtime}/include -isystem {gcc_headers} -isystem {sdk}/mipsel-linux/include "
           "-mips1 -mabi=32 -mfp32 -mhard-float -fPIC -mabicalls -mshared -mno-plt -mno-relax-pic-calls -G0 "
           "-fno-asynchronous-unwind-tables -fno-strict-aliasing -fno-stack-protector -fno-toplevel-reorder "
           "-fno-builtin-sin -fno-builtin-cos -U_FORTIFY_SOURCE")
COMPILE_CXX = (COMPILE + " -std=gnu++98 -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-use-cxa-atexit "
               "-Wno-reorder -Wno-write-strings -Wno-class-memaccess")  # for Sony's headers

# mkbin asks the compiler for the linker, libgcc, and the first and last object file.
COMPILER = """#!/bin/sh
case $1 in
  -print-file-name=collect2) echo {tools}/bin/ld ;;
  -print-file-name=*) echo "{tools}/lib/${{1#*=}}" ;;
  *) exec {program} {options} "$@" ;;
esac
"""

LINKER = """#!/bin/sh
PYTHONPATH={scripts} exec {python} -B -m stick.link "$@"
"""


def prepare(sdk, tools):
    """Makes the folder `tools`, for use as OPENRSDK_ROOT. Call it after build_problems() of stick.sdk."""
    shutil.rmtree(str(tools), ignore_errors=True)
    for folder in ("bin", "lib", "OPEN_R/lib", "mipsel-linux/lib/ldscripts"):
        (tools / folder).mkdir(parents=True)
    for path in [sdk / "OPEN_R" / name for name in ("bin", "include", "ldscript", "lib/adjust.o")]:
        (tools / path.relative_to(sdk)).symlink_to(path)
    (tools / "mipsel-linux/include").symlink_to(sdk / "mipsel-linux/include")
    (tools / "mipsel-linux/lib/ldscripts/elf32ltsmip.xbn").symlink_to(RUNTIME / "program.ld")
    _make_programs(sdk, tools)
    for archive in sorted((sdk / "OPEN_R/lib").glob("lib*.a")) + [sdk / "mipsel-linux/lib" / name for name in NEWLIB]:
        _convert(archive, tools / archive.relative_to(sdk))
    _convert(libgcc(sdk), tools / "lib/libgcc.a")
    _make_runtime(tools)


def version():
    """The compiler's name, such as mipsel-linux-gnu-g++ (Debian 12.2.0-14) 12.2.0."""
    return _run([PREFIX + "g++", "--version"]).splitlines()[0]


def libgcc(sdk):
    """libgcc.a of the newest GCC in the SDK. Debian's has instructions that the robot's processor lacks."""
    return max((sdk / "lib/gcc-lib/mipsel-linux").glob("*/libgcc.a"), default=None)


def _make_programs(sdk, tools):
    gcc_headers = _run([PREFIX + "gcc", "-print-file-name=include"]).strip()
    for name, options in (("gcc", COMPILE), ("g++", COMPILE_CXX)):
        _write_program(tools / "bin" / ("mipsel-linux-" + name), COMPILER.format(
            tools=tools, program=PREFIX + name,
            options=options.format(runtime=RUNTIME, gcc_headers=gcc_headers, sdk=sdk)))
    # There is nothing to strip, because link.py leaves symbols out, and GNU ld itself refuses undefined ones.
    for name, program in (("ar", PREFIX + "ar"), ("readelf", PREFIX + "readelf"), ("nm", "true"), ("strip", "true")):
        (tools / "bin" / ("mipsel-linux-" + name)).symlink_to(shutil.which(program))
    _write_program(tools / "bin/ld", LINKER.format(scripts=Path(__file__).parents[1], python=sys.executable))


def _write_program(path, text):
    path.write_text(text)
    path.chmod(0o755)


def _convert(archive, output):
    """Rewrites an archive and its files, because today's GNU ld refuses those of 2004."""
    with tempfile.TemporaryDirectory() as folder:
        _run([PREFIX + "ar", "x", str(archive)], folder)
        members = sorted(path.name for path in Path(folder).iterdir())
        _run([PREFIX + "strip", "--strip-debug", "--remove-section=.pdr", *members], folder)
        _run([PREFIX + "ar", "rcs", str(output), *members], folder)


def _make_runtime(tools):
    gcc, gxx = tools / "bin/mipsel-linux-gcc", tools / "bin/mipsel-linux-g++"
    with tempfile.TemporaryDirectory() as folder:
        for output, source in (("crtbegin.o", "begin.S"), ("crtend.o", "end.S")):
            _run([str(gcc), "-c", "-o", str(tools / "lib" / output), str(RUNTIME / source)], folder)
        _run([str(gxx), "-O2", "-Wall", "-Wextra", "-Werror", "-c", "-o", "runtime.o", str(RUNTIME / "runtime.cc")],
             folder)
        _run([str(gxx), "-c", "-o", "sizes.o", *(f"-I{tools}/OPEN_R/include/{name}" for name in ("MCOOP", "R4000", "")),
              str(RUNTIME / "sizes.cc")], folder)
        _run([PREFIX + "ar", "rcs", str(tools / "mipsel-linux/lib/libstdc++.a"), "runtime.o"], folder)


def _run(command, folder=None):
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True,
                          check=False)
    if done.returncode != 0:
        raise Problem(f"{command[0]} failed: " + (done.stderr.strip() or f"exit status {done.returncode}"),
                      "The command was: " + " ".join(command))
    return done.stdout
