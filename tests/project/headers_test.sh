#!/bin/sh
# headers_test.sh COMPILER: each public header compiles when it is the first and only one.
set -eu
for header in include/facemap/*.h; do
  echo "#include <facemap/${header##*/}>" | "$1" -std=c++20 -Wall -Wextra -Werror -fsyntax-only -Iinclude -x c++ -
done
