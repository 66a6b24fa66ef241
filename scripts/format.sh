#!/usr/bin/env bash
# Formats every source file: scripts/format.sh [--check]
#   --check   change nothing, fail where something would change
set -euo pipefail
. "$(dirname "$0")/setup.sh"

mode=(-i)
case ${1:-} in
  '') ;;
  --check) mode=(--dry-run -Werror) ;;
  *) die "unknown option '$1'; see the first lines of $0" ;;
esac

require clang-format=clang-format
sources | xargs clang-format "${mode[@]}"
