#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Looks for mistakes in our C++ with clang-tidy: the checks of .clang-tidy. The exit code is 0 only if none is found.
# Usage: tools/tidy.sh [FILE.cpp ...]    (without files: all of them)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v clang-tidy >/dev/null || {
    echo "tools/tidy.sh: Debian's package clang-tidy is missing" >&2
    exit 1
}

# Clang cannot read the precompiled headers of GCC, nor does it know all of its warnings.
build=build/tidy
cmake -S . -B $build -G Ninja -DAFTERGLOW_TESTS=ON -DAFTERGLOW_WERROR=OFF -DAFTERGLOW_TOGETHER=OFF \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -Wno-dev >/dev/null
cmake --build $build --target third_party_glad afterglow_commit >/dev/null # headers that are generated

files=("$@")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(git ls-files 'app/*.cpp' 'renderer/*.cpp' 'tests/*.cpp' 'tools/*.cpp')
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet -p $build --extra-arg=-Wno-unknown-warning-option
