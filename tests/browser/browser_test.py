#!/usr/bin/python3
"""The pages of sweeps, comparisons and runs in headless Chromium.

browser_test.py CAROM: makes runs in a temporary folder, opens their pages, and uses them as a person does.
"""
import pathlib
import subprocess
import sys
import tempfile

from browser import Browser, find_chromium

HOSTILE = "<script>boom()</script> & \"it's\""
SCENE = f"""scene: 1
title: '{HOSTILE.replace("'", "''")}'
gravity: [0, 0, 0]
balls:
  red: {{mass: 10, radius: 0.11, position: [-1, 0, 0], velocity: [2, 0, 0]}}
  blue: {{mass: 10, radius: 0.11, position: [1, 0, 0], velocity: [-2, 0, 0]}}
simulate: {{duration: 1}}
measures: {{far: max(balls.red.x_m)}}
output: {{energy: {{every: 0.1}}, video: {{size: [64, 36], fps: 10, samples: 1}}}}
"""
SWEEP = """sweep: 1
title: 'Speeds <b>after</b> the hit'
base: scene.yaml
grid:
  restitution.default: [0.5, 0.75, 1]
  balls.red.mass: [5, 10, 20, 40]
compare: {measures: [balls.red.speed_m_per_s, energy_lost_J, far]}
"""
WIDTHS = (400, 1600)

# The text of a column of all rows that are shown, and what is wider than the page.
COLUMN = "[...document.querySelectorAll('#runs tbody tr')].filter(row => !row.hidden).map(row => row.cells[%d].textContent.trim())"
HEADS = "[...document.querySelector('#runs thead').rows[0].cells].map(cell => cell.textContent)"
TOO_WIDE = "document.documentElement.scrollWidth - innerWidth"


def carom(folder, *arguments):
    subprocess.run([pathlib.Path(sys.argv[1]).resolve(), *arguments, "-q"], cwd=folder, check=True)


def check_quiet(browser, page):
    """No error, no request but for files."""
    assert not browser.errors, (page, browser.errors)
    foreign = [address for address in browser.requests if not address.startswith(("file:", "data:"))]
    assert not foreign, (page, foreign)


def check_widths(browser, page):
    for width in WIDTHS:
        browser.open(page, width)
        assert browser.value("innerWidth") == width
        assert browser.value(TOO_WIDE) <= 0, (page, width, browser.value(TOO_WIDE))
        # Letters of charts, in pixels of the screen.
        letters = browser.value("[...document.querySelectorAll('.chart text')].filter(text => text.textContent).map(text => "
                                "parseFloat(getComputedStyle(text).fontSize) * text.ownerSVGElement.getScreenCTM().a)")
        assert letters and min(letters) >= 9, (page, width, min(letters, default=None))
    check_quiet(browser, page)


def check_sorting(browser):
    heads = browser.value(HEADS)
    k = heads.index("energy lost (J)")
    numbers = [float(text) for text in browser.value(COLUMN % k)]
    click = f"document.querySelector('#runs thead').rows[0].cells[{k}].querySelector('button').click()"
    for wanted in (sorted(numbers), sorted(numbers, reverse=True), numbers):
        browser.value(click)
        assert [float(text) for text in browser.value(COLUMN % k)] == wanted


def check_filters(browser):
    heads = [head for head in browser.value(HEADS) if head != "picture"]

    def shown(head, words):
        browser.value(f"""(() => {{
            const input = document.querySelectorAll('#runs thead input')[{heads.index(head)}];
            input.value = '{words}';
            input.dispatchEvent(new Event('input'));
        }})()""")
        return len(browser.value(COLUMN % 0))

    assert shown("mass (kg)", "> 10") == 6
    assert browser.value("document.getElementById('shown').textContent") == "6 of 12 runs"
    assert shown("restitution.default", "0.75..1") == 4
    assert shown("mass (kg)", "") == 8
    assert shown("mass (kg)", "many") == 8
    assert browser.value("document.querySelectorAll('[aria-invalid]').length") == 1
    assert shown("mass (kg)", "") == 8 and shown("restitution.default", "") == 12
    assert shown("run", "r0003") == 1 and shown("run", "") == 12


