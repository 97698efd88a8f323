# pcgc debug: every command and what it refuses; conditions, edges, encapsulated graphs, cycles, surrogates, the past;
# the run is the same as without.
. "$ROOT/tests/tool/expect.inc"

cat >street.pcg <<'END'
//! Three houses, each with an entrance of its own.
graph street {
    param houses: int = 3
    attr number: int = 0
    attr note: string = "none"
    out doors: Shape
    out walls: Shape

    rectangle(width = 6m, height = 5m)
        -> copies: copy(count = houses, index => @number)
        -> move: translate(x = @number * 8m)
        -> extrude(amount = 3m)
        -> house: select { walls: side }
    house.walls -> each: entrance(height = 2m + @number * 1m)
    house.walls -> all: set { assign(@note, "seen") }
    each.door -> doors
    each.rest -> walls
}

graph entrance {
    param height: length = 1m
    attr door: bool = false
    in  walls: Shape
    out door: Shape
    out rest: Shape

    walls -> decompose() -> facade: amount_filter(amount = 1)
    facade.picked -> mark: set { assign(@door, true) } -> door
    facade.rest   -> rest
}
END

# debug COMMANDS [FILE] [OPTION…]: their answers are in $out
debug() {
    commands=$1
    shift
    run "$PCGC" debug "${@:-street.pcg}" -x "$commands" </dev/null
}
# answer: the answers to the last of the commands alone, in $answer
answer() {
    answer=$PWD/.answer
    awk '/^\(pcgc\)/ { text = ""; next } { text = text $0 "\n" } END { printf "%s", text }' "$out" >"$answer"
}
expect_answer() { # expect_answer COMMANDS TEXT
    debug "$1"
    answer
    grep -qF -- "$2" "$answer"
    result $? "'$1' answers: $2"
}
expect_exactly() { # expect_exactly COMMANDS: the answer to the last one is what is on stdin
    cat >wanted
    debug "$1"
    answer
    cmp -s wanted "$answer"
    result $? "'$1' answers exactly"
}

# ---- where it begins and ends ----
debug ''
expect_code 0 "no commands end the run"
expect_out "round 1: 'rectangle' of street, its round 1"
debug 'quit'
expect_code 0 "quit"
expect_empty "$err" "quit says nothing"
debug 'continue; step'
expect_code 0 "to the end"
expect_out "the run is done: "
expect_out "error: the run is over"
debug 'quit' street.pcg -o none.json
expect "of a run that was left nothing is written" [ ! -e none.json ]

# ---- moving ----
expect_answer 'step; step' "round 3: 'move' (translate) of street, its round 1"
expect_answer 's; s; s' "round 4: 'move' (translate) of street, its round 2"
expect_answer 'step; step; next' "'extrude' of street, its round 1"
expect_exactly 'break each; continue; step' <<'END'
round 13: 'decompose' of entrance, its round 1
    27 |     walls -> decompose() -> facade: amount_filter(amount = 1)
  in: #4
END
expect_answer 'break each; continue; over' "breakpoint 1: round 16: 'each' (entrance) of street, its round 2"
expect_answer 'break each; c; delete 1; over' "round 16: 'each' (entrance) of street, its round 2"
expect_answer 'break facade; c; delete all; out' "'each' (entrance) of street, its round 2"
expect_answer 'out' "error: this is the main graph"
expect_answer 'goto 5' "round 5: 'move' (translate) of street, its round 3"
expect_answer 'goto 999' "the run is done: "
expect_answer 'c; goto 999' "error: the run was over after "
expect_answer 'goto' "error: to which round?"
expect_answer 'goto x' "error: 'x' is no number of rounds"
expect_answer 'back 0' "error: '0' is no number of rounds"

# ---- looking ----
expect_exactly 'goto 13; queues' <<'END'
entrance:
  nothing waits
street:
  each.walls               2: #6 #8
  all.in                   3: #5 #7 #9
