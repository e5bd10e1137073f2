"""A user at mouse and keyboard, inside Blender: real X events by xdotool, screenshots by ImageMagick's import.

Every method that takes time is a generator: ``yield`` gives Blender time to handle events and to draw.
"""

import subprocess
import time

import bpy
import numpy as np

TICK = 0.025
"""Seconds between two steps."""
PATIENCE = 180
"""Seconds after which what a scenario waits for has failed: no measure of speed, for the machine may be busy."""

KEYCODES = {"F3": 69, "F12": 96}
"""Keys whose name gives xdotool the wrong level."""


class User:
    """What a person does; ``folder`` receives the screenshots."""

    def __init__(self, folder):
        self.folder = folder
        self.known = {}

    @property
    def window(self):
        return bpy.context.window_manager.windows[0]

    def area(self, kind="VIEW_3D"):
        return next(area for area in self.window.screen.areas if area.type == kind)

    def region(self, kind="UI", area="VIEW_3D"):
        return next(region for region in self.area(area).regions if region.type == kind)

    def send(self, *words):
        subprocess.run(["xdotool", *map(str, words)], check=True, timeout=PATIENCE)

    def wait(self, seconds):
        for _ in range(max(1, round(seconds / TICK))):
            yield

    def until(self, holds, what, seconds=PATIENCE):
        end = time.monotonic() + seconds
        while not holds():
            assert time.monotonic() < end, f"not within {seconds} s: {what}"
            yield

    def point(self, x, y):
        """Move the mouse to a place in the window, from the bottom left."""
        self.send(*self.moves(x, y))
        yield
        yield

    def moves(self, x, y):
        """The words that move the mouse to a place, in two steps: Blender ignores a jump."""
        column, row = round(x), self.window.height - 1 - round(y)
        return "mousemove", column - 3, row - 3, "mousemove", column, row

    def click(self, x, y):
        yield from self.point(x, y)
        self.send("click", 1)
        yield from self.wait(0.3)

    def key(self, name):
        self.send("key", KEYCODES.get(name, name))
        yield from self.wait(0.3)

    def scroll(self, steps, down=True):
        region = self.region()
        yield from self.point(region.x + region.width // 2, region.y + region.height // 2)
        self.send("click", "--repeat", steps, "--delay", 5, 5 if down else 4)
        yield
        yield

    def screenshot(self, name, areas=()):
        """Take a screenshot of the window, or of areas side by side; return its path.

        Blender's own operator gives a black one with software OpenGL.
        """
        path = f"{self.folder}/{name}.png"
        words = "-window", "root", *self.crop(areas), "-define", "png:compression-level=1", path
        subprocess.run(["import", *words], check=True, timeout=PATIENCE)
        return path

    def picture(self, name, areas=()):
        """Take a screenshot and return it, (rows, columns, 3) from 0 to 1, row 0 at the bottom. ImageMagick unpacks it:
        Blender takes half a second to load one.
        """
        words = "convert", self.screenshot(name, areas), "-depth", "8", "ppm:-"
        done = subprocess.run(words, check=True, timeout=PATIENCE, stdout=subprocess.PIPE)
        _, size, _, pixels = done.stdout.split(b"\n", 3)
        width, height = map(int, size.split())
        return np.frombuffer(pixels, np.uint8).reshape(height, width, 3)[::-1] / np.float32(255)

    def crop(self, areas):
        """The words that crop a screenshot to areas; none for the window."""
        if not areas:
            return []
        left, right = min(area.x for area in areas), max(area.x + area.width for area in areas)
        bottom, top = min(area.y for area in areas), max(area.y + area.height for area in areas)
        return ["-crop", f"{right - left}x{top - bottom}+{left}+{self.window.height - top}", "+repage"]

    def cut(self, picture, region):
        """Return the part of a screenshot that a region fills."""
        return picture[region.y : region.y + region.height, region.x : region.x + region.width]

    def open_tab(self, name, area=None):
        """Open an area's sidebar (N), the 3D View's by default, and click on its tabs until the one of that name is
        active.
        """
        area = area or self.area()
        region = next(region for region in area.regions if region.type == "UI")
        if region.width < 10:
            yield from self.point(area.x + area.width // 3, area.y + area.height // 3)
            yield from self.key("n")
            yield from self.until(lambda: region.width > 10, "the sidebar is open")
        yield from self.wait(0.5)
        for y in range(region.y + region.height - 12, region.y, -24):
            if region.active_panel_category == name:
                return
            yield from self.click(region.x + region.width - 12, y)
        raise AssertionError(f"the sidebar has no tab {name!r}")

    def find(self, command, region=None, keys="ctrl+c", share=1 / 3):
        """Move the mouse onto the button of an operator in a region, the sidebar's by default: the one of which Ctrl+C
        copies that Python command; of a property Ctrl+Shift+C copies the data path. ``known`` has its height, and that
        of each button passed on the way; the mouse is at a ``share`` of the region's width.

        Places are tried every 17 pixels, less than a button's height: those near the last place first. If it is not in
        sight, the sidebar is scrolled down, by less than its height at once, and back to its top.
        """
        wm, turns = bpy.context.window_manager, [0, 10, 10, 10, -60] if region is None else [0]
        region = region or self.region()
        x, top = region.x + round(region.width * share), region.y + region.height - 34
        for steps in turns:
            if steps:
                yield from self.scroll(abs(steps), steps > 0)
            first = self.known.get(command, top)
            for y in (first, *sorted(range(top, region.y, -17), key=lambda y: abs(y - first))):
                wm.clipboard = ""
                self.send(*self.moves(x, y))
                yield  # Blender leaves the button before this one first
                self.send("key", keys)
                yield
                yield
                copied = wm.clipboard.strip()
                if copied.startswith(command):
                    self.known[command] = y
                    return
                self.known[copied.partition("(")[0] + "("] = y
        raise AssertionError(f"no button for {command}")

    def see_render(self, name=""):
        """Wait for Blender's render view, take a screenshot with a name, and go back to the 3D View."""

        def has(kind):
            return any(area.type == kind for area in self.window.screen.areas)

        yield from self.until(lambda: has("IMAGE_EDITOR"), "the render is shown")
        yield from self.wait(0.7)
        if name:
            self.screenshot(name)
        editor = self.area("IMAGE_EDITOR")
        yield from self.point(editor.x + editor.width // 2, editor.y + editor.height // 2)
        yield from self.key("Escape")
        yield from self.until(lambda: has("VIEW_3D"), "the view is back")

    def press(self, command, region=None):
        """Press the button of an operator: see ``find``."""
        yield from self.find(command, region)
        region = region or self.region()
        yield from self.click(region.x + region.width // 3, self.known[command])


def pixels_of(image):
    """Return an image's pixels, (rows, columns, channels)."""
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], image.channels)
