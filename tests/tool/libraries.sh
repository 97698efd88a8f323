# What the libraries show: names that begin with pcg_ and no others, a soname, the usual links.
. "$ROOT/tests/tool/expect.inc"

version=$(sed -n 's/^#define PCG_VERSION "\(.*\)"/\1/p' "$ROOT/runtime/pcg.h")
expect "the first number of the version is the soname's" [ "${version%%.*}" = 0 ]

for library in libpcg libpcgrt; do
    nm -D --defined-only "$BUILD/$library.so" | awk '{print $NF}' >names
    expect "$library.so shows names" grep -q '^pcg_run_execute$' names
    run grep -v '^pcg_' names
    expect_empty "$out" "$library.so shows pcg_ names only"
    nm -g --defined-only "$BUILD/$library.a" | awk 'NF == 3 {print $3}' >names
    expect "$library.a shows names" grep -q '^pcg_run_execute$' names
    # A sanitizer marks variables with names of its own, which are not ours to hide.
    run grep -v -e '^pcg_' -e '^__odr_asan\.' -e '^__asan' names
    expect_empty "$out" "$library.a shows pcg_ names only"
    run readelf -d "$BUILD/$library.so"
    expect_out "Library soname: [$library.so.0]"
    run grep -c TEXTREL "$out"
    expect_code 1 "$library.so has no relocations in its code"
    run readelf -lW "$BUILD/$library.so"
    expect "$library.so has no stack that is executable" \
        sh -c "awk '/GNU_STACK/ && /RWE/ {exit 1}' '$out'"
    run readlink "$BUILD/$library.so"
    expect_out "$library.so.0"
    run readlink "$BUILD/$library.so.0"
    expect_out "$library.so.$version"
done

# Every function that pcg.h declares is in libpcg; in the runtime all but the compiler's.
sed -n 's/^PCG_API .*[ *]\(pcg_[a-z_]*\)(.*/\1/p' "$ROOT/runtime/pcg.h" | sort >declared
expect "pcg.h declares functions" [ "$(wc -l <declared)" -gt 40 ]
nm -D --defined-only "$BUILD/libpcg.so" | awk '{print $NF}' | sort >shown
run comm -23 declared shown
expect_empty "$out" "libpcg.so has all that pcg.h declares"
nm -D --defined-only "$BUILD/libpcgrt.so" | awk '{print $NF}' | sort >shown
run comm -23 declared shown
expect "libpcgrt.so has all but the compiler" \
    [ "$(tr '\n' ' ' <"$out")" = "pcg_compile_file pcg_compile_text " ]
done_testing