END
expect_answer 'goto 13; queues all' "facade.in                0"
expect_answer 'queues here' "error: 'queues' takes nothing"
expect_exactly 'goto 5; print' <<'END'
#3 Shape, made by rectangle: 1 face, 4 vertices
  @number = 2
  @note = "none" (default)
  scope: origin (0, 0, 0), size (6, 5, 0)
         x (1, 0, 0), y (0, 1, 0), z (0, 0, 1)
END
expect_answer 'goto 5; print in' "#3 Shape"
expect_answer 'goto 5; print @number' "#3 @number = 2"
expect_answer 'goto 5; print @note' '#3 @note = "none" (default)'
expect_answer 'goto 5; print extrude' "extrude.in               2: #1 #2"
expect_answer 'goto 5; print extrude.in' "#2 Shape, made by rectangle"
expect_answer 'goto 5; print #2' "@number = 1"
expect_answer 'goto 5; print #77' "error: #77 waits nowhere, and no round has taken it"
expect_answer 'goto 5; print #x' "error: '#x' is no number of an entity"
expect_answer 'goto 5; print nothing' "error: there is no queue 'nothing'"
expect_answer 'goto 5; print @none' "error: graph 'street' has no attribute '@none'"
expect_answer 'print' "this round has taken no entity"
expect_answer 'goto 5; parameters' "  x: length = 16m"
expect_answer 'break each; c; parameters' "  height: length = 2m"
expect_answer 'list' ">    9 |     rectangle(width = 6m, height = 5m)"
expect_answer 'list 30' "  29 |     facade.rest   -> rest"
expect_answer 'list; list' "  15 |     house.walls -> all: set"
expect_answer 'list 99' "error: the file ends before line 94"
expect_answer 'list x' "error: 'x' is no number of a line"
expect_exactly 'goto 14; where' <<'END'
'facade' (amount_filter) of entrance, its round 1, round 14 of all, at street.pcg:27
in 'each' (entrance) of street, its round 1, round 12 of all, at street.pcg:14
END
expect_answer 'c; where' "no round is under way"
expect_answer 'break move; c; info' "1: break move, hit 1 times"
expect_answer 'info' "no breakpoints"

# ---- help ----
debug 'help'
for command in break watch delete step next over out continue back goto queues print parameters list where info help quit; do
    expect_out "  $command "
done
expect_answer 'help break' "break window if @floor == 2"
expect_answer 'help brek' "did you mean 'break'?"
expect_answer 'stpe' "error: unknown command 'stpe', did you mean 'step'?"
expect_answer 'xyzzy' "error: unknown command 'xyzzy'; 'help' lists them"
expect_answer 'o' "error: 'o' may be more than one command"
expect_answer 'para' "  width: length = 6m"

# ---- breakpoints ----
expect_answer 'break move' "breakpoint 1: 'move' of street, line 11"
expect_answer 'break 11; c' "breakpoint 1: round 3: 'move' (translate)"
expect_answer 'break street.pcg:12; c' "'extrude' of street"
expect_answer 'break 3' "line 9, 'rectangle' of street"
expect_answer 'break 31' "error: no node begins in line 31 of 'street.pcg', or behind it"
expect_answer 'break other.pcg:3' "error: 'other.pcg' is no file of the program"
expect_answer 'break entrance/facade; c; c' "'facade' (amount_filter) of entrance, its round 2"
expect_answer 'break entrance/facad' "error: graph 'entrance' has no node 'facad', did you mean 'facade'?"
expect_answer 'break entrence/facade' "error: there is no graph 'entrence', did you mean 'entrance'?"
expect_answer 'break hous' "error: the program has no node 'hous', did you mean 'house'?"
expect_answer 'break doors' "error: 'doors' is a gate"
expect_answer 'break house.walls' "error: 'walls' is a port; give an edge: break house.walls -> "
expect_answer 'break' "error: where?"
expect_answer 'break a b' "error: one place at a time"
expect_answer 'break move ->' "error: where?"
expect_answer 'break house -> each; c' "  #4 is about to leave house.walls -> each.walls"
expect_answer 'break house.walls -> all.in; c' "  #5 is about to leave house.walls -> all.in, a copy of #4"
expect_answer 'break house -> all; c; print' "#5 Shape, made by house"
expect_answer 'break house -> move' "error: there is no edge from 'house' to 'move'"
expect_answer 'break entrance/walls -> decompose' "error: 'walls' is a gate, which passes on"
expect_answer 'break house -> nobody' "error: the program has no node 'nobody'"
expect_answer 'delete' "error: which one?"
expect_answer 'delete 7' "error: there is no breakpoint 7"
expect_answer 'break move; break extrude; delete 1; c' "breakpoint 2: "

