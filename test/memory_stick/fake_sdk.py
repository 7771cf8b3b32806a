"""Makes a folder that looks like Sony's SDK to scripts/memory_stick. Its tools are small shell scripts that write files
of the right kind, and log their arguments in `log`."""
import functools
import random

import fake_program
from stick.link import merge

LOG = 'echo "${{0##*/}} $*" >> "${{0%/*}}/{up}/log"\n'

COMPILER = r"""
case $1 in
  --version) exit 0 ;;
  -print-prog-name=*) echo "${0%/*}/${1#*=}"; exit 0 ;;
esac
while [ $# -gt 1 ]; do
  if [ "$1" = -o ]; then output=$2; fi
  shift
done
[ -f "$1" ] || { echo "$1: No such file" >&2; exit 1; }
echo object > "$output"
"""

ARCHIVER = """
case $1 in --version) exit 0 ;; esac
echo archive > "$2"
"""

# mkbin ... -o NAME.bin ...: writes a program that the robot's loader could place. Its input files have to exist.
MKBIN = r"""
case $1 in --help) exit 0 ;; esac
while [ $# -gt 0 ]; do
  case $1 in
    -o) output=$2; shift ;;
    -p) [ -d "$2" ] || exit 1; shift ;;
    -l* | -L*) ;;
    *) [ -f "$1" ] || { echo "mkbin: $1 is not there" >&2; exit 1; } ;;
  esac
  shift
done
cp "${0%/*}/../../program" "$output"
"""

# Like Sony's, it writes into the working directory.
STUBGEN = r"""
name=$(sed -n 's/^ObjectName *: *//p' "$1")
"${STUB_GENERATOR:-true}" "$1" .
touch def.h entry.h "${name}Stub.h" "${name}Stub.cc"
"""

TOOLS = {"gcc": COMPILER, "g++": COMPILER, "ar": ARCHIVER, "strip": "", "readelf": "",
         "nm": '[ "$1" = --version ] || cat "${0%/*}/../undefined"\n'}

# The output of nm -u for a complete program: one symbol is weak and may be absent, the other is the linker's own.
UNDEFINED = "         w __deregister_frame_info\n         U _gp_disp\n"

SYSTEM_CONF = {
    "OBJECT.CFG": "#\n# OBJECT.CFG\n#\nOPowerManager /MS/OPEN-R/SYSTEM/OBJS/POWERMGR.BIN\n",
    "CARDDRV.CFG": "/MS/OPEN-R/SYSTEM/OBJS/IPSTACK.BIN  -1\n",
    "WLANDFLT.TXT": "ESSID=FACTORY\r\n",
}


def make_sdk(sdk):
    for name, text in TOOLS.items():
        _script(sdk / "bin" / ("mipsel-linux-" + name), LOG.format(up="..") + text)
    for name in ("cc1", "cc1plus"):
        _script(sdk / "bin" / name, "")
    (sdk / "undefined").write_text(UNDEFINED)
    (sdk / "program").write_bytes(merge(fake_program.linked(), fake_program.tables(fake_program.sections())))
    openr = sdk / "OPEN_R"
    for name, text in (("mkbin", MKBIN), ("stubgen2", STUBGEN), ("gensnap", "")):
        _script(openr / "bin" / name, LOG.format(up="../..") + text)
    for name in ("ObjectComm", "OPENR", "Internet", "antMCOOP", "apsys", "mcoopstub", "OFSpub"):
        _write(openr / "lib" / f"lib{name}.a", "")
    for name in ("OPENR/OObject.h", "MCOOP/ant.h", "MCOOP.h", "TCPEndpointMsg.h"):
        _write(openr / "include" / name, "")
    _write(sdk / "mipsel-linux" / "include" / "string.h", "")
    for folder, model in (("MS_ERS7", "ERS-7"), ("MS_ERS200", "ERS-210")):
        _make_system(openr / folder / "WCONSOLE" / "memprot" / "OPEN-R", model)


def make_libjpeg(folder):
    _write(folder / "jpeglib.h", "#define JPEG_LIB_VERSION  62\n")
    for name in ("jcapimin jcapistd jccoefct jccolor jcdctmgr jchuff jcinit jcmainct jcmarker jcmaster jcomapi jcparam "
                 "jcphuff jcprepct jcsample jfdctflt jfdctfst jfdctint jerror jmemmgr jmemnobs jutils").split():
        _write(folder / f"{name}.c", "")


def _make_system(open_r, model):
    for name, size in (("APERIOS.GZ", 480_000), ("APERINIT.GZ", 30_000), ("BOOTPARA", 136)):
        (open_r / name).parent.mkdir(parents=True, exist_ok=True)
        (open_r / name).write_bytes(system_file(model + name, size))
    _write(open_r / "VERSION.txt", f"OPEN_R_SYS-115-030-SDK for {model} (OPEN-R SDK 1.1.5 r5)\n")
    _write(open_r / "MW" / "CONF" / "DESIGNDB.CFG", "[ERS-7]\n")
    _write(open_r / "MW" / "CONF" / "OBJECT.CFG", "# Sony's\n")
    for name, text in SYSTEM_CONF.items():
        _write(open_r / "SYSTEM" / "CONF" / name, text)
    for name in ("POWERMGR.BIN", "IPSTACK.BIN"):
        (open_r / "SYSTEM" / "OBJS").mkdir(exist_ok=True)
        (open_r / "SYSTEM" / "OBJS" / name).write_bytes(system_file(model + name, 8_000))


@functools.lru_cache(maxsize=None)
def system_file(name, size):
    """Like Sony's encrypted files, it looks like noise."""
    return random.Random(name).getrandbits(8 * size).to_bytes(size, "little")


def _write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode())


def _script(path, text):
    _write(path, "#!/bin/sh\n" + text)
    path.chmod(0o755)
