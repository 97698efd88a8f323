# pcgc library: a library outside the tree, built, used by every backend, and broken in every way.
. "$ROOT/tests/tool/expect.inc"

mkdir zoo
cat >zoo/library.pcg <<'END'
//! Animals.

/// Where they live.
enum Place { land, water }

/// Where animals live.
entity Cage: Shape
END
cat >zoo/zoo.h <<'END'
#include <pcg/shape.h>
struct cage {
    pcg_shape shape;
    double bars;
};
struct animal {
    pcg_entity entity;
    const char *name;
};
END
cat >zoo/types.c <<'END'
#include "library.h"
#include "animal.h"
#include "zoo.h"
static int copy(pcg_run *r, pcg_entity *to, const pcg_entity *from)
{
    ((struct cage *)to)->bars = ((const struct cage *)from)->bars;
    return pcg_type_shape.copy(r, to, from);
}
static void drop(pcg_run *r, pcg_entity *e)
{
    pcg_type_shape.drop(r, e);
}
const pcg_type pcg_zoo_type_Cage = {.name = "Cage", .parent = &pcg_type_shape,
                                    .size = sizeof(struct cage), .copy = copy, .drop = drop};
const pcg_type pcg_zoo_type_Animal = {.name = "Animal", .parent = &pcg_type_entity,
                                      .size = sizeof(struct animal)};
END
cat >zoo/cage.c <<'END'
/*pcg
/// Puts bars around a shape.
procedure cage(in: Shape) -> (out: Cage) [pure, one_to_one] {
    category "care"
    formerly enclosure
    param bars: int = 1   /// How many.
    example rectangle() -> cage(bars = 4) expect faces = 1, count = 1
}
*/
#include "cage.h"
#include "library.h"
#include "zoo.h"
int pcg_zoo_cage(pcg_call *call, struct pcg_zoo_cage *node)
{
    pcg_entity *in = (pcg_entity *)node->in;
    struct cage *c = (struct cage *)pcg_shape_new_of(call, &pcg_zoo_type_Cage, in);
    if (!c)
        return PCG_FAILED;
    pcg_shape_set_mesh(call->run, &c->shape, pcg_mesh_hold(node->in->mesh));
    c->bars = (double)node->bars;
    pcg_entity_drop(call->run, in);
    return pcg_emit(call, node->out, (pcg_entity *)c);
}
END
cat >zoo/animal.c <<'END'
/*pcg
/// Lives in a cage.
entity Animal: Entity
/// Puts animals into cages.
procedure animal(in: Cage) -> (out: Animal) [pure] {
    category "care"
    param home: Place = land   /// Where it lives.
    attr bars: int             /// Written: of its cage.
    /// One of that name.
    augment one(name: string) -> Animal
    example rectangle() -> cage() -> a: animal { x: one("x"); y: one("y") } expect x.count = 1, a.out.count = 0
}
*/
#include "animal.h"
#include "zoo.h"
int pcg_zoo_animal(pcg_call *call, struct pcg_zoo_animal *node)
{
    for (pcg_u32 i = 0; i < node->item_count; i++) {
        struct animal *a =
            (struct animal *)pcg_entity_new(call, &pcg_zoo_type_Animal, node->in);
        if (!a)
            return PCG_FAILED;
        a->name = pcg_string(call->run, node->items[i].one.name);
        pcg_set_int(call->run, &a->entity, &node->bars, (pcg_int)((struct cage *)node->in)->bars);
        PCG_TRY(pcg_emit(call, node->items[i].port, &a->entity));
    }
    pcg_note(call, "at %s", node->home == PCG_PLACE_WATER ? "sea" : "home");
    pcg_entity_drop(call->run, node->in);
    return PCG_OK;
}
END
cat >zoo/count.c <<'END'
/*pcg
/// How many bars a cage of that side has.
function bars(side: length) -> int [pure] { example bars(2m) == 20 }
/// How many there are on each square metre of a shape.
function bars(in: Shape, all: vec3) -> vec3 [pure] { example bars(in, [52, 0, 0]).x == 1 }
*/
#include "count.h"
#include "zoo.h"
pcg_int pcg_zoo_fn_bars_length(pcg_call *call, double side)
{
    (void)call;
    return side > 0 && side < 1e6 ? (pcg_int)(10 * side) : 0;
}
void pcg_zoo_fn_bars_Shape_vec3(pcg_call *call, const pcg_shape *s, const pcg_vec3 *all,
                                pcg_vec3 *result)
{
    (void)call;
    *result = vec3_scale(*all, 1 / pcg_shape_area(s));
}
END

