# pcgc debug --gdb: gdb stops on lines of the graph. Where there is no gdb, or it may run nothing, that is said and passed over.
. "$ROOT/tests/tool/expect.inc"

cat >tower.pcg <<'END'
graph tower {
    param height: length = 2m
    rectangle(width = 4m, height = 3m)
        -> up: extrude(amount = height)
        -> color(#ff0000)
}
END

mkdir none
run env PATH="$PWD/none" "$PCGC" debug --gdb tower.pcg -x run </dev/null
expect_code 2 "without a C compiler"
expect_err "cannot compile for gdb: "
if [ -n "$SANITIZE" ]; then
    echo "ok a sanitizer does not work under gdb: passed over"
    done_testing
fi
if ! gdb -q -batch -ex run --args true </dev/null 2>/dev/null | grep -q 'exited normally'; then
    echo "ok gdb is not installed, or may not run programs here: passed over"
    done_testing
fi

export TMPDIR=$PWD/tmp
mkdir tmp
run "$PCGC" debug --gdb tower.pcg -p height=5m --seed 3 -o tower.obj \
    -x 'break tower.pcg:4; run; continue; bt 3; info locals; delete; continue' </dev/null
expect_code 0 "gdb in batch mode"
expect_out "tower.pcg:4"
expect_out "-> up: extrude(amount = height)"
expect_out "main_tower_up"
expect_out "in_in = 0x"
expect "the run went on to its end" [ -s tower.obj ]
expect "nothing stays behind" [ -z "$(ls tmp)" ]
printf 'break main_tower_up\nrun\nlist\n' >steps.gdb
run "$PCGC" debug --gdb tower.pcg --batch steps.gdb </dev/null
expect_out "/* up: extrude(amount = height) */"
printf 'graph wrong { lgo() }\n' >wrong.pcg
run "$PCGC" debug --gdb wrong.pcg -x run </dev/null
expect_code 1 "errors in the graph"
done_testing
