#!/usr/bin/env bash
# Gets the coastlines of Natural Earth (public domain) for bench/curves into
# data/coast/: scripts/fetch_coastlines.sh
# They come out of the npm package world-atlas, which is unpacked, never
# installed; nothing in it is run. What cannot be had is left out with a notice.
set -euo pipefail
. "$(dirname "$0")/setup.sh"

readonly COAST=data/coast VERSION=2.0.2
readonly -A SHA256=(
  [land-110m]=ead5f68119c49a9250902e7da303bcb209341bbb8fefe7369a439b48b704658a
  [land-50m]=619477ff690c086885e45cb91707d783805561bd75ae8e437b7d4694b0204e0f
  [land-10m]=9b9f584709c119d63fbadf484ce425260497697b7166be7a2fe360e8c0b171a8)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

unpack() {
  command -v npm >/dev/null || {
    echo 'npm is not installed'
    return 1
  }
  (cd "$work" && npm pack --loglevel=error --ignore-scripts \
    --fetch-retries=0 --cache "$work/npm" "world-atlas@$VERSION") || return
  tar --extract --gzip --file "$work/world-atlas-$VERSION.tgz" \
    --directory "$work"
}

mkdir -p "$COAST"
if ! unpack >"$work/log" 2>&1; then
  say "left out, the coastlines: $(head --lines=1 "$work/log")"
  exit 0
fi
for map in "${!SHA256[@]}"; do
  echo "${SHA256[$map]}  $work/package/$map.json" |
    sha256sum --status --check || die "$map of world-atlas: wrong checksum"
  scripts/decode_coastlines.py "$work/package/$map.json" "$COAST/$map.xyz"
done
say "$(grep --count ring "$COAST"/*.xyz | paste --serial --delimiters=' ') rings"
