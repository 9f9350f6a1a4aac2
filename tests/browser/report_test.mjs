// Opens reports in a headless Chromium, as a person would from disk, and tries all that a page does.
//     node report_test.mjs MIS SCENES CHROMIUM NO_NUMBER
// Prints what was seen; exits with 1 at the first thing that is wrong.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Page } from "./chromium.mjs";

const [mis, scenes, chromium, no_number] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "mis-report-"));
const hostile = "<script>alert(1)</script><img src=x onerror=alert(2)> \"quoted\" & 'single' \u202Eabc ünï שלום";

function compare(name, ...words) {
  const out = join(folder, name);
  execFileSync(mis, ["compare", ...words, "--quiet", "--seed", "7", "--out", out], { stdio: ["ignore", "ignore", "inherit"] });
  return { url: "file://" + join(out, "report.html"), json: JSON.parse(readFileSync(join(out, "report.json"))), size: statSync(join(out, "report.html")).size };
}
/// A scene file without its comments.
const scene_of = (name) => JSON.parse(readFileSync(join(scenes, name), "utf8").replace(/\/\/[^"\n]*$/gm, ""));
/// A scene whose name and material are markup.
function hostile_scene() {
  const scene = scene_of("single.json");
  const file = join(folder, "<b>&'hostile\".json");
  const renamed = JSON.stringify({ ...scene, name: hostile, materials: Object.fromEntries(Object.entries(scene.materials).map(([k, v]) => [k + "<img src=x>", v])) }).replace(/"material":"([^"]*)"/g, '"material":"$1<img src=x>"');
  writeFileSync(file, renamed);
  return file;
}

let page;
const settled = () => page.until('document.querySelector("#hero-picture").dataset.painted && document.querySelector("#picture").dataset.painted === `${view.mode} ${picture_layer()}`');
const text = (selector) => page.value(`document.querySelector(${JSON.stringify(selector)}).innerText`);
const painted = () => page.value('(() => { const c = document.querySelector("#picture"); return c.toDataURL(); })()');
async function open(report) {
  page.errors.length = page.requests.length = 0;
  const milliseconds = await page.go(report.url);
  return milliseconds;
}
function nothing_went_wrong(report) {
  assert.deepEqual(page.errors, []);
  const outside = page.requests.filter((url) => url !== report.url && !/^(data|blob):/.test(url));
  assert.deepEqual(outside, [], "requests leave the file");
}
const close_to = (shown, value, what) => assert.ok(Math.abs(Number.parseFloat(shown) / value - 1) < .006, `${what}: the page shows ${shown}, report.json has ${value}`);
const units = { h: 3600, min: 60, s: 1, ms: 1e-3, "µs": 1e-6, ns: 1e-9 };
function seconds_of(shown) { const [, number, unit] = shown.match(/^([\d.e-]+)\s(\S+)/); return Number(number) * units[unit]; }

const tests = {
  async "the figures of the page are those of report.json"(report) {
    const scene = report.json.scenes[0], rows = await page.value(`[...document.querySelectorAll("#table tbody tr")].map((r) => ({ name: r.dataset.strategy, cells: Object.fromEntries([...r.querySelectorAll("[data-figure]")].map((c) => [c.dataset.figure, c.innerText])), rank: r.cells[1].innerText, all: r.innerText }))`);
    assert.equal(rows.length, scene.strategies.length);
    let ranked = 0;
    for (const row of rows) {
      const s = scene.strategies.find((t) => t.name === row.name);
      if (s.status !== "ranked") { assert.ok(row.all.includes({ not_run: "not run", not_resolved: "not resolved", biased: "biased" }[s.status])); continue; }
      ++ranked;
      assert.equal(row.rank, s.rank_low === s.rank_high ? `${s.rank}` : `${s.rank_low}–${s.rank_high}`);
      close_to(row.cells.variance, s.variance.value, "variance");
      close_to(row.cells.relative, s.relative_variance.value, "relative variance");
      close_to(row.cells.cost, 1e9 * s.seconds_per_sample.value, "ns per sample");
      close_to(row.cells.efficiency, s.efficiency.value, "efficiency");
      close_to(seconds_of(row.cells.time), s.seconds_to_1_percent, "time to 1 %");
    }
    assert.ok(ranked >= 3);
    assert.ok(await page.value('document.querySelector("#table table").scrollWidth <= 1.25 * document.querySelector("#table").clientWidth'), "ties do not push the figures out of sight");
    const spaces = (s) => s.replace(/\s+/g, " ").trim();
    assert.equal(spaces(await text("#verdict")), spaces(scene.sentences[0]));
    const checks = await page.value(`[...document.querySelectorAll("#checks tbody tr")].map((r) => [r.dataset.strategy, r.cells[3].innerText])`);
    for (const [name, mean] of checks) close_to(mean, scene.strategies.find((s) => s.name === name).mean, "mean");
  },

  async "the table sorts by each heading"() {
    const column = (k) => page.value(`[...document.querySelectorAll('#table tbody tr [data-figure="${k}"]')].map((c) => c.innerText)`);
    for (const [text_of_head, key] of [["Variance", "variance"], ["Rays/sample", "rays"], ["Rel. variance", "relative"]]) {
      await page.value(`[...document.querySelectorAll("#table th button")].find((b) => b.textContent === "${text_of_head}").click()`);
      const up = (await column(key)).map(Number.parseFloat);
      assert.deepEqual(up, up.slice().sort((a, b) => a - b), `${text_of_head} rises`);
      await page.value(`document.activeElement.click()`);
      assert.equal(await page.value(`document.querySelector('#table th[aria-sort="descending"]').innerText.replace(/[▲▼]/g, "").trim()`), text_of_head);
      const down = (await column(key)).map(Number.parseFloat);
      assert.deepEqual(down, up.slice().sort((a, b) => b - a), `${text_of_head} falls`);
    }
  },

  async "a click singles a strategy out everywhere, Escape lets go"(report) {
    const name = report.json.scenes[0].strategies.find((s) => s.status === "ranked").name;
    const dimmed = () => page.value(`[...document.querySelectorAll(".dim")].map((e) => e.dataset.strategy)`);
    await page.click_on(`#legend button[data-strategy="${name}"]`);
    assert.ok((await dimmed()).length > 10 && !(await dimmed()).includes(name));
    await page.key("Escape");
    assert.deepEqual(await dimmed(), []);
    await page.click_on(`#plot-variance .target[data-target="${name}"]`);
    assert.ok(!(await dimmed()).includes(name) && (await dimmed()).length > 10);
    await page.key("Escape");
  },

  async "plots answer to the pointer and to keys, and are saved as SVG"(report) {
    const s = report.json.scenes[0].strategies.find((t) => t.status === "ranked");
    const [x, y] = await page.middle(`#plot-variance .target[data-target="${s.name}"]`);
    await page.mouse("mouseMoved", x, y);
    await page.until('!document.querySelector("#tip").hidden');
    const tip = await text("#tip");
    assert.ok(tip.startsWith(s.name));
    close_to(tip.match(/variance ([\d.e-]+)/)[1], s.variance.value, "variance in the tip");
    for (const id of ["plot-error", "plot-variance", "plot-efficiency", "plot-stages"]) {
      await page.value(`document.querySelector("#${id} svg").focus()`);
      await page.key("ArrowDown");
      const first = await text("#tip");
      await page.key("ArrowDown");
      assert.notEqual(await text("#tip"), first, id);
      await page.key("Enter");
      assert.ok(await page.value('shown.strategy !== null'), id);
      await page.key("Escape");
      await page.value(`window.saved = null; { const make_url = URL.createObjectURL; URL.createObjectURL = (b) => { b.text().then((t) => { window.saved = t; }); URL.createObjectURL = make_url; return make_url.call(URL, b); }; } document.querySelector("#${id} button").click()`);
      await page.until("window.saved !== null");
      const valid = await page.value(`(() => { const d = new DOMParser().parseFromString(window.saved, "image/svg+xml"); return !d.querySelector("parsererror") && d.querySelectorAll("path, rect").length; })()`);
      assert.ok(valid > 5, `${id} as SVG`);
    }
  },

  async "a strategy's bar of stages is what its sample costs"(report) {
    for (const s of report.json.scenes[0].strategies.filter((t) => Object.keys(t.stage_seconds).length > 0)) {
      const tip = await page.value(`(() => { const t = document.querySelector('#plot-stages .target[data-target="${s.name}"]'); t.dispatchEvent(new MouseEvent("mousemove")); return document.querySelector("#tip").innerText; })()`);
      const stages = Object.entries(s.stage_seconds).reduce((sum, [name, seconds]) => sum + (name === "prepare" ? 0 : seconds), 0);
      close_to(tip.match(/: ([\d.e-]+) ns per sample/)[1], 1e9 * (Math.max(stages, s.seconds_per_sample.value) + s.seconds_per_point.value / report.json.at), s.name);
    }
    await page.value("hide_tip()");
  },

  async "marks stand out from both grounds by 3 to 1"() {
    const least = await page.value(`(() => {
      const light = (c) => { const k = d3.rgb(c), of = (v) => v / 255 <= .04045 ? v / 255 / 12.92 : ((v / 255 + .055) / 1.055) ** 2.4; return .2126 * of(k.r) + .7152 * of(k.g) + .0722 * of(k.b) + .05; };
      const all = [...Object.values(policy_colours), ...colours(30), no_policy_colour, ...stage_groups.map((g) => g.colour)];
      return Math.min(...all.flatMap((c) => ["#ffffff", "#14171a"].map((ground) => Math.max(light(c), light(ground)) / Math.min(light(c), light(ground)))));
    })()`);
    assert.ok(least >= 3, `${least} to 1`);
  },

  async "a policy or heuristic that the page has never heard of has a colour or mark of its own"() {
    // Today's look is by today's registry.
    assert.deepEqual(await page.value("Object.entries(policy_colours)"), [["uniform", "#C27E00"], ["power", "#2E93CC"], ["solid-angle", "#009E73"], ["radiant-solid-angle", "#D55E00"], ["all", "#CC79A7"], ["irradiance", "#0072B2"], ["product", "#7466B4"], ["tree", "#B04A6A"]]);
    assert.deepEqual(await page.value("Object.entries(heuristic_marks).map(([name, m]) => [name, m.word, m.dash, m.lighter])"), [["light", "circle", "1 4", 1], ["balance", "square", "7 3", 0], ["power", "triangle", null, -1], ["cutoff", "diamond", "7 3 1 3", 1.8], ["maximum", "star", "2 2", -1.8]]);
    const known = await page.value("colours(8)"), many = await page.value("colours(24)"), none = await page.value("no_policy_colour");
    assert.deepEqual(many.slice(0, known.length), known, "more policies change no colour of those before them");
    const least = await page.value(`(() => { const all = [...colours(24), no_policy_colour]; return Math.min(...all.flatMap((a, i) => all.slice(0, i).map((b) => difference(a, b)))); })()`);
    assert.ok(least >= 10, `colours differ by ${least} at least`);
    assert.ok(!many.includes(none));
    const marks = await page.value(`Array.from({ length: 12 }, (_, i) => mark_at(i)).map((m) => [m.word, m.dash, d3.symbol().type(m.symbol).size(70)()])`);
    for (const of of [0, 1, 2]) assert.equal(new Set(marks.map((m) => m[of])).size, marks.length, "shape, dash and word");
    assert.ok(marks.every((m) => !/NaN/.test(m[2])));
  },

  async "the curves cross 1 % at the report's time"(report) {
    for (const s of report.json.scenes[0].strategies.filter((t) => t.status === "ranked" && t.relative_variance.value > 1e-4)) {
      const error = await page.value(`curve_of(scene_now().strategies.find((s) => s.name === ${JSON.stringify(s.name)})).error(${s.seconds_to_1_percent})`);
      close_to(error, .01, s.name);
    }
  },

  async "the viewer shows every strategy in every mode"(report) {
    const seen = new Set(), scene = report.json.scenes[0];
    for (const [k, mode] of ["picture", "difference", "variance", "winner"].entries()) {
      await page.value(`document.querySelector("#picture").dataset.painted = ""; document.querySelectorAll("#modes button")[${k}].click()`);
      await page.until(`document.querySelector("#picture").dataset.painted.startsWith("${mode}")`);
      const picture = await painted();
      assert.ok(!seen.has(picture), `${mode} looks like another mode`);
      seen.add(picture);
      assert.equal(await page.value('document.querySelector("#scale").children.length > 0'), mode !== "picture");
    }
    await page.value('document.querySelectorAll("#modes button")[0].click()');
    const pictures = new Set();
    for (const [k, s] of scene.strategies.entries()) {
      if (s.status === "not_run") continue;
      await page.value(`document.querySelector("#picture").dataset.painted = ""; document.querySelector('#layers input[value="${k}"]').click()`);
      await page.until(`document.querySelector("#picture").dataset.painted === "picture ${k}"`);
      pictures.add(await painted());
    }
    assert.equal(pictures.size, scene.strategies.filter((s) => s.status !== "not_run").length);
  },

  async "the pictures' means are the report's"(report) {
    const scene = report.json.scenes[0];
    for (const [k, s] of scene.strategies.entries()) {
      if (s.status === "not_run") continue;
      const [mean, variance] = await page.value(`(async () => { const l = await layer_of(0, ${k}), w = await layer_of(0, "winners"); let m = 0, v = 0, n = 0; for (let i = 0; i < l.mean.length; ++i) if (w.kind[i] > 0) { m += l.mean[i]; v += l.variance[i]; ++n; } return [m / n, v / n]; })()`);
      close_to(mean, s.mean, `${s.name}: mean of the picture`);
      assert.ok(Math.abs(variance / s.variance.value - 1) < .02, `${s.name}: variance of the picture`);
    }
  },

  async "the viewer is driven by keys alone"() {
    await page.value('document.querySelector("#picture").focus(); document.querySelector("#picture").scrollIntoView({ block: "center" })');
    const layer = () => page.value("view.layer");
    const before = await layer();
    await page.key(".");
    assert.notEqual(await layer(), before);
    await page.key(",");
    assert.equal(await layer(), before);
    await page.key("r");
    assert.equal(await layer(), "reference");
    await page.key("r");
    assert.equal(await layer(), before);
    await page.key("4");
    assert.equal(await page.value("view.mode"), "winner");
    await page.key("1");
    const fit = await painted();
    await page.key("+");
    assert.equal(await page.value("view.zoom"), 2);
    assert.notEqual(await painted(), fit);
    await page.key("0");
    assert.equal(await page.value("view.zoom"), 1);
    for (let i = 0; i < 3; ++i) await page.key("ArrowDown");
    await page.key("Enter");
    await page.until('document.querySelectorAll("#pixel table").length > 0');
    assert.match(await text("#pixel h3"), /^At pixel \d+, \d+/);
    assert.match(await text("#read-out"), /reference/);
  },

  async "a click on a pixel shows its ranking and its lights"(report) {
    const [x, y] = await page.middle("#picture");
    await page.click(x, y + 40);
    await page.until('document.querySelectorAll("#pixel table").length === 2');
    const [ranking, lights] = await page.value(`[...document.querySelectorAll("#pixel table")].map((t) => [...t.tBodies[0].rows].map((r) => [...r.cells].map((c) => c.innerText)))`);
    assert.equal(ranking.length, report.json.scenes[0].strategies.filter((s) => s.status !== "not_run").length);
    assert.match(lights[0][0], /^light \d+$/);
    const shares = lights.map((l) => Number.parseFloat(l[1]));
    assert.ok(shares.every((s, i) => i === 0 || s <= shares[i - 1]));
  },

  async "exposure, gamma, wheel and drag change the picture"() {
    await page.value('document.querySelectorAll("#modes button")[0].click()');
    for (const [id, value] of [["exposure", -2], ["gamma", 1.2]]) {
      await settled();
      const before = await painted();
      await page.value(`{ const e = document.querySelector("#${id}"); e.value = ${value}; e.oninput(); }`);
      await page.until(`document.querySelector("#picture").toDataURL() !== ${JSON.stringify(before)}`);
    }
    const [x, y] = await page.middle("#picture");
    await page.mouse("mouseWheel", x, y, { deltaX: 0, deltaY: -600 });
    await page.until("view.zoom > 2");
    const at = await page.value("view.x");
    await page.mouse("mousePressed", x, y, { button: "left", buttons: 1, clickCount: 1 });
    for (const d of [20, 40, 60]) await page.mouse("mouseMoved", x + d, y, { button: "left", buttons: 1 });
    await page.mouse("mouseReleased", x + 60, y, { button: "left" });
    assert.ok(await page.value("view.x") < at);
    await page.value('document.querySelector("#zoom-fit").click()');
  },

  async "every control is reached by Tab and has a name"() {
    await page.value("document.activeElement.blur(); scrollTo(0, 0)");
    for (let known = false; !known;) {  // round and round, through the browser's own bar
      await page.key("Tab");
      known = await page.value('(() => { const e = document.activeElement; if (e === document.body) return false; const known = e.dataset.reached === "yes"; e.dataset.reached = "yes"; return known; })()');
    }
    const missed = await page.value(`[...document.querySelectorAll("button, select, input, summary, [tabindex]")].filter((e) => e.offsetParent !== null && e.dataset.reached !== "yes" && e.type !== "radio").map((e) => e.outerHTML.slice(0, 90))`);
    assert.deepEqual(missed, []);
    const { nodes } = await page.call("Accessibility.getFullAXTree");
    const nameless = nodes.filter((n) => !n.ignored && ["button", "radio", "slider", "combobox", "link", "image", "table"].includes(n.role?.value) && !n.name?.value);
    assert.deepEqual(nameless.map((n) => n.role.value), []);
  },

  async "text contrasts with its ground by 4.5 to 1, light and dark"() {
    for (const scheme of ["light", "dark"]) {
      await page.scheme(scheme);
      const low = await page.value(`(() => {
        const part = (v) => { v /= 255; return v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4; };
        const light = ([r, g, b]) => .2126 * part(r) + .7152 * part(g) + .0722 * part(b);
        const colour = (c) => c.match(/[\\d.]+/g).map(Number);
        const ground = (e) => { for (; e; e = e.parentElement) { const c = colour(getComputedStyle(e).backgroundColor); if (c.length < 4 || c[3] > .5) return c; } return colour(getComputedStyle(document.body).backgroundColor); };
        const found = [];
        for (const e of document.querySelectorAll("body *")) {
          const own = [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim());
          if (!own || e.offsetParent === null || e.closest("svg, script, style, .dim")) continue;
          const a = light(colour(getComputedStyle(e).color)), b = light(ground(e)), ratio = (Math.max(a, b) + .05) / (Math.min(a, b) + .05);
          if (ratio < 4.5) found.push(e.tagName + "." + e.className + " " + ratio.toFixed(2) + " " + e.textContent.slice(0, 30));
        }
        return found; })()`);
      assert.deepEqual(low, [], scheme);
    }
    await page.scheme("light");
  },

  async "on paper it is light, whole, and without controls"() {
    await page.call("Emulation.setEmulatedMedia", { media: "print", features: [{ name: "prefers-color-scheme", value: "dark" }] });
    await page.resize(703, 1000);  // A4 within its margins
    await page.until("innerWidth === 703");
    const seen = await page.value(`({ ground: getComputedStyle(document.body).backgroundColor,
      cut: [...document.querySelectorAll(".scroll")].filter((e) => e.offsetParent && e.getBoundingClientRect().left + e.scrollWidth > innerWidth).map((e) => e.id || e.className),
      controls: [...document.querySelectorAll("#viewer button, #viewer input, .plot-head button, nav button, .skip")].filter((e) => e.offsetParent && !e.closest("#scale, #pixel")).map((e) => e.outerHTML.slice(0, 60)) })`);
    assert.deepEqual(seen, { ground: "rgb(255, 255, 255)", cut: [], controls: [] });
    const { data } = await page.call("Page.printToPDF", { preferCSSPageSize: true });
    const pages = (Buffer.from(data, "base64").toString("latin1").match(/\/Type\s*\/Page\b/g) ?? []).length;
    const strategies = await page.value("report.scenes[0].strategies.length");
    assert.ok(pages >= 2 && pages <= strategies / 2, `${pages} pages for ${strategies} strategies`);
    assert.ok(await page.value('document.querySelector("#more-sentences").open'), "all findings are printed");
    await page.call("Emulation.setEmulatedMedia", { media: "", features: [{ name: "prefers-color-scheme", value: "light" }] });
    await page.resize(1280, 900);
  },

  async "a narrow window needs no scrolling sideways"() {
    for (const width of [400, 700, 1280]) {
      await page.resize(width, 800);
      await page.until(`innerWidth === ${width}`);
      await new Promise((resolve) => setTimeout(resolve, 100));
      assert.ok(await page.value("document.documentElement.scrollWidth <= innerWidth"), `${width} pixels`);
      const cut = await page.value(`[...document.querySelectorAll("svg[tabindex] .axis text")].filter((t) => { const a = t.getBoundingClientRect(), b = t.closest("svg").getBoundingClientRect(); return a.width > 0 && (a.left < b.left - 1 || a.right > b.right + 1); }).map((t) => t.textContent)`);
      assert.deepEqual(cut, [], `labels that are cut off at ${width} pixels`);
    }
    await page.resize(1280, 900);
  },
};

async function one_scene() {
  const report = compare("one", join(scenes, "overlap.json"), "--resolution", "96x64", "--spp", "256");
  const milliseconds = await open(report);
  await settled();
  const best = await page.value("scene_now().strategies.indexOf(best_of(scene_now()))");
  assert.deepEqual(await page.value("[...layers_read.keys()].sort()"), ["0:" + best, "0:reference", "0:winners"], "pictures that are not shown are not decoded");
  console.log(`one scene: ${(report.size / 1e6).toFixed(2)} MB, loaded in ${milliseconds.toFixed(0)} ms`);
  for (const [name, test] of Object.entries(tests)) {
    await test(report);
    nothing_went_wrong(report);
    console.log(`ok: ${name}`);
  }
}

async function several_scenes() {
  const file = hostile_scene();
  const report = compare("several", file, join(scenes, "single.json"), join(scenes, "overlap.json"), "--resolution", "48x32", "--spp", "128", "--policy", "uniform,solid-angle");
  await open(report);
  assert.equal(await page.value('document.querySelector("#one-scene").hidden'), true);
  const tabs = await page.value('[...document.querySelectorAll("#scenes button")].map((b) => b.textContent)');
  assert.deepEqual(tabs, ["All scenes", hostile, ...report.json.scenes.slice(1).map((s) => s.name)]);
  const cells = await page.value('document.querySelectorAll("#matrix tbody td").length'), names = report.json.scenes[0].strategies.length;
  assert.equal(cells, names * (3 + 1));
  for (const s of report.json.overall) assert.ok((await text("#over-all-table")).includes(s.name));
  for (let figure = 0; figure < 4; ++figure) {
    await page.value(`{ const s = document.querySelector("#matrix-figure"); s.value = "${figure}"; s.onchange(); }`);
    const shown = await page.value('[...document.querySelectorAll("#matrix tbody tr")].map((r) => [...r.cells].map((c) => c.innerText))');
    for (const k of [1, 2, 3]) assert.ok(shown.some((row) => ["1 ×", "exact"].includes(row[k])), `a best one on scene ${k}`);
  }
  for (const k of [1, 2, 3, 0]) {
    await page.value(`document.querySelectorAll("#scenes button")[${k}].click()`);
    if (k > 0) await page.until(`document.querySelector("#picture").dataset.painted && shown.scene === ${k - 1}`);
  }
  await page.value('document.querySelectorAll("#scenes button")[1].click()');
  assert.equal(await page.value('document.querySelector("#scene-name bdi").textContent'), hostile);
  assert.ok((await page.value('document.querySelector("#run").textContent')).includes(file));
  assert.equal(await page.value("document.querySelectorAll('img, b:not(.brand b)').length"), 0);
  await page.until('document.querySelector("#picture").dataset.painted === `${view.mode} ${picture_layer()}`');
  nothing_went_wrong(report);
  console.log("ok: several scenes, and names that are markup show as text");
}

/// A scene on some of whose tiles alone effects are simulated.
async function effects_by_tile() {
  const report = compare("tiles", join(scenes, "veach.json"), "--spp", "32", "--policy", "uniform");
  await open(report);
  const rows = await page.value('[...document.querySelectorAll("#effects tbody tr")].map((r) => r.innerText)'), effects = Object.entries(report.json.scenes[0].effects);
  assert.equal(rows.length, effects.length);
  assert.ok(effects.some(([, e]) => e.on && e.share < 1 && e.saved_rays_per_sample > 0), "one that is simulated on some tiles alone");
  for (const [name, e] of effects) {
    const row = rows.find((r) => r.startsWith(name.replaceAll("_", " ")));
    const rays = row.match(/(-?[\d.e-]+)\srays/), time = row.match(/(-?[\d.e-]+)\sns/);
    assert.equal(rays !== null, e.saved_rays_per_sample > 0, `${name}: rays are told where some are saved`);
    assert.equal(time !== null, e.saved_seconds_per_sample !== null, `${name}: time is told where it was measured`);
    if (rays) close_to(rays[1], e.saved_rays_per_sample, `${name}: rays saved`);
    if (time) close_to(time[1], 1e9 * e.saved_seconds_per_sample, `${name}: time saved`);
    if (e.on && e.share < 1) close_to(row.match(/on ([\d.]+)\s% of tiles/)[1], Number((100 * e.share).toPrecision(2)), `${name}: share`);
  }
  nothing_went_wrong(report);
  console.log("ok: what an effect saves is told wherever it was measured");
}

/// The registry gains six policies and four heuristics: a report of theirs is made from that of others.
async function names_that_no_page_knows() {
  const report = compare("new", join(scenes, "single.json"), "--resolution", "24x16", "--spp", "32", "--policy", "uniform,power", "--heuristic", "light,balance,power,cutoff,maximum,brdf");
  const policies = Array.from({ length: 6 }, (_, i) => `new-policy-${i}`), heuristics = Array.from({ length: 4 }, (_, i) => `new-heuristic-${i}`);
  const file = join(folder, "new", "report.html"), html = readFileSync(file, "utf8");
  const block = (id) => html.match(new RegExp(`<script type="application/json" id="${id}">(.*?)</script>`, "s"))[1];
  const glossary = JSON.parse(block("glossary")), figures = JSON.parse(block("report"));
  for (const name of policies) glossary.policy[name] = "in some new way";
  for (const name of heuristics) glossary.heuristic[name] = "in some new way";
  const names = figures.scenes[0].strategies.map((s) => s.name);
  figures.scenes[0].strategies.forEach((s, i) => { if (s.policy !== null) Object.assign(s, { policy: policies[i % 6], heuristic: heuristics[i % 4] }); });
  writeFileSync(file, html.replace(block("report"), () => JSON.stringify(figures)).replace(block("glossary"), () => JSON.stringify(glossary)));
  await open(report);
  await page.until('document.querySelectorAll("#legend button path").length > 0');
  const marks = await page.value(`[...document.querySelectorAll("#legend button")].map((b) => { const p = b.querySelector("path"); return [b.dataset.strategy, p.getAttribute("stroke").toLowerCase(), p.getAttribute("d")]; })`);
  assert.deepEqual(marks.map((m) => m[0]), names);
  assert.equal(new Set(marks.map((m) => m[1])).size, 6 + 1, "a colour for each new policy, and brdf's");
  assert.equal(new Set(marks.map((m) => m[2])).size, 4 + 1, "a mark for each new heuristic, and brdf's");
  const key = await text("#mark-key");
  for (const name of heuristics) assert.ok(key.includes(name), `the key names ${name}`);
  nothing_went_wrong(report);
  console.log("ok: names that no page knows have colours and marks of their own");
}

async function probes_alone() {
  const scene = scene_of("single.json");
  const file = join(folder, "probes.json");
  delete scene.camera;
  scene.probes = [0, 1].map((x) => ({ position: [x, 0, 0], normal: [0, 1, 0], outgoing: [0, 1, 0], material: Object.keys(scene.materials)[0] }));
  writeFileSync(file, JSON.stringify(scene));
  const report = compare("probes", file, "--spp", "256");
  await open(report);
  await page.until('document.querySelectorAll("#probes tbody tr").length > 0');
  assert.equal(await page.value('document.querySelector("#viewer").hidden && document.querySelector("#hero").hidden'), true);
  nothing_went_wrong(report);
  console.log("ok: probes without a picture");
}

async function pixels_that_are_no_numbers() {
  const file = join(folder, "no_number.html");
  const marked = JSON.parse(execFileSync(no_number, [file]));
  await open({ url: "file://" + file });
  await settled();
  const total = await page.value("maps_now().width * maps_now().height");
  for (const mode of ["picture", "difference", "variance"])
    for (const [layer, pixels] of Object.entries(marked)) {
      if (mode !== "picture" && layer === "reference") continue;
      assert.ok(pixels.length > 0 && pixels.length < total, layer);
      await page.value(`document.querySelector("#picture").dataset.painted = ""; set_mode("${mode}"); set_layer(${layer === "reference" ? '"reference"' : layer})`);
      await page.until(`document.querySelector("#picture").dataset.painted === "${mode} ${layer}"`);
      const [striped, magenta] = await page.value(`(() => {
        const { width, height } = view.painted, rgba = view.painted.getContext("2d").getImageData(0, 0, width, height).data;
        const is = (i, [r, g, b]) => rgba[4 * i] === r && rgba[4 * i + 1] === g && rgba[4 * i + 2] === b;
        const all = Array.from({ length: width * height }, (_, i) => i), magenta = all.filter((i) => is(i, bad_colour));
        return [all.filter((i) => is(i, ((i % width) + Math.floor(i / width)) % 6 < 3 ? bad_colour : [0, 0, 0])), magenta];
      })()`);
      const wanted = new Set(pixels);
      if (mode === "variance") for (const i of marked.reference) wanted.delete(i);  // the camera sees the light itself: no surface
      const shown = new Set(striped);
      assert.deepEqual([...wanted].filter((i) => !shown.has(i)), [], `${mode} of ${layer}: a pixel that is no number is striped`);
      assert.deepEqual(magenta.filter((i) => !wanted.has(i)), [], `${mode} of ${layer}: no other pixel is`);
    }
  const width = await page.value("maps_now().width"), at = (i) => page.value(`(async () => { pointed = { x: ${i % width}, y: ${Math.floor(i / width)} }; set_layer(0); await read_out(); return document.querySelector("#read-out").textContent; })()`);
  assert.match(await at(marked.reference[0]), /background, no number/);
  assert.match(await at(marked["0"].find((i) => !marked.reference.includes(i))), /samples here that were no numbers/);
  assert.ok(await page.value(`[...document.querySelectorAll("#checks tbody tr")].every((r) => Number(r.cells[7].innerText) > 0)`));
  assert.deepEqual(page.errors, []);
  console.log("ok: pixels that are no numbers show as marked");
}

async function stopped_early() {
  const out = join(folder, "partial");
  for (let seconds = 1; !existsSync(out) && seconds < 100; seconds *= 3)  // a slow machine may not have begun by then
    spawnSync("timeout", ["--signal=INT", String(seconds), mis, "compare", join(scenes, "overlap.json"), "--resolution", "64x48", "--time", "600", "--quiet", "--out", out]);
  await open({ url: "file://" + join(out, "report.html") });
  assert.match(await text("#banner"), /Stopped early/);
  console.log("ok: a report that was stopped says so");
}

try {
  page = await Page.open(chromium);
  for (const test of [one_scene, several_scenes, effects_by_tile, names_that_no_page_knows, probes_alone, pixels_that_are_no_numbers, stopped_early]) await test();
} catch (error) {
  console.error(error);
  process.exitCode = 1;
} finally {
  await page?.close();
  rmSync(folder, { recursive: true, force: true });
}
