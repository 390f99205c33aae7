#!/usr/bin/env bash
# test.sh [--long] - all tests, in a release build (gcc) and with sanitizers (clang).
set -u -o pipefail
long=
case ${1-} in
"") ;;
--long) long=1 ;;
*)
	cat <<'EOT'
usage: ./test.sh [--long]

Installs what is missing, builds twice (release with gcc; address and undefined behaviour sanitizers
with clang) and runs all tests. BATTEN_DATA names a folder of IGES files with reference values; tests that
need it are skipped where it is unset. --long adds valgrind, fuzzing and fault injection at scale.
EOT
	[ "${1-}" = --help ] || exit 2
	exit 0
	;;
esac
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install ${long:+$long_packages} $test_packages
# nothing of a user's own settings has a say in the tests
unset BATTEN_WORKER_PATH BATTEN_VECTOR_LEVEL
export XDG_CONFIG_HOME=/nonexistent LC_ALL=C.UTF-8
export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=detect_stack_use_after_return=0

log=$top/test.log
: >"$log"
failed=0
# run FOLDER [MESON TEST OPTION]...
run() {
	local folder=$1
	shift
	meson test -C "$folder" --no-rebuild --print-errorlogs "$@" 2>&1 | tee -a "$log" || failed=1
}

build build-test -Dtests=enabled
run build-test
CC=clang build build-sanitize -Dtests=enabled -Db_sanitize=address,undefined -Db_lundef=false \
	-Dc_args=-fno-sanitize-recover=all -Doptimization=1
run build-sanitize --timeout-multiplier 4
if [ -n "$long" ]; then
	run build-test --suite common --suite geometry --suite files --suite ipc --timeout-multiplier 30 \
		--wrapper 'valgrind -q --leak-check=full --error-exitcode=9'
	BATTEN_LONG=1 run build-test --suite fault --timeout-multiplier 30
	CC=clang build build-fuzz -Dfuzz=true -Dtests=enabled -Db_sanitize=address,undefined -Db_lundef=false \
		-Dc_args=-fsanitize=fuzzer-no-link -Doptimization=1
	run build-fuzz --suite fuzz --timeout-multiplier 20
fi

awk '/^Ok:/ { passed += $2 } /^Expected Fail:/ { passed += $3 } /^Fail:/ { failed += $2 }
	/^Unexpected Pass:/ { failed += $3 } /^Timeout:/ { failed += $2 } /^Skipped:/ { skipped += $2 }
	END { printf "%d passed, %d failed, %d skipped\n", passed, failed, skipped }' "$log"
rm -f "$log"
exit $failed
