#!/usr/bin/env bash
# run.sh [FILE...] - from a bare Debian machine to a hull (or FILE...) in the editor, or to four finished jobs.
set -u
case ${1-} in
-h | --help)
	cat <<'EOT'
usage: ./run.sh [FILE...]

Installs what is missing, builds, and opens the editor on the example hull, or on FILE... Where there is no
display it runs the main job instead: shading, curvature map, isophotes and ray trace, four worker
processes at once on a live board. The results are left in first-run/.
EOT
	exit 0
	;;
esac

files=()
for file; do
	files+=("$(realpath -- "$file")") || exit 1
done
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install $build_packages
build build -Dtests=disabled
[ ${#files[@]} -gt 0 ] || files=("$top/build/examples/hull.igs")

batten=$top/build/executive/batten
export BATTEN_JOBS=12 # all of a hull's at once, to have something to see
mkdir -p "$top/first-run" && cd "$top/first-run" || exit 1
if [ -n "${DISPLAY-}${WAYLAND_DISPLAY-}" ]; then
	"$batten" "${files[@]}" && exit
	say "the window did not open; going on without it"
fi
ids=()
# job WORKER [--PARAMETER]... - queue it on all files
job() {
	local id
	while read -r id; do
		ids+=("$id")
	done < <("$batten" submit "$1" "${files[@]}" "${@:2}")
}
job raytrace --png --size 1600x1000 --samples 4
job shading --png --size 1600x1000 --samples 4 --edges
job curvature --png --view three-quarter
job isophotes --svg
[ ${#ids[@]} -gt 0 ] || exit 1
"$batten" jobs --follow "${ids[@]}"
"$batten" wait "${ids[@]}"
status=$?
"$batten" jobs "${ids[@]}"
say ""
say "results are in $top/first-run:"
ls -1 >&2
exit $status
