# Texts that are too large to keep, or that only a machine would write: each ends in a located message.
. "$ROOT/tests/tool/expect.inc"

repeat() { # repeat COUNT TEXT
    awk -v count="$1" -v text="$2" 'BEGIN { for (i = 0; i < count; i++) printf "%s", text }'
}

{ printf 'graph g { '; repeat 1250000 'a -> b; '; printf 'a => b }\n'; } >line.pcg
run "$PCGC" check line.pcg
expect_code 1 "a line of 10 MB with an error at its end"
expect_err "line.pcg:1:10000013: error: found '=>', expected the end of the line, '->', ':' or '(' [E0010]"
expect "the excerpt of a long line is short" [ "$(wc -c <"$err")" -lt 1000 ]

{ printf 'graph g {\n'; repeat 100000 'a b c
'; printf '}\n'; } >errors.pcg
run "$PCGC" check errors.pcg
expect_code 1 "100,000 errors"
expect_err "99900 more are not shown"

repeat 1000000 '(' >open.pcg
run "$PCGC" check open.pcg
expect_code 1 "a million parentheses"
expect_err "open.pcg:1:201: error: nested more than 200 levels deep [E0012]"

{ printf 'graph g { const a = '; repeat 1000000 '-'; printf '1 }\n'; } >signs.pcg
run "$PCGC" check signs.pcg
expect_code 1 "a million signs"
expect_err "error: nested more than 1000 levels deep [E0012]"

{ printf 'graph g { a'; repeat 100000 ' -> a'; printf ' => }\n'; } >chain.pcg
run "$PCGC" check chain.pcg
expect_code 1 "a chain of 100,000 elements"
expect_err "chain.pcg:1:500013: error: found '=>'"

repeat 68000 '//                                                                                                  
' | awk '{ for (i = 0; i < 10; i++) print }' >large.pcg
run "$PCGC" check large.pcg
expect_code 2 "a file beyond the limit"
expect_err "large.pcg"

head -c 100000 "$PCGC" >binary.pcg
run "$PCGC" check binary.pcg
expect_code 1 "a program"
expect_err "a NUL byte in the text: this is no text file, or a damaged one [E0002]"

: >empty.pcg
run "$PCGC" --dump=parse empty.pcg
expect_code 0 "an empty file is a text"
# ---- bytes of no text end in one error, not in one a line ----
printf 'graph \001\377 a\n&\377\n(\002\n' >bytes.pcg
run "$PCGC" check bytes.pcg
expect_code 1 "bytes of no text"
expect_err "bytes.pcg:1:8: error: this is not UTF-8: byte 0xff [E0003]"
expect_err "1 file checked: 1 error, 0 warnings"

done_testing
