"""Chromium without a window, driven over the DevTools protocol by a pipe: no package beside Python and Chromium is needed."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time


class Browser:
    """A browser with one page. Chromium reads commands at descriptor 3 and writes answers to descriptor 4, each ended by a zero byte."""

    OPTIONS = ("--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--disable-extensions", "--no-first-run", "--mute-audio",
               "--disable-background-networking", "--disable-component-update", "--disable-sync", "--use-angle=swiftshader",
               "--enable-unsafe-swiftshader", "--disable-gpu-rasterization", "--disable-accelerated-2d-canvas", "--disable-gpu-compositing",
               "--hide-scrollbars", "--force-color-profile=srgb", "--enable-precise-memory-info")

    def __init__(self, width=1600, height=950, program=None):
        self.profile = tempfile.mkdtemp(prefix="tera_view_")
        command_read, self.command = os.pipe()
        self.answer, answer_write = os.pipe()
        shell = f'exec "$0" "$@" 3<&{command_read} 4>&{answer_write}'
        self.process = subprocess.Popen(["bash", "-c", shell, program or found(), *self.OPTIONS, f"--user-data-dir={self.profile}",
                                         f"--window-size={width},{height}", "about:blank"],
                                        pass_fds=(command_read, answer_write), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(command_read)
        os.close(answer_write)
        self.number, self.pending, self.events = 0, b"", []
        target = next(one for one in self._send("Target.getTargets")["targetInfos"] if one["type"] == "page")
        self.session = self._send("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.send(f"{domain}.enable")
        self.resize(width, height)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(20)
        os.close(self.command)
        os.close(self.answer)
        shutil.rmtree(self.profile, ignore_errors=True)

    def _send(self, method, session=None, timeout_s=300, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.command, json.dumps(message).encode() + b"\0")
        number, end = self.number, time.monotonic() + timeout_s
        while True:
            answer = self._read(end, method)
            if answer.get("id") == number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self.events.append(answer)

    def _read(self, end, method):
        while b"\0" not in self.pending:
            ready, _, _ = select.select([self.answer], [], [], max(0, end - time.monotonic()))
            if not ready:
                raise TimeoutError(f"no answer to {method}")
            piece = os.read(self.answer, 1 << 20)
            if not piece:
                raise RuntimeError("the browser ended")
            self.pending += piece
        message, self.pending = self.pending.split(b"\0", 1)
        return json.loads(message)

    def send(self, method, **parameters):
        return self._send(method, session=self.session, **parameters)

    def resize(self, width, height, mobile=False):
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2 if mobile else 1, mobile=mobile)

    def open(self, address):
        self.send("Page.navigate", url=address)

    def run(self, script, timeout_s=300):
        """The value of a JavaScript expression; a promise is waited for."""
        result = self.send("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True, timeout_s=timeout_s)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"].get("exception", {}).get("description", "failed") + f"\nin {script}")
        return result["result"].get("value")

    def wait(self, condition, timeout_s=30):
        """Until a JavaScript expression is true."""
        end = time.monotonic() + timeout_s
        while time.monotonic() < end:
            if self.run(f"Boolean({condition})"):
                return
            time.sleep(0.05)
        raise TimeoutError(f"{condition} did not come true; the page said {self.faults()}")

    def move(self, x, y):
        self.send("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def key(self, key, code=None, number=0):
        text = {"text": key} if len(key) == 1 else {}
        self.send("Input.dispatchKeyEvent", type="keyDown", key=key, code=code or key, windowsVirtualKeyCode=number, **text)
        self.send("Input.dispatchKeyEvent", type="keyUp", key=key, code=code or key, windowsVirtualKeyCode=number)

    def picture(self, file):
        """Writes what is to be seen as PNG."""
        data = self.send("Page.captureScreenshot", format="png")["data"]
        with open(file, "wb") as out:
            out.write(base64.b64decode(data))

    def faults(self):
        """Errors and warnings that the page has reported so far."""
        said = []
        for event in self.events:
            if event.get("method") == "Runtime.exceptionThrown":
                details = event["params"]["exceptionDetails"]
                said.append(details.get("exception", {}).get("description", details["text"]))
            if event.get("method") == "Runtime.consoleAPICalled" and event["params"]["type"] in ("error", "warning"):
                said.append(" ".join(str(a.get("value", a.get("description", ""))) for a in event["params"]["args"]))
            if event.get("method") == "Log.entryAdded" and event["params"]["entry"]["level"] == "error":
                said.append(event["params"]["entry"]["text"] + " " + event["params"]["entry"].get("url", ""))
        return said

    def memory_mb(self):
        """Of the page and its workers: the proportional memory of this browser's renderers."""
        total = 0
        for pid in self._descendants(self.process.pid):
            try:
                with open(f"/proc/{pid}/cmdline", "rb") as command, open(f"/proc/{pid}/smaps_rollup", encoding="ascii") as maps:
                    if b"--type=renderer" in command.read():
                        total += next(int(line.split()[1]) for line in maps if line.startswith("Pss:"))
            except (FileNotFoundError, ProcessLookupError, StopIteration):
                continue
        return total / 1024

    def _descendants(self, pid):
        with open(f"/proc/{pid}/task/{pid}/children", encoding="ascii") as file:
            children = file.read().split()
        return [pid, *(one for child in children for one in self._descendants(int(child)))]


def found():
    """Chromium's program, or None."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
