# A cycle that never empties, inside an encapsulated graph: each limit ends it with exit code 4 and a message that names
# the option, no file is written, and what was there stays.
. "$ROOT/tests/tool/expect.inc"

cat >endless.pcg <<'END'
graph endless {
    out out: Shape
    rectangle() -> spin() -> out
}
graph spin {
    in  in: Shape
    out out: Shape
    in -> again: copy(count = 2) -> c: condition(area(in) > 0m2)
    c.yes -> again
    c.no  -> out
}
END

cat >circling.pcg <<'END'
graph circling {
    out out: Shape
    rectangle() -> again: translate(x = 1m) -> c: condition(area(in) > 0m2)
    c.yes -> again
    c.no  -> out
}
END

stopped() { # stopped GRAPH OPTION VALUE
    rm -f new.glb
    echo before >old.obj
    run "$PCGC" run "$1.pcg" "$2=$3" -o new.glb -o old.obj
    expect_code 4 "$1 is stopped by $2"
    expect_err "$2"
    expect "$2: no model is written" test ! -e new.glb
    expect "$2: the model that was there stays" test "$(cat old.obj)" = before
    expect "$2: nothing else is left behind" test "$(ls | tr '\n' ' ')" = "circling.pcg endless.pcg old.obj "
}

stopped endless --max-rounds 5000
stopped endless --max-entities 5000
stopped endless --max-memory 8M
stopped circling --max-rounds 5000
stopped circling --max-seconds 0.2

# A limit on time that is met ends a run soon after it.
began=$(date +%s)
run "$PCGC" run circling.pcg --max-seconds=1
ended=$(date +%s)
expect_code 4 "a second is over"
expect "it took no longer than some seconds" test $((ended - began)) -le 10

done_testing
