"""The words of the project: spelling and house rules, in Markdown, in the documentation of the code and in the texts of the program.

    python tests/prose/check.py [FILE..]      default: every file of the project that has texts
    python tests/prose/check.py --planted     planted faults, each of which has to be found

words.txt has the words that only this project knows, terms.txt the names that are not used for a thing and the one that is.
not-yet.txt has the pages of the documentation whose sentences are not measured yet.
"""

import argparse
import pathlib
import re
import sys

from spellchecker import SpellChecker

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
MARKDOWN = ["*.md", "docs/*.md", "docs/guides/*.md", "docs/theory/*.md", "designs/*.md", "tests/*/README.md"]
SOURCES = ["src/**/*.rs", "examples/*.rs"]
PAGE = ["src/app/page/web/*.js", "src/app/page/web/*.html"]

# pages whose sentences are measured: the documentation that people write
MEASURED = ["README.md", "CONTRIBUTING.md", "docs/**/*.md"]
GENERATED = ["docs/answers.md"]
WIDEST = 120  # characters of a line of a comment
LONGEST, MEAN, NEGATED = 35, 18, 0.12  # words of one sentence; words and share of negations over all pages
NEGATION = re.compile(r"\b(?:no|not|none|never|nothing|neither|nor|nobody|nowhere|without|cannot|\w+n't)\b", re.I)
OPENING = re.compile(r"^[\"'(*_]*(?:What\b(?!.*\?)|Where\b(?!.*\?)|Of\b|That of\b|Those of\b)")

# words with a full stop that end no sentence
ABBREVIATIONS = {
    "al", "cf", "ch", "conf", "dept", "e.g", "ed", "eq", "eqs", "fig", "i.e", "inf", "int", "mech", "mach", "no", "nos", "p", "pp", "proc", "rev",
    "sec", "secs", "symp", "th", "trans", "vol", "vs",
}  # fmt: skip
# verbless heads of paragraphs: the sentence that follows a colon needs a subject
LABELS = re.compile(
    r"^\*?(Asked|Came out|Found first|Had to give|Workshop|Code|Tests?|Commands?|Command line|Keys|Library|Wanted|Needed)\*?:"
)
ELLIPSIS = re.compile(r"\u2026|(?<![./])\.{2,}(?![./\w])")
BRITISH = re.compile(
    r"\b(behavior|color(?:s|ed|ing)?|center(?:s|ed|ing)?|neighbor\w*|(?:normal|maxim|minim|general|linear|factor|initial|recogn)iz(?:e|ed|es|ing|ation)"
    r"|optimiz(?:ed|es|ing|ation|ations)|meters?|gray|analyz\w*)\b"
)


def entries(name):
    lines = (HERE / name).read_text(encoding="utf-8").splitlines()
    return [line.strip() for line in lines if line.strip() and not line.startswith("#")]


TERMS = [(re.compile(rf"\b(?:{a.strip()})\b", re.I), b.strip()) for a, b in (e.split("=>") for e in entries("terms.txt"))]
SPELLER = SpellChecker(language="en", distance=1)
SPELLER.word_frequency.load_words(w.lower() for w in entries("words.txt"))


def masked(text):
    """The text with code, addresses and formulas replaced by a mark that is no word."""
    text = re.sub(r"``.*?``|`[^`]*`", "\u00a7", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"https?://\S+|<[^>\s][^>]*>", "\u00a7", text)


def ends(text):
    """The places in a line between two sentences."""
    found = []
    for end in re.finditer(r"[.?!][\"')\]*_]* +(?=[\"'(\[*_]*[A-Z\u00a7])", text):
        before = re.search(r"[\w.-]*$", text[: end.start()]).group(0)
        initial = re.fullmatch(r"(?:[A-Z]\.-?)*[A-Z]", before) and text[end.start()] == "."
        if before.lower().strip(".-") in ABBREVIATIONS or initial or before.endswith("."):
            continue
        found.append(end.start())
    return found


def spelling(text):
    words = re.findall(r"[^\W\d_]+(?:'[a-z]+)?", text)
    plain = {re.sub(r"'s?$", "", w) for w in words if len(w) > 3 and not re.search(r"[a-z][A-Z]", w)}
    unknown = SPELLER.unknown(w.lower() for w in plain)
    return sorted(w for w in plain if w.lower() in unknown)


def words_of(text):
    """Faults of the words of a text without code: (rule, what)."""
    found = [("spelling", w) for w in spelling(text)]
    text = re.sub(r"(?<![*\w])\*(?=[^*\s])(?:[^*]*\s){3}[^*]*\*", "\u00a7", text)  # titles keep the words of their authors
    found += [("British spelling", m.group(0)) for m in BRITISH.finditer(text)]
    for synonym, term in TERMS:
        found += [("one term per thing", f"`{m.group(0)}`: say `{term}`") for m in synonym.finditer(text)]
    return found


