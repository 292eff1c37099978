# shellcheck shell=bash disable=SC2119,SC2154
# Shared by ./kedge and ./check (bash, sourced with $root set): installs what
# is missing and builds. Everything it says goes to standard error.

build=$root/build
stamp=$build/.kedge_is_current

say() { echo "kedge: $*" >&2; }

fail()
{
  say "$@"
  exit 1
}

# Words to run a command as the administrator with; fails if there is no way.
administrator()
{
  if [ "$(id -u)" -eq 0 ]; then
    echo env
  elif command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
    echo sudo env
  else
    return 1
  fi
}

# apt-get with patience: another program may hold the locks of dpkg or apt.
patient_apt_get()
{
  local tries=0
  while ! $become DEBIAN_FRONTEND=noninteractive \
      apt-get -q -y -o DPkg::Lock::Timeout=600 "$@" >"$apt_log" 2>&1; do
    if ! grep -q "Could not get lock\|Unable to lock" "$apt_log" || [ $((tries += 1)) -gt 60 ]; then
      tail -n 20 "$apt_log" >&2
      return 1
    fi
    say "another program is installing packages, waiting"
    sleep 10
  done
}

# say_how_much PACKAGE...: what apt would download and unpack, if it says so.
say_how_much()
{
  local line
  $become LC_ALL=C apt-get --assume-no --no-install-recommends install "$@" 2>/dev/null |
    grep '^Need to get\|^After this operation' |
    while read -r line; do say "  $line"; done || true
}

# need PACKAGE...: installs those of the packages that are not there.
need()
{
  local missing become apt_log
  missing=$(missing_packages "$@")
  [ -z "$missing" ] && return
  missing=${missing//$'\n'/ }
  if ! command -v apt-get >/dev/null; then
    say "this system has no apt; make sure that it has the equivalents of: $missing"
    return
  fi
  become=$(administrator) || fail "these packages are missing and only an administrator can install them:
    sudo apt-get install --no-install-recommends $missing"
  say "installing $missing and what they need"
  apt_log=$(mktemp)
  trap 'rm -f "$apt_log"' EXIT
  patient_apt_get update ||
    say "the list of packages could not be renewed; trying with the one that is there"
  # shellcheck disable=SC2086  # the words of $missing are packages
  say_how_much $missing
  # shellcheck disable=SC2086
  patient_apt_get install --no-install-recommends $missing ||
    fail "apt could not install: $missing (its last words stand above)"
  rm -f "$apt_log"
  trap - EXIT
}

# Those of the given packages that are not installed.
missing_packages()
{
  if ! command -v dpkg-query >/dev/null; then
    printf '%s\n' "$@"
    return
  fi
  local installed
  # shellcheck disable=SC2016  # dpkg-query's own variables
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
    sed -n 's/ installed$//p' | sort -u)
  printf '%s\n' "$@" | sort -u | comm -23 - <(echo "$installed")
}

# What building and running takes: a compiler, deal.II with all it brings
# (MPI, Trilinos, p4est, UMFPACK), and a BLAS that is fast.
need_build_tools()
{
  need cmake g++ libdeal.ii-dev libopenblas0-pthread ninja-build openmpi-bin
}

# How many files to compile at once: as many as there are processors, but
# each takes about 1.5 GB.
n_jobs()
{
  local processors gigabytes
  processors=$(nproc)
  gigabytes=$(awk '/^MemAvailable/ {print int($2 / 1500000)}' /proc/meminfo)
  [ "$gigabytes" -lt 1 ] && gigabytes=1
  echo $((processors < gigabytes ? processors : gigabytes))
}

# configure [-D...]: makes build/ unless it is there and fits.
configure()
{
  local home
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt" 2>/dev/null || true)
  if [ -n "$home" ] && [ "$home" != "$root" ]; then
    say "build/ was made for $home; making it anew"
    rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles"
  fi
  if [ ! -e "$build/build.ninja" ] || [ ! -e "$build/CMakeCache.txt" ] || [ $# -gt 0 ]; then
    say "configuring"
    cmake -S "$root" -B "$build" -G Ninja "$@" >"$build/configure.log" 2>&1 || {
      tail -n 40 "$build/configure.log" >&2
      fail "CMake could not configure the build (all it said: $build/configure.log)"
    }
  fi
}

# configure_with OPTION...: the same, with these CMake options switched on.
configure_with()
{
  local option missing=()
  for option in "$@"; do
    grep -qs "^$option:BOOL=ON" "$build/CMakeCache.txt" || missing+=(-D "$option=ON")
  done
  configure "${missing[@]}"
}

# compile TARGET...: with progress if there is somebody to see it. The stamp
# is as old as the beginning, so that changes made meanwhile count as new.
compile()
{
  say "building"
  touch "$stamp.begin"
  if [ -t 2 ]; then
    ninja -C "$build" -j "$(n_jobs)" "$@" >&2
  else
    ninja --quiet -C "$build" -j "$(n_jobs)" "$@" >&2
  fi || fail "the build failed"
  mv "$stamp.begin" "$stamp"
}

# True if nothing that the executable is made of changed since it was built.
is_current()
{
  [ -x "$build/kedge" ] && [ -e "$stamp" ] &&
    [ -z "$(find "$root/CMakeLists.txt" "$root/cmake" "$root/include" "$root/source" \
              -newer "$stamp" -print -quit)" ]
}

# locked COMMAND...: one at a time in this folder.
locked()
{
  mkdir -p "$build" 2>/dev/null || true
  [ -w "$build" ] ||
    fail "cannot write to $build, which is needed to build; copy this folder to where you may write"
  exec 9>"$build/.lock"
  flock -n 9 || { say "waiting for another build in $build"; flock 9; }
  "$@"
  exec 9>&-
}
