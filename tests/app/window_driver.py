"""Drives the real window, on a display of its own, by real input events. It tells where its widgets lie by --dump-ui."""

import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import time
import unittest

from program import PROGRAM, ProgramTest, png_pixel

SIZE = (1366, 768)  # a laptop's screen
PICTURE = (96, 64)
NO_PASSES = {"tab", "scene", "camera", "compare", "capture", "status", "parameters", "stability", "palette", "nodes", "views", "lights",
             "light", "snapshots", "time", "sweep", "gizmo", "object", "viewer", "banner", "graph", "resources"}  # parts of the window
TOOLS = {"Xvfb": "xvfb", "xdotool": "xdotool", "xwininfo": "x11-utils"}


class Display:
    """An X server on a free display; only the process that was started here is ended."""

    def __init__(self):
        self.memory = tempfile.TemporaryDirectory(prefix="bounce_screen_")
        read, write = os.pipe()
        self.process = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{SIZE[0]}x{SIZE[1]}x24", "-nolisten", "tcp",
                                         "-noreset", "-fbdir", self.memory.name], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.name = ":" + pipe.readline().strip()

    def close(self):
        self.process.terminate()
        self.process.wait(30)
        self.memory.cleanup()

    def pixels(self, x0, y0, x1, y1):
        """Rows of pixels as the screen has them now."""
        screen = (pathlib.Path(self.memory.name) / "Xvfb_screen0").read_bytes()  # an X window dump
        header = struct.unpack(">25I", screen[:100])
        start, row, size = header[0] + 12 * header[19], header[12], header[11] // 8
        places = [[start + y * row + x * size for x in range(x0, x1)] for y in range(y0, y1)]
        return [[screen[place:place + 3] for place in line] for line in places]


class WindowTest(ProgramTest):
    @classmethod
    def setUpClass(cls):
        missing = [package for tool, package in TOOLS.items() if not shutil.which(tool)]
        if missing:
            raise unittest.SkipTest("not installed: " + ", ".join(missing))
        cls.display = Display()
        cls.addClassCleanup(cls.display.close)

    def environment(self):
        environment = dict(super().environment(), DISPLAY=self.display.name, HOME=str(self.folder),
                           XDG_STATE_HOME=str(self.folder / "state"), XDG_CACHE_HOME=str(self.folder / "cache"))
        environment.pop("WAYLAND_DISPLAY", None)
        environment.pop("XAUTHORITY", None)
        return environment

    # --- the program ---

    def open(self, *arguments):
        self.earlier = {}  # where widgets were before the last event
        self.dump = self.folder / "dump.json"
        self.dump.unlink(missing_ok=True)
        self.log = open(self.folder / "log", "w+")
        self.addCleanup(self.log.close)
        self.window = subprocess.Popen([PROGRAM, "view", *map(str, arguments), "--window", "%dx%d" % SIZE, "--dump-ui", str(self.dump)],
                                       env=self.environment(), cwd=self.out, stdout=self.log, stderr=self.log)
        self.addCleanup(self.stop, self.window)
        self.wait(lambda state: state["rendered"] >= 2 and state["drawn"] >= 3, "the first frames")

    def said(self):
        self.log.flush()
        return (self.folder / "log").read_text()

    def state(self):
        return json.loads(self.dump.read_text()) if self.dump.exists() else None

    def wait(self, what, description, seconds=90):
        """Waits for a drawn frame whose state satisfies `what`; returns the state. Widgets that are not drawn do not."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            state = self.state()
            try:
                if state and what(state):
                    return state
            except KeyError:
                pass
            self.assertIsNone(self.window.poll(), f"the program ended while waiting for {description}: {self.said()}")
            time.sleep(0.05)
        self.fail(f"{description}: not within {seconds} s; {json.dumps(self.state())}; {self.said()}")

    def wait_for_exit(self):
        self.assertEqual(self.window.wait(90), 0, self.said())

    def kill(self):
        """As a crash does: at once, and without a word."""
        self.window.kill()
        self.window.wait(30)

    # --- input ---

    def events(self, *words):
        """Events one after another, faster than frames: none is waited for. Words are xdotool's; a widget's name in
        brackets is its middle, [NAME@SHARE] the place at a share of its width."""
        spelled = []
        for word in map(str, words):
            if word.startswith("["):
                name, _, share = word[1:-1].partition("@")
                spelled += map(str, self.place(name, float(share or 0.5)))
            else:
                spelled.append(word)
        subprocess.run(["xdotool", *spelled], env=self.environment(), check=True, timeout=60)

    def input(self, *words):
        """One event, and the frame that heard it."""
        before, self.earlier = self.state()["drawn"], self.state()["widgets"]
        subprocess.run(["xdotool", *map(str, words)], env=self.environment(), check=True, timeout=60)
        self.wait(lambda state: state["drawn"] > before, "a frame after " + " ".join(map(str, words)))
        time.sleep(0.1)

    def place(self, widget, share=0.5):
        """A point of a widget: at a share of its width, half its height. A parameter that lies beyond the panel's edge is
        wheeled into view."""
        for turn in range(40):
            state = self.state()
            rows = [rect for name, rect in state["widgets"].items() if name.endswith(".mark")]
            if widget in state["widgets"] or not rows or not re.fullmatch(r"\w+\.\w+", widget) or widget.split(".")[0] in NO_PASSES:
                break
            x0, y0, x1, y1 = rows[len(rows) // 2]
            self.move(round((x0 + x1) / 2), round((y0 + y1) / 2))
            self.input("click", 4 if turn < 10 else 5)  # up to the first, then down
        state = self.wait(lambda state: widget in state["widgets"], f"the widget {widget}")
        if state["widgets"][widget] != self.earlier.get(widget):
            # What has just come up takes its place over some frames.
            first, end = state["drawn"], time.monotonic() + 1
            while time.monotonic() < end and self.state()["drawn"] < first + 3:
                time.sleep(0.05)
            state = self.wait(lambda state: widget in state["widgets"], f"the widget {widget}")
        x0, y0, x1, y1 = state["widgets"][widget]
        return round(x0 + share * (x1 - x0)), round((y0 + y1) / 2)

    def move(self, x, y):
        """A pointer that is at the place already moves nothing, so that no frame is drawn for it."""
        place = subprocess.run(["xdotool", "getmouselocation"], env=self.environment(), capture_output=True, text=True, check=True, timeout=60)
        if not place.stdout.startswith(f"x:{x} y:{y} "):
            self.input("mousemove", x, y)

    def click(self, widget):
        self.move(*self.place(widget))
        self.input("mousedown", 1)
        self.input("mouseup", 1)

    def drag(self, widget, start, end, button=1):
        points = [self.place(widget, share) for share in (start, (start + end) / 2, end)]
        self.move(*points[0])
        self.input("mousedown", button)
        self.move(*points[1])
        self.move(*points[2])
        self.input("mouseup", button)

    def type(self, widget, text):
        self.click(widget)
        subprocess.run(["xdotool", "type", "--delay", "50", text], env=self.environment(), check=True, timeout=60)

    def capture(self, key="F12"):
        """Presses the key; returns the file that was written."""
        before = self.state()["last_capture"]
        self.input("key", key)
        path = self.wait(lambda state: state["last_capture"] != before, "a capture")["last_capture"]
        return self.out / os.path.basename(path)

    def middle(self, path):
        return png_pixel(path, PICTURE[0] // 2, PICTURE[1] // 2)
