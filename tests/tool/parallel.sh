# The surrogate `parallel`: one thread and many give the same bytes and messages in the same order; what
# cannot be run in threads is run without, and says why.
. "$ROOT/tests/tool/expect.inc"

# same FILE WHAT [OPTIONS…]: two, three and five threads do what one does
same() {
    file=$1 which=$2
    shift 2
    rm -f one.obj
    run "$PCGC" run "$file" --threads 1 --json -o one.obj "$@"
    one=$code
    cp "$out" one.out
    cp "$err" one.err
    cp one.obj one.kept 2>/dev/null || : >one.kept
    for n in 2 3 5; do
        rm -f one.obj
        run "$PCGC" run "$file" --threads $n --json -o one.obj "$@"
        [ -e one.obj ] || : >one.obj
        expect "$which: $n threads, exit code $one" test "$code" -eq "$one"
        expect "$which: $n threads, the same result" cmp one.out "$out"
        expect "$which: $n threads, the same messages" cmp one.err "$err"
        expect "$which: $n threads, the same model" cmp one.kept one.obj
    done
}

cat >lots.pcg <<'END2'
graph lots {
    param house: string = "house"
    param lots: int = 60
    param empty: length = 1m
    attr number: int
    attr grown: length
    rectangle(width = 12m, height = 9m)
        -> copy(count = lots, index => @number)
        -> translate(x = @number * 15m)
        -> set { assign(@grown, 1m * @number) }
        -> h: parallel(graph = house, height = 3m + (@number % 4) * 3m, number = @number, empty = empty,
                       grown <=> @grown) {
            in  lot: Shape
            out wall: Shape
            out rest: Shape = *
            param height: length
            param empty: length
            attr grown: length
            attr number: int
        }
    h.wall -> c: condition(@grown > 60m)
    c.yes -> tall: color(color = #ff0000)
    c.no  -> low: translate(z = rand(0m, 1m))
    out tall_walls: Shape
    out low_walls: Shape
    out rest: Shape
    tall -> tall_walls
    low -> low_walls
    h.rest -> rest
}
graph house {
    param height: length = 6m
    param empty: length = 1m
    attr grown: length = 0m
    attr number: int = 0
    attr floor: int = 0
    in lot: Shape
    out wall: Shape
    out roof: Shape
    lot -> set { assign(@grown, @grown + height) } -> extrude(amount = height + rand(0m, 2m)) -> m: select { top; rest: all }
    m.top -> texture(file = "no such file.jpg") -> roof
    m.rest -> decompose()
        -> split(axis = y, repeat = true, slice_index => @floor) { absolute(1m) }
        -> parts: split(axis = x) { a: absolute(@number % 7 == 0 ? empty : 1m); b: flexible() }
    parts.a -> wall
    parts.b -> spare: translate(x = 1m)
}
END2
same lots.pcg "lots" --seed 3
same lots.pcg "a warning from some of them" -p empty=-1m
expect_err "(node 'parts', round "
same lots.pcg "one" -p lots=1
same lots.pcg "none" -p lots=0
same lots.pcg "a bad entity, when strict" -p empty=-1m --strict
expect "it stops the run" test "$one" -eq 3
same lots.pcg "a limit of rounds" --max-rounds 2000
expect "it is met" test "$one" -eq 4
same lots.pcg "a limit of entities" --max-entities 2000
run "$PCGC" run lots.pcg --threads 4 --json --max-memory 500k
expect_code 4 "a limit of memory"
run "$PCGC" run lots.pcg --threads 4 --entities --json
expect_code 0 "entities that remember their ways"
expect_out '"path":['
run "$PCGC" run lots.pcg -p house=lots
expect_code 3 "a graph that does not fit"
"$PCGC" lots.pcg -o lots && "$PCGC" run lots.pcg --json --threads 1 --seed 2 >one.out 2>/dev/null
run ./lots --json --threads 3 --seed 2
expect "an executable, three threads" cmp one.out "$out"

# ---- sources, impulses, several inputs, groups, references, what feeds itself ----
cat >kinds.pcg <<'END2'
graph kinds {
    attr n: int
    rectangle() -> many: copy(count = 30, index => @n)
    many -> made: parallel(graph = "make", n = @n) { out out: Shape; attr n: int } -> a
    parallel(graph = "make") { out out: Shape } -> a
    many -> t1: translate(x = 5m)
    many -> t2: translate(x = 9m)
    both: parallel(graph = "two") { in one: Shape; in other: Shape; out out: Shape }
    t1 -> both.one
    t2 -> both.other
    both -> b
    many -> g: group()
    g -> parallel(graph = "pass") { in in: Group; out out: Group } -> ungroup() -> shapes: type_filter { shape }
    shapes.shape -> d
    many -> s: sequence { first: step; second: step }
    s.first  -> color(color = #00ff00) -> parallel(graph = "move") { in in: Shape; out out: Shape } -> e
    s.second -> f
    many -> again: parallel(graph = "move") { in in: Shape; out out: Shape } -> high: condition(@n < 20)
    high.yes -> set { assign(@n, @n + 6) } -> again
    high.no -> h
    out a: Shape
    out b: Shape
    out d: Shape
    out e: Shape
    out f: Shape
    out h: Shape
}
graph make {
    attr n: int = 7
    out out: Shape
    box(width = 1m) -> translate(x = rand(0m, 9m), z = 1m * @n) -> out
}
graph two {
    in one: Shape
    in other: Shape
    out out: Shape
    one -> out
    other -> translate(x = rand(0m, 2m)) -> out
}
graph pass { in in: Group; out out: Group
    in -> out }
graph move { in in: Shape; out out: Shape
    in -> translate(z = rand(1m, 2m)) -> out }
END2
same kinds.pcg "kinds of nodes" --seed 4

# ---- what is loaded in threads ----
mkdir styles
printf 'graph plain {\n    in in: Shape\n    out out: Shape\n    in -> extrude(amount = rand(1m, 2m)) -> out\n}\n' >styles/plain.pcg
printf 'graph unused {\n    param never: int = 0\n    in in: Shape\n    out out: Shape\n    in -> c: condition(true)\n    c.yes -> out\n    out none: Shape\n    c.no -> color() -> none\n}\n' >styles/unused.pcg
printf 'graph counted {\n    attr n: int\n    in in: Shape\n    out out: Shape\n    in -> counter(value => @n) -> translate(z = 1m * @n) -> out\n}\n' >styles/counted.pcg
cat >styled.pcg <<'END2'
graph styled {
    attr n: int
    param styles: int = 2
    param broken: int = -1
    rectangle() -> copy(count = 40, index => @n)
        -> parallel(graph = "house", styles = styles, broken = broken, n = @n) {
            in in: Shape
            out out: Shape
            param styles: int
            param broken: int
            attr n: int
        } -> out
    out out: Shape
}
graph house {
    param styles: int = 1
    param broken: int = -1
    attr n: int
    in in: Shape
    out out: Shape
    in -> dynamic(graph = @n == broken ? "styles/broken.pcg" : @n % styles == 0 ? "styles/plain.pcg" : @n % styles == 1 ? "styles/unused.pcg" : "styles/counted.pcg") {
        in in: Shape
        out out: Shape
    } -> out
}
END2
printf 'graph broken { lgo() }\n' >styles/broken.pcg
same styled.pcg "graphs that are loaded in threads"
expect_err "received nothing"
same styled.pcg "one of them keeps state" -p styles=3
same styled.pcg "one of them is broken" -p broken=17
expect_err "styles/broken.pcg:1:16: error: unknown procedure 'lgo' [E0102]"

# ---- what is not for threads ----
cat >tied.pcg <<'END2'
graph tied {
    attr n: int
    rectangle() -> copy(count = 20) -> w: parallel(graph = "numbered", n => @n) { in in: Shape; out out: Shape; attr n: int }
        -> translate(z = 1m * @n) -> out
    out out: Shape
}
graph numbered {
    attr n: int
    in in: Shape
    out out: Shape
    in -> numbers: counter(value => @n) -> out
}
END2
same tied.pcg "state"
expect_err "tied.pcg:3:40: note: graph 'numbered' is run for one entity after another: 'numbers' keeps state"
run "$PCGC" --dump=order tied.pcg
expect_out "  w one after another: "
expect_out "    'numbers' keeps state"
run "$PCGC" --dump=order kinds.pcg
expect_out "  made in threads"
sed 's/parallel(graph = "numbered"/parallel(graph = "numbered", threads = -1/; s/numbers: counter(value => @n)/translate(x = 1m)/; s/graph tied/graph below/' tied.pcg >below.pcg
run "$PCGC" run below.pcg
expect_code 3 "fewer threads than none"
expect_err "cannot run in -1 threads"

# ---- cancelling ----
cat >endless.pcg <<'END2'
graph endless {
    rectangle() -> copy(count = 8) -> parallel(graph = "loop") { in in: Shape; out out: Shape } -> out
    out out: Shape
}
graph loop {
    in in: Shape
    out out: Shape
    in -> again: translate(x = 1m) -> c: condition(false)
    c.no -> again
    c.yes -> out
}
END2
run timeout 20 "$PCGC" run endless.pcg --threads 3 --max-seconds 500ms --max-rounds 100000000000
expect_code 4 "out of time in threads"
expect_err "longer than its limit"
run timeout -s INT 1 "$PCGC" run endless.pcg --threads 3 --max-rounds 100000000000
expect "interrupted in threads" grep -q . "$err"
done_testing