strict="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wmissing-prototypes -Werror"
run "$PCGC" library zoo --test --cc "$CC" --cflags "$strict"
expect_code 0 "examples of a library"
expect_out "6 passed, 0 failed"
expect "a test alone writes nothing" test ! -e zoo.so
run "$PCGC" library zoo --cc "$CC" -o zoo.so
expect_code 0 "a library"
expect_empty "$err" "nothing is said of a good library"
expect "its one symbol" test "$(nm -D --defined-only zoo.so | grep -v ' [wWvV] \|asan' | wc -l)" = 1
expect "no other name of the runtime than pcg_" sh -c \
    "! nm -D --undefined-only zoo.so | awk '{print \$NF}' | grep -qE '^(run|arena|vec3|polygon|library)_'"
"$PCGC" library zoo --cc "$CC" -o again.so
# What a sanitizer adds names the place of the sources.
[ -n "$SANITIZE" ] || expect "one source, one library" cmp zoo.so again.so
mkdir elsewhere
(cd elsewhere && "$PCGC" library ../zoo/ --cc "$CC")
[ -n "$SANITIZE" ] || expect "wherever it is built" cmp zoo.so elsewhere/zoo.so
rm -r again.so elsewhere

# ---- using it ----
cat >g.pcg <<'END'
use zoo as z

graph g {
    attr bars: int = 0
    attr density: vec3 = [0, 0, 0]
    out cages: Cage
    out shapes: Shape
    out beasts: Animal
    rectangle(width = 3m) -> home: cage(bars = bars(z.bars(2m) * 1m))
    home -> set { assign(@density, bars(in, [3, 0, 0])) } -> cages
    home -> copy(count = 2) -> extrude(amount = 1m) -> shapes
    home -> a: animal(home = water, bars => @bars) { ox: one("ox"); bee: one("bee") }
    a.ox -> beasts
    a.bee -> beasts
}
END
run "$PCGC" run g.pcg --json --entities -q
expect_code 0 "a graph that uses it"
cp "$out" expected
expect_out '"type":"Cage","count":1,"faces":1'
expect_out '"type":"Animal","count":2'
expect_out '"attributes":{"bars":200,"density":[0, 0, 0]}'
expect_out '"density":[1, 0, 0]'
expect_out '"message":"at sea"'

expect_same() { # WHAT COMMAND…: it prints what the first run did
    what=$1
    shift
    run "$@"
    expect "$what" cmp "$out" expected
}
"$PCGC" g.pcg -o g.so
expect_same "the same from a shared object" "$PCGC" run g.so --json --entities -q
"$PCGC" g.pcg --cc="$CC" -o h.so
expect_same "and from one of a C compiler" "$PCGC" run h.so --json --entities -q
"$PCGC" g.pcg -o program
expect_same "and from an executable" ./program --json --entities -q
"$PCGC" g.pcg --cc="$CC" -o program
expect_same "and from one of a C compiler" ./program --json --entities -q

