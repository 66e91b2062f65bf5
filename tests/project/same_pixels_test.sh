#!/bin/sh
# same_pixels_test.sh [BUILDS]: the same pixels and planes, and the same generated scenes, from g++ and clang++, with and
# without optimization. Needs build/release and the others (clang dev if none is named); makes clang-dev itself.
set -eu
builds=${*:-clang dev}

case " $builds " in *' clang-dev '*)
  cmake -S . -B build/clang-dev -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER=clang++-14 \
    -DFACEMAP_BUILD_TESTS=OFF >/dev/null
  cmake --build build/clang-dev --target facemap_program
esac

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
root=$PWD

# draw PROGRAM FOLDER: scenes, and pictures of one of them that use every part of the renderer.
draw() {
  facemap=$1
  mkdir "$2"
  cd "$2"
  for scene in chessboard grass bust typewriter; do "$facemap" scene $scene -o $scene.obj >$scene.flags; done
  planes='--aov id=id.npy --aov depth=depth.npy --aov lights=lights.npy'
  # shellcheck disable=SC2046,SC2086 # lists of flags
  "$facemap" render bust.obj -o surface.png --size 96x64 $planes $(cat bust.flags)
  "$facemap" render bust.obj -q -o edges.png --size 48x48 --projection plane --samples edges --falloff inverse-square
  "$facemap" render bust.obj -q -o inside.png --size 48x48 --camera 0,0.1,0 --field-angle 360 --light 0.1,0,0.1
  "$facemap" render bust.obj -q -o fill.png --size 48x48 --builder fill --normals flat --light 5,5,5
  "$facemap" map bust.obj -q -o map.png --size 64x64 --at 0,0,3
  cd "$root"
}

draw "$root/build/release/bin/facemap" "$folder/release"
for build in $builds; do
  draw "$root/build/$build/bin/facemap" "$folder/$build"
  diff -r "$folder/release" "$folder/$build"
  echo "build/$build: the same"
done
