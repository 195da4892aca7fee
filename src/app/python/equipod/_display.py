"""Figures and live pages for notebooks."""

from __future__ import annotations

import html
import pathlib
import webbrowser
from dataclasses import dataclass


def _write_new(path: str | pathlib.Path, text: str) -> None:
    with open(path, "x", encoding="utf-8") as file:
        file.write(text)


@dataclass(frozen=True)
class Figure:
    """A picture as SVG text; a notebook shows it.

    Attributes
    ----------
    svg : str
        The text of the picture.
    """

    svg: str

    def save(self, path: str | pathlib.Path) -> None:
        """Writes the picture; the file must not exist."""
        _write_new(path, self.svg)

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"Figure(SVG of {len(self.svg)} characters)"


@dataclass(frozen=True)
class Page:
    """The live page of a design, one file of HTML; a notebook shows it in a frame.

    Attributes
    ----------
    html : str
        The text of the page.
    """

    html: str

    def save(self, path: str | pathlib.Path) -> None:
        """Writes the page; the file must not exist."""
        _write_new(path, self.html)

    def open(self) -> pathlib.Path:
        """Writes the page to a temporary file and opens it in the browser; the file."""
        import tempfile

        with tempfile.NamedTemporaryFile("w", suffix=".html", delete=False, encoding="utf-8") as file:
            file.write(self.html)
        webbrowser.open(pathlib.Path(file.name).as_uri())
        return pathlib.Path(file.name)

    def _repr_html_(self) -> str:
        page = html.escape(self.html, quote=True)
        return f'<iframe srcdoc="{page}" style="width:100%;height:640px;border:0"></iframe>'

    def __repr__(self) -> str:
        return f"Page(HTML of {len(self.html)} characters; .save(path) writes it, .open() shows it)"