run "$PCGC" info g.pcg
expect_out "  zoo  ./zoo.so"
run "$PCGC" info g.so
expect_out "  zoo  ./zoo.so"
run "$PCGC" info g.pcg --json
expect "info in JSON" python3 -c "import json; assert json.load(open('$out'))['libraries'][0]['name'] == 'zoo'"
run "$PCGC" --dump=check g.pcg
expect_out "zoo.cage"
run "$PCGC" doc zoo
expect_out "zoo: Animals."
run "$PCGC" doc zoo.animal
expect_out "procedure zoo.animal"
run "$PCGC" doc --use zoo --html
expect_out "Puts animals into cages."

# ---- what check says ----
check() { # the graph's statements
    printf 'use zoo\ngraph c {\n%s\n}\n' "$1" >c.pcg
    run "$PCGC" check c.pcg
}
check 'rectangle() -> animal { one("x") }'
expect_code 1 "a Shape where a Cage is asked for"
expect_err "'rectangle' gives Shape, 'animal' takes Cage [E0301]"
expect_err "= help: insert cage()"
check 'rectangle() -> cagee()'
expect_err "did you mean 'cage'?"
check 'rectangle() -> zoo.cages()'
expect_err "library 'zoo' has no procedure 'cages' [E0119]"
expect_err "did you mean 'cage'?"
check 'rectangle() -> enclosure()'
expect_err "'enclosure' is called 'cage' today [W0505]"
check 'rectangle() -> cage() -> animal(home = wter) { one("x") }'
expect_err "did you mean 'water'?"

cat >part.pcg <<'END'
use zoo
graph part { in lot: Shape; out cage: Cage; lot -> c: cage(); c -> cage }
END
cat >whole.pcg <<'END'
import part from "part.pcg"
graph whole { out all: Shape; rectangle() -> part() -> all }
END
run "$PCGC" run whole.pcg -q
expect_code 0 "a graph that imports one that uses it"
sed -i 's/rectangle()/rectangle() -> cage()/' whole.pcg
run "$PCGC" check whole.pcg
expect_code 1 "what another file uses is not in scope"
expect_err "unknown procedure 'cage' [E0102]"

# ---- where it is looked for ----
mkdir away libs
cp g.pcg g.so program away
mv zoo.so libs
run "$PCGC" check away/g.pcg
expect_code 1 "a library that is not there"
expect_err "unknown library 'zoo' [E0104]"
expect_err "= help: there is none in away, "
run "$PCGC" check -L libs away/g.pcg
expect_code 0 "--library-path"
run env PCG_LIBRARY_PATH=nowhere::libs "$PCGC" run away/g.pcg -q
expect_code 0 "PCG_LIBRARY_PATH"
run "$PCGC" run away/g.so
expect_code 2 "a compiled graph without its library"
expect_err "cannot load 'away/g.so': it needs library 'zoo': there is none in away/"
run "$PCGC" run -L libs away/g.so -q
expect_code 0 "a compiled graph, and --library-path"
run away/program
expect_code 2 "an executable without its library"
expect_err "program: cannot run: it needs library 'zoo'"
run away/program -L libs -q
expect_code 0 "an executable, and -L"
mv libs/zoo.so zoo.so

