#!/bin/sh
# All sources are as clang-format 14 lays them out with .clang-format.
set -eu
find include src apps tests examples bench python -name '*.h' -o -name '*.cpp' | sort | xargs clang-format-14 --dry-run -Werror
