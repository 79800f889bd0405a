#!/usr/bin/env bash
# Makes docs/images/window.png: the window on the hall, on a virtual display of 1536 x 864.
# Usage: docs/make_window_picture.sh [PROGRAM]    (default: the first afterglow in a build folder)
# Needs xvfb, xauth and xdotool (third_party/install.sh --tests), and imagemagick to make the file small.
set -euo pipefail

root=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-$(find "$root"/build* -type f -name afterglow -path '*bin*' 2>/dev/null | head -n 1)}
[ -x "$program" ] || { echo "make_window_picture.sh: no program; build first, or name it" >&2; exit 1; }
program=$(realpath "$program")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# 960 x 540 pixels are rendered, a step more than the default without a GPU. After thirty frames
# the whole window is saved.
export program
xvfb-run --auto-servernum --server-args="-screen 0 1536x864x24 -noreset" bash -euc '
    "$program" view hall --size 1536x864 &
    until window=$(xdotool search --onlyvisible --name "^Afterglow"); do
        kill -0 $!
        sleep 0.1
    done
    xdotool mousemove 1000 400 windowfocus "$window" key p equal h
    for _ in $(seq 30); do xdotool key n; done
    # Pictures are equal once all steps are done.
    last=0
    while :; do
        last=$((last + 1))
        xdotool key F12
        file=$(printf afterglow-%04d.png $last)
        until [ -e "$file" ]; do kill -0 $!; sleep 0.1; done
        [ $last -gt 1 ] && cmp -s "$before" "$file" && break
        before=$file
        sleep 1
    done
    sleep 6 # until the notice is gone
    last=$((last + 1))
    xdotool key shift+F12
    file=$(printf afterglow-%04d.png $last)
    until [ -e "$file" ]; do kill -0 $!; sleep 0.1; done
    cp "$file" window.png
    xdotool key ctrl+q
    wait $!
'
mkdir -p "$root/docs/images"
convert window.png -alpha off -strip -define png:compression-level=9 "$root/docs/images/window.png"
echo "$root/docs/images/window.png"
