"""What the tests are given: Chromium, the built book, and a tab of their own."""

from pathlib import Path

import pytest
from playwright.sync_api import sync_playwright

from book import Book, Served
from browser import ARGUMENTS, PROGRAM, Tab
from lab import Lab


def pytest_addoption(parser):
    usual = Path(__file__).resolve().parents[2] / "target/book"
    parser.addoption("--book", type=Path, default=usual, help="the built book (target/book)")


@pytest.fixture(scope="session")
def book(pytestconfig):
    return Book(pytestconfig.getoption("book"))


@pytest.fixture(scope="session")
def served(book):
    with Served(book) as there:
        yield there


@pytest.fixture(scope="session")
def chromium():
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=PROGRAM, args=ARGUMENTS)
        yield browser
        browser.close()


@pytest.fixture
def tab(chromium, book):
    """So that no theme, no window and no setting comes from another test."""
    with Tab(chromium, book) as own:
        yield own


@pytest.fixture
def lab(tab):
    return Lab(tab)
