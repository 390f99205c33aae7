# setup.sh - installs what is missing and builds; sourced by run.sh and test.sh.

cd "$(dirname "${BASH_SOURCE[0]}")" || exit 1
top=$PWD

build_packages="gcc libc6-dev meson ninja-build pkg-config libjansson-dev libxxhash-dev libuv1-dev
	libsqlite3-dev libopenexr-dev libdeflate-dev libcairo2-dev
	libpango1.0-dev fonts-inter fonts-dejavu-core libglfw3-dev libepoxy-dev libegl-dev libgl1-mesa-dri"
test_packages="$build_packages libcmocka-dev clang libclang-rt-14-dev xvfb xdotool"
long_packages="$test_packages valgrind"

say() {
	printf '%s\n' "$*" >&2
}

# install PACKAGE... - those that are missing, by apt-get, after saying which
install() {
	local package missing="" root=""
	for package; do
		dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
			missing+=" $package"
	done
	[ -n "$missing" ] || return 0
	say "installing from Debian's packages:$missing"
	if [ "$(id -u)" -ne 0 ]; then
		command -v sudo >/dev/null || {
			say "these packages are missing and neither root nor sudo is at hand; install them and run this again"
			exit 1
		}
		root=sudo
	fi
	$root apt-get update -qq </dev/null &&
		DEBIAN_FRONTEND=noninteractive $root apt-get install -y -qq --no-install-recommends \
			-o DPkg::Lock::Timeout=300 $missing </dev/null >"$top/.install.log" 2>&1 || {
		say "apt-get failed; the end of .install.log:"
		tail -5 "$top/.install.log" >&2
		exit 1
	}
	rm -f "$top/.install.log"
}

# build FOLDER [MESON OPTION]... - quick when nothing changed
build() {
	local folder=$1 log=$1.log
	shift
	if [ ! -f "$folder/build.ninja" ]; then
		say "setting up $folder"
		meson setup "$folder" "$@" >"$log" 2>&1 || {
			say "meson failed; the end of $log:"
			tail -20 "$log" >&2
			exit 1
		}
	fi
	say "building $folder"
	ninja -C "$folder" >"$log" 2>&1 || {
		say "the build failed; the end of $log:"
		tail -40 "$log" >&2
		exit 1
	}
	rm -f "$log"
}