# ---- hosts ----
cat >host.c <<'END'
#include <pcg/pcg.h>
#include <stdio.h>
static void say(void *user, const pcg_message *m)
{
    (void)user;
    if (m->severity == PCG_ERROR)
        printf("%s\n", m->text);
}
static size_t faces(const pcg_program *p)
{
    pcg_run *r = pcg_run_new(p, NULL);
    size_t count = r && pcg_run_execute(r) == PCG_STATUS_OK ? pcg_run_face_count(r) : 0;
    pcg_run_free(r);
    return count;
}
int main(void)
{
    const char *const paths[] = {"libs", NULL};
    pcg_compile_options o = {.size = sizeof o, .message = say};
    printf("%d\n", pcg_compile_file("away/g.pcg", &o) == NULL);
    printf("%d\n", pcg_program_load("away/g.so", &o) == NULL);
    o.library_paths = paths;
    pcg_program *a = pcg_compile_file("away/g.pcg", &o), *b = pcg_program_load("away/g.so", &o);
    if (!a || !b)
        return 1;
    printf("%zu %zu\n", faces(a), faces(b));
    pcg_program_free(a);
    printf("%zu\n", faces(b));
    pcg_program_free(b);
    for (int i = 0; i < 200; i++)
        pcg_program_free(pcg_compile_file("away/g.pcg", &o));
    FILE *maps = fopen("/proc/self/maps", "r");
    char line[4096];
    int open = 0;
    while (maps && fgets(line, sizeof line, maps))
        for (char *at = line; *at; at++)
            open += at[0] == 'z' && at[1] == 'o' && at[2] == 'o' && at[3] == '.';
    if (maps)
        fclose(maps);
    printf("open: %d\n", open);
    return 0;
}
END
mv zoo.so libs
run "$CC" -std=c11 -Wall -Wextra -Werror -I "$BUILD/include" -o host host.c "$BUILD/libpcg.a" -rdynamic -ldl -lm -lpthread
expect_code 0 "a host compiles"
run ./host
expect_code 0 "a host that names the folder"
expect_out "unknown library 'zoo'"
expect_out "cannot load 'away/g.so': it needs library 'zoo'"
expect_out "13 13"
expect_out "open: 0"
mv libs/zoo.so zoo.so

# ---- built again ----
cp -r zoo zoo2
cat >zoo2/feed.c <<'END'
/*pcg
/// Feeds.
procedure feed(in: Animal) -> (out: Animal) [pure] { category "care"; example impulse() expect count = 1 }
*/
#include "feed.h"
int pcg_zoo_feed(pcg_call *call, struct pcg_zoo_feed *node)
{
    return pcg_emit(call, node->out, node->in);
}
END
"$PCGC" library zoo2 --name zoo --cc "$CC" -o libs/zoo.so
run "$PCGC" run -L libs away/g.so -q
expect_code 0 "what is new in a library does not matter to compiled graphs"
sed -i 's|    param bars: int = 1 .*|&\n    param thick: length = 1m /// How thick.|' zoo2/cage.c
"$PCGC" library zoo2 --name zoo --cc "$CC" -o libs/zoo.so
run "$PCGC" run -L libs away/g.so
expect_code 2 "what has changed does"
expect_err "it was compiled with another version of library 'zoo' than 'libs/zoo.so', which has another 'pcg_zoo_cage'"
sed -i 's|enum Place { land, water }|enum Place { water, land }|' zoo2/library.pcg
cp zoo/cage.c zoo2
"$PCGC" library zoo2 --name zoo --cc "$CC" -o libs/zoo.so
run "$PCGC" run -L libs away/g.so
expect_code 2 "so do enumerators in another order"

# ---- homonyms ----
cat >both.pcg <<'END'
import part from "part.pcg"
use zoo
graph both { rectangle() -> part() -> a: animal { one("x") } }
END
mkdir third
cp libs/zoo.so both.pcg third
sed -i 's|part.pcg|../part.pcg|' third/both.pcg
run "$PCGC" check third/both.pcg
expect_code 1 "one name, two files"
expect_err "library 'zoo' is './zoo.so' for another file, and 'third/zoo.so' for this one [E0123]"
"$PCGC" library zoo2 --name ark --cc "$CC" -o ark.so 2>"$err"
sed 's/pcg_zoo_/pcg_ark_/g' -i zoo2/*.c
run "$PCGC" library zoo2 --name ark --cc "$CC" -o ark.so
expect_code 0 "another library with the same names"
printf 'use zoo\nuse ark\ngraph c { rectangle() -> cage() }\n' >c.pcg
run "$PCGC" check c.pcg
expect_code 1 "two libraries that declare one type"
expect_err "library 'ark' cannot be used beside 'zoo': both have 'Animal' [E0124]"
mkdir farm
printf '/*pcg\n/// Cages.\nprocedure cage(in: Shape) -> (out: Shape) [pure] { category "care"; example rectangle() -> cage() expect count = 1 }\n*/\n#include "cage.h"\nint pcg_farm_cage(pcg_call *c, struct pcg_farm_cage *n)\n{\n    return pcg_emit(c, n->out, (pcg_entity *)n->in);\n}\n' >farm/cage.c
run "$PCGC" library farm --cc "$CC" --test -o farm.so
expect_code 0 "a library with a homonym"
printf 'use zoo\nuse farm\ngraph c { rectangle() -> cage() }\n' >c.pcg
run "$PCGC" check c.pcg
expect_err "'cage' is in the libraries 'zoo' and 'farm' [E0109]"
printf 'use zoo\nuse farm as f\ngraph c { rectangle() -> zoo.cage() -> f.cage() }\n' >c.pcg
run "$PCGC" run c.pcg -q
expect_code 0 "told apart by their libraries"

