"""Where links lead: from source to source while pages are made, and over all that was made at the end."""
import html.parser
import posixpath
import re
import urllib.parse

OUTSIDE = re.compile(r"(https?|mailto):")


def relative(address, here):
    """The address as a page at `here` must write it; "" is the site's root, and ends in a slash or is empty."""
    folder = posixpath.dirname(here)
    if not address:
        return "../" * (folder.count("/") + 1) if folder else ""
    return posixpath.relpath(address, folder or ".")


class Resolver:
    """Turns links between sources into links between pages, and notes those that lead nowhere."""

    def __init__(self, root, pages):
        self.root, self.pages, self.mistakes = root, pages, []

    def line(self, source, span, link):
        """The line of a link within the lines of its block, "12:1-14:20"."""
        first, last = (int(place.split(":")[0]) for place in span.split("-"))
        rows = (self.root / source).read_text(encoding="utf-8").splitlines()
        written = urllib.parse.unquote(link)
        return next((number for number in range(first, last + 1) if written in rows[number - 1]), first)

    def target(self, source, path):
        return posixpath.normpath(posixpath.join(posixpath.dirname(source), urllib.parse.unquote(path)))

    def file(self, source, link):
        """The file that a link of a picture names, if it is there."""
        path = self.root / self.target(source, link)
        return path if path.is_file() else None

    def wrong(self, source, line, expected, found):
        self.mistakes.append(f"{source}:{line}: expected {expected}; found \"{found}\"")

    def address(self, source, line, link, here):
        """What `link` of `source` is on the page at `here`."""
        if OUTSIDE.match(link):
            return link
        path, _, anchor = link.partition("#")
        name = self.target(source, path) if path else source
        if name in self.pages:
            if anchor and anchor not in self.pages[name].anchors:
                self.wrong(source, line, f"an anchor of {name} after the #", link)
            page = relative(self.pages[name].address, here) if path else ""
            return page + ("#" + anchor if anchor else "")
        if not re.match("docs/(pictures|results)/", name):
            self.wrong(source, line, "a link to a page, a picture or a result of the site", link)
        elif not (self.root / name).is_file():
            self.wrong(source, line, "a link to a file that is there", link)
        return relative(name.removeprefix("docs/"), here)

    def name(self, source, element, link):
        """What is called after a file, as in [docs/viewer.md](docs/viewer.md), is called after its page here."""
        page = self.pages.get(self.target(source, link.partition("#")[0]))
        if page and re.fullmatch(r"(docs/)?[\w.-]+\.md", element.text or "") and not len(element):
            element.text = page.label

    def html(self, source, here):
        """The text of an HTML file whose links name sources, with those of the page at `here`."""
        rows = (self.root / source).read_text(encoding="utf-8").splitlines(keepends=True)
        for number, row in enumerate(rows, 1):
            rows[number - 1] = re.sub(
                r'\b(href|src)="([^"$#][^"]*)"',
                lambda found: f'{found[1]}="{self.address(source, number, found[2], here)}"', row)
        return "".join(rows)


class Made(html.parser.HTMLParser):
    """What a page that was made refers to, and which anchors it has."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.twice, self.links, self.loads = set(), [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        line = self.getpos()[0]
        for key, value in attributes:
            if key == "id":
                if value in self.ids:
                    self.twice.append((line, value))
                self.ids.add(value)
            elif key in ("href", "src", "srcset", "poster", "data"):
                (self.links if tag == "a" else self.loads).append((line, value or ""))


def check(out, addresses):
    """The mistakes of all pages that were made: links into nothing, anchors twice, anything from the network."""
    made = {address: Made((out / address).read_text(encoding="utf-8")) for address in addresses}
    mistakes = []
    for address, page in made.items():
        mistakes += [f"{out / address}:{line}: expected each anchor once; found \"{name}\" again"
                     for line, name in page.twice]
        mistakes += [f"{out / address}:{line}: expected nothing from the network; found \"{link}\""
                     for line, link in page.loads if OUTSIDE.match(link) or link.startswith("//")]
        for line, link in page.links + page.loads:
            if OUTSIDE.match(link) or link.startswith(("data:", "//")):
                continue
            path, _, anchor = urllib.parse.unquote(link).partition("#")
            name = posixpath.normpath(posixpath.join(posixpath.dirname(address), path)) if path else address
            if not (out / name).is_file():
                mistakes.append(f"{out / address}:{line}: expected a link to a file of the site; found \"{link}\"")
            elif anchor and anchor not in (made[name].ids if name in made else ()):
                mistakes.append(f"{out / address}:{line}: expected an anchor of {name}; found \"{link}\"")
    return mistakes
