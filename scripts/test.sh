#!/usr/bin/env bash
# Builds and runs the tests: scripts/test.sh [--strict] [--preset P] [--label L]
#   --strict     a compiler warning is an error
#   --preset P   dev (default), clang, asan or release
#   --label L    only tests with this label: unit or slow
set -euo pipefail
. "$(dirname "$0")/setup.sh"

strict=OFF
preset=dev
label=
while [ $# -gt 0 ]; do
  case $1 in
    --strict) strict=ON ;;
    --preset | --label)
      [ $# -gt 1 ] || die "$1 wants a value"
      printf -v "${1#--}" %s "$2"
      shift
      ;;
    *) die "unknown option '$1'; see the first lines of $0" ;;
  esac
  shift
done

require "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
if [ "$preset" = clang ]; then require clang=clang++; fi

# Some tests want the paper's own sets, which are not part of this project.
if [ -z "${UMBRELLA_DATA:-}" ] && [ -d ../shared/data ]; then
  UMBRELLA_DATA=$(cd ../shared/data && pwd)
fi
if [ -n "${UMBRELLA_DATA:-}" ]; then export UMBRELLA_DATA; fi

configure "$preset" -DWARNINGS_AS_ERRORS="$strict"
cmake --build --preset "$preset"
say "preset $preset, labels: ${label:-unit and slow}"
say "UMBRELLA_DATA: ${UMBRELLA_DATA:-not set, tests that need it are skipped}"
ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error \
  ${label:+--label-regex "^$label\$"}
