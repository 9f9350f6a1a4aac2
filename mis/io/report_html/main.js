// The first screen, and which scene is shown.

/// A sentence with the names of strategies set as names.
function sentence_parts(sentence, names) {
  const parts = [], words = sentence.replaceAll(" %", "\u00a0%").split(/([ ,:;()]+)/);
  for (const word of words) {
    const bare = word.replace(/\.$/, "");
    if (names.has(bare)) parts.push(name_text(bare), word.slice(bare.length));
    else parts.push(word);
  }
  return parts;
}

/// What the strategy's name says, in words.
function meaning_of(s) {
  if (s.model === "strata") return `That is: ${s.counts[0]} light draws per point, in rounds. Each light that matters has a stratum of its own, and earlier draws say how the others are spread.`;
  if (s.policy === null) return `${s.name}: ${glossary.technique[s.technique] ?? "no light is chosen"}.`;
  const how = s.counts[1] === 0 ? glossary.heuristic[s.heuristic] : `the light draw and the BSDF draw are weighed ${glossary.heuristic[s.heuristic] ?? "by " + s.heuristic}`;
  const technique = s.technique === "cone" ? "" : ` The direction: ${glossary.technique[s.technique] ?? s.technique}.`;
  const which = glossary.policy[s.policy] ?? s.policy;
  return `That is: ${which.startsWith("one draw") ? which : "the light is drawn " + which}; ${how}.${technique}`;
}

function draw_tiles(scene, best) {
  const tile = (what, value, more) => make("div", {}, make("dt", {}, what), make("dd", {}, value, make("small", {}, ...[more].flat())));
  const tiles = [];
  if (best.seconds_to_1_percent !== null) tiles.push(tile("Time to 1 % error", duration(best.seconds_to_1_percent), `95\u00a0%: ${between(best.seconds_to_1_percent_interval, duration)}`));
  const others = ranked(scene).filter((s) => s !== best && s.seconds_to_1_percent !== null).sort((a, b) => a.seconds_to_1_percent - b.seconds_to_1_percent);
  const compared = (what, s) => { const x = sooner(scene, best.name, s.name); if (x) tiles.push(tile(what, number(x.value) + " ×", [x.value < 1.05 ? "as soon as " : "sooner than ", name_text(s.name), `; 95\u00a0%: ${between(x)}`])); };
  if (others.length > 0) compared("Against the next best", others[0]);
  if (others.length > 1) compared("Against the slowest", others[others.length - 1]);
  const count = ranked(scene).length - 1, rivals = ranked(scene).filter((s) => s !== best && s.may_be_best).length;
  const not_ranked = scene.strategies.length - ranked(scene).length, others_not_ranked = not_ranked > 0 ? `; ${not_ranked} more are not ranked` : "";
  const may_be = `${rivals} of ${count} others may be better`, more = scene.seconds_to_decide > 0 ? `; about ${duration(scene.seconds_to_decide)} more would decide` : "";
  tiles.push(tile("How sure", count === 0 ? "alone" : scene.decided ? "sure" : "not decided",
    (count === 0 ? "no other is ranked" : !scene.decided ? may_be + more : rivals > 0 ? `at most 5\u00a0% behind any other, at 95\u00a0%; ${may_be}` : `not behind any of ${count} others, at 95\u00a0%`) + (count > 0 ? others_not_ranked : "")));
  $("tiles").replaceChildren(...tiles);
}

function draw_answer() {
  const scene = scene_now(), best = best_of(scene), names = new Set(scene.strategies.map((s) => s.name)), first = 3;
  const pixels = scene.resolution ? `${scene.resolution[0]} × ${scene.resolution[1]} pixels, ` : `${number(scene.shading_points)} probes, `;
  $("scene-name").replaceChildren(make("bdi", {}, scene.name || scene.file), ` · ${pixels}${scene.lights} ${scene.lights === 1 ? "light" : "lights"}, ${scene.strategies.length} strategies compared`);
  const [use, ...reasons] = scene.sentences[0].split(": ");
  $("verdict").replaceChildren(...sentence_parts(use, names), reasons.length > 0 ? ": " : "", make("span", {}, ...sentence_parts(reasons.join(": "), names)));
  $("meaning").textContent = best ? meaning_of(best) : "";
  $("tiles").replaceChildren();
  if (best) draw_tiles(scene, best);
  const item = (sentence) => make("li", {}, ...sentence_parts(sentence, names));
  const rest = scene.sentences.slice(1);
  $("sentences").replaceChildren(...rest.slice(0, first).map(item));
  $("more-sentences").hidden = rest.length <= first;
  $("more-sentences").firstElementChild.textContent = `${rest.length - first} more ${rest.length - first === 1 ? "finding" : "findings"}`;
  $("more-sentences").lastElementChild.replaceChildren(...rest.slice(first).map(item));
  $("answer").classList.toggle("bare", maps_now() === null);
  $("hero").hidden = maps_now() === null;
}

