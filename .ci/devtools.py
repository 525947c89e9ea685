"""Chromium by the DevTools protocol, over a pair of pipes: nothing to install beside the browser, no port to find free.

Only what .ci/browser needs: a page, its keys, its screen, and all that it asks for or complains about.
"""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

FLAGS = """--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking
--disable-component-update --disable-sync --hide-scrollbars --remote-debugging-pipe""".split()
NAMES = ["chromium", "chromium-browser", "google-chrome"]
# What a key is called, the text it types, and its number on the keyboard; letters are their own.
KEYS = {"Enter": ("\r", 13), "Tab": (None, 9), "Escape": (None, 27), "ArrowLeft": (None, 37), "ArrowRight": (None, 39)}


class Failure(Exception):
    """The browser did not do what it was asked."""


class Chromium:
    """One browser with one tab.

    `patience`: how many seconds what must come may take; `grace`: the same of what may not come at all.
    """

    def __init__(self, patience=60.0, grace=15.0):
        self.patience, self.grace = patience, grace
        self.profile = tempfile.mkdtemp(prefix="pendula-browser-")
        program = next(filter(None, map(shutil.which, NAMES)), None)
        if program is None:
            raise Failure("there is no Chromium here: apt-get install chromium")
        inbox, self.to = os.pipe()
        self.out, outbox = os.pipe()
        # The browser reads from descriptor 3 and writes to 4: through spares, as the pipes may be 3 and 4 themselves.
        plumbing = f'exec 8<&{inbox} 9>&{outbox} && exec 3<&8 4>&9 8<&- 9>&- && exec "$@"'
        command = ["bash", "-c", plumbing, "bash", program, *FLAGS, f"--user-data-dir={self.profile}", "about:blank"]
        self.process = subprocess.Popen(command, pass_fds=(inbox, outbox), stderr=subprocess.DEVNULL)
        os.close(inbox)
        os.close(outbox)
        self.buffer, self.number, self.session = b"", 0, None
        self.loaded, self.urls, self.complaints = 0, {}, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log", "Network"]:
            self.call(f"{domain}.enable")
        # A headless tab in the background draws nothing, and lets no element have the focus.
        self.call("Emulation.setFocusEmulationEnabled", enabled=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.session = None
            self.call("Browser.close")
            self.process.wait(10)
        except (Failure, OSError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def call(self, method, **params):
        """What the browser answers to `method`."""
        self.number += 1
        request = {"id": self.number, "method": method, "params": params}
        if self.session:
            request["sessionId"] = self.session
        message = json.dumps(request).encode() + b"\0"
        while message:
            message = message[os.write(self.to, message) :]
        deadline = time.monotonic() + self.patience
        while True:
            answer = self._receive(deadline)
            if answer is None:
                raise Failure(f"{method}: no answer within {self.patience:g} s")
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise Failure(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def _receive(self, deadline):
        """The next message, its event noted; None after the deadline."""
        while b"\0" not in self.buffer:
            ready, _, _ = select.select([self.out], [], [], max(0, deadline - time.monotonic()))
            if not ready:
                return None
            piece = os.read(self.out, 1 << 20)
            if not piece:
                raise Failure("the browser has gone")
            self.buffer += piece
        line, _, self.buffer = self.buffer.partition(b"\0")
        message = json.loads(line)
        self._note(message.get("method"), message.get("params", {}))
        return message

    def _note(self, event, p):
        if event == "Page.loadEventFired":
            self.loaded += 1
        elif event == "Runtime.consoleAPICalled" and p["type"] in ("error", "warning", "assert"):
            words = " ".join(str(a.get("value", a.get("description", ""))) for a in p["args"])
            self.complaints.append(f"console {p['type']}: {words}")
        elif event == "Runtime.exceptionThrown":
            details = p["exceptionDetails"]
            words = details.get("exception", {}).get("description") or details["text"]
            self.complaints.append(f"console error: {words.splitlines()[0]}")
        elif event == "Log.entryAdded" and p["entry"]["level"] in ("error", "warning"):
            # A failed request is told of below, with its name.
            if p["entry"]["source"] != "network":
                self.complaints.append(f"console {p['entry']['level']}: {p['entry']['text']}")
        elif event == "Network.requestWillBeSent":
            url = self.urls[p["requestId"]] = p["request"]["url"]
            if not url.startswith(("file:", "data:", "blob:", "about:")):
                self.complaints.append(f"leaves the machine: {url}")
        elif event == "Network.loadingFailed" and not p.get("canceled"):
            self.complaints.append(f"missing: {self.urls.get(p['requestId'], '?')} ({p['errorText']})")

    def take_complaints(self):
        """What the page complained of since this was last asked, each thing once."""
        complaints, self.complaints = list(dict.fromkeys(self.complaints)), []
        return complaints

    def open(self, path):
        """Opens a file and waits until it has loaded."""
        before = self.loaded
        answer = self.call("Page.navigate", url=Path(path).resolve().as_uri())
        if "errorText" in answer:
            raise Failure(f"{path}: {answer['errorText']}")
        if not self.wait_for_load(before):
            raise Failure(f"{path}: not loaded within {self.patience:g} s")

    def wait_for_load(self, before, patience=None):
        """Whether a page has loaded since there were `before` of them."""
        deadline = time.monotonic() + (patience or self.patience)
        while self.loaded == before:
            if self._receive(deadline) is None:
                return False
        return True

    def run(self, script):
        """The value of an expression in the page; a promise is waited for."""
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise Failure(details.get("exception", {}).get("description") or details["text"])
        return answer["result"].get("value")

    def wait_until(self, script):
        """Whether an expression in the page becomes true in time."""
        deadline = time.monotonic() + self.grace
        while not (held := self.run(script)) and time.monotonic() < deadline:
            time.sleep(0.02)
        return bool(held)

    def press(self, key):
        """Presses and releases a key, as the keyboard would."""
        text, code = KEYS.get(key, (key, ord(key[0].upper())))
        event = {"key": key, "code": key, "windowsVirtualKeyCode": code}
        self.call("Input.dispatchKeyEvent", type="keyDown", **event, **({"text": text} if text else {}))
        self.call("Input.dispatchKeyEvent", type="keyUp", **event)

    def drag(self, start, end):
        """Presses the mouse at one point, moves it to another in a few steps, and lets go."""
        mouse = lambda kind, x, y, **more: self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)
        mouse("mouseMoved", *start)
        mouse("mousePressed", *start, button="left", clickCount=1)
        for part in [0.25, 0.5, 0.75, 1]:
            x, y = (a + part * (b - a) for a, b in zip(start, end))
            mouse("mouseMoved", x, y, button="left", buttons=1)
        mouse("mouseReleased", *end, button="left", clickCount=1)

    def screen(self, width, height=900, media=""):
        """Sets the size of the window, and what it is for: '' is the screen, 'print' paper."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", media=media)

    def scripts(self, on):
        """Allows the pages' scripts, or not."""
        self.call("Emulation.setScriptExecutionDisabled", value=not on)

    def picture(self, path):
        """Saves the whole page as PNG."""
        data = self.call("Page.captureScreenshot", captureBeyondViewport=True)["data"]
        Path(path).write_bytes(base64.b64decode(data))

    def clip(self, path, first, last):
        """Saves the page from the top of one element to the bottom of another as PNG."""
        box = self.run(f"""(() => {{ const [a, b] = [{first}, {last}].map(e => e.getBoundingClientRect());
            return {{x: a.x, y: a.y + scrollY, width: a.width, height: b.bottom - a.y, scale: 1}} }})()""")
        data = self.call("Page.captureScreenshot", captureBeyondViewport=True, clip=box)["data"]
        Path(path).write_bytes(base64.b64decode(data))

    def paper(self, path):
        """Saves the page as PDF on A4, with margins of a centimetre."""
        inch = 2.54
        size = {"paperWidth": 21.0 / inch, "paperHeight": 29.7 / inch}
        margins = {f"margin{side}": 1 / inch for side in ("Top", "Bottom", "Left", "Right")}
        data = self.call("Page.printToPDF", **size, **margins)["data"]
        Path(path).write_bytes(base64.b64decode(data))