def blocks(text):
    """Lines of Markdown by kind: (number, kind, text without the mark of a list)."""
    fence = generated = False
    blank, depth = True, 0
    for number, line in enumerate(text.splitlines(), 1):
        bare = line.strip()
        indent = len(line) - len(line.lstrip())
        if bare.startswith("```"):
            fence = not fence
            kind = "code"
        elif fence:
            kind = "code"
        elif bare.startswith("<!--"):
            generated = bare.startswith("<!-- options of")
            kind = "code"
        elif generated:
            kind = "code"
        elif not bare:
            kind = "blank"
        elif blank and indent >= depth + 4 or (blank == "code" and indent >= 4):
            kind = "code"
        elif bare.startswith("|"):
            kind = "table"
        elif bare.startswith("#"):
            kind, depth = "head", 0
        elif bare.startswith("!["):
            kind = "picture"
        else:
            kind = "prose"
            mark = re.match(r"(?:[-*+]|\d+[.)]) +", bare)
            if mark:
                depth, bare, kind = indent + len(mark.group(0)), bare[mark.end() :], "item"
            elif indent == 0:
                depth = 0
        blank = True if kind == "blank" else "code" if kind == "code" and not fence else False
        yield number, kind, bare


def markdown(text):
    """Faults of a page: (line, rule, what)."""
    found = []
    lines = list(blocks(text))
    for at, (number, kind, bare) in enumerate(lines):
        if kind in ("blank", "code"):
            continue
        plain = masked(bare)
        found += [(number, *f) for f in words_of(plain)]
        if kind in ("prose", "item"):
            found += [(number, "one sentence a line", plain[max(0, e - 30) : e + 20]) for e in ends(plain)]
            if LABELS.match(plain):
                found.append((number, "a sentence has a subject", plain[:40]))
            if ELLIPSIS.search(plain):
                found.append((number, "no ellipses", plain[:60]))
            after = next((k for _, k, _ in lines[at + 1 :] if k != "blank"), "head")
            last = at + 1 == len(lines) or lines[at + 1][1] != "prose"
            lead = after in ("code", "table", "item", "picture")
            short = kind == "item" and len(plain.split()) < 12
            if last and not lead and not short and not re.search(r"[.?!:;,][\"')*\]]*$|\[\]$", plain):
                found.append((number, "a sentence ends", plain[-40:]))
    first = [(k, b) for _, k, b in lines if k != "blank"][:2]
    if len(first) < 2 or first[0][0] != "head" or first[1][0] != "prose" or len(masked(first[1][1]).split()) < 6:
        found.append((1, "a page begins with a sentence that says what it is for", first[-1][1][:60]))
    return found


def sentences(text):
    """Sentences of a page outside code, tables, headings and generated parts: (line, sentence, number of words)."""
    for number, kind, bare in blocks(text):
        if kind not in ("prose", "item"):
            continue
        plain = masked(bare)
        cuts = [0, *(end + 1 for end in ends(plain)), len(plain)]
        for sentence in (plain[a:b].strip() for a, b in zip(cuts, cuts[1:])):
            words = len(re.findall(r"[\w\u00a7][\w\u00a7'.^/-]*", sentence))
            if words >= 3:
                yield number, sentence, words


def measured(text):
    """Faults of single sentences: (line, rule, what)."""
    found = []
    for number, sentence, words in sentences(text):
        if words > LONGEST:
            found.append((number, f"a sentence of at most {LONGEST} words", f"{words}: {sentence[:60]}"))
        if OPENING.match(sentence):
            found.append((number, "a sentence begins with its subject", sentence[:60]))
    return found


def together(texts):
    """Faults of many pages together: (rule, what)."""
    all_of_them = [(sentence, words) for text in texts for _, sentence, words in sentences(text)]
    count = max(len(all_of_them), 1)
    mean = sum(words for _, words in all_of_them) / count
    share = sum(bool(NEGATION.search(sentence)) for sentence, _ in all_of_them) / count
    found = [("a mean of at most %d words" % MEAN, f"{mean:.1f} words")] if mean > MEAN else []
    if share > NEGATED:
        found.append((f"at most {NEGATED:.0%} of negations", f"{share:.1%} of {count} sentences"))
    return found


def pages_to_measure():
    """Pages whose sentences are measured, and those of not-yet.txt."""
    waiting = {ROOT / name for name in entries("not-yet.txt")}
    pages = {page for pattern in MEASURED for page in ROOT.glob(pattern)} - {ROOT / name for name in GENERATED}
    return sorted(pages - waiting), sorted(waiting)