def check_films(browser):
    browser.value("document.querySelectorAll('#runs tbody input')[0].click()")
    browser.value("document.querySelectorAll('#runs tbody input')[5].click()")
    videos = "[...document.querySelectorAll('#side video')]"
    browser.wait_for(f"{videos}.length === 2 && {videos}.every(video => video.readyState > 0)")
    assert browser.value(f"{videos}.map(video => [video.videoWidth, Math.round(10 * video.duration)])") == [[64, 11], [64, 11]]
    assert "/runs/r0001/animation.mp4" in browser.value(f"{videos}[0].src")

    # One button plays all in step.
    browser.value("[...document.querySelectorAll('#side button')].find(one => one.textContent === 'Play all').click()")
    browser.wait_for(f"{videos}.every(video => video.currentTime > 0.2)")
    apart = browser.value(f"Math.abs({videos}[0].currentTime - {videos}[1].currentTime)")
    assert apart < 0.1, apart
    assert "r0006" in browser.value("document.getElementById('side').textContent")
    browser.value("[...document.querySelectorAll('#side button')].find(one => one.textContent === 'Close').click()")
    assert browser.value("document.getElementById('side').hidden && !document.querySelector('#runs input:checked')")


def check_links(browser):
    """A link of the ranking leads to its row, and every link into the folder to something."""
    browser.value("document.querySelector('.rank a').click()")
    browser.wait_for("location.hash.length > 1 && document.querySelector('#runs tr:target') !== null")
    assert browser.value("[...document.querySelectorAll('a[href^=\"#\"]')].every(one => document.querySelector(one.hash))")
    addresses = browser.value("[...document.querySelectorAll('a[href], video[src], img[src]')].map(one => one.href || one.src)")
    for address in addresses:
        path = pathlib.Path(address.split("#")[0].removeprefix("file://"))
        assert path.exists(), address
    assert len(addresses) > 30, len(addresses)


def main():
    if find_chromium() is None:
        print("there is no chromium")
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="carom-browser-") as name:
        folder = pathlib.Path(name)
        (folder / "scene.yaml").write_text(SCENE)
        (folder / "sweep.yaml").write_text(SWEEP)
        carom(folder, "sweep", "sweep.yaml", "-o", "sweep")
        carom(folder, "sweep", "scene.yaml", "--latin", "12", "--grid", "balls.red.mass=5:20", "--grid",
              "restitution.default=0.5:1", "--only", "energy", "--measures", "energy_lost_J,max_speed_m_per_s", "-o", "latin")
        carom(folder, "run", "scene.yaml", "--only", "report,video", "-o", "run")
        carom(folder, "compare", "run", "sweep/runs/r0001", "-o", "two")

        browser = Browser(folder / "profile")
        try:
            for page in ("sweep", "latin", "run"):
                check_widths(browser, folder / page / "index.html")
            browser.open(folder / "two/index.html", 400)
            assert browser.value(TOO_WIDE) <= 0

            browser.open(folder / "sweep/index.html")
            assert browser.value("document.querySelector('h1').textContent") == "Speeds <b>after</b> the hit"
            check_sorting(browser)
            check_filters(browser)
            check_films(browser)
            check_links(browser)
            check_quiet(browser, "sweep")

            browser.open(folder / "run/index.html")
            assert browser.value("document.querySelector('h1').textContent") == HOSTILE
            browser.wait_for("document.querySelector('video').readyState > 0")
            check_quiet(browser, "run")
            browser.print(folder / "run.pdf")
            assert (folder / "run.pdf").read_bytes().startswith(b"%PDF")
        finally:
            browser.close()


main()
