# The chapter on how a graph runs: every command run, what it prints compared.
python3 "$ROOT/tests/documents.py" "$ROOT/docs/how_a_graph_runs.md"