# ---- conditions ----
expect_answer 'break move if @number == 2; c' "breakpoint 1: round 5: 'move'"
expect_answer 'break move if houses == 3 && @number == 1; c' "breakpoint 1: round 4: 'move'"
expect_answer 'break all if area(in) > 1m2; c' "'all' (set) of street, its round 1"
expect_answer 'break facade if area(in) > 1000m2; c' "the run is done"
expect_answer 'break house -> each if @number == 1; c' "  #6 is about to leave house.walls -> each.walls"
expect_answer 'break mark if !@door; c' "'mark' (set) of entrance"
expect_answer 'break move if 10 / @number == 5; c' "the condition of breakpoint 1 cannot be evaluated: "
expect_answer 'break move if 10 / @number == 5; c; c; c' "the run is done"
debug 'break move if @nmber == 2; info'
expect_out "<command>:1:15: error: unknown attribute '@nmber' [E0401]"
expect_out "    1 | break move if @nmber == 2"
expect_out "      |               ^~~~~~ did you mean 'number'?"
expect_out "no breakpoints"
expect_answer 'break move if @number' "error: "
expect_answer 'break move if' "error: "
expect_answer 'break move if @number == ' "<command>:1:"
expect_answer 'break move if true) -> foo(' "error: "
expect_answer 'break move if lgo(1) == 2' "did you mean 'log'"
expect_answer 'break rectangle if @number == 0' "error: "

# ---- watches ----
expect_answer 'watch @number; c' "  @number = 1, before: 0"
expect_answer 'watch number; c; c' "  @number = 2, before: 0"
expect_answer 'watch @door; c' "  @door = true, before: false"
expect_answer 'watch @nmber' "error: no graph has an attribute '@nmber', did you mean '@number'?"
expect_answer 'watch' "error: which attribute?"

# ---- the past ----
expect_answer 'goto 14; back 1; queues' "  each.walls               2: #6 #8"
expect_answer 'back' "this is the first round"
expect_answer 'goto 9; back 4; print @number' "#3 @number = 2"
expect_answer 'goto 9; goto 5; parameters' "  x: length = 16m"
expect_answer 'goto 14; goto 3; where' "'move' (translate) of street, its round 1, round 3 of all"
expect_answer 'goto 9; goto 3; step' "round 4 of 9 so far: 'move' (translate) of street, its round 2"
expect_answer 'goto 9; back 2; step; step; step' "round 10: "
expect_answer 'goto 13; goto 1; break move if @number == 1; c' "breakpoint 1: round 4 of 13 so far: "
expect_answer 'goto 13; goto 1; break move if area(in) > 1m2; c' "asks for more than attributes"
expect_answer 'goto 13; goto 1; watch @number; c; c' "  @number = 2, before: 0"
expect_answer 'goto 13; goto 1; break house -> each; c' "  #4 is about to leave house.walls -> each.walls"
expect_answer 'c; back 2; where' "'all' (set) of street, its round 2, round 25 of all"
debug 'goto 20; goto 2' street.pcg --history 1K
expect_out "are no longer recorded: they needed more than 1 KiB (--history sets the limit)"
expect_code 0 "a record that is too small"

