# The generator: what it says of interfaces with mistakes, and that it writes nothing then.
. "$ROOT/tests/tool/expect.inc"

mkdir zoo
cat >zoo/library.pcg <<'END'
//! Animals.

/// Where they live.
enum Place { land, water }

/// An animal.
entity Animal: Entity
END

# kernel NAME: a kernel file from the interface on stdin.
kernel() {
    {
        echo '/*pcg'
        cat
        printf '*/\n#include "%s.h"\n' "$1"
    } >"zoo/$1.c"
}

generate() {
    rm -rf gen
    run "$BUILD/pcgen" --abi "$ROOT/runtime/abi.h" -o gen zoo
}

kernel feed <<'END'
/// Feeds animals.
procedure feed(in: Animal) -> (out: Animal) [one_to_one] {
    category "care"
    param amount: float = 1 /// How much.
    example impulse() -> feed(amount = 2) expect count = 1, 'out.count' = 1
}
END
generate
expect_code 0 "a good library"
expect_empty "$err" "nothing is said of a good library"
expect "the kernel's header is there" test -f gen/zoo/feed.h
expect "the registry is there" test -f gen/registry.c
expect "the example is there" test -f gen/examples/zoo_feed_1.pcg
expect "the example uses its library" grep -q '^use zoo$' gen/examples/zoo_feed_1.pcg

touch -d '2001-01-01' gen/zoo/feed.h
run "$BUILD/pcgen" --abi "$ROOT/runtime/abi.h" -o gen zoo
expect "what did not change keeps its time" test gen/zoo/feed.h -ot zoo/feed.c

kernel feed <<'END'
procedure feed(in: Animl) -> (out: Animal) [quick] {
    param amount: flot
    param case: int /// One.
    param case_: int /// Another, which is the same in C.
    param instance: int /// A part of every node.
    augment with(food: Animal) -> float
}
END
generate
expect_code 1 "an interface with mistakes"
expect_err "zoo/feed.c:2:11: error: procedure 'feed' has no documentation [E0803]"
expect_err "error: procedure 'feed' has no category [E0804]"
expect_err "error: procedure 'feed' has no example [E0805]"
expect_err "error: unknown trait 'quick', expected pure, stateful, effect, reads, one_to_one or random [E0807]"
expect_err "zoo/feed.c:2:20: error: unknown type 'Animl' [E0802]"
expect_err "did you mean 'Animal'?"
expect_err "zoo/feed.c:3:11: error: parameter 'amount' has no documentation [E0803]"
expect_err "error: unknown type 'flot' [E0802]"
expect_err "error: 'case_' has the same name in C as 'case': 'case_' [E0806]"
expect_err "error: 'instance' has the same name in C as 'a part of every node': 'instance' [E0806]"
expect_err "error: augmentation 'with' has no documentation [E0803]"
expect_err "error: found type 'Animal', expected a value [E0813]"
expect_err "error: found type 'float', expected an entity [E0813]"
expect "nothing is written then" test ! -e gen

kernel feed <<'END'
/// Says something.
procedure say(in: Animal) { category "care"; example impulse() expect count = [1] }
/// Doubles.
function twice(x: float) -> float [pure] { example twice(1.0) == 2.0 }
/// Doubles again.
function twice(x: float) -> Animal [pure] { example twice(1.0) == 2.0 }
/// Adds.
function add(x: any[], y: float) -> float [pure]
/// Places.
enum Place { land, air }
graph g { impulse() }
END
generate
expect_code 1 "more mistakes"
expect_err "zoo/feed.c:3:11: error: procedure 'say' stands in a file called 'feed' [E0809]"
expect_err "zoo/feed.c:7:10: error: 'twice' is declared twice [E0801]"
expect_err "^~~~~ first here"
expect_err "error: found type 'Animal', expected a value [E0813]"
expect_err "error: only the last parameter of a function takes what is left, as any[] [E0810]"
expect_err "error: function 'add' has no example [E0805]"
expect_err "error: 'Place' is declared twice [E0801]"
expect_err "error: an interface holds no graph [E0808]"

kernel feed <<'END'
/// Feeds.
procedure feed(in: Animal) { category "care"; example impulse() expect count = [1] }
END
generate
expect_code 1 "an expectation that is no value"
expect_err "error: an example expects a number, a string or a bool [E0814]"

kernel feed <<'END'
/// Feeds.
procedure feed(in: Animal {
END
generate
expect_code 1 "a syntax error"
expect_err "zoo/feed.c:3:"

run "$BUILD/pcgen" --abi "$ROOT/runtime/abi.h" -o gen nowhere
expect_code 1 "a folder that is not there"
expect_err "pcgen: nowhere: No such file or directory"
run "$BUILD/pcgen" zoo
expect_code 2 "wrong usage"
done_testing
