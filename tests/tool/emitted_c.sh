# Emitted C compiles without a warning, by every compiler that is there, and runs with nothing but the runtime.
. "$ROOT/tests/tool/expect.inc"

for graph in "$ROOT"/examples/*.pcg "$ROOT"/tests/run/e*.pcg "$ROOT"/tests/run/cycle*.pcg \
    "$ROOT"/tests/run/names_in_c.pcg; do
    name=$(basename "$graph" .pcg)
    "$PCGC" "$graph" -o "$name.c" >/dev/null 2>&1
    for compiler in gcc clang; do
        command -v $compiler >/dev/null || continue
        run $compiler -std=c11 -O1 -Wall -Wextra -Werror -c -o emitted.o "$name.c"
        expect_code 0 "$compiler compiles $name.c"
    done
    run tcc -Wall -Werror -c -o emitted.o "$name.c"
    expect_code 0 "tcc compiles $name.c"
done

expect "places in it are the source's" grep -q '^#line [0-9]* ".*house.pcg"$' house.c
expect "and its own" grep -q '^#line [0-9]* "house.c"$' house.c
expect "nothing is included" sh -c '! grep -q "^ *# *include" house.c'

# ---- the same bytes, whoever asks ----
cp "$ROOT/tests/run/expression_floats.pcg" floats.pcg
for backend in "" --cc; do
    "$PCGC" floats.pcg $backend -o one.so && "$PCGC" floats.pcg $backend -o two.so
    expect "one text, one shared object $backend" cmp one.so two.so
    expect "it needs no library" sh -c '! readelf -d one.so | grep -q NEEDED'
    expect "its code is not written to" sh -c '! readelf -d one.so | grep -q TEXTREL'
    expect "nothing in it is writable and executable" sh -c '! readelf -lW one.so | grep -q RWE'
done
run "$PCGC" floats.pcg --cc=no-such-compiler -o no.so
expect_code 2 "a compiler that is not there"
expect_err "cannot run 'no-such-compiler'"
expect "nothing is left behind" sh -c '! ls -a | grep -q "^no\.so"'

# ---- what would not fit on a stack ----
{
    printf 'graph wide {\n    attr l: list<float>\n    out out: Shape\n    rectangle() -> set { assign(@l, ['
    awk 'BEGIN { for (i = 0; i < 5000; i++) printf "%srand(0, 1)", i ? ", " : "" }'
    printf ']) } -> out\n}\n'
} >wide.pcg
run "$PCGC" run wide.pcg
expect_code 1 "an expression of 5,000 calls"
expect_err "the expressions of 'set' need more than 4096 intermediate values [E0602]"
sed 's/rand(0, 1)/1.5/g' wide.pcg >long.pcg
run "$PCGC" run long.pcg --json
expect_code 0 "a list of 5,000 numbers"

# ---- a program of one's own ----
cat >own.c <<'END'
#include <stdio.h>
#include "floats.h"
int main(void)
{
    pcg_program *program = pcg_program_of(&pcg_graph_expression_floats);
    pcg_run *r = pcg_run_new(program, NULL);
    int status = pcg_run_execute(r);
    printf("%zu faces\n", pcg_run_face_count(r));
    pcg_run_free(r);
    pcg_program_free(program);
    return status;
}
END
"$PCGC" floats.pcg -o floats.c
run "$CC" -std=c11 -I "$BUILD" -o own own.c floats.c "$BUILD/libpcgrt.a" -ldl -lm -lpthread
expect_code 0 "a program with the graph built in"
run ./own
expect_out "1 faces"

done_testing
