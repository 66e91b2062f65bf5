#!/bin/sh
# Includes point one way, as in docs/architecture.md: image, scene, map, picture, visibility, material, render; math, simd and parallel serve them
# and know none of them. Programs include the public headers alone.
set -eu
failed=0

# forbid FOLDERS PATTERN: no file of these folders includes what the pattern names.
forbid() {
  # shellcheck disable=SC2086 # a list of folders
  if grep -rnE "#include \"$2/" $1; then
    echo "the includes above lead out of their room" >&2
    failed=1
  fi
}

forbid 'src/math src/simd src/parallel' '(image|scene|map|picture|visibility|material|render)'
forbid 'src/image' '(scene|map|picture|visibility|material|render)'
forbid 'src/scene' '(map|picture|visibility|material|render)'
forbid 'src/map' '(picture|visibility|material|render)'
forbid 'src/picture' '(visibility|material|render)'
forbid 'src/visibility' '(material|render)'
forbid 'src/material' '(map|picture|visibility|render)'
forbid 'apps examples python bench/facemap_bench* bench/visibility*' '(math|simd|parallel|image|scene|map|picture|visibility|material|render)'
exit $failed
