"""What explain.py prints."""

import json


def test_explain_prints_the_steps_of_the_pixel_that_cast_and_project_know(command, scene):
    done = command("explain", scene, "--pixel", "12,9", "--frame", "1.25")
    for title in (
        "Pixel",
        "View coordinates [-1, 1]²",
        "Model",
        "Ray in the world",
        "Shapes on the line of the ray",
        "Seen",
    ):
        assert f"{title}\n  " in done.stdout
    assert "its center: x = 12.5, y = 9.5" in done.stdout
    facts = json.loads(command("verify", scene, "--frame", "1.25", "--json").stdout)["camera"]
    assert f"eye ({', '.join(f'{value + 0.0:.6g}' for value in facts['eye'])})" in done.stdout
