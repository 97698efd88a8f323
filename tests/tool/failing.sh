# What fails for one entity of many: where it is told to be, exit codes, --strict, and how many are told.
. "$ROOT/tests/tool/expect.inc"

# fails NAME MESSAGE
fails() {
    run "$PCGC" run "$ROOT/tests/run/$1.pcg" -q
    expect_code 0 "$1"
    expect_err "warning: $2 [W0701]"
    run "$PCGC" run "$ROOT/tests/run/$1.pcg" -q --strict -o strict.glb
    expect_code 3 "$1 --strict"
    expect_err "error: $2 [E0701]"
    expect "one error ends it" [ "$(grep -c 'error:' "$err")" = 1 ]
    expect "nothing is written" [ ! -e strict.glb ]
}
fails failing_single "the amount is nan m: the shape is not extruded (node 'grow', round 3)"
fails failing_collective \
    "1 entities have a coordinate that is no finite number: they are in no cluster (node 'zones', round 1)"
fails failing_encapsulated "no roof is built: the face has no area (node 'roof', round 3)"
fails failing_augmentation "slice 'low' has a size of -1 m: it is left out (node 'parts', round 3)"
fails failing_files "no image file 'files/textures/none.jpg' (node 'paper', round 2)"

# The first twenty of a node are told, the others counted.
cat >many.pcg <<'PCG'
graph many {
    param zero: float = 0
    attr n: int
    out all: Shape
    rectangle() -> copy(count = 25, index => @n) -> grow: extrude(amount = 1m / zero) -> each() -> all
}
graph each {
    attr n: int = 5
    in  in: Shape
    out out: Shape
    in -> pick: set { assign(@n, at([1, 2], @n)) } -> out
}
PCG
run "$PCGC" run many.pcg --json
expect_code 0 "many fail"
expect_out '"count":25'
run "$PCGC" run many.pcg -q
expect "twenty of the one node" [ "$(grep -c "(node 'grow', round " "$err")" = 20 ]
expect "twenty of the node in a graph" [ "$(grep -c "(node 'pick', round " "$err")" = 20 ]
expect_err "warning: 5 more warnings of 'grow' are not shown [W0703]"
expect_err "warning: 5 more warnings of 'pick' are not shown [W0703]"
done_testing