/// What a run that was stopped lacks.
function draw_banner() {
  const stopped = shown.scene >= 0 && scene_now().partial;
  $("banner").hidden = !report.partial && !stopped;
  $("banner").textContent = stopped ? "Stopped early: these are the results so far." :
    report.partial ? "The run was stopped early: scenes that it had not begun are missing" + (report.scenes.some((s) => s.partial) ? `, and of ${report.scenes.filter((s) => s.partial).map((s) => s.name || s.file).join(", ")} there are the results so far.` : ".") : "";
}

async function draw_hero() {
  const scene = shown.scene, m = maps_now(), canvas = $("hero-picture");
  if (!m) return;
  await when_read(m.winners);
  const gain = await gain_of(scene), reference = await layer_of(scene, "reference");
  if (scene !== shown.scene) return;
  canvas.width = m.width;
  canvas.height = m.height;
  canvas.getContext("2d").putImageData(paint_mean(m, reference.mean, reference, null, gain, 2.2), 0, 0);
  $("hero-caption").textContent = "The scene: the ranked strategies' samples together.";
  canvas.dataset.painted = "yes";
}

function draw_layers() {
  const m = maps_now(), scene = scene_now();
  $("viewer").hidden = m === null;
  if (!m) return;
  const radio = (value, ...label) => make("label", {}, make("input", { type: "radio", name: "layer", value: String(value), onchange: () => set_layer(value) }), ...label);
  $("layers").replaceChildren($("layers").firstElementChild, radio("reference", "reference"),
    ...m.strategies.map(({ strategy: k }) => { const s = scene.strategies[k]; return radio(k, mark_icon(s), make("bdi", {}, s.name), make("small", { title: "share of the pixels that it wins, by variance" }, m.wins.variance.strategy[k] > 0 ? percent(m.wins.variance.strategy[k]) : "")); }));
  $("viewer-size").textContent = (m.scale > 1 ? `Pictures here are ${m.scale} times smaller than the render; each pixel is the mean of ${m.scale * m.scale}. ` : "") +
    "Colours are the reference's, the strategies differ in luminance. Means are kept to 0.2\u00a0%, variances to 0.7\u00a0%; maps.exr has them whole, with colours." +
    " Percentages beside names: the share of the pixels that each surely wins, by variance.";
  view.cross = pointed = null;
  view.painted = null;
  $("pixel").replaceChildren();
  zoom_to_fit();
  const best = best_of(scene);
  view.layer = m.strategies.find((s) => scene.strategies[s.strategy] === best)?.strategy ?? "reference";
  set_mode(view.mode);
  set_layer(view.layer);
}

function draw_plots() {
  draw_error_time();
  draw_variances();
  draw_efficiencies();
  draw_stages();
  apply_choice();
}

let pictures_are_here = false, hero = null;
function show_scene(scene) {
  shown.scene = scene;
  shown.strategy = null;
  ++view.ticket;  // what is still being painted is of another scene
  Object.assign(view, { layer: "reference", before: null, painted: null, cross: null });
  const all = scene < 0;
  document.title = "mis: " + (all ? `${report.scenes.length} scenes` : scene_now().name || scene_now().file);
  $("over-all").hidden = !all;
  $("one-scene").hidden = all;
  draw_scene_tabs();
  draw_banner();
  if (all) return draw_over_all();
  for (const draw of [draw_answer, draw_ranking, draw_at_counts, draw_probes, draw_legend, draw_plots, draw_run, draw_effects, draw_checks]) draw();
  $("viewer").hidden = maps_now() === null;
  hero = draw_hero();
  if (pictures_are_here) show_pictures();
}

