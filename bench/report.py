"""report.py - what was measured, as a table for people."""


def milliseconds(spread):
    return "%.3g (%.3g-%.3g)" % tuple(1e3 * spread[k] for k in ("median", "least", "most"))


def amount(value):
    return "%.0f" % value if value >= 1000 else "%.3g" % value


def row_of(point, unit):
    label = [point["series"]] if point["series"] else []
    label += ["%s%s" % (format(point["size"], ","), " " + unit if unit else "")] if point["size"] is not None else []
    label += ["%d thr." % point["threads"]] if point["threads"] else []
    rows = []
    for number, (name, side) in enumerate(point["sides"].items()):
        faces = side["counts"].get("faces", 0)
        rows.append((", ".join(label) if number == 0 else "", name, milliseconds(side["wall"]),
                     milliseconds(side["cpu"]),
                     "%.3g (%.3g-%.3g)" % tuple(point["ratio"]["cpu"][k] for k in ("median", "least", "most"))
                     if number == 0 and "ratio" in point else "",
                     "%.1f" % (side["memory"]["median"] / (1 << 20)),
                     amount(side["memory"]["median"] / faces) if faces >= 1000 else "",
                     "%.3g+%.3g" % (1e3 * side["user"]["median"], 1e3 * side["system"]["median"])
                     if "user" in side else ""))
    return rows


HEADS = ("", "", "wall ms", "cpu ms", "cpu ratio", "MiB", "B/face", "process user+system ms")


def lines_of(rows):
    widths = [max(len(r[i]) for r in rows) for i in range(len(rows[0]))]
    for row in rows:
        cells = [cell.ljust(w) if i < 2 else cell.rjust(w) for i, (cell, w) in enumerate(zip(row, widths))]
        yield "  " + "  ".join(cells).rstrip()


def figure_line(figure):
    aim = ""
    if figure["aim"] is not None:
        aim = "   aim: at %s %s, %s" % ("least" if figure["at_least"] else "most", amount(figure["aim"]),
                                        "reached" if figure["met"] else "not reached")
    return "  %-72s %8s %-5s%s" % (figure["what"], amount(figure["value"]), figure["unit"], aim)


def table(document):
    """Medians of so many runs, with the least and the most."""
    out = ["medians of %d (least-most); %d processors" % (document["runs"], document["machine"]["processors"])]
    for w in document["workloads"]:
        out += ["", "%s  %s" % (w["name"], w["title"]), ""]
        out += lines_of([HEADS] + [row for p in w["points"] for row in row_of(p, w["unit"])])
        out += [""] + [figure_line(f) for f in w["figures"]]
    return "\n".join(out)
