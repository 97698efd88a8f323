# pcgc doc: entries, lists, search, and the whole reference in every form.
. "$ROOT/tests/tool/expect.inc"

run "$PCGC" doc extrude
expect_code 0 "an entry"
expect_out "procedure geometry.extrude"
expect_out "extrude<T: Faced>(in: T) -> (out: T)"
expect_out "amount: length = 1m"
expect_out "Examples"
expect_empty "$err" "an entry says nothing on stderr"

run "$PCGC" doc geometry.extrude
expect_code 0 "an entry by library and name"
expect_out "procedure geometry.extrude"

run "$PCGC" doc core.min
expect_out "min(a: int, b: int) -> int"
expect_out "min(a: length, b: length) -> length"

run "$PCGC" doc Shape
expect_out "entity geometry.Shape"
run "$PCGC" doc Axis
expect_out "enum geometry.Axis"

run "$PCGC" doc
expect_code 0 "the list"
expect_out "core: "
expect_out "geometry: "
expect_out "extrude"

run "$PCGC" doc dynamic
expect_code 0 "what the compiler itself declares"
expect_out "procedure core.dynamic"

run "$PCGC" doc core
expect_code 0 "one library"
expect_out "order_by"
expect "the list of one library holds no other" sh -c "! grep -q extrude '$out'"

run "$PCGC" doc --search sort
expect_code 0 "search by synonym"
expect_out "order_by"
run "$PCGC" doc -s "NUMBERS list"
expect_out "count"

run "$PCGC" doc extrud
expect_code 1 "a name that is not there"
expect_err "did you mean 'extrude'?"
expect_empty "$out" "a name that is not there prints nothing on stdout"
run "$PCGC" doc --search extrud
expect_code 0 "a part of a name"
run "$PCGC" doc --search qqqqqqqq
expect_code 1 "a word that is nowhere"
expect_err "pcgc doc lists everything"

run "$PCGC" doc --search ""
expect_code 2 "an empty search"
run "$PCGC" doc --html --json
expect_code 2 "two forms"
run "$PCGC" doc --html extrude
expect_code 2 "a page of one entry"

run "$PCGC" doc --json
expect_code 0 "JSON"
expect "JSON is JSON" python3 -c "
import json
entries = json.load(open('$out'))['entries']
extrude = [e for e in entries if e['name'] == 'extrude'][0]
assert extrude['parameters'][0]['type'] == 'length'
assert extrude['examples'] and extrude['file'] == 'geometry/extrude.c' and extrude['line'] > 0
assert all(e['summary'] for e in entries)
"
run "$PCGC" doc extrude --json
expect_out '"name": "extrude"'

run "$PCGC" doc --html
expect_code 0 "HTML"
expect "every element of the page is closed" python3 - "$out" <<'END'
import html.parser
import sys


class Checker(html.parser.HTMLParser):
    open_tags = []
    void = {"meta", "input", "link", "br", "img", "html", "!doctype", "body"}

    def handle_starttag(self, tag, attributes):
        if tag not in self.void:
            self.open_tags.append(tag)

    def handle_endtag(self, tag):
        if tag not in self.void:
            assert self.open_tags.pop() == tag, (tag, self.getpos())


checker = Checker()
checker.feed(open(sys.argv[1], encoding="utf-8").read())
assert not checker.open_tags, checker.open_tags
END
expect "links lead to entries" python3 - "$out" <<'END'
import re
import sys

page = open(sys.argv[1], encoding="utf-8").read()
ids = re.findall(r'id="([^"]*)"', page)
assert len(ids) == len(set(ids)) > 50
assert set(re.findall(r'href="#([^"]*)"', page)) == set(ids)
END

run "$PCGC" doc --markdown
expect_code 0 "Markdown"
expect_out "#### extrude"
expect "code blocks come in pairs" python3 -c "
assert open('$out', encoding='utf-8').read().count('\n\`\`\`') % 2 == 0"

run "$PCGC" doc closest
expect_code 0 "a synonym"
expect_out "procedure geometry.nearest"

run "$PCGC" doc closet
expect_code 1 "what is nearly a synonym"
expect_err "nothing is called 'closet', did you mean 'closest'?"

done_testing
