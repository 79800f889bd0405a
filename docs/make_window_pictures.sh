#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes docs/images/window.png and docs/images/workbench/*.png: the window in each of its views, on a
# virtual display, driven by its own keys and mouse.
# Usage: docs/make_window_pictures.sh [PROGRAM [NAME]]   (default: the first afterglow in a build
# folder, and all pictures)
# Needs xvfb, xauth and xdotool (third_party/install.sh --tests), and imagemagick to make files small.
set -euo pipefail

root=$(cd "$(dirname "$0")/.." && pwd)
program=${1:-$(find "$root"/build* -type f -name afterglow -path '*bin*' 2>/dev/null | head -n 1)}
[ -x "$program" ] || { echo "make_window_pictures.sh: no program; build first, or name it" >&2; exit 1; }
program=$(realpath "$program")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
out=$root/docs/images/workbench
mkdir -p "$out"
export program folder out

# picture NAME SCENE STEPS...: opens the scene in a window of 1600 x 900 without anything remembered,
# does the steps, saves the window. Steps: a key; move:X,Y; down; up; frames:N (renders N frames and
# pauses); wait:SECONDS.
cat > "$folder/session" <<'SESSION'
set -euo pipefail
name=$1 scene=$2
shift 2
mkdir -p "$folder/$name"
cd "$folder/$name"
export XDG_CONFIG_HOME=$folder/$name/config
"$program" view "$scene" --size 1600x900 2> log.txt &
pid=$!
trap 'kill $pid 2>/dev/null || true' EXIT
until window=$(xdotool search --onlyvisible --name "^Afterglow" 2>/dev/null); do
    kill -0 $pid
    sleep 0.1
done
xdotool mousemove 900 300 windowfocus "$window" key p
saved=0
save() { # KEY: waits for the file
    saved=$((saved + 1))
    xdotool key "$1"
    local file
    file=$(printf afterglow-%04d.png $saved)
    until [ -e "$file" ]; do kill -0 $pid; sleep 0.1; done
    newest=$file
}
settled() { # until two pictures in a row are the same
    local before=
    while :; do
        save F12
        [ -n "$before" ] && cmp -s "$before" "$newest" && break
        before=$newest
        sleep 0.7
    done
}
for step in "$@"; do
    case $step in
    wait:*) sleep "${step#wait:}" ;;
    frames:*)
        for _ in $(seq "${step#frames:}"); do xdotool key n; done
        settled
        ;;
    move:*)
        IFS=, read -r x y <<< "${step#move:}"
        xdotool mousemove "$x" "$y"
        sleep 0.4
        ;;
    down) xdotool mousedown 1; sleep 0.4 ;;
    up) xdotool mouseup 1; sleep 0.4 ;;
    *) xdotool key "$step"; sleep 0.2 ;;
    esac
done
sleep 6 # until notices are gone
save shift+F12
convert "$newest" -alpha off -strip -define png:compression-level=9 "$out/$name.png"
xdotool key ctrl+q
wait $pid
trap - EXIT
SESSION
only=${2:-}
picture() {
    [ -z "$only" ] || [ "$only" = "$1" ] || return 0
    xvfb-run --auto-servernum --server-args="-screen 0 1600x900x24 -noreset" bash "$folder/session" "$@"
    echo "$out/$1.png"
}

probe=(move:960,200 down move:1080,300 up)
picture wipe cornell t "${probe[@]}" F4 F4 frames:40 l frames:3
picture curves cornell t "${probe[@]}" frames:40 l frames:60
picture two-up cornell t t frames:30 l frames:4
picture four-up hall t t t frames:24 l frames:3
# Before the event the difference is black in every frame, so that it seems settled at once.
picture difference cornell T frames:30 wait:20 l frames:3
picture inspector cornell F2 frames:30 l frames:1 move:1000,430 ctrl+i wait:1
# The light goes out in the frame whose passes are looked at, up to the last iteration of the gradient.
picture passes hall F3 frames:16 l $(printf 'period %.0s' $(seq 19)) wait:4
picture lambda cornell frames:20 2 frames:1 v v v v v v v v v v v v v v v v v v v v v v
picture oracle cornell minus minus frames:30 1 frames:1 u wait:130 U U U U U
picture presets cornell frames:20 F7 wait:1
picture tour cornell F6 wait:2 Next wait:2 Next wait:2 Next wait:2 Next wait:2 Next wait:12 p
picture keys cornell frames:10 F1 wait:1
picture window hall equal frames:30
[ ! -e "$out/window.png" ] || mv "$out/window.png" "$root/docs/images/window.png"
