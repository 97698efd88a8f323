# The manuals, followed to the letter: every file in them is written, every command run, every graph checked.
python3 "$ROOT/tests/documents.py" "$ROOT/docs/tutorial.md" "$ROOT/docs/language.md" "$ROOT/docs/embedding.md" "$ROOT/docs/seeing.md" "$ROOT/docs/debugging.md" \
    "$ROOT/README.md"
