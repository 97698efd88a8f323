# docs/libraries.md, followed to the letter.
python3 "$ROOT/tests/documents.py" "$ROOT/docs/libraries.md"
