"""How long an input waits until a frame that heard it is on the screen: figures, and no time that must be met.

BOUNCE_LATENCY="SHOT GRAPH" measures these in a picture of the window's size; else a small scene is taken. The figures hold
the start of a process that sends the event (about 10 ms)."""

import json
import os
import statistics
import subprocess
import time
import unittest

from window_driver import WindowTest

EVENTS = 40


class WindowLatency(WindowTest):
    def wait(self, what, description, seconds=1800):
        """A large scene takes its time to open."""
        return super().wait(what, description, seconds)

    def answered(self, *words):
        """Milliseconds from the event to the frame that heard it."""
        before, start = self.state()["drawn"], time.monotonic()
        subprocess.run(["xdotool", *map(str, words)], env=self.environment(), check=True, timeout=60)
        while time.monotonic() < start + 90:
            try:
                if self.state()["drawn"] > before:
                    return 1000 * (time.monotonic() - start)
            except json.JSONDecodeError:
                pass
            time.sleep(0.002)
        self.fail("an event was not answered within 90 s")

    def report(self, what, times):
        times.sort()
        print(f"{what}: median {statistics.median(times):.0f} ms, 99th percentile {times[int(0.99 * (len(times) - 1))]:.0f} ms "
              f"of {len(times)} events", flush=True)

    def test_input_is_answered(self):
        given = os.environ.get("BOUNCE_LATENCY", "").split()
        shot, graph = given if given else (str(self.shot), "direct")
        self.open(shot, "--graph", graph)
        x0, y0, x1, y1 = self.state()["widgets"]["viewport"]
        x, y = round((x0 + x1) / 2), round((y0 + y1) / 2)
        self.report(f"{graph}, pointer over panels", [self.answered("mousemove", 40 + 3 * i, 20 + 4 * i) for i in range(EVENTS)])
        self.answered("mousemove", x, y)
        camera = self.state()["camera"]
        self.answered("mousedown", 1)
        times = [self.answered("mousemove", x + 3 * i, y) for i in range(1, EVENTS)]
        self.answered("mouseup", 1)
        self.report(f"{graph}, camera dragged", times)
        self.wait(lambda state: state["camera"] != camera, "the camera that was dragged")
        whole = self.wait(lambda state: state["size"][0] >= round(x1 - x0) - 1, "the whole picture once it rests")
        self.assertGreater(whole["rendered"], 0)


if __name__ == "__main__":
    unittest.main()
