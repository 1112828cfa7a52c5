"""One Markdown file as a page: its title, its headings with their anchors, and its body."""
import dataclasses
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

import images

# What cmark-gfm makes of Markdown. Anything else was written as HTML, which Markdown's other readers may drop.
ELEMENTS = set("a blockquote body br code del em h1 h2 h3 h4 h5 h6 hr img li ol p pre strong".split()
               + "table tbody td th thead tr ul".split())
PLACE = "data-sourcepos"


@dataclasses.dataclass
class Page:
    source: str  # relative to the root, docs/viewer.md
    address: str  # relative to the site, viewer.html
    tree: xml.Element
    title: str
    label: str  # its name in the navigation
    description: str
    headings: list  # of (level, anchor, text)

    @property
    def anchors(self):
        return {anchor for _, anchor, _ in self.headings}


def address_of(source):
    """README.md is readme.html, docs/viewer.md viewer.html, docs/results/README.md results/index.html."""
    name = source.removeprefix("docs/")
    if name.endswith("/README.md"):
        return name.removesuffix("README.md") + "index.html"
    return name.removesuffix(".md").lower() + ".html"


def words(element):
    return "".join(element.itertext())


def anchor_of(text, taken):
    """As GitHub names it, so that a link works there and here: lower case, hyphens for blanks, no punctuation."""
    plain = re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")
    anchor, number = plain, 0
    while anchor in taken:
        number += 1
        anchor = f"{plain}-{number}"
    return anchor


def line_of(element):
    return int(element.get(PLACE).split(":")[0])


def fail(source, line, message):
    sys.exit(f"site: {source}:{line}: {message}")


def parse(root, source):
    program = shutil.which("cmark-gfm")
    if not program:
        sys.exit("site: expected the program cmark-gfm; apt-get install cmark-gfm")
    made = subprocess.run([program, "--unsafe", "--sourcepos", "-e", "table", "-e", "strikethrough", root / source],
                          check=True, capture_output=True, text=True).stdout
    made = re.sub("<!--.*?-->", "", made, flags=re.DOTALL)  # whose hyphens XML would refuse
    made = f"<body {PLACE}=\"1:1\">{made}</body>"
    try:
        tree = xml.fromstring(made)
    except xml.ParseError as error:
        row, column = error.position
        before = "\n".join([*made.split("\n")[: row - 1], made.split("\n")[row - 1][:column]])
        line = re.findall(f'{PLACE}="([0-9]+)', before)[-1]  # of the block that the place is in
        fail(source, line, f"expected Markdown alone; found HTML or a bare < near \"{before[-30:]}\"")
    refuse_html(tree, source, 1)
    return tree


def refuse_html(element, source, line):
    line = line_of(element) if element.get(PLACE) else line
    if element.tag not in ELEMENTS:
        fail(source, line, f"expected Markdown alone; found the HTML element <{element.tag}>")
    for child in element:
        refuse_html(child, source, line)


def read(root, source):
    tree = parse(root, source)
    headings, taken = [], set()
    for element in tree:
        if re.fullmatch("h[1-6]", element.tag):
            anchor = anchor_of(words(element), taken)
            taken.add(anchor)
            element.set("id", anchor)
            headings.append((int(element.tag[1]), anchor, words(element)))
            if (element.tag == "h1") != (len(headings) == 1):
                fail(source, line_of(element), f"expected one heading of the first level, above all others; found "
                                               f"{element.tag} \"{words(element)}\"")
    if not headings:
        fail(source, 1, "expected a heading of the first level; found none")
    first = next((words(element) for element in tree if element.tag == "p"), "")
    description = re.split(r"(?<=[.!?:])\s", first.replace("\n", " "), maxsplit=1)[0].rstrip(":")
    return Page(source, address_of(source), tree, headings[0][2], headings[0][2], description, headings)


def anchored(element):
    """A heading gets a link to itself, to be copied."""
    link = xml.SubElement(element, "a", {"class": "anchor", "href": "#" + element.get("id"),
                                         "aria-label": "Link to this section"})
    link.text = "#"


def as_figure(paragraph):
    """A picture that is a paragraph of its own becomes a figure with its words below it."""
    image = paragraph[0]
    caption = image.get("alt", "")
    paragraph.tag = "figure"
    link = xml.Element("a", {"href": image.get("src")})
    image.tail = None
    paragraph.remove(image)
    link.append(image)
    paragraph.text = None
    paragraph.append(link)
    xml.SubElement(paragraph, "figcaption", {"aria-hidden": "true"}).text = caption  # `alt` says the same aloud


def body(page, resolver):
    """The page's HTML, its links rewritten; those that lead nowhere are mistakes of the resolver."""
    parents = {child: parent for parent in page.tree.iter() for child in parent}

    def place(element, link):
        while element.get(PLACE) is None:
            element = parents[element]
        return resolver.line(page.source, element.get(PLACE), link)

    for element in list(page.tree.iter()):
        key = {"a": "href", "img": "src"}.get(element.tag)
        if key:
            link = element.get(key)
            resolver.name(page.source, element, link)
            element.set(key, resolver.address(page.source, place(element, link), link, page.address))
            if element.tag == "img":
                element.attrib.update(images.size(resolver.file(page.source, link)))
                element.set("loading", "lazy")
    for element in list(page.tree):
        if element.tag == "p" and len(element) == 1 and element[0].tag == "img" and not (element.text or "").strip():
            as_figure(element)
        elif re.fullmatch("h[2-6]", element.tag):
            anchored(element)
    for element in list(page.tree.iter()):
        if element.tag == "table":
            parent = parents[element]
            wide = xml.Element("div", {"class": "wide", "tabindex": "0"})
            wide.tail, element.tail = element.tail, None
            parent[list(parent).index(element)] = wide
            wide.append(element)
            if all(len(words(cell)) < 27 for row in element.iter("tr") for cell in row[1:]):
                element.set("class", "short")  # numbers, which are read along the line
        elif element.tag == "pre":
            element.set("tabindex", "0")  # what scrolls must be reached by keys
    for element in page.tree.iter():
        element.attrib.pop(PLACE, None)
    return "".join(xml.tostring(element, encoding="unicode", method="html") for element in page.tree)
