# shellcheck shell=bash
# Sourced by the scripts of tools/: what they share. Messages go to standard error.

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
jobs=$(nproc)
run=()  # a command that builds and tests run under

note() { printf -- '-- %s\n' "$*" >&2; }

fail() {
  printf 'tools/%s: %s\n' "${0##*tools/}" "$*" >&2
  exit 1
}

# The comment at the head of the script.
usage() { sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"; }

# apt_get ARGUMENTS…: as root, through sudo if need be, without questions, waiting for a package manager that
# is busy. What it says goes to build/apt.log and is shown if it fails.
apt_get() {
  local command=(env DEBIAN_FRONTEND=noninteractive apt-get -q -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300
    -o Acquire::Retries=3 "$@")
  if [[ $EUID -ne 0 ]]; then
    command -v sudo > /dev/null || fail "this needs root or sudo: apt-get $*"
    command=(sudo -- "${command[@]}")
  fi
  mkdir -p "$root/build"
  "${command[@]}" > "$root/build/apt.log" 2>&1 || {
    tail -n 30 "$root/build/apt.log" >&2
    return 1
  }
}

# A repository that cannot be reached, perhaps one that has nothing to do with us, is no reason to stop: what
# follows says whether the lists at hand suffice.
refresh_package_lists() {
  note 'refreshing the package lists'
  apt_get update || note 'not all package lists could be refreshed; going on with what is there'
}

# packages_for PURPOSE…: their names, one a line.
packages_for() {
  local purpose
  for purpose in "$@"; do
    awk -v purpose="$purpose" '$1 == purpose { print $2; found = 1 } END { exit !found }' \
      "$root/tools/setup/packages.txt" ||
      fail "no packages are listed for '$purpose'"
  done
}

# missing_packages NAME…: those of them that dpkg does not have installed, one a line.
missing_packages() {
  local name
  for name in "$@"; do
    dpkg-query -W -f '${db:Status-Status}\n' "$name" 2> /dev/null | grep -qx installed ||
      printf '%s\n' "$name"
  done
}

# install_packages PURPOSE…: installs what is missing for them, without recommended packages.
install_packages() {
  local text names missing
  text=$(packages_for "$@")
  mapfile -t names <<< "$text"
  if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    fail "this is not Debian; install what corresponds to these packages of Debian 12," \
      "then use CMake's presets:" "${names[@]}"
  fi
  text=$(missing_packages "${names[@]}")
  [[ -n $text ]] || return 0
  mapfile -t missing <<< "$text"
  note 'installing' "${missing[@]}"
  refresh_package_lists
  apt_get install --yes --no-install-recommends "${missing[@]}" ||
    fail 'these packages could not be installed:' "${missing[@]}"
}

# One run of these scripts at a time in build/: another one waits.
lock_build() {
  mkdir -p "$root/build"
  exec {build_lock}> "$root/build/.lock"
  flock --nonblock "$build_lock" || {
    note 'waiting for another run of these scripts'
    flock "$build_lock"
  }
}
unlock_build() { exec {build_lock}>&-; }

# configure PRESET: into build/PRESET, with ccache if it is there.
configure() {
  note "configuring build/$1"
  cmake -S "$root" --preset "$1" --log-level=NOTICE -DMORSEL_BUILD_TOOLS=ON -DMORSEL_BUILD_TESTS=ON \
    -DMORSEL_BUILD_PYTHON=OFF \
    -DMORSEL_SAMPLES="$root/build/samples" -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" \
    "${@:2}" >&2
}

# compile PRESET [--target …]
compile() {
  note "building build/$1"
  "${run[@]}" cmake --build "$root/build/$1" --parallel "$jobs" "${@:2}" >&2
}
