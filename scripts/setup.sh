# shellcheck shell=bash disable=SC2034
# Sourced by the scripts beside it: installs what a fresh Debian machine lacks.
# Needs only bash and what every Debian has. Leaves the shell in the project's
# root folder.

export LC_ALL=C
if [ -n "${UMBRELLA_DATA:-}" ]; then
  UMBRELLA_DATA=$(cd "$UMBRELLA_DATA" && pwd) || exit 1
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

# Debian package = what shows that it is there: a command, or a header below
# an include folder. What is there is never asked of apt-get again.
readonly BUILD_PACKAGES=(
  'g++=g++'
  'cmake=cmake'
  'ninja-build=ninja'
  'libeigen3-dev=eigen3/Eigen/Core'
  'libcli11-dev=CLI/CLI.hpp'
  'nlohmann-json3-dev=nlohmann/json.hpp'
  'libfast-float-dev=fast_float/fast_float.h')
readonly TEST_PACKAGES=(
  'libgtest-dev=gtest/gtest.h'
  'libgmock-dev=gmock/gmock.h'
  'libbenchmark-dev=benchmark/benchmark.h'
  'libboost-dev=boost/version.hpp')
readonly GATE_PACKAGES=(
  'clang=clang++'
  'clang-format=clang-format'
  'clang-tidy=clang-tidy')
readonly DATA_PACKAGES=(
  'bzip2=bzip2')

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }
die() {
  say "$*"
  exit 1
}

is_there() {
  command -v "$1" >/dev/null || [ -e "/usr/include/$1" ] ||
    [ -e "/usr/local/include/$1" ]
}

# run_as_root COMMAND...: directly, or with sudo where it asks nothing or
# there is a terminal to ask on.
run_as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif [ -t 0 ]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

may_be_root() {
  [ "$(id -u)" = 0 ] || { command -v sudo >/dev/null &&
    { [ -t 0 ] || sudo -n true 2>/dev/null; }; }
}

# require PACKAGE=SIGN...: installs the packages whose sign is missing.
require() {
  local missing=() entry
  for entry in "$@"; do
    is_there "${entry#*=}" || missing+=("${entry%=*}")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  command -v apt-get >/dev/null ||
    die "missing, by their Debian names: ${missing[*]}; please install them"
  local command="apt-get update && apt-get install --no-install-recommends"
  command+=" ${missing[*]}"
  may_be_root || die "missing packages; as root, run: $command"
  say "installing ${missing[*]}"
  if ! { run_as_root apt-get --quiet=2 -o APT::Update::Error-Mode=any update &&
    run_as_root env DEBIAN_FRONTEND=noninteractive apt-get --quiet=2 --yes \
      -o Dpkg::Use-Pty=0 install --no-install-recommends "${missing[@]}"; } \
    >/dev/null
  then
    die "apt-get failed (is there a network?); as root, run: $command"
  fi
}

# configure PRESET [CMAKE OPTION...]; with ccache where it is installed.
configure() {
  local preset=$1
  shift
  if [ -z "${CMAKE_CXX_COMPILER_LAUNCHER:-}" ] && command -v ccache >/dev/null
  then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache
  fi
  cmake --preset "$preset" "$@"
}

# Our own source files, one a line; asks no git, there may be none.
sources() {
  find lib apps bench tests -name '*.h' -o -name '*.cpp' | sort
}
