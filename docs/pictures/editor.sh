#!/usr/bin/env bash
# editor.sh [BUILD] - makes the README's pictures of the window, on an X server of its own, from the
# example hull. Needs Xvfb, xdotool and ImageMagick's import.
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=$(realpath "${1:-build}")
out=$PWD/docs/pictures
work=$(mktemp -d)
coproc X { exec Xvfb -noreset -displayfd 1 -screen 0 1280x800x24 -nolisten tcp 2>/dev/null; }
server=$X_PID
editor=
trap 'kill $editor $server 2>/dev/null || true; wait; "$build/executive/batten" shutdown >/dev/null 2>&1 || true; rm -rf "$work"' EXIT
read -r number <&"${X[0]}"
export DISPLAY=:$number LIBGL_ALWAYS_SOFTWARE=1 XDG_CONFIG_HOME=$work/config
cd "$work"
cp "$build/examples/hull.igs" .
"$build/executive/batten" hull.igs 2>editor.log &
editor=$!
window=$(xdotool search --sync --onlyvisible --class batten | head -1)
xdotool windowfocus "$window"

# still - until two looks in a row see the same
still() {
	local before="" now
	while now=$(import -window root rgb:- | md5sum); [ "$now" != "$before" ]; do
		before=$now
		sleep 0.5
	done
}
# key KEY... - one after the other
key() {
	local k
	for k; do
		xdotool key --window "$window" "$k"
		still
	done
}
# routine NAME - found by its name and run with what it proposes
routine() {
	key slash
	xdotool type --window "$window" "$1"
	still
	key Return
}
shot() {
	still
	import -window root -strip "png:$out/$1"
}

still
# the starboard side is the second surface
routine "select current surface"
xdotool type --window "$window" "hull-2"
key Return
routine "gaussian"
key Return
"$build/executive/batten" wait >/dev/null || true
still
xdotool mousemove --window "$window" 520 420
shot editor-curvature.png
trace=$("$build/executive/batten" submit raytrace hull.igs --size 6000x4000 --samples 4)
shade=$("$build/executive/batten" submit shading hull.igs --size 4000x2600 --samples 4)
held=$("$build/executive/batten" submit isophotes hull.igs#2 --after "$trace")
"$build/executive/batten" hold $held >/dev/null
until "$build/executive/batten" jobs --json | grep -q '"state": *"running"'; do sleep 0.1; done
"$build/executive/batten" suspend $shade >/dev/null || true
xdotool key --window "$window" j
sleep 2 # bars move all the time
import -window root -strip "png:$out/editor-jobs.png"
"$build/executive/batten" kill $trace >/dev/null
key Escape
key slash
xdotool type --window "$window" "iso"
shot editor-search.png
key Escape F10
key F1
shot editor-help.png
