#!/bin/sh
# Runs every command of the ```sh blocks in README.md and docs, from the top folder, in their order.
# scripts/test itself is what runs this: it only has to be there.
set -eu
for page in README.md CONTRIBUTING.md docs/*.md; do
  commands=$(awk '/^```sh$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$page" |
    sed 's|^scripts/test.*|test -x scripts/test|')
  [ -n "$commands" ] || continue
  echo "== $page"
  echo "$commands" | sh -eux
done

# The gallery's pictures are those that its commands have just made.
for picture in docs/figures/gallery/*.png; do
  echo "== $picture"
  build/release/bin/facemap compare "$picture" "out/gallery/${picture##*/}" || {
    echo "$picture differs: scripts/figures gallery draws it anew" >&2
    exit 1
  }
done
