"""Compares two runs of portable-roots: do they find the same roots with the same certificates?

    compare.py [--identical] EXPECTED OTHER
    compare.py --self-test EXPECTED

Two certificates are of the same root only if all their discs meet. Each proves that its root lies in its own discs, and
is the only one near. So every disc of a root has to meet that of its partner, and partners are unique. The statements
about the problem are equal: the numbers of roots, certified, real and unproved ones, whether all are accounted for, the
count of poses. Roots without a certificate are compared to `ROUNDING`. --identical: not a bit differs.
"""

import sys

# of a root without certificate, relative to the larger of 1 and the number: half the digits of a double
ROUNDING = 2.0**-26


class Differs(Exception):
    pass


def read(text):
    problems = {}
    for line in text.splitlines():
        words, _, discs = line.partition(" | ")
        kind, *facts = words.split()
        if kind == "problem":
            roots = problems.setdefault(facts[0], (facts[1:], []))[1]
        else:
            numbers = discs.split()
            triples = [numbers[i : i + 3] for i in range(0, len(numbers), 3)]
            roots.append((facts, [(complex(float(x), float(y)), None if r == "-" else float(r)) for x, y, r in triples]))
    return problems


def meet(one, other):
    (a, r), (b, s) = one, other
    if (r is None) != (s is None):
        return False
    slack = ROUNDING * max(1.0, abs(a)) if r is None else r + s
    # the sum and the difference are rounded
    return abs(a - b) <= slack * (1 + 2.0**-48)


def compare(expected, other):
    """Raises Differs, else gives the largest distance of partners relative to the larger of 1 and the number."""
    expected, other = read(expected), read(other)
    if not expected or list(expected) != list(other):
        raise Differs(f"problems {list(expected)} against {list(other)}")
    largest = 0.0
    for name, (facts, roots) in expected.items():
        others_facts, others = other[name]
        if facts != others_facts or len(roots) != len(others):
            raise Differs(f"{name}: {facts}, {len(roots)} roots, against {others_facts}, {len(others)} roots")
        free = list(range(len(others)))
        for i, (said, discs) in enumerate(roots):
            partners = [k for k in free if said == others[k][0] and all(map(meet, discs, others[k][1]))]
            if len(partners) != 1:
                raise Differs(f"{name}: root {i} {said} has {len(partners)} partners")
            free.remove(partners[0])
            pairs = zip(discs, others[partners[0]][1])
            largest = max([largest, *(abs(a - b) / max(1.0, abs(a)) for (a, _), (b, _) in pairs)])
    return largest


def self_test(text):
    """The comparison can fail: a moved root, a lost one, one found twice, another verdict, a lost certificate."""
    lines = text.splitlines(keepends=True)
    k = next(i for i, line in enumerate(lines) if line.startswith("root"))
    words = lines[k].split(" ")
    first = words.index("|") + 1

    def changed(at, word):
        return " ".join(words[:at] + [word] + words[at + 1 :])

    real = "real=NonReal" if "real=Real" in lines[k] else "real=Real"
    faults = {
        "a root moved by 1e-9": lines[:k] + [changed(first, repr(float(words[first]) + 1e-9))] + lines[k + 1 :],
        "a root lost": lines[:k] + lines[k + 1 :],
        "a root twice": lines[: k + 1] + [lines[k]] + lines[k + 2 :],
        "another verdict": lines[:k] + [changed(1, real)] + lines[k + 1 :],
        "a certificate lost": lines[:k] + [changed(first + 2, "-")] + lines[k + 1 :],
        "a count": [lines[0].replace("unproved=", "unproved=1"), *lines[1:]],
    }
    compare(text, text)
    for fault, lines in faults.items():
        try:
            compare(text, "".join(lines))
        except Differs:
            continue
        sys.exit(f"the comparison does not see {fault}")
    print(f"the comparison sees {', '.join(faults)}")


def main(arguments):
    options = [a for a in arguments if a.startswith("--")]
    texts = [open(a, encoding="utf-8").read() for a in arguments if not a.startswith("--")]
    if "--self-test" in options:
        return self_test(*texts)
    if "--identical" in options and texts[0] != texts[1]:
        sys.exit("the same kind of processor gives other bits")
    try:
        largest = compare(*texts)
    except Differs as difference:
        sys.exit(str(difference))
    roots = sum(len(roots) for _, roots in read(texts[0]).values())
    how = "bit by bit" if texts[0] == texts[1] else f"largest distance {largest:.1e}"
    print(f"   {len(read(texts[0]))} problems, {roots} roots, the same certificates, {how}")


main(sys.argv[1:])
