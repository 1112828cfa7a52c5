#!/usr/bin/env python3
"""Makes the documentation site: plain HTML of README.md, CONTRIBUTING.md, CHANGELOG.md and docs/*.md, with the
pages, figures and tables of docs/results. A link or an anchor that leads nowhere fails it, with file and line.

Needs cmark-gfm and Python's standard library. `scripts/site` builds the program of --bench first.
"""
import sys

sys.dont_write_bytecode = True  # the sources stay as they are

import argparse
import html
import pathlib
import shutil
import string

import links
import markdown
import results

HERE = pathlib.Path(__file__).resolve().parent
GENERATOR = "Obscura, scripts/site"
RESULTS = "docs/results/README.md"

# What stands in the navigation, in this order, and under which name. A page that is named nowhere stands at the
# end, under its own title.
SECTIONS = {
    "Begin": {"README.md": "Overview"},
    "Experimenters": {
        "docs/viewer.md": "The viewer",
        "docs/scenes.md": "Scenes",
        "docs/protocols.md": "Protocol files",
    },
    "Participants": {"docs/measurement.md": "Measurement and data"},
    "Analysts": {
        "docs/analysis.md": "Analysis",
        "docs/validity.md": "Validity",
        "docs/archive.md": "Archives of studies",
    },
    "Techniques": {
        "docs/techniques.md": "Techniques",
        "docs/reference.md": "The reference",
        "docs/benchmarks.md": "Measuring them",
        "docs/stability.md": "Where they fail",
        RESULTS: "Results",
        "docs/cluster.md": "On a cluster",
    },
    "Inside": {
        "docs/architecture.md": "Architecture",
        "CONTRIBUTING.md": "Contributing",
        "CHANGELOG.md": "Changes",
    },
}


def sources(root):
    """Every Markdown file that becomes a page, relative to the root."""
    named = [name for section in SECTIONS.values() for name in section]
    found = [path.relative_to(root).as_posix() for path in sorted(root.glob("docs/*.md"))]
    found = [name for name in found if not name.endswith(".in.md")]  # a part of a page that a program prints
    every = dict.fromkeys(named + found)
    return [name for name in every if (root / name).is_file()]


def navigation(pages, current, here):
    """The list of all pages as HTML, seen from the page `current` at the address `here`."""
    named = {name for names in SECTIONS.values() for name in names}
    sections = {title: list(names) for title, names in SECTIONS.items()}
    sections["Inside"] += [name for name in pages if name not in named]
    parts = []
    for title, names in sections.items():
        rows = []
        for name in names:
            if name in pages:
                mark = ' aria-current="page"' if name == current else ""
                address = links.relative(pages[name].address, here)
                rows.append(f'<li><a href="{address}"{mark}>{html.escape(pages[name].label)}</a></li>')
        if rows:
            parts.append(f"<section>\n<h2>{title}</h2>\n<ul>\n" + "\n".join(rows) + "\n</ul>\n</section>")
    return "\n".join(parts)


def contents(headings):
    """The list of a page's sections: of the second level, and of the third below them."""
    rows, depth = [], 2
    for level, anchor, text in headings:
        if level not in (2, 3) or (level == 3 and not rows):
            continue
        if level > depth:
            rows.append("<ul>")
        elif level < depth:
            rows.append("</li></ul></li>")
        elif rows:
            rows.append("</li>")
        rows.append(f'<li><a href="#{anchor}">{html.escape(text)}</a>')
        depth = level
    return "\n".join(["<ul>", *rows, "</li></ul></li></ul>" if depth == 3 else "</li></ul>"]) if rows else ""


def filled(template, address, **values):
    root = links.relative("", address)
    return string.Template(template).substitute(values, root=root, generator=GENERATOR)


def write_page(out, page, pages, body):
    """A page of the documentation, within the template."""
    listed = contents(page.headings) if len(page.headings) > 3 else ""
    aside = f'<nav class="contents" aria-label="On this page"><h2>On this page</h2>{listed}</nav>' if listed else ""
    small = f'<details class="contents"><summary>On this page</summary>{listed}</details>' if listed else ""
    text = filled(
        (HERE / "page.html").read_text(encoding="utf-8"),
        page.address,
        title=html.escape(page.title if page.title == "Obscura" else f"{page.title} – Obscura"),
        description=html.escape(page.description, quote=True),
        navigation=navigation(pages, page.source, page.address),
        contents=aside,
        details=small,
        body=body,
    )
    target = out / page.address
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(text, encoding="utf-8")


def prepare(out):
    """The folder, which must be new or a site of ours: what is in another one would be mixed with it."""
    first = out / "index.html"
    if out.is_dir() and any(out.iterdir()) and not (first.is_file() and GENERATOR in first.read_text(encoding="utf-8")):
        sys.exit(f"site: expected a new folder for --out, or one with a site in it; found other files in {out}")
    out.mkdir(parents=True, exist_ok=True)


def build(root, out, bench):
    """Writes the site and returns the mistakes, each with its place."""
    pages = {name: markdown.read(root, name) for name in sources(root)}
    for names in SECTIONS.values():
        for name in names.keys() & pages.keys():
            pages[name].label = names[name]
    resolver = links.Resolver(root, pages)
    prepare(out)
    for name in ("style.css", "mark.svg"):
        shutil.copy(HERE / name, out / name)
    pictures = root / "docs/pictures"
    if pictures.is_dir():
        shutil.copytree(pictures, out / "pictures", dirs_exist_ok=True)
    folders = results.publish(root / "docs/results", out / "results", bench)
    for page in pages.values():
        body = markdown.body(page, resolver)
        if page.source == RESULTS and folders:
            page.headings.append(results.LISTING)
            body = results.linked(body, folders) + results.listing(folders)
        write_page(out, page, pages, body)
    home = "docs/site/home.html"
    (out / "index.html").write_text(
        filled(resolver.html(home, "index.html"), "index.html", navigation=navigation(pages, "", "index.html")),
        encoding="utf-8",
    )
    made = [f"results/{folder.name}/{folder.page}" for folder in folders if folder.page]
    return resolver.mistakes or links.check(out, ["index.html", *(page.address for page in pages.values()), *made])


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--out", type=pathlib.Path, required=True, help="folder of the site")
    options.add_argument("--bench", help="obscura-bench, which makes the pages of results; without, there are none")
    options.add_argument("--root", type=pathlib.Path, default=HERE.parents[1], help="where README.md and docs are")
    given = options.parse_args()
    mistakes = build(given.root.resolve(), given.out, given.bench)
    for mistake in mistakes:
        print(f"site: {mistake}", file=sys.stderr)
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
