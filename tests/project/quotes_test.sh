#!/bin/sh
# README.md shows examples/minimal.cpp word for word.
set -eu
awk '/^```cpp$/ { inside = 1; next } /^```$/ { inside = 0 } inside' README.md | diff - examples/minimal.cpp