def comment(said):
    """Faults of a line of a comment in prose: (rule, what)."""
    plain = masked(said)
    starts = [0, *(end + 1 for end in ends(plain))]
    return [("a sentence begins with its subject", plain[a:].strip()[:60]) for a in starts if OPENING.match(plain[a:].strip())]


def rust(text):
    """Faults of the documentation comments and of the texts of a source file: (line, rule, what)."""
    found = []
    text = re.split(r"#\[cfg\(test\)\]\s*mod tests \{", text)[0]
    fence, head = False, []
    for number, line in enumerate(text.splitlines(), 1):
        said = re.match(r"\s*//[/!]? ?(.*)", line)
        if said:
            said = said.group(1)
            if said.strip().startswith("```"):
                fence = not fence
            elif not fence:
                if re.match(r"//!", line) and (not head or head[-1][0] == number - 1) and said.strip():
                    head.append((number, said))
                plain = masked(re.sub(r"\[`[^`]*`\](?:\([^)]*\))?", "\u00a7", said))
                plain = re.sub(r"\$[^$]*\$|^ {4}.*|^\s*\|.*|`.*$", "", plain)  # the rest of a code span over two lines
                found += [(number, *f) for f in words_of(re.sub(r"\b\w*[_\d]\w*\b|\w+\.\w+", "", plain))]
                if len(line) > WIDEST and not re.match(r"\s*\||# mod ", said):
                    found.append((number, f"a comment of at most {WIDEST} characters", f"{len(line)}"))
                if "|" not in said and not said.startswith("    "):
                    found += [(number, *f) for f in comment(said)]
                if LABELS.match(plain):
                    found.append((number, "a sentence has a subject", plain[:40]))
            continue
        fence = False
        for literal in re.findall(r'"((?:[^"\\]|\\.)*)"', re.sub(r"//.*$", "", line)):
            if len(re.findall(r"\b[a-z]{2,} [a-z]{2,}", literal)) >= 2 and "<" not in literal:
                plain = re.sub(r"\{[^}]*\}|`[^`]*`|--\w[\w-]*|\\.|\b\w*[_\d/]\w*\b|\w+\.\w+|\w+::\w+", "\u00a7", literal)
                found += [(number, *f) for f in words_of(plain)]
    if head and not re.search(r"[.?!:,][\"')`]*$", head[-1][1].strip()):
        found.append((head[-1][0], "a sentence ends", head[-1][1][-40:]))
    return found


def page(text):
    """Faults of the comments and texts of the page, a script or HTML: (line, rule, what)."""
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        if re.match(r"\s*(?://|/\*\*?|\*) ", line):
            said = [re.sub(r"^\s*\S+ ", "", line)]
        elif re.search(r"</?[a-z]+[ >]", line):
            said = [re.sub(r"<[^>]*>?|&\w+;", "\u00a7", line)]
        else:
            said = re.findall(r'"([^"]*)"|`([^`]*)`', line)
            said = [s for pair in said for s in pair if len(re.findall(r"\b[a-z]{2,} [a-z]{2,}", s)) >= 2]
        for text in said:
            plain = re.sub(r"\$\{.*?\}|`[^`]*`|\b\w*[_\d/(]\w*\b|\w+\.\w+|\S*[={}]\S*", "\u00a7", text)
            found += [(number, *f) for f in words_of(plain)]
    return found


def judge(path):
    return {".md": markdown, ".rs": rust}.get(path.suffix, page)


def check(paths):
    faults = 0
    pages, _ = pages_to_measure()
    for path in paths:
        text = path.read_text(encoding="utf-8")
        for line, rule, what in judge(path)(text) + (measured(text) if path in pages else []):
            faults += 1
            print(f"{path.relative_to(ROOT) if path.is_relative_to(ROOT) else path}:{line}: {rule}: {what}")
    return faults


def alone(text):
    """The faults that a page would have if it were the only one: (line, rule, what)."""
    return [(1, *fault) for fault in together([text])]


