# make install into a scratch folder: what is there, pkg-config compiles a host against it, shared and
# static, the installed pcgc works by itself, and make uninstall leaves nothing.
. "$ROOT/tests/tool/expect.inc"

staging=$PWD/staging
make_install() { # make_install TARGET [VARIABLE=VALUE]…
    run env -u MAKEFLAGS -u MAKELEVEL make -s -C "$ROOT" "BUILD=$BUILD" "DESTDIR=$staging" "$@"
}

# A sanitized build is installed with the flags that it was made with: nothing is made anew.
make_install install PREFIX=/opt/pcg ${SANITIZE:+"SANITIZE=$SANITIZE"}
expect_code 0 "make install"
top=$staging/opt/pcg
for file in bin/pcgc lib/libpcg.a lib/libpcg.so lib/libpcg.so.0 lib/libpcgrt.a lib/libpcgrt.so \
    lib/libpcgrt.so.0 lib/pkgconfig/libpcg.pc lib/pkgconfig/libpcgrt.pc include/pcg/pcg.h \
    include/pcg/abi.h include/pcg/shape.h include/pcg/library.h share/doc/pcgc/README.md \
    share/doc/pcgc/docs/embedding.md share/doc/pcgc/examples/house.pcg share/man/man1/pcgc.1 \
    share/bash-completion/completions/pcgc share/zsh/site-functions/_pcgc; do
    expect "$file is there" [ -s "$top/$file" ]
done
run grep -rlF "$staging" "$top/lib/pkgconfig" "$top/share"
expect_empty "$out" "nothing that is read names the scratch folder"

export PKG_CONFIG_PATH="$top/lib/pkgconfig" PKG_CONFIG_SYSROOT_DIR="$staging"
run pkg-config --modversion libpcg
expect_out "$("$PCGC" --version | cut -d' ' -f2)"
shared=$(pkg-config --cflags --libs libpcg)
static=$(pkg-config --cflags --static --libs libpcg | sed 's/-lpcg/-l:libpcg.a/')
run "$CC" -std=c11 "$ROOT/examples/host.c" -o shared $shared
expect_code 0 "a host, shared, by pkg-config"
run "$CC" -std=c11 "$ROOT/examples/host.c" -o static $static
expect_code 0 "a host, static, by pkg-config"
run env "LD_LIBRARY_PATH=$top/lib" ./shared "$ROOT/examples/house.pcg" 8m
expect_out "3203 polygons"
run readelf -d ./shared
expect_out "Shared library: [libpcg.so.0]"
run ./static "$ROOT/examples/house.pcg" 8m
expect_out "3203 polygons"
run readelf -d ./static
expect "the static host needs no libpcg" sh -c "! grep -q libpcg '$out'"

# The installed compiler looks for its runtime beside itself, not where it was built.
pcgc=$top/bin/pcgc
run "$pcgc" library --new mine
run "$pcgc" library mine --test --cc "$CC" -o "mine.so"
expect_code 0 "it builds a library with the headers beside it"
mkdir "$top/lib/pcg"
mv mine.so "$top/lib/pcg"
printf 'use mine\ngraph lifted { rectangle() -> lift() }\n' >lifted.pcg
run "$pcgc" run lifted.pcg -q
expect_code 0 "and finds it where it is installed"
rm -r "$top/lib/pcg"
cp "$ROOT/examples/door.pcg" door.pcg
run "$pcgc" run door.pcg -o door.glb
expect_code 0 "the installed pcgc runs"
run "$pcgc" door.pcg -o door.so
expect_code 0 "and makes a shared object"
run "$pcgc" door.pcg -o door
expect_code 0 "and an executable"
run ./door -o door2.glb
run cmp door.glb door2.glb
expect_code 0 "which does the same"

make_install uninstall PREFIX=/opt/pcg
expect_code 0 "make uninstall"
run find "$staging" ! -type d
expect_empty "$out" "make uninstall leaves no file"
expect "and no folder of its own" [ ! -e "$top/share/doc/pcgc" -a ! -e "$top/include/pcg" ]

make_install install PREFIX=/usr LIBDIR=/usr/lib/x86_64-linux-gnu ${SANITIZE:+"SANITIZE=$SANITIZE"}
expect_code 0 "make install with another folder for libraries"
run cat "$staging/usr/lib/x86_64-linux-gnu/pkgconfig/libpcg.pc"
expect_out "libdir=\${prefix}/lib/x86_64-linux-gnu"
run "$staging/usr/bin/pcgc" door.pcg -o again
expect_code 0 "the installed pcgc finds its runtime there"
done_testing
