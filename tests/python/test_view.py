import html
import os
import re

import amble
import pytest

from conftest import ROBOT


def test_a_champion_a_run_and_a_file_give_the_same_page(run):
    champion = run.champion()
    pages = [amble.view(what, seconds=1.0).html for what in (champion, run, champion.path)]
    assert pages[0].startswith("<!DOCTYPE html>") and pages[0] == pages[1] == pages[2]
    assert amble.view(champion, seconds=1.0, engine="ode").html != pages[0]


def test_a_recording_gives_a_page(recording):
    assert amble.view(recording).html == amble.view(recording.path).html
    with pytest.raises(ValueError, match="made already"):
        amble.view(recording, seconds=1.0)


def test_several_walk_side_by_side_and_a_history_goes_from_first_to_last(run, recording):
    both = amble.view([run, recording]).html
    assert len(both) > len(amble.view(run).html) and "<title>2 walkers</title>" in both
    history = amble.view(run, seconds=1.0, history=True).html
    assert ": its history</title>" in history
    for wrong in (run.champion(), [run, run], recording):
        with pytest.raises(ValueError, match="history: expected one Run"):
            amble.view(wrong, history=True)
    with pytest.raises(ValueError, match="at least one"):
        amble.view([])


def test_what_disturbs_is_chosen_as_everywhere(run, tmp_path):
    champion = run.champion()
    noise = tmp_path / "noise.toml"
    noise.write_text(f'robot = "{ROBOT}"\n[noise]\nstart_joint_rad = 0.2\n')
    pages = [amble.view(champion, seconds=1.0, **choice).html
             for choice in ({"level": "micro"}, {"noise": noise}, {"undisturbed": True}, {"level": "micro", "trials": 5})]
    assert len(set(pages)) == 4 and "of 5 trials" in pages[3]
    assert champion.typical(seconds=1.0, noise=noise, trials=3)["level"] != "milli"
    assert champion.gait(seconds=1.0, noise=noise, trials=3) != champion.gait(seconds=1.0, undisturbed=True)
    for wrong in ({"level": "micro", "noise": noise}, {"undisturbed": True, "level": "micro"}, {"trials": -1}):
        with pytest.raises(ValueError, match="expected"):
            amble.view(champion, **wrong)
    with pytest.raises(amble.Error, match="level"):
        amble.view(champion, level="no-level")
    assert "<title>Mine</title>" in amble.view(champion, seconds=1.0, title="Mine").html


def test_a_page_shows_itself_in_a_notebook_and_is_saved(recording, tmp_path):
    page = amble.view(recording, height=300)
    shown = re.fullmatch(r'<iframe srcdoc="([^"]*)" sandbox="allow-scripts" [^>]*height="300"[^>]*></iframe>',
                         page._repr_html_())
    assert html.unescape(shown[1]) == page.html
    assert page.save(tmp_path / "walk.html").read_text(encoding="utf-8") == page.html


def test_a_page_is_saved_over_pages_alone_and_says_where(recording, run, tmp_path, monkeypatch):
    page = amble.view(recording)
    monkeypatch.chdir(tmp_path)
    assert page.save("new/walk.html") == page.save("new/walk.html") == tmp_path / "new/walk.html"
    (tmp_path / "notes.html").write_text("mine")
    with pytest.raises(amble.Error, match="is not a page"):
        page.save("notes.html")
    for name in (run.champion().path, "walk.txt", ""):
        with pytest.raises(ValueError, match="expected a (name that ends in .html|file)"):
            page.save(name)
    assert sorted(os.listdir(tmp_path)) == ["new", "notes.html"] and (tmp_path / "notes.html").read_text() == "mine"