PLANTED = [
    (markdown, "spelling", "# A\n\nThis page describes the platfrom and its legs.\n"),
    (markdown, "British spelling", "# A\n\nThis page describes the color of the platform.\n"),
    (markdown, "one term per thing", "# A\n\nThis page describes the direct kinematics of a platform.\n"),
    (markdown, "one sentence a line", "# A\n\nThis page describes the legs of it. The joints come later.\n"),
    (markdown, "one sentence a line", "# A\n\nThis page describes the legs `a`. `b` comes later.\n"),
    (markdown, "a sentence has a subject", "# A\n\nThis page describes the legs of it.\n*Had to give:* the stroke.\n"),
    (markdown, "no ellipses", "# A\n\nThis page describes legs, joints, poses ...\n"),
    (markdown, "no ellipses", "# A\n\nThis page describes (legs, joints, poses ..) of platforms.\n"),
    (markdown, "a sentence ends", "# A\n\nThis page describes the legs of a platform\n\nIt has joints.\n"),
    (markdown, "a page begins with a sentence that says what it is for", "# A\n\n| a | b |\n|---|---|\n"),
    (markdown, "a page begins with a sentence that says what it is for", "# A\n\n## Legs\n\nThe platform has six legs and joints.\n"),
    (measured, "a sentence of at most 35 words", "# A\n\nThis page has" + " a leg and" * 12 + " a joint.\n"),
    (measured, "a sentence begins with its subject", "# A\n\nWhat the search finds is a platform.\n"),
    (measured, "a sentence begins with its subject", "# A\n\n* Of two legs the shorter one is meant.\n"),
    (measured, "a sentence begins with its subject", "# A\n\nIt has legs.\nThose of the base are long.\n"),
    (alone, "a mean of at most 18 words", "# A\n\nThis page has" + " a leg and" * 6 + " a joint.\n"),
    (alone, "at most 12% of negations", "# A\n\nThis page has no legs.\nIt has six joints.\n"),
    (rust, "spelling", "//! The pose of a platfrom.\n"),
    (rust, "spelling", 'fn f() { g("the leg of the platfrom is too long") }\n'),
    (rust, "one term per thing", "/// The direct kinematics of a platform.\nfn f() {}\n"),
    (rust, "a sentence ends", "//! The pose of a platform\n\nfn f() {}\n"),
    (rust, "a sentence has a subject", "/// Wanted: all poses.\nfn f() {}\n"),
    (rust, "a comment of at most 120 characters", "/// The pose of a platform" + " and a pose" * 10 + ".\n"),
    (rust, "a sentence begins with its subject", "/// What a platform does.\nfn f() {}\n"),
    (rust, "a sentence begins with its subject", "/// The legs of a platform. Of these all are kept.\nfn f() {}\n"),
    (page, "spelling", '$("words").textContent = "the legs of the platfrom hold it here";\n'),
    (page, "one term per thing", "<p>The direct kinematics of a platform.</p>\n"),
]
SOUND = [
    (markdown, "# A\n\nThis page, by N. Rojas and J.-C. Latombe (sec. 5, Fig. 2), has one formula:\n\n    a. B. C\n\n* one\n* two\n"),
    (measured, "# A\n\nWhat is a leg?\n\n| Of | what |\n\n    Where this is code\n\nIt has" + " legs" * 33 + ".\n"),
    (alone, "# A\n\nThis page has six legs and not five.\n" + "It has six joints.\n" * 9),
    (page, '  const plane = `${platfrom} of ${legs} holds it here`;\n'),
    (rust, '//! The pose of a platform.\n\n/// The `platfrom` of a design.\nfn f() { g("a..b") }\n'),
]


def planted():
    missed = 0
    for judged, rule, text in PLANTED:
        if rule not in {r for _, r, _ in judged(text)}:
            missed += 1
            print(f"planted fault not found: {rule}: {text!r}")
    for judged, text in SOUND:
        for fault in judged(text):
            missed += 1
            print(f"found in a sound text: {fault}: {text!r}")
    print(f"{len(PLANTED)} planted faults, {len(PLANTED) + len(SOUND) - missed} of {len(PLANTED) + len(SOUND)} texts judged as they should be")
    return missed


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--planted", action="store_true")
    options = parser.parse_args()
    if options.planted:
        return 1 if planted() else 0
    paths = [p.resolve() for p in options.files]
    if not paths:
        paths = {p for pattern in MARKDOWN + SOURCES + PAGE for p in ROOT.glob(pattern)}
        paths = sorted(paths.union(pages_to_measure()[0]))
        if len(paths) < 200:
            print(f"{len(paths)} files: the project is not there")
            return 1
    faults = check(paths)
    if not options.files:
        pages, waiting = pages_to_measure()
        texts = [page.read_text(encoding="utf-8") for page in pages]
        found = [f"{rule}: {what}" for rule, what in together(texts)]
        found += [f"not-yet.txt names {page.relative_to(ROOT)}, which does not exist" for page in waiting if not page.exists()]
        print(*found, f"{len(pages)} pages measured, {len(waiting)} not yet", sep="\n")
        faults += len(found)
    print(f"{len(paths)} files, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
