"""The folders of docs/results on the site: their files, and a page of each, made anew from its CSV."""
import concurrent.futures
import dataclasses
import os
import shutil
import subprocess
import sys

import images

LISTING = (2, "all-folders", "All folders")  # the heading of the list: level, anchor, text

# What makes a page of a folder, by the table that the folder has.
MAKERS = {
    "sweep.csv": ("sweep.html", lambda bench, folder: [bench, "page", folder]),
    "stability.csv": ("stability.html", lambda bench, folder: [bench, "stability", "--page", "--out", folder]),
}


@dataclasses.dataclass
class Folder:
    name: str
    page: str  # within the folder; "" where there is none
    figure: object  # a path, or None
    files: list  # names of CSV files


def make_page(folder, bench):
    """The name of the page that the program made in the folder, "" where there is none to make."""
    for table, (page, command) in MAKERS.items():
        if bench and (folder / table).is_file():
            made = subprocess.run(command(bench, folder), capture_output=True, text=True)
            if made.returncode or not (folder / page).is_file():
                sys.exit(f"site: expected {page} in {folder}; {bench} said: {made.stdout}{made.stderr}")
            text = (folder / page).read_text(encoding="utf-8")
            back = '<body>\n<p class="aside"><a href="../index.html">Obscura: results</a></p>\n'
            (folder / page).write_text(text.replace("<body>\n", back, 1), encoding="utf-8")
            return page
    return ""


def publish(source, out, bench):
    """Copies each folder and makes its page; gives the folders in the order of their names."""
    names = sorted(path.name for path in source.iterdir() if path.is_dir()) if source.is_dir() else []

    def one(name):
        shutil.copytree(source / name, out / name, dirs_exist_ok=True)
        page = make_page(out / name, bench)
        figures = sorted((source / name / "figures").glob("*.svg"))
        # The chart of speed against accuracy says most, where there is one.
        figure = next((path for path in figures if path.name.startswith("scatter")), figures[0] if figures else None)
        files = sorted(path.name for path in (source / name).glob("*.csv"))
        return Folder(name, page, figure, files)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(one, names))


def listing(folders):
    """A list of all folders as HTML, for the end of the page of results: chart, page and tables of each."""
    items = []
    for folder in folders:
        parts = []
        if folder.figure:
            chart = f"{folder.name}/figures/{folder.figure.name}"
            size = " ".join(f'{key}="{value}"' for key, value in images.size(folder.figure).items())
            address = f"{folder.name}/{folder.page}" if folder.page else chart
            image = f'<img src="{chart}" {size} loading="lazy" alt="Chart of {folder.name}">'
            parts.append(f'<a href="{address}">{image}</a>')
        files = ([(folder.page, "page")] if folder.page else []) + [(name, name) for name in folder.files]
        rows = ", ".join(f'<a href="{folder.name}/{target}">{label}</a>' for target, label in files)
        items.append(f'<li id="{folder.name}"><strong>{folder.name}</strong>{"".join(parts)}<p>{rows}</p></li>')
    return f'<h2 id="{LISTING[1]}">{LISTING[2]}</h2>\n<ul class="folders">\n' + "\n".join(items) + "\n</ul>\n"


def linked(body, folders):
    """The body of the page of results, in which each folder's name in code leads to the folder in the list."""
    for folder in folders:
        code = f"<code>{folder.name}</code>"
        body = body.replace(code, f'<a href="#{folder.name}">{code}</a>')
    return body
