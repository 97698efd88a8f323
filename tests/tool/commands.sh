# pcgc's commands: what they print where, exit codes, usage errors.
. "$ROOT/tests/tool/expect.inc"

cat >box.pcg <<'END'
//! A box on its own.
graph box_of {
    param height: length = 2m range [1m, 9m]   /// How high.
    attr n: int = 7
    rectangle(width = 3m, height = 4m) -> grown: extrude(amount = height)
}
END
printf 'graph wrong { lgo() }\n' >wrong.pcg
printf 'graph empty_one {\n    attr n: int\n    rectangle() -> copy(count = 0) -> extrude()\n}\n' >nothing.pcg
printf 'graph late {\n    const unused = 1\n    param style: string = "other"\n    in tile: Shape = rectangle()\n    tile -> w: dynamic(graph = style) { in tile: Shape; out out: Shape }\n}\n' >late.pcg

# ---- words that are no file ----
run "$PCGC"
expect_code 0 "no arguments"
expect_out "pcgc run house.pcg -o house.glb"
run "$PCGC" --version
expect_out "pcgc 0."
run "$PCGC" help run
expect_code 0 "help of a command"
expect_out "--seed"
run "$PCGC" rnu
expect_code 2 "an unknown command"
expect_err "did you mean 'run'?"
run "$PCGC" box.pcg
expect_code 2 "compiling to nowhere"
expect_err "where to?"
run "$PCGC" box.pcg -o box.glb
expect_code 2 "compiling to a model"
expect_err "models are written by pcgc run"
run "$PCGC" --dump=chekc box.pcg
expect_code 2 "an unknown pass"

# ---- check ----
run "$PCGC" check box.pcg
expect_code 0 "check of what is right"
expect_err "1 file checked: 0 errors, 1 warning"
expect_err "[W0504]"
expect_empty "$out" "check prints nothing on stdout"
run "$PCGC" check .
expect_code 1 "check of a folder"
expect_err "wrong.pcg:1:15: error: unknown procedure 'lgo' [E0102]"
run "$PCGC" check missing.pcg
expect_code 2 "a file that is not there"
run "$PCGC" check --message-format=json wrong.pcg
expect_err '"code": "E0102"'

# ---- run ----
run "$PCGC" run box.pcg
expect_code 0 "run"
expect_err "6 faces"
expect_empty "$out" "run without --json prints nothing on stdout"
run "$PCGC" run box.pcg --json --entities
expect_out '"version":1,"graph":"box_of","seed":0'
expect_out '"port":"grown.out","type":"Shape","count":1,"faces":6'
expect_out '"attributes":{"n":7}'
run "$PCGC" run box.pcg --json
expect "no times without --timings" sh -c '! grep -q "\"time\"" .out'
run "$PCGC" run box.pcg --json --timings -o timed.glb
expect "what took how long, from the text to the file" python3 -c '
import json, sys
t = json.load(open(".out"))["time"]
sys.exit(not (list(t)[:3] == ["read", "parse", "resolve"] and list(t)[-3:] == ["run", "glb", "total"]
              and abs(sum(v for k, v in t.items() if k != "total") - t["total"]) < 1e-9))'
run "$PCGC" run box.pcg -p height=300cm --json
expect_out '"volume":36'
run "$PCGC" run box.pcg -p height=10m
expect_code 2 "a parameter out of range"
expect_err "from 1m to 9m"
run "$PCGC" run box.pcg -p heigth=3m
expect_code 2 "an unknown parameter"
expect_err "did you mean 'height'?"
run "$PCGC" run box.pcg -p 3m
expect_err "takes name=value"
run "$PCGC" run wrong.pcg
expect_code 1 "running what does not check"
run "$PCGC" run late.pcg
expect_code 3 "running a surrogate that names nothing"
expect_err "[E0710]"
expect "what was said before is not said again" sh -c '[ "$(grep -c W0504 .err)" = 1 ]'
run "$PCGC" run nothing.pcg
expect_code 0 "nothing came out"
expect_err "[W0501]"
run "$PCGC" run box.pcg --node rectangle --json
expect_out '"port":"rectangle.out","type":"Shape","count":1,"faces":1'
run "$PCGC" run box.pcg --node roof
expect_code 2 "stopping at a node that is not there"
expect_err "has no node 'roof'"
run "$PCGC" run box.pcg --node gron
expect_err "did you mean 'grown'?"
cat >gathering.pcg <<'END'
graph gathering {
    out one: Shape
    out all: Shape = *
    box() -> apart: select { top; rest: all }
    apart.rest -> one
    box() -> tag(name = "box")
}
END
run "$PCGC" run gathering.pcg --node all --json
expect_out '"outputs":[{"port":"all","type":"Shape","count":2,'
run "$PCGC" run box.pcg -o box.xyz
expect_code 2 "an unknown format"
run "$PCGC" run box.pcg -o nowhere/box.glb
expect_code 2 "a folder that is not there"
run sh -c '"$0" run - --json <box.pcg' "$PCGC"
expect_code 0 "a graph from standard input"
run "$PCGC" run box.pcg -q -o - -f obj
expect_out "v "
printf 'graph endless {\n    rectangle() -> again\n    again: translate(x = 1m) -> again\n}\n' >endless.pcg
run "$PCGC" run endless.pcg --max-seconds 200ms
expect_code 4 "the limit on time"
expect_err "--max-seconds raises the limit"
run timeout -s TERM 1 "$PCGC" run endless.pcg -o endless.glb
expect_err "pcgc: interrupted"
expect "nothing was written" test ! -e endless.glb
run "$PCGC" run box.pcg --size 12
expect_code 2 "a picture's size"

# ---- what is written appears whole or not at all ----
mkdir full
run "$PCGC" run box.pcg -q -o full
expect_code 2 "writing over a folder"
expect "no parts are left behind" sh -c '! ls -a . full | grep -q part'

# ---- compiled ----
run "$PCGC" box.pcg -o box.so
expect_code 0 "to .so"
expect "the stack of what it makes is not executable" sh -c 'readelf -lW box.so | grep GNU_STACK | grep -q "RW "'
run "$PCGC" run box.so -p height=3m --json
expect_out '"volume":36'
run "$PCGC" info box.so
expect_out "height: length = 2m"
run "$PCGC" info box.pcg --json
expect_out '"name": "height", "type": "length", "initial": "2m"'
run "$PCGC" box.pcg -o box.c
expect "a header comes with it" grep -q pcg_graph_box_of box.h
run "$PCGC" box.pcg -o box
expect_code 0 "to an executable"
run ./box -p height=3m --json
expect_out '"volume":36'
printf 'not a graph' >broken.so
run "$PCGC" run broken.so
expect_code 1 "text that is called .so is read as text"
head -c 3000 box.so >cut.so
run "$PCGC" run cut.so
expect_code 2 "half a shared object"

done_testing
