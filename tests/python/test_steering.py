"""Champions that are told where to go, and steered by hand."""
import amble
import pytest
from conftest import SOURCE, program

STRAIGHT, OBEYING = SOURCE / "robots/hexapod/champion.json", SOURCE / "robots/hexapod/steered.json"
GAINS = "turn_gain = 2, full_speed_m_s = 0.3"


def test_a_champion_does_what_the_command_line_says_it_does_when_told(tmp_path):
    told = amble.Champion(OBEYING).trial(1.0, command="0.2,0.3; 0,0", record=tmp_path / "a.rec")
    assert 0.0 <= told["tracking"] <= 1.0
    assert program("trial", OBEYING, "--undisturbed", "--seconds", "1", "--command", "0.2,0.3; 0,0", "--record", tmp_path / "b.rec")[0] == 0
    assert list(amble.Recording(tmp_path / "a.rec")["com.x"]) == list(amble.Recording(tmp_path / "b.rec")["com.x"])


@pytest.mark.filterwarnings("ignore:command. this champion senses no commands")
def test_steering_by_hand_changes_the_walk_and_its_trials():
    champion = amble.Champion(STRAIGHT)
    free, steered = (champion.trial(2.0, command="0.1,0.3", steering=gains) for gains in (None, GAINS))
    assert free["distance_m"] != steered["distance_m"]
    assert "tracking" not in champion.trial(2.0)
    free, steered = (champion.typical(1.0, trials=2, command="0.1,0.3", steering=gains) for gains in (None, GAINS))
    assert free["trials"] != steered["trials"]


def test_commands_without_effect_are_said_to_have_none():
    champion = amble.Champion(STRAIGHT)
    for walk in (champion.trial, lambda *told, **more: champion.typical(*told, trials=1, **more)):
        with pytest.warns(UserWarning, match="^command: this champion senses no commands, and walks as it would without$"):
            walk(1.0, command="0.1,0")
        with pytest.warns(UserWarning, match="^command: what begins after 3 s is never told, as the trial is 1 s long; for more: seconds$"):
            walk(1.0, command="0.1,0,3; 0,0,1", steering=GAINS)


def test_export_writes_the_steering_of_the_command_line(tmp_path):
    ours = amble.Champion(STRAIGHT).export(tmp_path / "walker.c", steering=GAINS)
    (tmp_path / "b").mkdir()
    assert program("export", STRAIGHT, "--format", "c", "--steering", GAINS, "-o", tmp_path / "b/walker.c") == (0, "")
    assert (tmp_path / "b/walker.c").read_text() == open(ours).read()


def test_what_is_wrong_is_named_by_its_argument(tmp_path):
    champion = amble.Champion(STRAIGHT)
    with pytest.raises(amble.Error, match='^command "1e3,0": speed = 1000: expected a number from -100 to 100'):
        champion.trial(1.0, command="1e3,0")
    with pytest.raises(amble.Error, match="^steering: unknown key 'foo'"):
        champion.typical(1.0, command="0.1,0", steering="foo = 1")
    with pytest.raises(ValueError, match="^steering: .* expected command as well"):
        champion.trial(1.0, steering=GAINS)
    with pytest.raises(ValueError, match="^steering: only with a path that ends in .c or .json"):
        champion.export(tmp_path / "robot.xml", steering=GAINS)
    assert not list(tmp_path.iterdir())
