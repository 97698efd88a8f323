# Surrogates: names that are written out and names that are computed give the same; what does not fit or
# cannot be loaded is said with both places; compiled graphs choose, too.
. "$ROOT/tests/tool/expect.inc"

mkdir styles
cat >styles/tall.pcg <<'END2'
graph tall {
    param height: length = 1m range [0m, 9m]
    attr  size: float = 0
    in  tile: Shape
    out window: Shape
    out sill: Shape
    tile -> size(height => @size) -> grown: extrude(amount = height * (1 + rand()))
    grown -> set { assign(@size, @size + volume(in)) } -> window
    box(width = 50cm) -> sill
    box(width = 25cm) -> spare: translate(x = rand(0m, 9m))
}
graph size { attr height: float
    in in: Shape
    out out: Shape
    in -> set { assign(@height, 3.0) } -> out
}
END2

# choose NAME-EXPRESSION FILE: a graph that runs it, and says where its name comes from
choose() {
    cat >"$2" <<END2
graph choose {
    param style: string = "styles/tall.pcg"
    attr n: int
    attr size: float
    rectangle() -> copy(count = 3, index => @n) -> w: dynamic(graph = $1, height = @n * 1m, size <=> @size) {
        in  tile:   Shape
        out window: Shape
        out sill:   Shape
        param height: length = 2m
        attr size: float
    }
    out windows: Shape
    out sills: Shape
    w.window -> windows
    w.sill   -> sills
}
END2
}
choose '"styles/tall.pcg"' written.pcg
choose style computed.pcg
choose '"styles/" + (@n > 0 ? "tall" : "tall") + ".pcg"' by_entity.pcg
run "$PCGC" run written.pcg --json --entities --seed 5
expect_code 0 "a name that is written out"
expect_out '"port":"windows","type":"Shape","count":3'
mv .out written
for file in computed.pcg by_entity.pcg; do
    run "$PCGC" run $file --json --entities --seed 5
    expect "$file gives the same bytes as a name that is written out" cmp -s .out written
done
expect "a name that is written out is an ordinary encapsulation" sh -c \
    '"$PCGC" --dump=emit written.pcg | grep -q "main_choose_w_enter" && ! "$PCGC" --dump=emit written.pcg | grep -q "static const pcg_surrogate_info"'

# ---- compiled ----
run "$PCGC" computed.pcg -o computed.so
expect_code 0 "a computed name, to .so"
run "$PCGC" run computed.so --json --entities --seed 5
expect "a .so that loads source, in pcgc" cmp -s .out written
"$PCGC" written.pcg -o written_alone
run ./written_alone --json --entities --seed 5
expect "an executable, names written out" cmp -s .out written
"$PCGC" computed.pcg -o alone
"$PCGC" styles/tall.pcg -o styles/tall.so
run ./alone --json
expect_code 3 "an executable holds no compiler"
expect_err "this program holds no compiler"
run ./alone --json --entities --seed 5 -p style=styles/tall.so
expect_code 0 "an executable loads what is compiled"
expect "with the same bytes" cmp -s .out written
mkdir elsewhere
mv alone styles elsewhere
run ./elsewhere/alone --json --entities --seed 5 -p style=styles/tall.so
expect "files are found beside the executable" cmp -s .out written
mv elsewhere/styles .

# ---- the rest ----
cat >rest.pcg <<'END2'
graph rest {
    param style: string = "styles/tall.pcg"
    rectangle() -> w: dynamic(graph = style) {
        in  tile:   Shape
        out window: Shape
        out rest:   Shape = *
    }
    w.window -> log()
    out rest: Shape
    w.rest -> rest
}
END2
run "$PCGC" run rest.pcg --json
expect_out '"port":"rest","type":"Shape","count":2'

