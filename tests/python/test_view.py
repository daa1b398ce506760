import html
import re

import amble
import pytest


def test_a_champion_a_run_and_a_file_give_the_same_page(run):
    champion = run.champion()
    pages = [amble.view(what, seconds=1.0).html for what in (champion, run, champion.path)]
    assert pages[0].startswith("<!DOCTYPE html>") and pages[0] == pages[1] == pages[2]
    assert amble.view(champion, seconds=1.0, engine="ode").html != pages[0]


def test_a_recording_gives_a_page(recording):
    assert amble.view(recording).html == amble.view(recording.path).html
    with pytest.raises(ValueError, match="made already"):
        amble.view(recording, seconds=1.0)


def test_a_page_shows_itself_in_a_notebook_and_is_saved(recording, tmp_path):
    page = amble.view(recording, height=300)
    shown = re.fullmatch(r'<iframe srcdoc="([^"]*)" sandbox="allow-scripts" [^>]*height="300"[^>]*></iframe>',
                         page._repr_html_())
    assert html.unescape(shown[1]) == page.html
    assert page.save(tmp_path / "walk.html").read_text(encoding="utf-8") == page.html
