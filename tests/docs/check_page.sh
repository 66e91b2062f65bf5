#!/bin/sh
# check_page.sh ROOT PAGE: every file, every function beside its file and every test that the page names in
# backquotes exists. Files are given from the project's root, tests as Suite.Name.
set -eu
root=$1
page=$2
cd "$root"
status=0
complain() { echo "$page: $*" >&2; status=1; }

names=$(mktemp)
trap 'rm -f "$names"' EXIT
awk '/^```/ { inside = !inside; next } !inside' "$page" | tr '\n' ' ' | grep -oE '`[^`]+`( `[A-Za-z_]+`)?' > "$names" || true
[ -s "$names" ] || complain "names nothing"

tests=0
files=0
while IFS='`' read -r _ first _ second _; do
  case $first in
    src/* | include/* | tests/* | apps/* | bench/* | docs/* | scripts/* | examples/* | cmake/*)
      files=$((files + 1))
      if [ ! -e "$first" ]; then
        complain "no file $first"
      elif [ -n "$second" ] && ! grep -qw -- "$second" "$first"; then
        complain "no $second in $first"
      fi ;;
    [A-Z]*.[A-Z]*)
      suite=${first%%.*}
      name=${first#*.}
      tests=$((tests + 1))
      grep -rqE "^TEST(_F|_P)?\($suite, $name\)" tests || complain "no test $first" ;;
  esac
done < "$names"
echo "$page: $files files and $tests tests named"
exit $status