# ---- where commands come from ----
printf 'step\n\n# nothing\nqueues\n' >steps.txt
run "$PCGC" debug street.pcg --batch steps.txt </dev/null
expect_code 0 "commands from a file"
expect_out "(pcgc) queues"
cp "$out" from_file
"$PCGC" debug street.pcg <steps.txt >from_stdin
expect "from the standard input the same" cmp from_file from_stdin
"$PCGC" debug street.pcg -x 'step' --batch - <steps.txt >both
expect "first -x, then the file" grep -q "round 3" both
run "$PCGC" debug street.pcg --batch none.txt
expect_code 2 "commands that cannot be read"
expect_err "cannot read 'none.txt'"
run "$PCGC" debug -
expect_code 2 "graph and commands from one stream"
"$PCGC" debug - --graph street -x 'break extrude; c' <street.pcg >piped
expect "a graph from the standard input" grep -q "'extrude' of street" piped
run "$PCGC" debug
expect_code 2 "no file"
run "$PCGC" debug none.pcg </dev/null
expect_code 2 "a file that is not there"
"$PCGC" street.pcg -o street.so
run "$PCGC" debug street.so </dev/null
expect_code 2 "a compiled graph"
expect_err "it needs the source"
printf 'graph wrong { lgo() }\n' >wrong.pcg
debug 'step' wrong.pcg
expect_code 1 "errors in the graph"
debug 'print; print height' street.pcg -p houses=2 -p nothing=1
expect_code 2 "an unknown parameter"
printf 'graph empty { out none: Shape }\n' >empty.pcg
debug 'queues; back; step; print; where; list' empty.pcg
expect_code 0 "a graph without a round"
expect_out "the run is done: 0 rounds"

# ---- runs that fail ----
printf 'graph bad { rectangle() -> assert(area(in) > 9m2, "small") }\n' >bad.pcg
debug 'continue; back; print; step' bad.pcg
expect_code 3 "a run that fails"
expect_out "the run has failed: "
expect_out "round 1 of "
cat >endless.pcg <<'END'
graph endless {
    attr turn: int
    rectangle() -> again
    again: set { assign(@turn, @turn + 1) } -> more: condition(@turn > 0)
    more.yes -> again
}
END
debug 'continue; back 2; print @turn' endless.pcg --max-rounds 1000
expect_code 4 "a limit"
expect_out "the run has come to a limit"
expect_out "#1 @turn = 499"

# ---- surrogates ----
mkdir styles
cat >styles/tall.pcg <<'END'
graph tall {
    attr grown: bool
    in  tile: Shape
    out window: Shape
    tile -> grow: extrude(amount = 2m) -> set { assign(@grown, true) } -> window
}
END
cat >chosen.pcg <<'END'
graph chosen {
    param style: string = "styles/tall.pcg"
    attr n: int
    out windows: Shape
    rectangle() -> copy(count = 2, index => @n) -> w: dynamic(graph = style) {
        in  tile: Shape
        out window: Shape
    }
    w -> windows
}
END
debug 'break tall/grow; continue; where; list; print; queues; break tall.pcg:5; delete 1; c; watch @grown; c; goto 4; where' chosen.pcg
expect_code 0 "a graph that is loaded"
expect_out "breakpoint 1: 'grow' of tall, once such a graph is loaded"
expect_out "in 'w' (dynamic) of chosen, its round 1"
expect_out ">    5 |     tile -> grow: extrude(amount = 2m)"
expect_out "breakpoint 2: line 5 of 'tall.pcg', once it is loaded"
expect_out "@grown = true, before: false"
expect_out "round 4 of "
debug 'break tall/grow if @n == 1' chosen.pcg
expect_out "error: graph 'tall' is not part of the program: a condition cannot be compiled for it"

# ---- the run is the same as without ----
for graph in street.pcg chosen.pcg "$ROOT"/examples/figures/figure_*.pcg "$ROOT/examples/house.pcg" "$ROOT/examples/street.pcg"; do
    "$PCGC" run "$graph" --entities -o plain.json 2>plain.err
    "$PCGC" debug "$graph" --entities -o watched.json -x 'step; step; queues; print; back; step' -x continue </dev/null >/dev/null 2>watched.err
    expect "$(basename "$graph"): the same result" cmp plain.json watched.json
done

# ---- what was, is shown as it was; Ctrl+C ----
python3 "$ROOT/tests/tool/debug.py"
[ $? -eq 0 ] || failures=$((failures + 1))
done_testing
