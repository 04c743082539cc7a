"""The page of `masonry view` in headless Chromium: it opens without errors, its slider moves, a click names a block."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest

import masonry
from masonry.viewing.view import PageView, view_of_result
from tests.results.sample import sample

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine: apt install chromium")
WORDS = (
    *("--headless", "--no-sandbox", "--no-first-run", "--disable-quic", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
    *("--ignore-gpu-blocklist", "--window-size=1000,700", "--virtual-time-budget=20000", "--dump-dom"),
)
PROBE = """<script>
const errors = [];
window.addEventListener("error", (event) => errors.push(event.message));
window.addEventListener("unhandledrejection", (event) => errors.push(String(event.reason)));
(async () => {
  const ended = () => document.body.dataset.ready || document.getElementById("failed");
  while (!ended()) await new Promise((go) => setTimeout(go, 50));
  const answer = { errors };
  const click = (x, y) => ["pointerdown", "pointerup"].forEach((name) => document.getElementById("canvas")
    .dispatchEvent(new PointerEvent(name, { clientX: x, clientY: y, pointerId: 1, bubbles: true, isPrimary: true })));
  const picked = () => document.getElementById("picked").innerText;
  try { await (async () => { PROGRAM })(); } catch (error) { errors.push(error.message); }
  const words = document.createElement("pre");
  words.id = "answer";
  words.textContent = JSON.stringify(answer);
  document.body.append(words);
})();
</script>
</body>"""


def answers(view: PageView, folder, program: str) -> dict:
    """What a program finds in a page that was opened."""
    page = folder / "page.html"
    page.write_text(view.text.replace("</body>", PROBE.replace("PROGRAM", program)), encoding="utf-8")
    command = [str(CHROMIUM), *WORDS, f"--user-data-dir={folder / 'profile'}", page.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    answer = re.search('<pre id="answer">(.*?)</pre>', done.stdout, re.S)
    assert answer, done.stderr[-2000:]
    return json.loads(answer[1].replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"))


def test_a_click_names_the_block_that_is_seen(tmp_path):
    view = masonry.view(masonry.load("arch", {"specimen.voussoirs": 7, "specimen.points_per_edge": 2}))
    program = """
      masonryView.look("front");
      answer.named = [];
      for (const block of [0, 2, 3, 6]) { click(...masonryView.onScreen(block)); answer.named.push(picked()); }
      click(3, 690);
      answer.nothing = picked();
      document.getElementById("number").value = 5;
      document.getElementById("find").requestSubmit();
      answer.chosen = picked();
      answer.loads = document.getElementById("loads").innerText;
    """
    answer = answers(view, tmp_path, program)
    assert answer["errors"] == []
    assert [int(re.match(r"block\s+(\d+)", words)[1]) for words in answer["named"]] == [0, 2, 3, 6]
    assert answer["nothing"] == "nothing yet" and re.match(r"block\s+5", answer["chosen"])
    assert "weight: z -" in answer["loads"]


def test_the_slider_moves_the_frame_and_the_point_on_the_curve(tmp_path):
    result = sample()
    program = """
      const slider = document.getElementById("frame");
      const dot = () => document.querySelector("#curve circle").getAttribute("cx");
      const go = (frame) => { slider.value = frame; slider.dispatchEvent(new Event("input")); };
      go(slider.max); answer.last = [masonryView.state.frame, Number(dot()), masonryView.onScreen(0)];
      go(0); answer.first = [masonryView.state.frame, Number(dot()), masonryView.onScreen(0)];
      answer.words = document.getElementById("frame-words").innerText;
      masonryView.pick({ joint: 0 });
      answer.joint = picked();
    """
    answer = answers(view_of_result(result), tmp_path, program)
    assert answer["errors"] == []
    assert answer["last"][0] == len(result.history.frames) - 1 and answer["first"][0] == 0
    displacements = [frame.displacement for frame in result.history.frames]
    assert np.sign(answer["last"][1] - answer["first"][1]) == np.sign(displacements[-1] - displacements[0])
    assert answer["words"].startswith(f"1 of {len(displacements)}")
    assert "between block" in answer["joint"]
