#!/usr/bin/env bash
# The C examples under AddressSanitizer and valgrind, against an instance that this starts. By hand:
#
#     cargo build -p glidepath -p glidepath-capi && bash crates/capi/tests/memory.sh
#
# The library itself is as cargo built it: what is found is what crosses the border, and what is
# left allocated. For errors inside, AddressSanitizer's own allocator serves the library, too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."
built=target/debug
work=$(mktemp -d /dev/shm/glidepath-memory.XXXXXX)
export XDG_RUNTIME_DIR="$work"
"$built/glidepath" interpolator --best-effort >"$work/interpolator.log" 2>&1 &
interpolator=$!
trap 'kill "$interpolator"; wait "$interpolator" || true; rm -rf "$work"' EXIT
soname="libglidepath.so.$(sed -n 's/^#define GP_ABI \([0-9]*\)u$/\1/p' crates/capi/include/glidepath.h)"
ln -s "$PWD/$built/libglidepath.so" "$work/$soname"
sleep 2

compile() { # NAME OPTION…
    cc -std=c11 -g -O1 -Wall -Wextra -Werror -pedantic -pthread -I crates/capi/include "${@:2}" \
        "crates/capi/examples/$1.c" "$work/$soname" -Wl,-rpath,"$work" -o "$work/$1"
}

for name in follow servo; do
    arguments=(default 500 "$work/setpoints.bin")
    [[ $name == servo ]] && arguments=(default 3 500)
    compile "$name" -fsanitize=address,undefined -fno-sanitize-recover=all
    echo "== $name, AddressSanitizer with leaks"
    "$work/$name" "${arguments[@]}"
    if command -v valgrind >/dev/null; then
        compile "$name"
        echo "== $name, valgrind"
        valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
            "$work/$name" "${arguments[@]}"
    else
        echo "SKIPPED: valgrind is not installed"
    fi
done
