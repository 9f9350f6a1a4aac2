// A pixel: what the pointer is over, and what a click shows.

let pointed = null;

/// Figures of a page's pixel.
async function figures_at({ x, y }) {
  const scene = shown.scene, m = maps_now(), i = y * m.width + x;
  const reference = await layer_of(scene, "reference"), winners = await layer_of(scene, "winners");
  return { i, kind: winners.kind[i], reference: reference.mean[i], winner: winner_words(winners.variance, i), cheapest: winner_words(winners.efficiency, i) };
}
const pixel_words = ({ x, y }) => { const k = maps_now().scale; return k === 1 ? `pixel ${x}, ${y}` : `pixels ${x * k}–${x * k + k - 1}, ${y * k}–${y * k + k - 1}`; };
const winner_words = (winners, i) => winners.strategy[i] >= 0 ? scene_now().strategies[winners.strategy[i]].name : winners.policy[i] >= 0 ? maps_now().policies[winners.policy[i]] + "/?" : "undecided";

async function read_out() {
  if (maps_now() === null) return;
  const at = pointed ?? view.cross, out = $("read-out"), layer = picture_layer(), scene = shown.scene;
  const title = layer === "reference" ? "reference" : scene_now().strategies[layer].name;
  if (!at) { out.textContent = view.mode === "winner" ? "" : title; return; }
  const f = await figures_at(at), own = await layer_of(scene, layer);
  if (scene !== shown.scene) return;
  let text = `${pixel_words(at)} · `;
  if (f.kind === 0) text += `background, ${isFinite(f.reference) ? number(f.reference) : "no number"}`;
  else {
    text += `reference ${number(f.reference)}`;
    if (layer !== "reference") {
      text += ` · ${title}: mean ${number(own.mean[f.i])}`;
      if (f.reference > 0) text += ` (${own.mean[f.i] >= f.reference ? "+" : "−"}${percent(Math.abs(own.mean[f.i] / f.reference - 1))})`;
      text += `, variance ${number(own.variance[f.i])}`;
      if (own.bad && own.bad[f.i]) text += ", samples here that were no numbers";
    }
    text += f.kind === 1 ? " · no light reaches it" : ` · winner: ${f.winner}`;
  }
  if (pointed === at || view.cross === at) out.textContent = text;
}

/// The ranking at a pixel, and its lights.
async function show_pixel() {
  const place = $("pixel"), m = maps_now(), at = view.cross, scene = scene_now();
  if (!at) return place.replaceChildren();
  const f = await figures_at(at);
  if (scene !== scene_now()) return;
  const head = make("h3", {}, `At ${pixel_words(at)}: `, f.kind === 0 ? "background" : f.kind === 1 ? "no light reaches it" : `least variance: ${f.winner}; least variance × time: ${f.cheapest}`);
  if (f.kind !== 2) return place.replaceChildren(head);
  const rows = [];
  for (const { strategy } of m.strategies) {
    const s = scene.strategies[strategy], layer = await layer_of(shown.scene, strategy);
    const seconds = (s.seconds_per_sample.value ?? NaN) + (s.seconds_per_point.value ?? 0) / report.at;
    rows.push({ s, mean: layer.mean[f.i], variance: layer.variance[f.i], cost: layer.variance[f.i] * seconds });
  }
  rows.sort((a, b) => is_ranked(b.s) - is_ranked(a.s) || a.variance - b.variance);
  const least = Math.min(...rows.filter((r) => is_ranked(r.s)).map((r) => r.cost));
  const ranking = table_of("Strategies at this pixel", [{ text: "Strategy", className: "text" }, { text: "Mean" }, { text: "Variance" }, { text: "Variance × time" }],
    rows.map((r) => make("tr", { "data-strategy": r.s.name, className: is_ranked(r.s) ? "" : "out" }, cell([pick_button(r.s), is_ranked(r.s) ? "" : note(status_words[r.s.status])], "text"), cell(number(r.mean)), cell(number(r.variance)),
      cell(isFinite(r.cost) && least > 0 ? number(r.cost / least) + " ×" : "–"))));
  const lights = await lights_table(m, at);
  if (scene !== scene_now()) return;
  place.replaceChildren(head, make("div", { className: "scroll" }, ranking), lights);
  apply_choice();
}

async function lights_table(m, at) {
  const found = await lights_at(m, at.x, at.y), box = make("div", { className: "scroll" });
  const rows = found.map(({ light, share }) => {
    const l = m.lights.lights[light], luminance = l ? .2126 * l.radiance[0] + .7152 * l.radiance[1] + .0722 * l.radiance[2] : null;
    return make("tr", {}, cell(`light ${light}`, "text"), cell(percent(share)), cell(l ? l.center.map((v) => number(v)).join(", ") : "–"), cell(l ? number(l.radius) : "–"), cell(number(luminance)));
  });
  box.append(found.length === 0 ? make("p", { className: "note" }, "No light is above the horizon here.") :
    table_of("Lights at this pixel", [{ text: "Light", className: "text" }, { text: "Share" }, { text: "Centre" }, { text: "Radius" }, { text: "Luminance" }], rows),
    make("p", { className: "note" }, `Share: of what all lights together would give a white surface that nothing shades; the ${rows.length || 4} largest. Lights are numbered from 0, as the scene file lists them.` + (m.lights.stride > 1 ? ` Found for one pixel in ${number(m.lights.stride ** 2)}.` : "")));
  return box;
}
