# Completion and the manual page, which are made from the same tables as --help.
. "$ROOT/tests/tool/expect.inc"

mkdir bin folder
ln -s "$PCGC" bin/pcgc
PATH=$PWD/bin:$PATH
cat >tower.pcg <<'END'
graph tower {
    /// Of the walls.
    param height: length = 30m range [6m, 200m]
    param round: bool = false
    param along: Axis = x
    rectangle() -> extrude(amount = round ? height : 2m)
}
END
pcgc tower.pcg -o tower.so

# complete WORD…: what a real bash makes of `pcgc WORD…` with the cursor behind the last one; '=' and
# ':' are words of their own, as bash hands them over.
cat >complete.bash <<'END'
source <(pcgc completion bash)
compopt() { :; }
COMP_WORDS=(pcgc "$@")
COMP_CWORD=$#
_pcgc pcgc "${@: -1}" "${@: -2:1}"
printf '%s\n' "${COMPREPLY[@]}"
END
complete() {
    run bash complete.bash "$@"
}
expect_line() {
    grep -qxF -- "$1" "$out"
    result $? "completed: $1"
}
expect_no_line() {
    ! grep -qxF -- "$1" "$out"
    result $? "not completed: $1"
}

complete ru
expect_line run
expect_no_line check
complete ""
expect_line check
expect_line completion
expect_line tower.pcg
complete run to
expect_line tower.pcg
expect_line tower.so
complete run --
expect_line --parameter
expect_line --max-seconds
expect_line --message-format
complete run --max
expect_line --max-rounds
expect_no_line --output
complete run tower.pcg -p ""
expect_line height=
expect_line round=
complete debug tower.pcg -x bre
expect_line break
expect_no_line back
complete run tower.pcg -p hei
expect_line height=
expect_no_line round=
complete run tower.so -p al
expect_line along=
complete run tower.pcg -p round =
expect_line true
expect_line false
complete run tower.pcg -p round = f
expect_line false
expect_no_line true
complete run tower.pcg -p along = ""
expect_line x
expect_line z
complete run tower.pcg -o to
expect_line tower.so
complete run --message-format = j
expect_line json
complete run --message-format t
expect_line text
complete check -I fo
expect_line folder
expect_no_line tower.pcg
complete --du
expect_line --dump
complete help ch
expect_line check
complete completion ""
expect_line bash
expect_line zsh
complete run nothing.pcg -p ""
expect_empty "$err" "a graph that is not there completes to nothing, silently"

run pcgc completion fish
expect_code 2 "a shell that is not known"
expect_err "there is bash and zsh, not 'fish'"
pcgc completion bash >completion.bash
run bash -n completion.bash
expect_code 0 "bash reads the script"
pcgc completion zsh >_pcgc
expect "the script for zsh says what it completes" grep -q '^#compdef pcgc$' _pcgc
if command -v zsh >/dev/null; then
    run zsh -n _pcgc
    expect_code 0 "zsh reads its script"
else
    echo "ok zsh is not installed: its script was not read"
fi

# Every option of --help is in the manual page.
pcgc --manual >pcgc.1
for command in "" run check info doc bench; do
    pcgc $command --help | sed -n 's/^  .*--\([a-z-]*\).*/\1/p' | grep -v '^help$' >options
    expect "pcgc $command has options" [ -s options ]
    missing=
    while read -r option; do
        written=$(printf '%s' "$option" | sed 's/-/\\-/g')
        grep -qF -- "\\-\\-$written" pcgc.1 || missing="$missing $option"
    done <options
    expect "the manual page has all options of 'pcgc $command'" [ -z "$missing" ]
done
if command -v man >/dev/null; then
    run env LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z pcgc.1
    expect_code 0 "man formats the page"
    expect_empty "$err" "without a warning"
else
    echo "ok man is not installed: the page was not formatted"
fi
if command -v mandoc >/dev/null; then
    run mandoc -Tlint -W warning pcgc.1
    expect_empty "$out" "mandoc finds nothing wrong"
else
    echo "ok mandoc is not installed: the page was not checked"
fi
done_testing