# ---- files that are no library ----
use_bad() { # WHAT MESSAGE: bad/zoo.so
    printf 'use zoo\ngraph c { rectangle() -> cage() }\n' >bad/c.pcg
    run "$PCGC" run bad/c.pcg
    expect_code 1 "$1"
    expect_err "library 'bad/zoo.so' cannot be used: $2"
}
mkdir bad
echo hello >bad/zoo.so
use_bad "a text file" "it is no shared object"
cp g.so bad/zoo.so
use_bad "a graph" "it is no library that pcgc made"
cp farm.so bad/zoo.so
use_bad "a library of another name" "the library in it is called 'farm'"
for size in 10 100 1000 4096 9000; do
    head -c $size zoo.so >bad/zoo.so
    run "$PCGC" run bad/c.pcg
    expect_code 1 "cut short at $size bytes"
    expect_err "cannot be used: it is"
done
cat >abi.c <<'END'
#include <pcg/library.h>
extern const pcg_library pcg_described;
const pcg_library pcg_described = {.abi = PCG_ABI + 1, .size = sizeof(pcg_library), .name = "zoo"};
END
$CC -shared -fPIC -I "$BUILD/include" -o bad/zoo.so abi.c
use_bad "another ABI" "it was made for interface "
sed -i 's/sizeof(pcg_library)/8/; s/ + 1//' abi.c
$CC -shared -fPIC -I "$BUILD/include" -o bad/zoo.so abi.c
use_bad "another size" "it was made for interface "

# ---- what cannot be built ----
build_bad() { # CODE WHAT MESSAGE…
    run "$PCGC" library worse --name zoo --cc "$CC" -o worse.so
    code_wanted=$1 what=$2
    shift 2
    expect_code "$code_wanted" "$what"
    for message; do
        expect_err "$message"
    done
    expect "nothing is written" test ! -e worse.so
    rm -rf worse
    cp -r zoo worse
}
cp -r zoo worse
sed -i 's/int pcg_zoo_cage(/int pcg_zoo_cag(/' worse/cage.c
sed -i 's/fn_bars_length(pcg/fn_bars_width(pcg/' worse/count.c
build_bad 1 "kernels that are missing" \
    "worse/cage.c:3:11: error: procedure 'cage' is declared, and no file defines 'pcg_zoo_cage' [E0815]" \
    "worse/count.c:3:10: error: function 'bars' is declared, and no file defines 'pcg_zoo_fn_bars_length' [E0815]"
sed -i 's/const pcg_type pcg_zoo_type_Cage/const pcg_type pcg_zoo_type_Cag/' worse/types.c
build_bad 1 "a type that is missing" \
    "worse/library.pcg:7:8: error: entity type 'Cage' is declared, and no file defines 'pcg_zoo_type_Cage' [E0815]"
