#!/bin/sh
# headers_test.sh COMPILER: each public header compiles when it is the first and only one.
set -eu
export compiler="$1"
find include/facemap -name '*.h' -printf '%f\n' |
  xargs -n 1 -P "$(nproc)" sh -c 'echo "#include <facemap/$0>" |
    "$compiler" -std=c++20 -Wall -Wextra -Werror -fsyntax-only -Iinclude -x c++ -'
