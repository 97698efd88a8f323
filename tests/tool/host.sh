# Programs of others: the hosts that the README shows, in C and in Python, shared and static; and what
# they say of a mistake.
. "$ROOT/tests/tool/expect.inc"

strict="-std=c11 -Wall -Wextra -Wpedantic -Werror"
run "$CC" $strict "$ROOT/examples/host.c" -o host "-I$BUILD" "-L$BUILD" -lpcg "-Wl,-rpath,$BUILD"
expect_code 0 "the host, by libpcg.so"
run "$CC" $strict "$ROOT/examples/host.c" -o static "-I$BUILD" "$BUILD/libpcg.a" -ldl -lm -lpthread
expect_code 0 "the host, by libpcg.a"

for host in ./host ./static; do
    run $host "$ROOT/examples/house.pcg" 8m
    expect_code 0 "$host: the default height"
    expect_out "3203 polygons"
    run $host "$ROOT/examples/house.pcg" 12m
    expect_out "4283 polygons"
    run $host "$ROOT/examples/house.pcg" 100m
    expect_code 1 "$host: a height out of range"
    expect_err "parameter 'height' must be from 3m to 60m"
    run $host nothing.pcg 12m
    expect_code 2 "$host: no such graph"
    expect_err "cannot read 'nothing.pcg'"
done

# python FILE ARGUMENT…: a host in Python; into a sanitized library the sanitizer has to come first.
python() {
    run env ${ASAN_LIBRARY:+"LD_PRELOAD=$ASAN_LIBRARY" ASAN_OPTIONS=detect_leaks=0} python3 "$@"
}
python "$ROOT/examples/host.py" "$BUILD/libpcg.so" "$ROOT/examples/house.pcg" 12m
expect_code 0 "the host in Python"
expect_out "4283 polygons, 8564 triangles, 14.23 m high"
python "$ROOT/examples/host.py" "$BUILD/libpcg.so" "$ROOT/examples/house.pcg" 100m
expect_code 1 "in Python, a height out of range"
expect_err "parameter 'height' must be from 3m to 60m"

sed -n '/^#include/,$p' "$ROOT/examples/host.c" >code
sed -n '/^```c host.c/,/^```$/p' "$ROOT/README.md" | sed '1d;$d' >shown
run diff code shown
expect_code 0 "the README shows this C"
sed -n '/^import ctypes/,$p' "$ROOT/examples/host.py" >code
sed -n '/^```python host.py/,/^```$/p' "$ROOT/README.md" | sed '1d;$d' >shown
run diff code shown
expect_code 0 "the README shows this Python"
done_testing
