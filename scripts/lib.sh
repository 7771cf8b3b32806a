# Functions that the scripts share. Source this file; do not run it.
# shellcheck shell=bash
set -euo pipefail
unset CDPATH  # otherwise cd could go elsewhere

project_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build_dir=$project_dir/.build

# The system's tools come first, because python3 or cmake of pyenv, conda or pip would not find the ROS packages.
export PATH=/usr/bin:/bin:$PATH
export PYTHONNOUSERSITE=1
export HOME=${HOME:-/root}

say() {
  printf '\n== %s\n' "$*"
}

# show_progress WHAT LOG: reads the output of Ninja or apt-get, writes it to LOG, and shows how far it is: on a terminal
# in one line that counts, elsewhere in a line every ten seconds.
show_progress() {
  local line count=0 all=0 begin=$SECONDS next=$((SECONDS + 10))
  while IFS= read -r line; do
    printf '%s\n' "$line" >&3
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      count=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
    elif [[ $line =~ ^[0-9]+\ upgraded,\ ([0-9]+)\ newly\ installed ]]; then
      all=$((3 * BASH_REMATCH[1]))
    elif [[ $line =~ ^(Get:|Unpacking |Setting up ) ]]; then
      ((count += count < all))
    else
      continue
    fi
    if [ -t 1 ]; then
      printf '\r%s: %d of %d steps' "$1" "$count" "$all"
    elif ((SECONDS >= next)); then
      printf '%s: %d of %d steps\n' "$1" "$count" "$all"
      next=$((SECONDS + 10))
    fi
  done 3> "$2"
  [ ! -t 1 ] || printf '\r\033[K'
  printf '%s: %d steps in %d s\n' "$1" "$count" $((SECONDS - begin))
}

# use_sanitizer NAME: switches to the build folder of this sanitizer (cmake/sanitizers.cmake). rosrun looks for programs
# everywhere in the project but in build/, so all builds but the usual one are there.
use_sanitizer() {
  case $1 in
    address | thread | fuzz) build_dir=$project_dir/build/$1 ;;
    *) fail "there is no sanitizer '$1'." "Choose address or thread." ;;
  esac
}

# watch_with NAME: builds and runs programs with the sanitizer address or thread. test/sanitizers explains suppressions.
watch_with() {
  [[ $1 =~ ^(address|thread)$ ]] || fail "there is no sanitizer '$1'." "Choose address or thread."
  use_sanitizer "$1"
  local suppressions=$project_dir/test/sanitizers
  export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
  export UBSAN_OPTIONS=print_stacktrace=1
  export LSAN_OPTIONS=suppressions=$suppressions/leaks.txt:print_suppressions=0
  export TSAN_OPTIONS=suppressions=$suppressions/threads.txt:halt_on_error=1:second_deadlock_stack=1:history_size=7
}

# at_once N MEGABYTES: prints how many processes run at the same time: N for each processor, or fewer if memory does not
# suffice for so many of this size.
at_once() {
  awk -v most=$(($1 * $(nproc))) -v size="$2" '
    /^MemAvailable/ { fit = int($2 / 1000 / size) }
    END { print (fit < 1 ? 1 : fit < most ? fit : most) }' /proc/meminfo
}

# fail PROBLEM [ADVICE...]: prints what went wrong, then the advice, one line each.
fail() {
  printf '\n%s: %s\n' "${0##*/}" "$1" >&2
  shift
  [ $# -eq 0 ] || printf '  %s\n' "$@" >&2
  exit 1
}

# For the running script, --help prints the comment at its top.
if [[ ${1:-} =~ ^(--help|-h)$ ]]; then
  sed -n '2,/^[^#]/{s/^# \{0,1\}//p}' "$0"
  exit 0
fi

# packages_of GROUP...: the packages in scripts/packages.txt, for this release.
packages_of() {
  local release
  release=$(. /etc/os-release && echo "${VERSION_CODENAME:-$ID}")
  awk -v groups=" $* " -v release=",$release," '
    /^[a-z]/ && index(groups, " " $1 " ") {
      split($2, part, "@")
      is_except = sub(/^!/, "", part[2])
      if (part[2] == "" || (index("," part[2] ",", release) > 0) != is_except) print part[1]
    }' "$project_dir/scripts/packages.txt"
}

source_setup() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

# Debian has ROS in /usr; Ubuntu 20.04 has it in /opt/ros/noetic.
if [ -f /opt/ros/noetic/setup.bash ]; then
  source_setup /opt/ros/noetic/setup.bash
fi

# use_private_ros FOLDER: nodes use only this machine and log to the folder, in any environment. It works even if
# the host's name has no address.
use_private_ros() {
  unset ROS_HOSTNAME ROS_NAMESPACE ROS_MASTER_URI ROSCONSOLE_CONFIG_FILE
  export ROS_IP=127.0.0.1 ROS_HOME=$1 ROS_LOG_DIR=$1/log
  mkdir -p "$ROS_LOG_DIR"
}

# free_port PORT: prints a free TCP port of this machine: PORT itself if possible.
free_port() {
  python3 - "$1" <<'PYTHON'
import socket, sys
for port in (int(sys.argv[1]), 0):
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            continue
        print(probe.getsockname()[1])
        break
PYTHON
}

# start_roscore LOG: starts a ROS master on a free port until this script ends.
start_roscore() {
  local port
  port=$(free_port 0)
  export ROS_MASTER_URI=http://127.0.0.1:$port
  setsid roscore -p "$port" > "$1" 2>&1 &  # Ctrl-C does not reach it
  roscore=$!
  trap 'kill "$roscore"; wait "$roscore" || true' EXIT
  until true 2> /dev/null < "/dev/tcp/127.0.0.1/$port"; do
    kill -0 "$roscore" 2> /dev/null || fail "roscore did not start:" "$(tail -n 3 "$1")"
    sleep 0.1
  done
}
