"""Pages in a browser: headless Chromium opens them from the file system, clicks, drags and reads. It needs the Debian packages
chromium, chromium-driver and python3-selenium, which are optional."""

import json
import re
import shutil
import sys
import tempfile
import unittest

from page_maker import EVIL, POINTS, PageTest, assembled

try:
    try:
        import selenium
    except ImportError:  # a Python that is not Debian's does not look among Debian's modules
        sys.path.append("/usr/lib/python3/dist-packages")
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
    from selenium.webdriver.common.keys import Keys
    MISSING = "" if shutil.which("chromium") and shutil.which("chromedriver") else "chromium and chromium-driver are not installed"
except ImportError as error:
    MISSING = f"python3-selenium is not installed ({error})"


def start_browser(profile):
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1280,860",
                     "--disable-background-networking", "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={profile}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


@unittest.skipIf(MISSING, MISSING)
class Browser(PageTest):
    @classmethod
    def setUpClass(cls):
        profile = tempfile.TemporaryDirectory(prefix="bounce_browser_", ignore_cleanup_errors=True)
        cls.addClassCleanup(profile.cleanup)
        cls.browser = start_browser(profile.name)
        cls.addClassCleanup(cls.browser.quit)

    def open(self, path):
        """Opens the page; when the test ends, nothing may have been complained of, and nothing fetched."""
        for kind in ("browser", "performance"):
            self.browser.get_log(kind)
        self.browser.get(path.as_uri())
        self.addCleanup(self.check_quiet, path)

    def check_quiet(self, path):
        self.assertEqual(self.browser.get_log("browser"), [])
        messages = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
        self.assertIn(path.as_uri(), asked)
        self.assertEqual([url[:80] for url in asked if url != path.as_uri() and not url.startswith(("data:", "chrome:"))], [],
                         "beside what stands in the page, and icons of the browser's")

    def all(self, selector):
        return self.browser.find_elements("css selector", selector)

    def one(self, selector):
        found = self.all(selector)
        self.assertEqual(len(found), 1, selector)
        return found[0]

    def read(self, script, *arguments):
        return self.browser.execute_script("return " + script, *arguments)

    def texts(self, selector):
        return self.read("[...document.querySelectorAll(arguments[0])].map((node) => node.textContent)", selector)

    def seen(self, selector):
        return [node.text for node in self.all(selector) if node.is_displayed()]

    def do(self):
        return ActionChains(self.browser)

    def show(self, node):
        """Brings it to the middle of the window, where no head of a table covers it."""
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", node)
        return node

    def drag(self, node, start, end):
        """From and to places in shares of the node from its middle."""
        self.show(node)
        size = node.size
        at = lambda share: (round(share[0] * size["width"]), round(share[1] * size["height"]))
        (x0, y0), (x1, y1) = at(start), at(end)
        self.do().move_to_element_with_offset(node, x0, y0).click_and_hold().move_by_offset((x1 - x0) // 2, (y1 - y0) // 2).move_by_offset(
            x1 - x0 - (x1 - x0) // 2, y1 - y0 - (y1 - y0) // 2).release().perform()

    def wheel(self, node, amount, share=(0, 0)):
        self.show(node)
        origin = ScrollOrigin.from_element(node, round(share[0] * node.size["width"]), round(share[1] * node.size["height"]))
        self.do().scroll_from_origin(origin, 0, amount).perform()

    def head(self, text, table="table.sortable"):
        (found,) = [node for node in self.all(f"{table} th") if node.text.split(" ▲")[0].split(" ▼")[0] == text]
        return self.show(found)

    def column(self, index):
        """What the rows that are shown begin with in a column, from the top."""
        script = """[...document.querySelectorAll('table.sortable tr')].filter((row) => !row.hidden && !row.querySelector('th'))
                    .map((row) => row.cells[arguments[0]].textContent)"""
        return self.read(script, index)


class ChartPage(Browser):
    def setUp(self):
        super().setUp()
        self.open(self.chart())
        self.choose_scene("cornell")

    def choose_scene(self, name):
        self.one("#scene").send_keys(name)
        self.assertEqual(self.read("document.getElementById('scene').value"), name)

    def mark(self, words):
        (found,) = [node for node in self.all(".scatter .point") if words in node.find_element("css selector", "title").get_attribute("textContent")]
        return found

    def ticks(self):
        return self.texts(".scatter > text")

    def test_names_are_text(self):
        self.assertIn(EVIL, self.texts(".scatter > text"), "the legend")
        self.assertFalse(self.all("img[src=x]"))
        self.do().move_to_element(self.mark(EVIL)).perform()
        self.assertIn(EVIL, self.one("#card h3").text)

    def test_a_mark_shows_its_picture(self):
        self.do().move_to_element(self.mark("resolution=128")).perform()
        self.assertIn("shadow_maps.resolution=128", self.one("#card h3").text)
        row = "[...document.querySelectorAll('tr[data-point]')].find((r) => r.textContent.includes('resolution=128')).querySelectorAll('img')"
        self.assertEqual(self.read("[...document.querySelectorAll('#card img')].map((i) => i.src)"), self.read(f"[...{row}].map((i) => i.src)"))
        self.assertTrue(self.read("document.querySelector('#card img').naturalWidth === 64"), "a picture, and not a broken one")
        self.assertIn("20.00 %", self.one("#card .figures").text)

    def test_two_marks_are_compared(self):
        self.mark("resolution=64").click()
        self.assertEqual(self.seen(".differences"), [])
        self.mark("resolution=256").click()
        lines = {cells[0]: cells[1:] for cells in self.read("[...document.querySelectorAll('.differences tr')].map((r) => [...r.cells].map((c) => c.textContent))")}
        self.assertEqual(lines["shadow_maps.resolution"], ["64", "256"])
        self.assertEqual(lines["GPU time, ms"], ["5", "20"])
        self.assertEqual(lines["RMSE"], ["40.00 %", "10.00 %"])
        self.assertEqual(lines["direct, ms"], ["4", "19"])
        for same in ("scene", "graph", "size", "memory, MiB", "SSIM", "gbuffer, ms"):
            self.assertNotIn(same, lines)
        self.assertEqual(len(self.all("#pair .frame")), 3, "the divided pictures and two maps")
        self.mark(EVIL).click()
        self.assertIn("graph", self.texts(".differences td:first-child"))
        self.assertFalse(self.all("#pair .frame"), "a divider has two sides")
        self.show(self.all(".chip button")[0]).click()
        self.assertEqual(len(self.all(".chip")), 2)
        self.assertEqual(len([box for box in self.all("input.choose") if box.is_selected()]), 2)

    def test_the_divider_and_the_linked_zoom(self):
        for words in ("resolution=64", "resolution=256"):
            self.mark(words).click()
        slider = self.one("#pair .slider .frame")
        clip = "document.querySelectorAll('#pair .slider .layer')[1].style.clipPath"
        self.assertEqual(self.read(clip), "inset(0px 0px 0px 50%)")
        self.drag(slider, (0, 0), (-0.25, 0))
        self.assertAlmostEqual(float(re.search(r"([\d.]+)%", self.read(clip)).group(1)), 25, delta=1)
        self.assertAlmostEqual(float(self.one(".position").get_attribute("value")), 25, delta=1)
        self.one(".position").send_keys(Keys.END)
        self.assertEqual(self.read(clip), "inset(0px 0px 0px 100%)", "the keyboard moves it too")
        transforms = "[...new Set([...document.querySelectorAll('#pair img')].map((i) => i.style.transform))]"
        first, second = self.all("#pair .map .frame")
        self.wheel(first, -240, (-0.4, -0.4))
        (zoomed,) = self.read(transforms)
        self.assertIn("scale(2)", zoomed)
        self.drag(second, (0.2, 0), (-0.2, 0))
        (moved,) = self.read(transforms)
        self.assertNotEqual(moved, zoomed)
        self.assertIn("scale(2)", moved)
        self.do().move_to_element(first).perform()
        self.assertEqual(self.read("[...document.querySelectorAll('#pair .cross')].map((c) => c.hidden)"), [False, True, False])
        self.show(first)
        self.do().double_click(first).perform()
        self.assertIn("scale(1)", self.read(transforms)[0])

    def test_the_axes_zoom(self):
        whole = self.ticks()
        self.wheel(self.one(".scatter"), -240)
        near = self.ticks()
        self.assertNotEqual(near, whole)
        self.wheel(self.one(".scatter"), 480)
        self.assertEqual(self.ticks(), whole, "no further out than all")
        self.drag(self.one(".scatter"), (-0.3, -0.3), (0, 0.1))
        self.assertNotEqual(self.ticks(), whole)
        self.assertFalse(self.all(".rectangle"))
        (button,) = [node for node in self.all("button") if node.text == "show all"]
        button.click()
        self.assertEqual(self.ticks(), whole)
        self.do().move_to_element(self.mark("resolution=64")).click().perform()
        self.assertEqual(len(self.all(".chip")), 1, "what is zoomed can still be chosen")

    def test_another_error_and_cost_and_scene(self):
        self.assertEqual(len(self.all(".scatter .point")), 5)
        front = self.read("document.querySelectorAll('.scatter .point[fill-opacity=\"1\"]').length")
        self.assertEqual(front, 3, "64, 128 and 256")
        self.one("#cost").send_keys("memory")
        self.assertIn("memory, MiB", self.ticks())
        self.one("#error").send_keys("1 - SSIM")
        self.assertTrue(any(text.startswith("1 - SSIM") for text in self.ticks()))
        self.choose_scene("atrium")
        self.assertEqual(len(self.all(".scatter .point")), 1)

    def test_the_table_is_sorted_and_filtered(self):
        self.head("GPU ms").click()
        self.assertEqual([float(re.match(r"[\d.]+", text).group()) for text in self.column(1)], [5, 7, 9, 10, 20, 100])
        self.assertEqual(self.head("GPU ms").get_attribute("aria-sort"), "ascending")
        self.head("GPU ms").send_keys(Keys.ENTER)
        self.assertEqual([float(re.match(r"[\d.]+", text).group()) for text in self.column(1)], [100, 20, 10, 9, 7, 5])
        self.head("point").click()
        self.assertIn("atrium", self.column(0)[0])
        self.show(self.one(".filter")).send_keys("cornell resolution=1")
        self.assertEqual(len(self.column(0)), 2, "128 and 1024")
        self.assertEqual(self.one(".count").text, "2 of 6 rows")
        self.assertEqual(len(self.all(".scatter .point")), 2, "the chart shows what the table shows")

    def test_rows_choose_too(self):
        row = [node for node in self.all("tr[data-point]") if "resolution=128" in node.text][0]
        self.show(row.find_element("css selector", "input")).click()
        self.assertEqual(self.texts(".letter"), ["A"])
        self.assertIn("A: cornell · direct · shadow_maps.resolution=128", self.one(".chip").text)

    def test_a_command_is_copied(self):
        row = [node for node in self.all("tr[data-point]") if "resolution=256" in node.text][0]
        button = self.show(row.find_element("css selector", "button.copy"))
        button.click()
        field = self.one(".filter")
        for _ in range(50):  # the clipboard is written aside
            field.clear()
            field.send_keys(Keys.CONTROL, "v")
            if field.get_attribute("value"):
                break
        self.assertEqual(field.get_attribute("value"), "bounce render cornell --graph direct --size 64x36 --frames 1 "
                                                       "--set shadow_maps.resolution=256 --timings t.json -o x.exr")


class OtherPages(Browser):
    def test_the_policy_refuses_other_scripts(self):
        self.browser.get(self.chart().as_uri())
        self.browser.get_log("browser")
        self.browser.execute_script("const s = document.createElement('script'); s.textContent = 'window.other = 1'; document.body.append(s);"
                                    "document.body.insertAdjacentHTML('beforeend', '<img src=\"data:,\" onerror=\"window.other = 2\">')")
        self.do().pause(0.2).perform()
        self.assertIsNone(self.read("window.other ?? null"))
        complaints = [entry["message"] for entry in self.browser.get_log("browser")]
        self.assertEqual(sum("Content Security Policy" in text for text in complaints), 2, complaints)

    def test_without_script_there_are_chart_and_table(self):
        page = self.chart()
        plain = page.with_name("plain.html")
        plain.write_text(re.sub(r"script-src [^;]*", "script-src 'none'", page.read_text(), count=1))
        self.browser.get(plain.as_uri())
        self.assertEqual(len(self.all("#plot > svg circle title")), 6, "a mark each with its title")
        self.assertEqual(len([row for row in self.all("tr[data-point]") if row.is_displayed()]), 6)
        self.assertFalse(self.all("button"))

    def test_stability(self):
        self.open(self.stability())
        self.assertTrue(any(EVIL in text for text in self.texts("td")))
        self.assertFalse(self.all("img"))
        curve = self.all("svg.curve")[0]
        self.do().move_to_element(curve).perform()
        self.assertIn("low: direct", self.one(".above").text)
        self.assertEqual(len(self.texts(".above .value")), 3)
        points = self.read("document.querySelector('.above .own').getAttribute('points').split(' ').length")
        self.assertEqual(points, 3)
        self.do().move_to_element(self.one("h1")).perform()
        self.assertFalse(self.all(".above"))
        curve.click()
        self.do().move_to_element(self.one("h1")).perform()
        self.one(".above")
        self.do().send_keys(Keys.ESCAPE).perform()
        self.assertFalse(self.all(".above"))
        self.one(".filter").send_keys("same")
        self.assertEqual(len(self.column(0)), 1)

    def test_ablation(self):
        self.open(self.ablation())
        for text, index in (("time", 3), ("error, points", 1)):
            self.head(text).click()
            numbers = [float(re.match(r"[+-]?[\d.]+", cell).group()) for cell in self.column(index) if re.match(r"[+-]?[\d.]+", cell)]
            self.assertGreater(len(numbers), 3)
            self.assertEqual(numbers, sorted(numbers))
        image = self.show(self.all("td img")[0])
        self.do().move_to_element(image).perform()
        self.assertEqual(self.one(".above img").get_attribute("src"), image.get_attribute("src"))
        self.assertGreater(self.one(".above img").size["width"], 2 * image.size["width"])

    def test_tuning(self):
        self.open(self.tuning())
        self.assertIn("start", self.texts(".scatter text"))
        # Which settings were tried depends on measured times: any but the graph's own will do.
        names = {node: node.get_attribute("textContent") for node in self.all(".scatter .point")}
        changed = next(node for node, name in names.items() if re.fullmatch(r"[\w.]+=\w+", name))
        parameter, value = names[changed].split("=")
        # By key: points as near as these may lie over each other.
        next(node for node, name in names.items() if "as it is" in name).send_keys(Keys.ENTER)
        changed.send_keys(Keys.ENTER)
        lines = {cells[0]: cells[1:] for cells in self.read("[...document.querySelectorAll('.differences tr')].map((r) => [...r.cells].map((c) => c.textContent))")}
        self.assertIn(value, lines[parameter])
        self.assertEqual(len(set(lines[parameter])), 2, "the graph's own value is told")
        self.assertFalse(self.all("#pair"))
        self.head("ms").click()
        numbers = [float(text) for text in self.column(3)]
        self.assertEqual(numbers, sorted(numbers))

    def test_comparison(self):
        self.open(self.comparison())
        self.assertIn(EVIL, self.one("figure.slider figcaption").text)
        slider = self.one(".slider .frame")
        self.drag(slider, (0, 0), (0.25, 0))
        self.assertAlmostEqual(float(self.one(".position").get_attribute("value")), 75, delta=1)
        self.wheel(slider, -480)
        self.assertEqual(self.one(".zoom").text, "4.0 ×")
        self.head("part").click()
        self.head("part").click()
        self.assertEqual(self.column(0), ["out.radiance", "out.direct"])

    def test_snapshots(self):
        """The window writes that page: the markup here is its."""
        body = "<h1>Snapshots</h1>" + "".join(
            f'<section><h2>{i + 1}: direct</h2><img alt="" src="data:image/png;base64,{one["thumbnail_png"]}"></section>'
            for i, one in enumerate(POINTS[:3]))
        page = self.folder / "snapshots.html"
        page.write_text(assembled(body, ["page", "pictures", "snapshots"]))
        self.open(page)
        self.assertEqual(self.one("figcaption").text, "left: 1: direct; right: 2: direct")
        left, right = self.all("select")
        right.send_keys("3")
        self.assertEqual(self.one("figcaption").text, "left: 1: direct; right: 3: direct")
        frame = self.one(".frame")
        self.wheel(frame, -240)
        before = self.read("document.querySelector('.layer img').style.transform")
        self.do().key_down(Keys.SHIFT).perform()
        self.drag(frame, (0.1, 0), (-0.1, 0))
        self.do().key_up(Keys.SHIFT).perform()
        self.assertNotEqual(self.read("document.querySelector('.layer img').style.transform"), before, "Shift moves")
        self.assertEqual(float(self.one(".position").get_attribute("value")), 50)

    def test_all_methods(self):
        self.open(self.methods())
        self.assertEqual(self.read("document.getElementById('light').value"), "shadows")
        self.assertEqual(len(self.all(".scatter .point")), 2)
        self.assertEqual(len(self.all("#card img")), 3, "picture, error, reference")
        first, second = self.all(".scatter .point")
        first.click()
        self.assertIn("right: reference", self.one(".slider figcaption").text)
        second.click()
        self.assertIn("shadow_maps.resolution", self.texts(".differences td:first-child"))
        self.one("#light").send_keys("one")
        self.assertEqual(len(self.all(".scatter .point")), 2)
        self.one("#tuned").click()
        self.assertEqual(len(self.all(".scatter .point")), 1, "rsm alone")
        self.one("#tuned").click()
        self.one("#light").send_keys("every")
        self.assertEqual(len(self.all(".scatter .point")), 4)
        self.assertTrue(any("all light" in text for text in self.texts(".scatter text")))


if __name__ == "__main__":
    unittest.main()
