#!/bin/sh
# claims.sh check|update PROGRAM PAGE [times]: the page's tables are those that the program prints, each known by
# its header line; update puts them in. With times the tables of times, which differ from run to run.
set -eu
action=$1 program=$2 page=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$program" ${4-} >"$folder/tables"
awk -v tables="$folder/tables" '
  BEGIN {
    while ((getline line < tables) > 0) {
      if (line == "") { header = ""; continue }
      if (header == "") header = line
      table[header] = table[header] line "\n"
    }
  }
  inside { if ($0 != "") next; inside = 0 }
  $0 in table { printf "%s", table[$0]; found[$0] = 1; inside = 1; next }
  { print }
  END {
    for (header in table) {
      if (!(header in found)) { print "the page has no table " header > "/dev/stderr"; exit 1 }
    }
  }' "$page" >"$folder/page"

case $action in
  check) diff "$page" "$folder/page" ;;
  update) cat "$folder/page" >"$page" ;;
esac
