"""What the Python scripts of this folder share, as expect.inc for the shell's."""
failed = 0


def report(holds, what, *details):
    """An expectation; `details` explain one that does not hold."""
    global failed
    failed += not holds
    print(("ok " if holds else "not ok ") + what)
    for line in () if holds else map(str, details):
        print("    " + (line if line.isprintable() else repr(line)))


def done_testing():
    raise SystemExit(failed > 0)
