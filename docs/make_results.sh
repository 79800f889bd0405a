#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes docs/results.md, docs/counted.md and their pictures: runs the suite, the competitors, the options and a sweep.
# Usage: docs/make_results.sh [PROGRAM [FOLDER]]    (an hour and a half on two cores without a GPU; what is
# in FOLDER already is not run again)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${1:-build/release/bin/afterglow}
folder=${2:-out/results}
run() { "$program" "$@" --size "${size:-320x180}" --context osmesa >/dev/null; }

started=$SECONDS
run experiment all --out "$folder/suite"
suite=$((SECONDS - started))
run experiment light-off light-on light-dim fill-light light-color sparse-light light-move object-move \
    --filter svgf,asvgf,clamp,percentile,confidence,counted --out "$folder/competitors"
run experiment fill-light light-dim light-on \
    --filter asvgf,asvgf:feedbackIteration=1,asvgf:gradientOver=channels,asvgf:gradientOver=channels:lambdaFetch=light,asvgf:historyLaw=effective:varianceExponent=0.5,asvgf:lambdaFetch=nearest,asvgf:lambdaFetch=bilinear,asvgf:gradientKernel=b3-5x5,asvgf:gradientIterations=3,asvgf:historyLaw=frames,asvgf:historyLaw=effective,asvgf:alphaMoments=0.1,asvgf:alphaMoments=0.6,asvgf:atrousIterations=3 \
    --out "$folder/options"
run experiment static fill-light light-dim light-color \
    --filter counted,counted:gradientOver=luminance,counted:countReusedOnce=off,counted:scaleHistory=off,counted:historyDuringChange=128,counted:historyBetweenPixels=128,counted:varianceExponent=0,counted:varianceExponent=1,counted:atrousIterations=5,counted:feedbackIteration=1,counted:maxHistory=32,counted:shortHistoryBoost=3,counted:reactivity=100,counted:lambdaFetch=max:reactivity=200 \
    --out "$folder/counted"
for signal in path split bounce; do
    size=192x108 run experiment bounce-off gloss-off gloss-move fill-light --signal $signal --filter asvgf,counted --out "$folder/paths/$signal"
done
for signal in both separate; do
    run experiment light-off light-dim fill-light sparse-light --signal $signal --filter svgf,asvgf,counted --out "$folder/signals/$signal"
done
run sweep fill-light --over alpha=0.05,0.1,0.2,0.4,0.8 --filter fixed,svgf,asvgf,percentile --out "$folder/sweep"

/usr/bin/python3 docs/make_results.py "$folder"
mkdir -p docs/images/results
for name in light-off fill-light light-color sparse-light; do
    ffmpeg -v error -y -i "$folder/suite/$name/contact_sheet.png" -vf scale=1400:-2 -q:v 4 "docs/images/results/$name.jpg"
done
node docs/report_picture.mjs "$folder/suite/fill-light/report.html" docs/images/report.png
node docs/report_picture.mjs "$folder/sweep/report.html" docs/images/results/sweep.png "Noise against lag"
ffmpeg -v error -y -i "$folder/suite/light-off/contact_sheet.png" -vf scale=1800:-2:flags=lanczos docs/images/light-off.png
echo "docs/results.md, docs/counted.md; the suite took $suite s"
