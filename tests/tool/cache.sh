# The surrogate `cache`: the same bytes whether what a graph gives is made, kept or found; what makes it
# make again; what is not kept; processes that share a folder; files that are damaged.
. "$ROOT/tests/tool/expect.inc"
export XDG_CACHE_HOME="$PWD/cache"
unset PCG_NO_CACHE
kept=$XDG_CACHE_HOME/pcgc

# files N WHAT: so many entries are on disk
files() {
    [ "$(ls "$kept" 2>/dev/null | grep -c '\.kept$')" -eq "$1" ]
    result $? "$2: $1 entries"
}
# same FILE WHAT [OPTIONS…]: made without a cache, with an empty one, and found
same() {
    file=$1 which=$2
    shift 2
    rm -rf "$kept"
    run "$PCGC" run "$file" --no-cache --json -o model.obj "$@"
    expect_code 0 "$which"
    cp "$out" plain.out && cp "$err" plain.err && cp model.obj plain.obj
    for state in empty filled; do
        run "$PCGC" run "$file" --json -o model.obj "$@"
        expect "$which, $state: the same result" cmp plain.out "$out"
        expect "$which, $state: the same messages" cmp plain.err "$err"
        expect "$which, $state: the same model" cmp plain.obj model.obj
    done
    run "$PCGC" run "$file" --json -o model.obj --threads 3 "$@"
    expect "$which, in threads: the same result" cmp plain.out "$out"
}