# ---- what does not fit ----
printf 'graph other {\n    param height: int = 1\n    in  tile: Shape\n    out window: Shape\n    tile -> window\n}\n' >other.pcg
run "$PCGC" run computed.pcg -p style=other.pcg
expect_code 3 "an interface that does not fit"
expect_err "graph 'other' (other.pcg:1:7) has no output 'sill', which the surrogate declares as Shape (line 8)"
printf 'graph other {\n    param height: int = 1\n    attr size: float\n    in  tile: Shape\n    out window: Shape\n    out sill: Shape\n    tile -> copy(count = height, index => @size) -> window\n    box() -> sill\n}\n' >other.pcg
sed -i 's/, index => @size//' other.pcg
run "$PCGC" run computed.pcg -p style=other.pcg
expect_err "parameter 'height' of graph 'other' does not fit: it is int (other.pcg:1:7), and the surrogate declares length (line 9)"
run "$PCGC" run computed.pcg -p style=nowhere.pcg
expect_code 3 "a file that is not there"
expect_err "cannot load graph 'nowhere.pcg': there is no such file"
run "$PCGC" run computed.pcg -p style=./styles
expect_err "it is no file"
run "$PCGC" run computed.pcg -p style=nothing_of_this_name
expect_code 3 "a name of nothing"
printf 'graph broken { lgo() }\n' >broken.pcg
run "$PCGC" run computed.pcg -p style=broken.pcg
expect_code 3 "a file with errors"
expect_err "broken.pcg:1:16: error: unknown procedure 'lgo' [E0102]"
choose '"broken.pcg"' broken_written.pcg
run "$PCGC" run broken_written.pcg
expect_code 1 "the same when it is compiled"
expect_err "broken.pcg:1:16: error: unknown procedure 'lgo' [E0102]"
printf 'no code' >styles/no.so
run "$PCGC" run computed.pcg -p style=styles/no.so
expect_code 3 "a .so that is none"

# ---- recursion ----
cat >again.pcg <<'END2'
graph again {
    param next: string = "again.pcg"
    in in: Shape = rectangle()
    out out: Shape
    in -> w: dynamic(graph = next) { in in: Shape; out out: Shape } -> out
}
END2
run "$PCGC" run again.pcg --max-depth 20
expect_code 4 "a graph that loads itself"
expect_err "the limit of 20 deep"
sed 's/= next/= "again.pcg"/' again.pcg >self.pcg && mv self.pcg again.pcg
run "$PCGC" run again.pcg --max-depth 20
expect_code 4 "and one that names itself"

# ---- silence in what was loaded ----
cat >silent.pcg <<'END2'
graph silent {
    in  tile: Shape
    out window: Shape
    tile -> c: condition(width(in) > 100m)
    c.yes -> extrude() -> window
    c.no  -> log()
}
END2
cat >loads.pcg <<'END2'
graph loads {
    param style: string = "silent.pcg"
    rectangle() -> dynamic(graph = style) { in tile: Shape; out window: Shape }
}
END2
run "$PCGC" run loads.pcg
expect_err "silent.pcg:5:14: warning: 'extrude' received nothing (1 went to 'c.no')"

# ---- what is measured: with times, so that no two runs say the same ----
cat >measured.pcg <<'END2'
graph measured {
    attr n: int
    rectangle() -> copy(count = 3, index => @n) -> profile(graph = "work", amount = @n * 1m) {
        in  in: Shape
        out out: Shape
        param amount: length
    } -> out
    out out: Shape
}
graph work {
    param amount: length = 1m
    in  in: Shape
    out out: Shape
    in -> copy(count = 2) -> translate(x = amount) -> out
}
END2
run "$PCGC" run measured.pcg --json
expect_code 0 "a profile"
expect_err "note: graph 'work' ran 3 times in 0.0"
expect_err " s: 9 rounds, 3 in, 6 out; amount = 2m"
expect_out '"severity":"note"'

# ---- watched ----
run "$PCGC" trace computed.pcg -o trace.json
expect_code 0 "a trace goes into what was loaded"
expect "its rounds are told" grep -q '"grown"' trace.json
expect "and which graph was chosen" grep -q 'styles/tall.pcg' trace.json
done_testing
