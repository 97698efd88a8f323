# What resolve and check say, to the letter: labels, second places, help; and the limits of imports.
. "$ROOT/tests/tool/expect.inc"

# said WHAT: what the last run printed on stderr, but for its summary, is what stands on stdin.
said() {
    cat >expected
    expect "$1" cmp -s expected "$err"
}

cat >two_places.pcg <<'EOF'
graph two_places {
    rectangle() -> all: reverse()
    impulse() -> all
    all -> extrude()
}
EOF
run "$PCGC" check -q two_places.pcg
expect_code 1 "types that meet"
said "an edge's types name both places" <<'EOF'
two_places.pcg:4:5: error: 'all' gives Entity, 'extrude' takes Faced [E0301]
    4 |     all -> extrude()
      |     ^~~    ^~~~~~~
      = help: 'all' takes Shape from 'rectangle' (line 2) and Impulse from 'impulse' (line 3): together they are Entity
EOF

cat >suggestions.pcg <<'EOF'
graph suggestions {
    attr floor: int
    rectangle(widht = 1m) -> extrude
    rectangle(width = in.area) -> extrude(amount = in.height, cap = floor == 0)
    box(width = min(1m, 2deg))
    rectangle() -> copy(count = 2, index = @floor)
}
EOF
run "$PCGC" check -q suggestions.pcg
expect_code 1 "suggestions"
said "suggestions stand behind the carets and below" <<'EOF'
suggestions.pcg:3:15: error: 'rectangle' has no parameter 'widht' [E0501]
    3 |     rectangle(widht = 1m) -> extrude
      |               ^~~~~ did you mean 'width'?
suggestions.pcg:3:30: error: 'extrude' is a procedure, not a node [E0116]
    3 |     rectangle(widht = 1m) -> extrude
      |                              ^~~~~~~ write extrude()
suggestions.pcg:4:23: error: unknown name 'in' [E0106]
    4 |     rectangle(width = in.area) -> extrude(amount = in.height, cap = floor == 0)
      |                       ^~
suggestions.pcg:4:55: error: Shape has no component 'height' [E0206]
    4 |     rectangle(width = in.area) -> extrude(amount = in.height, cap = floor == 0)
      |                                                       ^~~~~~
      = help: write height(in)
suggestions.pcg:4:69: error: unknown name 'floor' [E0106]
    4 |     rectangle(width = in.area) -> extrude(amount = in.height, cap = floor == 0)
      |                                                                     ^~~~~ write @floor
suggestions.pcg:5:17: error: no function 'min' takes (length, angle) [E0204]
    5 |     box(width = min(1m, 2deg))
      |                 ^~~~~~~~~~~~~
      = help: there is min(a: int, b: int); min(a: float, b: float); min(a: length, b: length); min(a: area, b: area); and 4 more
suggestions.pcg:6:36: error: attribute 'index' is written by 'copy' and takes no value [E0404]
    6 |     rectangle() -> copy(count = 2, index = @floor)
      |                                    ^~~~~~~~~~~~~~
      = help: write index => @attribute
EOF

# ---- imports ----
mkdir parts ring
printf 'graph wall {\n    out out: Shape\n    box() -> out\n}\n' >parts/wall.pcg
printf 'import wall from "wall.pcg"\ngraph on_path { wall() }\n' >on_path.pcg
run "$PCGC" check -q on_path.pcg
expect_code 1 "an import that is nowhere"
expect_err "on_path.pcg:1:18: error: cannot read 'wall.pcg': there is no such file [E0111]"
run "$PCGC" check -q -I ring -I parts on_path.pcg
expect_code 0 "an import on the import path"

printf 'import b from "b.pcg"\ngraph a { b() }\n' >ring/a.pcg
printf 'import c from "./c.pcg"\ngraph b { c() }\n' >ring/b.pcg
printf 'import a from "../ring/a.pcg"\ngraph c { a() }\n' >ring/c.pcg
run "$PCGC" check -q ring/a.pcg
expect_code 1 "a cycle of imports"
said "a cycle of imports is shown" <<'EOF'
ring/c.pcg:1:15: error: the import leads back to its own file: 'ring/a.pcg' imports 'ring/b.pcg' imports 'ring/c.pcg' imports 'ring/a.pcg' [E0110]
    1 | import a from "../ring/a.pcg"
      |               ^~~~~~~~~~~~~~~
EOF

mkdir deep
awk 'BEGIN {
    for (i = 0; i <= 101; i++) {
        name = "deep/g" i ".pcg"
        printf "import g%d from \"g%d.pcg\"\ngraph g%d { g%d() }\n", i + 1, i + 1, i, i + 1 > name
        close(name)
    }
}'
printf 'graph g101 { box() }\n' >deep/g101.pcg
run "$PCGC" check -q deep/g0.pcg
expect_code 1 "imports 101 deep"
expect_err "deep/g100.pcg:1:18: error: imports are nested more than 100 deep [E0112]"
printf 'graph g100 { box() }\n' >deep/g100.pcg
run "$PCGC" check -q deep/g0.pcg
expect_code 0 "imports 100 deep"

mkdir many
awk 'BEGIN {
    for (i = 1; i <= 10000; i++) {
        name = "many/g" i ".pcg"
        printf "graph g%d { out out: Shape; box() -> out }\n", i > name
        close(name)
        printf "import g%d from \"g%d.pcg\"\n", i, i > "many/all.pcg"
    }
    printf "graph all { box() }\n" > "many/all.pcg"
}'
run "$PCGC" check -q many/all.pcg
expect_code 1 "10,001 files"
expect_err "many/all.pcg:10000:20: error: more than 10000 files are imported [E0113]"

# ---- many errors ----
awk 'BEGIN { printf "graph errors {\n"; for (i = 0; i < 20000; i++) printf "rectangl%d(width = x%d)\n", i, i; printf "}\n" }' >errors.pcg
run "$PCGC" check -q errors.pcg
expect_code 1 "20,000 errors"
expect_err "19900 more are not shown"
done_testing
