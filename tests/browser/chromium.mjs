// A headless Chromium, driven over its DevTools protocol through a pipe (file descriptors 3 and 4): no port, no package.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const flags = ["--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--disable-sync", "--disable-extensions", "--mute-audio", "--hide-scrollbars", "--remote-debugging-pipe"];

/// One page in a browser of its own. Collects what goes wrong and every request that is made.
export class Page {
  static async open(program, options = {}) {
    const page = new Page();
    page.folder = mkdtempSync(join(tmpdir(), "mis-browser-"));
    page.process = spawn(program, [...flags, `--user-data-dir=${page.folder}`, "about:blank"], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    page.gone = new Promise((resolve) => page.process.on("exit", resolve));
    page.listen(page.process.stdio[4]);
    page.errors = [];
    page.requests = [];
    const { targetInfos } = await page.call("Target.getTargets", {}, null);
    const { sessionId } = await page.call("Target.attachToTarget", { targetId: targetInfos.find((t) => t.type === "page").targetId, flatten: true }, null);
    page.session = sessionId;
    for (const domain of ["Page", "Runtime", "Log", "Network", "Accessibility"]) await page.call(`${domain}.enable`);
    await page.resize(options.width ?? 1280, options.height ?? 900);
    return page;
  }

  listen(stream) {
    this.waiting = new Map();
    this.listeners = new Map();
    this.last = 0;
    let rest = [];
    stream.on("data", (data) => {
      for (let end; (end = data.indexOf(0)) >= 0; data = data.subarray(end + 1)) {
        this.receive(JSON.parse(Buffer.concat([...rest, data.subarray(0, end)]).toString()));
        rest = [];
      }
      rest.push(data);
    });
  }
  receive(message) {
    if (message.id) {
      const { resolve, reject } = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      return message.error ? reject(new Error(message.error.message)) : resolve(message.result);
    }
    const p = message.params;
    if (message.method === "Runtime.exceptionThrown") this.errors.push(p.exceptionDetails.exception?.description ?? p.exceptionDetails.text);
    if (message.method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(p.type)) this.errors.push(p.args.map((a) => a.value ?? a.description).join(" "));
    if (message.method === "Log.entryAdded" && ["error", "warning"].includes(p.entry.level)) this.errors.push(`${p.entry.text} ${p.entry.url ?? ""}`);
    if (message.method === "Network.requestWillBeSent") this.requests.push(p.request.url);
    this.listeners.get(message.method)?.(p);
    this.listeners.delete(message.method);
  }
  call(method, params = {}, session = this.session) {
    const id = ++this.last;
    this.process.stdio[3].write(JSON.stringify({ id, method, params, ...(session ? { sessionId: session } : {}) }) + "\0");
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }
  event(method) { return new Promise((resolve) => this.listeners.set(method, resolve)); }

  resize(width, height, scale = 1) { return this.call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: scale, mobile: false }); }
  scheme(value) { return this.call("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] }); }
  /// Milliseconds until the load event.
  async go(url) {
    const loaded = this.event("Page.loadEventFired"), start = performance.now();
    await this.call("Page.navigate", { url });
    await loaded;
    return performance.now() - start;
  }
  /// The value of an expression (awaited), run in the page.
  async value(expression) {
    const { result, exceptionDetails } = await this.call("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  /// Until the expression is true; fails after some seconds.
  async until(expression, seconds = 20) {
    for (const end = performance.now() + 1000 * seconds; performance.now() < end;) {
      if (await this.value(expression)) return;
      await new Promise((resolve) => setTimeout(resolve, 25));
    }
    throw new Error(`never true: ${expression}`);
  }
  async key(key, modifiers = 0) {
    const text = key.length === 1 ? key : key === "Enter" ? "\r" : undefined;
    await this.call("Input.dispatchKeyEvent", { type: text ? "keyDown" : "rawKeyDown", key, code: key, text, modifiers, windowsVirtualKeyCode: virtual_keys[key] });
    await this.call("Input.dispatchKeyEvent", { type: "keyUp", key, code: key, modifiers, windowsVirtualKeyCode: virtual_keys[key] });
  }
  async mouse(type, x, y, more = {}) { await this.call("Input.dispatchMouseEvent", { type, x, y, ...more }); }
  async click(x, y) {
    await this.mouse("mouseMoved", x, y);
    await this.mouse("mousePressed", x, y, { button: "left", clickCount: 1 });
    await this.mouse("mouseReleased", x, y, { button: "left", clickCount: 1 });
  }
  /// The middle of the first element that a selector finds, scrolled into view.
  middle(selector) {
    return this.value(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.scrollIntoView({ block: "center" }); const b = e.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()`);
  }
  async click_on(selector) { await this.click(...await this.middle(selector)); }
  async picture(options = {}) {
    const { data } = await this.call("Page.captureScreenshot", { format: "png", ...options });
    return Buffer.from(data, "base64");
  }
  async close() {
    this.call("Browser.close", {}, null).catch(() => {});
    await this.gone;
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}
const virtual_keys = { Tab: 9, Enter: 13, Escape: 27, ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40 };