cat >city.pcg <<'END2'
graph city {
    param width: length = 10m
    param times: int = 3
    attr n: int
    attr size: length
    cache(graph = "quarter", where = disk, width = width) { out lots: Shape; param width: length }
        -> here: translate(z = rand(0m, 1m)) -> lots
    rectangle() -> many: copy(count = times, index => @n)
    many -> each: cache(graph = "house", where = disk, size <=> @size, n = @n % 2) {
        in  lot: Shape
        out wall: Shape
        out rest: Shape = *
        attr n: int
        attr size: length
    }
    each.wall -> color(color = rand() < 0.5 ? #ff0000 : #00ff00) -> translate(x = 1m * @n, y = @size) -> walls
    each.rest -> rest
    many -> by: cache(graph = "quarter", width = 1m) { out lots: Shape; param width: length }
    by -> c: condition(@n == 1)
    c.yes -> ones
    out lots: Shape
    out walls: Shape
    out rest: Shape
    out ones: Shape
}
graph quarter {
    param width: length = 5m
    out lots: Shape
    rectangle(width = width, height = 6m) -> copy(count = 10) -> translate(x = 10m) -> texture(file = "brick.jpg") -> lots
}
graph house {
    attr n: int = 0
    attr size: length = 0m
    in lot: Shape
    out wall: Shape
    out roof: Shape
    lot -> set { assign(@size, @size + 1m * @n + 1m) } -> extrude(amount = @n == 0 ? -0m : 1m * @n) -> map_uv_box()
        -> m: select { top; rest: all }
    m.top -> roof
    m.rest -> material(metallic = 0.5) -> decompose() -> wall
}
END2
same city.pcg "a city"
same city.pcg "another seed" --seed 8
files 3 "of a source, and of two houses"
"$PCGC" run city.pcg --json >one.out 2>/dev/null
files 3 "what draws nothing does not depend on the seed"
"$PCGC" run city.pcg --json -p width=11m >two.out 2>/dev/null
files 4 "a parameter is another one"
run "$PCGC" run city.pcg --json --no-cache -p width=11m
expect "and gives what is made" cmp two.out "$out"
run env PCG_NO_CACHE=1 "$PCGC" run city.pcg --json -p width=12m
files 4 "switched off by the environment"

# ---- what makes it make again ----
: >brick.jpg
run "$PCGC" run city.pcg --json
expect "a file that it asks for has come" sh -c '! grep -q "no image file" "$1"' - "$err"
rm brick.jpg
run "$PCGC" run city.pcg --json
expect_err "no image file"
sed -i 's/copy(count = 10)/copy(count = 11)/' city.pcg
run "$PCGC" run city.pcg --json
expect_out '"port":"lots","type":"Shape","count":11,'
count=$(ls "$kept" | wc -l)
sed -i 's/rand(0m, 1m)/rand(0m, 2m)/' city.pcg
run "$PCGC" run city.pcg --json
expect "a change of what is around it makes no new entry" test "$(ls "$kept" | wc -l)" -eq "$count"
printf 'graph inner { out out: Shape\n    box() -> out }\n' >inner.pcg
cat >imports.pcg <<'END2'
import inner from "inner.pcg"
graph imports {
    cache(graph = "outer", where = disk) { out out: Shape } -> out
    out out: Shape
}
graph outer { out out: Shape
    inner() -> out }
END2
same imports.pcg "an import"
printf 'graph inner { out out: Shape\n    box() -> copy(count = 2) -> out }\n' >inner.pcg
run "$PCGC" run imports.pcg --json
expect_out '"port":"out","type":"Shape","count":2,'

# ---- chance, streets, groups, what warns ----
cat >kinds.pcg <<'END2'
use streets
graph kinds {
    param seeded: bool = true
    attr n: int
    rectangle() -> copy(count = 3, index => @n) -> many: translate(x = 1m * @n)
    many -> a: cache(graph = "drawn", where = disk) { in in: Shape; out out: Shape } -> translate(z = rand(0m, 1m)) -> d1
    cache(graph = "net", where = disk) { out out: StreetNetwork } -> d2
    cache(graph = "held", where = disk) { out out: Group } -> ungroup() -> t: type_filter { shape }
    t.shape -> translate(z = rand(0m, 1m)) -> d3
    many -> w: cache(graph = "warns", where = disk) { in in: Shape; out out: Shape } -> d4
    many -> s: sequence { one: step; two: step }
    s.one -> cache(graph = "drawn", where = disk) { in in: Shape; out out: Shape } -> d5
    s.two -> d6
    out d1: Shape
    out d2: StreetNetwork
    out d3: Shape
    out d4: Shape
    out d5: Shape
    out d6: Shape
}
graph drawn { in in: Shape; out out: Shape
    in -> extrude(amount = rand(1m, 2m)) -> out }
graph net { out out: StreetNetwork
    rectangle() -> translate(x = rand(0m, 5m)) -> streets_from_shapes(width = 3m, name = "Main Street") -> out }
graph held { out out: Group
    rectangle() -> copy(count = 4) -> translate(x = rand(0m, 5m)) -> group() -> out }
graph warns { in in: Shape; out out: Shape
    in -> s: split(axis = x) { a: absolute(-1m); b: flexible() }
    s.b -> out
    s.a -> out }
END2
same kinds.pcg "kinds of entities"
same kinds.pcg "kinds of entities, seed 5" --seed 5
expect_err "warning: what graph 'drawn' gives is not kept: what enters it is referred to from elsewhere"
expect "its warnings are told again" sh -c 'test "$(grep -c "slice .a. has a size" "$1")" -eq 3' - "$err"

# ---- what is not kept ----
cat >tied.pcg <<'END2'
graph tied {
    attr n: int
    rectangle() -> copy(count = 3) -> w: cache(graph = "numbered", n => @n) { in in: Shape; out out: Shape; attr n: int }
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
expect_err "tied.pcg:3:39: warning: what graph 'numbered' gives is not kept: 'numbers' keeps state [W0705]"
expect_out '"bounds":[[0,0,0],[1,1,2]]'
run "$PCGC" --dump=order tied.pcg
expect_out "  w not kept: "
run "$PCGC" trace city.pcg -o trace.json
expect "a trace sees all rounds" grep -q '"map_uv_box"' trace.json

# ---- damage ----
same city.pcg "a city, again"
for what in truncated changed empty; do
    for entry in "$kept"/*.kept; do
        case $what in
        truncated) head -c 90 "$entry" >short && cp short "$entry" ;;
        changed) printf 'xx' | dd of="$entry" bs=1 seek=66 conv=notrunc 2>/dev/null ;;
        empty) : >"$entry" ;;
        esac
    done
    run "$PCGC" run city.pcg --json
    expect_code 0 "entries that are $what"
    expect "are told of once" test "$(grep -c 'damaged, and is made anew \[W0706\]' "$err")" -eq 1
    run "$PCGC" run city.pcg --json
    expect "and are made anew: $what" cmp plain.out "$out"
done
mkdir other
for entry in "$kept"/*.kept; do cp "$entry" other/one; done
for entry in "$kept"/*.kept; do cp other/one "$entry"; done
run "$PCGC" run city.pcg --json
expect_err "[W0706]"
run "$PCGC" run city.pcg --json
expect "entries of another key are not taken" cmp plain.out "$out"
: >no-folder
run env XDG_CACHE_HOME="$PWD/no-folder" "$PCGC" run city.pcg --json
expect_code 0 "no folder"
expect "is told of once" test "$(grep -c 'nothing is kept on disk: .*\[W0707\]' "$err")" -eq 1
run env -u XDG_CACHE_HOME -u HOME "$PCGC" run city.pcg --json
expect_code 0 "no home"
expect_err "[W0707]"
mkdir -p "$kept/$(printf '%032d' 0).kept"
run "$PCGC" run city.pcg --json
expect "a folder in place of an entry harms nothing" cmp plain.out "$out"

# ---- limits ----
rm -rf "$kept"
for width in 1 2 3 4 5 6 7 8 9; do
    "$PCGC" run city.pcg -q --max-cache 12k -p width=${width}m 2>/dev/null
done
size=$(cat "$kept"/*.kept | wc -c)
expect "the folder stays within its limit" test "$size" -le 12288 -a "$size" -gt 0
run "$PCGC" run city.pcg --json --max-cache 100
expect_code 0 "a limit that nothing fits in"
expect_err "[W0707]"

# ---- several processes at once ----
rm -rf "$kept"
for n in 1 2 3 4 5 6; do
    (for width in 10 20 30; do "$PCGC" run city.pcg --json -p width=${width}m >"$n.$width" 2>"$n.$width.err"; done) &
done
wait
for width in 10 20 30; do
    "$PCGC" run city.pcg --json --no-cache -p width=${width}m >alone 2>/dev/null
    for n in 1 2 3 4 5 6; do
        expect "process $n, $width m" cmp alone $n.$width
        expect "process $n, $width m: nothing was damaged" sh -c '! grep -q "W070[67]" "$1"' - $n.$width.err
    done
done
expect "nobody left an incomplete file" test -z "$(ls -A "$kept" | grep '^\.')"

# ---- an executable ----
"$PCGC" city.pcg -o city
run ./city --json
expect_code 0 "an executable keeps, too"
cp "$out" first
run ./city --json
expect "and finds" cmp first "$out"
done_testing