sed -i 's/, .copy = copy, .drop = drop}/}/' worse/types.c
build_bad 1 "a type that is not copied" "entity type 'Cage' lacks a copy or drop that 'Shape'"
sed -i 's/sizeof(struct cage)/8/' worse/types.c
build_bad 1 "a type that is too small" "entity type 'Cage' is smaller than 'Shape'"
sed -i 's/"Animal", .parent = &pcg_type_entity/"Animal", .parent = \&pcg_type_impulse/' worse/types.c
build_bad 1 "a type of another parent" "entity type 'Animal': its pcg_type is not called so, or does not derive from 'Entity'"
sed -i 's/"Animal", .parent = &pcg_type_entity/"Animal", .parent = \&pcg_type_faced/' worse/types.c
sed -i "s/^entity Animal: Entity/entity Animal: Faced/" worse/*.c worse/library.pcg
build_bad 1 "a type that is neither a shape nor a part of one" "entity type 'Animal' derives from 'Faced': of what has a place only 'Shape' can be derived from"
sed -i 's/node->bars;/node->bras;/' worse/cage.c
sed -i 's/node->home/node->hone/' worse/animal.c
build_bad 1 "C that is wrong" "worse/cage.c:20:" "worse/animal.c:" "bras" "hone"
sed -i 's/pcg_emit(/pcg_emt(/' worse/cage.c
build_bad 1 "a function that is nowhere" "worse/cage.c:22:" "pcg_emt"
printf '#include <pcg/shape.h>\nint secret(void);\nint open(void);\nint open(void)\n{\n    return secret();\n}\n' >worse/more.c
build_bad 1 "a function that nobody defines" "it needs 'secret', which neither it nor this runtime has"
sed -i 's/procedure cage(in: Shape)/procedure cage(in: Shpe)/' worse/cage.c
sed -i 's/^entity Cage: Shape/entity Cage: Shape\n\/\/\/ Twice.\nenum Axis { x }/' worse/library.pcg
build_bad 1 "interfaces that are wrong" "worse/cage.c:3:20: error: unknown type 'Shpe' [E0802]" \
    "worse/library.pcg:9:6: error: 'Axis' is declared twice [E0801]"
sed -i 's/procedure cage(in: Shape)/procedure cage(in Shape)/' worse/cage.c
build_bad 1 "a block that is no interface" "worse/cage.c:3:"
rm worse/*.c
echo 'int x;' >worse/a.c
rm worse/library.pcg
build_bad 1 "a folder without an interface" "no file in 'worse' holds an interface"
sed -i 's/expect faces = 1, count = 1/expect faces = 2, count = 1/' worse/cage.c
run "$PCGC" library worse --name zoo --cc "$CC" --test
expect_code 1 "an example that does not hold"
expect_out "5 passed, 1 failed"
expect_err "worse/cage.c:7: error: example 'zoo_cage_1': expected faces = 2, found 1"

run "$PCGC" library zoo --cc no-such-cc -o no.so
expect_code 1 "no C compiler"
expect_err "there is no C compiler 'no-such-cc': install one (gcc or clang), or name it with --cc"
expect "nothing is left behind" sh -c '! ls -a | grep -q "^no\.so"'
run "$PCGC" library nowhere
expect_code 2 "a folder that is not there"
expect_err "nowhere: No such file or directory"
run "$PCGC" library zoo --name core
expect_code 2 "the name of a library that is built in"
run "$PCGC" library zoo --name no-name
expect_code 2 "a name that is none"
run "$PCGC" library zoo zoo2
expect_code 2 "two folders"
mkdir type
sed 's/farm_cage/type_shape/g; s/cage/shape/g' farm/cage.c >type/shape.c
run "$PCGC" library type --cc "$CC" -o type.so
expect_code 1 "a name of the runtime"
expect_err "'shape' would be 'pcg_type_shape' in C, which is a part of the runtime [E0816]"
done_testing
