#!/usr/bin/env bash
# make.sh [BUILD] - makes the pictures of the README from the example hull, with the program itself.
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=$(realpath "${1:-build}")
hull=$build/examples/hull.igs
view=-40,6:perspective@14
out=$PWD/docs/pictures
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$build/workers/batten-shading" "$hull" --view $view --size 1200x400 --samples 4 --edges --png
"$build/workers/batten-raytrace" "$hull" --view $view --size 1200x400 --samples 4 --png
"$build/workers/batten-curvature" "$hull#2" --view $view --size 1200x400 --quantity H
"$build/workers/batten-isophotes" "$hull#2" --view $view --svg
"$build/workers/batten-contours" "$hull" --stations 0:142:21 --waterlines 1:13:13 --buttocks 5 --draught 6.2 --svg
"$build/workers/batten-reflection" "$hull#2" --kind highlight --view $view --svg
"$build/workers/batten-isocurvature" "$hull#2" --quantity H --from -0.3 --to 0.3 --count 13 --view $view --svg
cp hull.isocurvature.svg "$out"
cp hull.shade.png hull.trace.png hull.view.png hull.isophote.svg hull.contour.svg hull.reflect.svg "$out"
