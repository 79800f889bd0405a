#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the Debian 12 packages that Afterglow is built from, and only those that are missing.
# Usage: third_party/install.sh [--tests]    (--tests adds what only the tests need)
set -euo pipefail

packages=(
    build-essential cmake ninja-build pkg-config ccache
    libglfw3-dev libglm-dev libimgui-dev libtinygltf-dev libstb-dev libtinyexr-dev
    nlohmann-json3-dev libcli11-dev libfmt-dev python3-glad
    libosmesa6-dev libosmesa6 libegl-dev libegl1 libegl-mesa0 libgl1-mesa-dri libgl1
    fonts-roboto-unhinted
)
if [ "${1:-}" = --tests ]; then
    packages+=(doctest-dev libembree-dev glslang-tools xvfb xauth xdotool 9wm libxcb1-dev
        clang-format python3-skimage python3-numpy ffmpeg chromium mesa-vulkan-drivers)
    command -v node >/dev/null || packages+=(nodejs npm)
fi

missing=()
for package in "${packages[@]}"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
    echo "Installing Debian packages: ${missing[*]}"
    sudo=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "third_party/install.sh: these packages are missing and neither root nor sudo is at hand: ${missing[*]}" >&2; exit 1; }
        sudo=(sudo)
    fi
    "${sudo[@]}" apt-get update -qq
    "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

if [ "${1:-}" = --tests ]; then
    # The library that drives the browser. Once it is there, no network is needed.
    cd "$(dirname "${BASH_SOURCE[0]}")/../tests/report"
    if ! cmp -s package-lock.json node_modules/.installed-lock.json; then
        echo "Installing the packages of tests/report"
        npm ci --ignore-scripts --no-audit --no-fund --silent
        cp package-lock.json node_modules/.installed-lock.json
    fi
fi
