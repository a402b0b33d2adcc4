"""A headless Chromium, driven over a pipe by its DevTools protocol: no driver, no port, no other package."""

import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

TIMEOUT = 120  # seconds for any answer; only a machine that is very busy comes near


class BrowserError(Exception):
    pass


class Browser:
    """One browser process; pages are opened one after the other."""

    def __init__(self):
        program = shutil.which("chromium")
        if program is None:
            raise BrowserError("chromium is not installed (tools/setup/packages.txt names the package)")
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self.write_end = os.pipe()
        self.read_end, from_browser = os.pipe()
        command = [program, "--headless", "--no-sandbox", "--disable-gpu-sandbox", "--disable-quic",
                   "--no-first-run",
                   "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
                   "--disable-background-networking", "--disable-component-update", "--disable-sync",
                   "--disable-default-apps", "--disable-extensions", "--disable-dev-shm-usage",
                   "--hide-scrollbars",
                   "--force-color-profile=srgb", "--remote-debugging-pipe",
                   f"--user-data-dir={self.profile.name}", "about:blank"]
        # the browser reads from descriptor 3 and writes to 4
        self.process = subprocess.Popen(
            ["/bin/bash", "-c", f'exec "$@" 3<&{to_browser} 4>&{from_browser}', "browser", *command],
            pass_fds=(to_browser, from_browser), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer = b""
        self.last = 0
        self.events = []

    def close(self):
        try:
            self.call("Browser.close")
        except BrowserError:
            pass
        os.close(self.write_end)
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.read_end)
        self.profile.cleanup()

    def _read(self, deadline):
        """The next message; None if none comes by then."""
        while b"\0" not in self.buffer:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([self.read_end], [], [], left)[0]:
                return None
            chunk = os.read(self.read_end, 1 << 20)
            if not chunk:
                raise BrowserError("the browser has gone")
            self.buffer += chunk
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, session=None, **parameters):
        self.last += 1
        message = {"id": self.last, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        try:
            while data:
                data = data[os.write(self.write_end, data):]
        except BrokenPipeError as error:
            raise BrowserError("the browser has gone") from error
        deadline = time.monotonic() + TIMEOUT
        while True:
            answer = self._read(deadline)
            if answer is None:
                raise BrowserError(f"no answer to {method}")
            if answer.get("id") == self.last:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            if "method" in answer:
                self.events.append(answer)

    def open(self, path, **settings):
        return Page(self, path, **settings)


class Page:
    """A tab that shows one file, with all its messages and requests from the beginning."""

    def __init__(self, browser, path, width=1400, height=1000, dark=False, phone=False):
        self.browser = browser
        target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.target = target
        for domain in ("Runtime", "Log", "Network", "Page"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, mobile=phone,
                  deviceScaleFactor=2 if phone else 1)
        if phone:
            self.call("Emulation.setTouchEmulationEnabled", enabled=True)
        self.prefer("dark" if dark else "light")
        browser.events.clear()
        self.url = pathlib.Path(path).resolve().as_uri()
        self.call("Page.navigate", url=self.url)
        self.state()

    def state(self):
        """Waits until the page has loaded: "ready" or "failed"."""
        deadline = time.monotonic() + TIMEOUT
        while (state := self.run("document.body ? document.body.dataset.state : undefined")) in (
                None, "loading"):
            if time.monotonic() > deadline:
                raise BrowserError("the page does not come to an end of loading")
            time.sleep(0.05)
        return state

    def frame(self):
        """The frame of the page that has a process of its own."""
        deadline = time.monotonic() + TIMEOUT
        while time.monotonic() < deadline:
            for target in self.browser.call("Target.getTargets", filter=[{"type": "iframe"}])["targetInfos"]:
                made = object.__new__(Page)
                made.browser, made.target = self.browser, target["targetId"]
                made.session = self.browser.call("Target.attachToTarget", targetId=made.target,
                                                 flatten=True)["sessionId"]
                return made
            time.sleep(0.05)
        raise BrowserError("the page has no frame in a process of its own")

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def run(self, expression):
        """The value of a JavaScript expression, a promise's when it is fulfilled."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise BrowserError(details.get("exception", {}).get("description", details["text"]))
        return result["result"].get("value")

    def prefer(self, scheme):
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def said(self):
        """What went to the console, or was thrown and not caught, but for the driver's remarks on speed."""
        self.run("0")
        lines = []
        for event in self.browser.events:
            parameters = event.get("params", {})
            if event["method"] == "Runtime.consoleAPICalled":
                lines.append(" ".join(str(a.get("value", a.get("description"))) for a in parameters["args"]))
            elif event["method"] == "Runtime.exceptionThrown":
                details = parameters["exceptionDetails"]
                lines.append(details.get("exception", {}).get("description", details["text"]))
            elif event["method"] == "Log.entryAdded":
                lines.append(parameters["entry"]["text"])
        return [line for line in lines if "GL Driver Message (OpenGL, Performance" not in line]

    def requests(self):
        """The addresses that were asked for."""
        self.run("0")
        return [event["params"]["request"]["url"] for event in self.browser.events
                if event["method"] == "Network.requestWillBeSent"]

    def press(self, key, modifiers=0):
        text = {"text": key} if len(key) == 1 else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, modifiers=modifiers, **text)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key, modifiers=modifiers)

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, x, y):
        self.drag((x, y), (x, y))

    def drag(self, start, end):
        self.mouse("mouseMoved", *start)
        self.mouse("mousePressed", *start, button="left", buttons=1, clickCount=1)
        if end != start:
            self.mouse("mouseMoved", *end, button="left", buttons=1)
        self.mouse("mouseReleased", *end, button="left", clickCount=1)

    def picture(self, whole=False):
        """A screenshot as PNG."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png",
                                          captureBeyondViewport=whole)["data"])

    def close(self):
        self.browser.call("Target.closeTarget", targetId=self.target)
