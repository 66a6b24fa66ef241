#!/usr/bin/env bash
# Builds the command, reconstructs the objects of the paper's Table 2 and then
# all other scans at hand, and prints the tables: scripts/reproduce.sh [--quick]
#   --quick   only the objects of Table 2
# UMBRELLA_DATA may name a folder with the paper's own sets (*.xyz.gz); without
# it, and where a set is missing, a real scan or a generated set of like size
# stands in and is named. Meshes, reports and tables are left in out/.
set -euo pipefail
. "$(dirname "$0")/setup.sh"

readonly BUILD=build/reproduce REAL=data/real SAMPLES=data/samples OUT=out
readonly UMBRELLA=$BUILD/bin/umbrella
readonly HEADINGS=$'object\tpoints\tfilter_triangles\tfilter_seconds\t'\
$'closed_triangles\ttotal_seconds\tset\treport'
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build() {
  configure release -B "$BUILD" -DBUILD_TESTS=OFF -DBUILD_BENCHMARKS=OFF
  cmake --build "$BUILD"
}

# find_set OWN STAND_INS: sets `input`, the file to read, and `label`, its name
# in the table; both are empty where nothing is at hand. STAND_INS are tried in
# turn: real scans, or generate:SHAPE:N.
find_set() {
  local own=${UMBRELLA_DATA:-}/$1.xyz.gz stand_in shape n
  input='' label=''
  if [ -n "${UMBRELLA_DATA:-}" ] && [ -f "$own" ]; then
    input=$work/$1.xyz label=$1
    gzip -dc "$own" >"$input"
    return
  fi
  for stand_in in ${2//,/ }; do
    if [[ $stand_in == generate:* ]]; then
      IFS=: read -r _ shape n <<<"$stand_in"
      input=$work/$shape.ply label="stand-in: generated $shape"
      "$UMBRELLA" generate "$shape" -n "$n" -o "$input"
      return
    elif [ -f "$REAL/$stand_in" ]; then
      input=$REAL/$stand_in label="stand-in: $stand_in"
      return
    fi
  done
}

# reconstruct INPUT NAME: leaves OUT/NAME.ply and OUT/NAME.json; sets `report`,
# `-` where there is none. Status 3, a surface with an open region, is a result.
reconstruct() {
  local status=0
  report=$OUT/$2.json
  rm -f "$report" "$OUT/$2.ply"
  say "$2 <- ${1##*/}"
  "$UMBRELLA" reconstruct "$1" -o "$OUT/$2.ply" --report "$report" --quiet ||
    status=$?
  case $status in
    0 | 3) ;;
    *)
      say "$2: umbrella reconstruct failed with status $status"
      failed+=("$2")
      report=-
      ;;
  esac
}

# run_table2 TSV: appends a line for each row of the paper's table.
run_table2() {
  local object points filter filter_s closed total_s own stand_ins
  local input label report
  while IFS=$'\t' read -r object points filter filter_s closed total_s own \
    stand_ins; do
    find_set "$own" "$stand_ins"
    report=-
    if [ -n "$input" ]; then
      reconstruct "$input" "$object"
    else
      say "$object: no set at hand, not $own nor $stand_ins"
    fi
    line "$object" "$points" "$filter" "$filter_s" "$closed" "$total_s" \
      "${label:--}" "$report" >>"$1"
  done < <(tail -n +2 data/paper_table2.tsv)
}

# run_scans FOLDER TSV: appends a line for each set in the folder.
run_scans() {
  local path name report
  mkdir -p "$OUT/scans"
  for path in "$1"/*; do
    name=${path##*/}
    reconstruct "$path" "scans/$name"
    line "$name" - - - - - - "$report" >>"$2"
  done
}

# line CELL...: separated by tabs.
line() {
  local IFS=$'\t'
  echo "$*"
}

# print TSV TITLE: the tables, also into a file beside the TSV.
print() {
  {
    printf '\n%s\n\n' "$2"
    "$BUILD/bin/report_table" "$1"
  } | tee "${1%.tsv}.md"
}

quick=
case ${1:-} in
  '') ;;
  --quick) quick=yes ;;
  *) die "unknown option '$1'; see the first lines of $0" ;;
esac

require "${BUILD_PACKAGES[@]}"
build
scripts/fetch_data.sh
mkdir -p "$OUT"
failed=()

echo "$HEADINGS" >"$OUT/table2.tsv"
run_table2 "$OUT/table2.tsv"
print "$OUT/table2.tsv" "Table 2, the paper's numbers (2002) and ours"

if [ -z "$quick" ]; then
  echo "$HEADINGS" >"$OUT/scans.tsv"
  if compgen -G "$REAL/*" >/dev/null; then
    run_scans "$REAL" "$OUT/scans.tsv"
    print "$OUT/scans.tsv" "All real scans at hand"
  else
    say "no real scan is at hand (no network?): the committed samples instead"
    run_scans "$SAMPLES" "$OUT/scans.tsv"
    print "$OUT/scans.tsv" "The committed samples"
  fi
fi
[ ${#failed[@]} = 0 ] || die "failed: ${failed[*]}"