/// The scene's picture first, then the viewer, once the browser has shown that.
async function show_pictures() {
  await hero;
  await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
  draw_layers();
}

function start_viewer() {
  $("modes").append(...modes.map(([mode, text]) => make("button", { type: "button", role: "radio", "data-mode": mode, onclick: () => set_mode(mode) }, text)));
  const say_tone = () => { $("exposure-value").textContent = `${$("exposure").value > 0 ? "+" : ""}${$("exposure").value} EV`; $("gamma-value").textContent = $("gamma").value; };
  $("exposure").oninput = $("gamma").oninput = () => { say_tone(); repaint(); };
  say_tone();
  $("winner-by").onchange = repaint;
  $("zoom-in").onclick = () => zoom_by(2);
  $("zoom-out").onclick = () => zoom_by(.5);
  $("zoom-fit").onclick = zoom_to_fit;
  const canvas = $("picture");
  canvas.setAttribute("aria-label", "Picture of the scene by the chosen strategy");
  let drag = null;
  canvas.onpointerdown = (e) => { drag = { x: e.clientX, y: e.clientY, moved: false }; canvas.setPointerCapture(e.pointerId); };
  canvas.onpointermove = (e) => {
    if (drag && (drag.moved || Math.hypot(e.clientX - drag.x, e.clientY - drag.y) > 4)) {
      const f = (canvas.width / canvas.clientWidth) / scale_now();
      view.x -= (e.clientX - drag.x) * f;
      view.y -= (e.clientY - drag.y) * f;
      drag = { x: e.clientX, y: e.clientY, moved: true };
      show_view();
    }
    pointed = pixel_under(e);
    read_out();
  };
  canvas.onpointerup = (e) => { if (drag && !drag.moved && pixel_under(e)) { view.cross = pixel_under(e); show_view(); show_pixel(); } drag = null; };
  canvas.onpointerleave = () => { pointed = null; read_out(); };
  canvas.addEventListener("wheel", (e) => { if (!e.ctrlKey && view.zoom === 1 && e.deltaY > 0) return; e.preventDefault(); zoom_by(2 ** (-e.deltaY / 300), e); }, { passive: false });
  canvas.onkeydown = move_cross;
  $("viewer").addEventListener("keydown", viewer_key);
}
function move_cross(e) {
  const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key], m = maps_now();
  if (e.key === "Enter") { show_pixel(); return e.preventDefault(); }
  if (!step) return;
  const k = e.shiftKey ? 10 : 1, at = view.cross ?? { x: Math.floor(m.width / 2), y: Math.floor(m.height / 2) };
  view.cross = { x: Math.max(0, Math.min(m.width - 1, at.x + k * step[0])), y: Math.max(0, Math.min(m.height - 1, at.y + k * step[1])) };
  pointed = null;
  show_view();
  read_out();
  e.preventDefault();
}
function viewer_key(e) {
  if (e.ctrlKey || e.metaKey || e.altKey || e.target.matches("select")) return;
  const act = { ",": () => flip(-1), ".": () => flip(1), "+": () => zoom_by(2), "=": () => zoom_by(2), "-": () => zoom_by(.5), "0": zoom_to_fit,
    r: () => set_layer(view.layer === "reference" ? view.before ?? maps_now().strategies[0]?.strategy ?? "reference" : "reference") }[e.key.toLowerCase()] ?? (modes[Number(e.key) - 1] && (() => set_mode(modes[Number(e.key) - 1][0])));
  if (!act) return;
  act();
  e.preventDefault();
}

$("footer").replaceChildren(`mis ${report.version} · seed ${report.seed} · `, command_text(report.command), " · the same figures: report.json and strategies.csv");
show_scene(shown.scene);
document.addEventListener("DOMContentLoaded", () => {
  pictures_are_here = true;
  if (maps.some((m) => m !== null)) start_viewer();
  if (shown.scene >= 0) show_pictures();
});
document.addEventListener("keydown", (e) => { if (e.key === "Escape") { hide_tip(); if (shown.strategy !== null) choose(shown.strategy); } });
addEventListener("beforeprint", () => { $("more-sentences").open = true; });
let laid_out_at = innerWidth;
addEventListener("resize", () => {
  if (innerWidth === laid_out_at || shown.scene < 0) return;
  laid_out_at = innerWidth;
  draw_plots();
  show_view();
});
