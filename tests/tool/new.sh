# pcgc new, and what pcgc run means in a folder.
. "$ROOT/tests/tool/expect.inc"

run "$PCGC" new hello
expect_code 0 "a project"
expect_err "cd hello"
run sh -c 'cd hello && "$0" check hello.pcg' "$PCGC"
expect_err "0 errors, 0 warnings"
run sh -c 'cd hello && "$0" run' "$PCGC"
expect_code 0 "and what it makes"
expect_err "hello.glb"
expect_err "pcgc run --seed 7"
expect_err "pcgc run -p side="
expect "a model" sh -c 'head -c 4 hello/hello.glb | grep -q glTF'
case " $LEFT_OUT " in
*" png "*) ;;
*) expect "a picture" sh -c 'head -c 4 hello/hello.png | grep -q PNG' ;;
esac
rm hello/hello.glb
run sh -c 'cd hello && "$0" run -p side=3 --json' "$PCGC"
expect_out '"graph":"hello"'
expect "options say what is written" test ! -e hello/hello.glb
run "$PCGC" new hello
expect_code 2 "what is there stays"
expect_err "there is one of that name"
run "$PCGC" new
expect_code 2 "without a name"
run "$PCGC" new "it's"
expect_code 2 "a name that no graph can have"
run "$PCGC" new none/hello
expect_code 2 "in a folder that is not there"
for name in my-town true 7up "Grüße"; do
    run "$PCGC" new "$name"
    expect_code 0 "a project called $name"
    run sh -c 'cd "$1" && "$0" run -q --node rim' "$PCGC" "$name"
    expect_code 0 "runs"
done

mkdir one two
printf 'graph only { box() }\n' >one/only.pcg
cp one/only.pcg two/first.pcg
cp one/only.pcg two/second.pcg
run sh -c 'cd one && "$0" run --json' "$PCGC"
expect_out '"graph":"only"'
run sh -c 'cd two && "$0" run' "$PCGC"
expect_code 2 "several files, none of which is the folder's"
expect_err "which file?"

done_testing
