// The pictures: one at a time, all at the same zoom and place.

const modes = [["picture", "Picture"], ["difference", "Difference to reference"], ["variance", "Variance"], ["winner", "Who wins where"]];
const view = { mode: "picture", layer: "reference", before: null, zoom: 1, x: 0, y: 0, cross: null, painted: null, ticket: 0 };
const picture_layer = () => view.mode === "picture" || view.layer !== "reference" ? view.layer : maps_now().strategies[0]?.strategy ?? "reference";

const is_lit = (winners) => (i) => winners.kind[i] === 2;
/// The factor that brings a scene's luminances to where the eye sees them: exposure 0.
async function gain_of(scene) {
  const m = maps[scene];
  if (!m.gain) m.gain = .8 / quantile_of((await layer_of(scene, "reference")).mean, .95, is_lit(await layer_of(scene, "winners")));
  return m.gain;
}
const difference_range = .5;
/// The range of a scene's variances, the same for all strategies.
async function measure_scene(scene) {
  const m = maps[scene];
  if (m.measures) return m.measures;
  const best = best_of(report.scenes[scene]), first = m.strategies.find((s) => report.scenes[scene].strategies[s.strategy] === best) ?? m.strategies[0];
  const variance = first ? (await layer_of(scene, first.strategy)).variance : (await layer_of(scene, "reference")).mean;
  const lit = is_lit(await layer_of(scene, "winners")), middle = quantile_of(variance, .5, lit), top = quantile_of(variance, .99, lit);
  m.measures = { variances: [middle / 300, Math.max(top * 30, middle * 300)] };
  return m.measures;
}

/// Draws the picture's pixels anew: another layer, mode or tone.
async function repaint() {
  const scene = shown.scene, m = maps_now(), ticket = ++view.ticket;
  if (!m) return;
  await gain_of(scene);
  const measures = view.mode === "variance" ? await measure_scene(scene) : null, layer = picture_layer();
  const reference = await layer_of(scene, "reference"), winners = await layer_of(scene, "winners"), own = await layer_of(scene, layer);
  if (ticket !== view.ticket) return;
  const gain = maps[scene].gain * 2 ** Number($("exposure").value), of = report.scenes[scene];
  let image;
  if (view.mode === "winner") image = paint_winners(m, winners[$("winner-by").value], winners.kind, of.strategies, shown.strategy);
  else if (view.mode === "variance" && own.variance) image = paint_variance(m, own, winners.kind, measures.variances);
  else if (view.mode === "difference") image = paint_difference(m, own, reference.mean, winners.kind, of.epsilon, difference_range);
  else image = paint_mean(m, own.mean, reference, own.bad, gain, Number($("gamma").value));
  const canvas = new OffscreenCanvas(m.width, m.height);
  canvas.getContext("2d").putImageData(image, 0, 0);
  view.painted = canvas;
  show_view();
  draw_scale(measures);
  read_out();
  $("picture").dataset.painted = `${view.mode} ${layer}`;  // for whoever waits for it
}

/// Brings the painted pixels to the screen at the present zoom and place.
function show_view() {
  const canvas = $("picture"), m = maps_now();
  if (!m || !view.painted) return;
  const ratio = devicePixelRatio || 1, width = Math.round(canvas.clientWidth * ratio);
  const height = Math.round(Math.min(width * m.height / m.width, innerHeight * .8 * ratio));
  if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; canvas.style.height = height / ratio + "px"; }
  const context = canvas.getContext("2d"), scale = scale_now();
  context.fillStyle = "#000";
  context.fillRect(0, 0, width, height);
  context.imageSmoothingEnabled = scale < 1;
  context.setTransform(scale, 0, 0, scale, width / 2 - view.x * scale, height / 2 - view.y * scale);
  context.drawImage(view.painted, 0, 0);
  context.setTransform(1, 0, 0, 1, 0, 0);
  if (view.cross) draw_cross(context, scale, width, height);
}
const scale_now = () => { const c = $("picture"), m = maps_now(); return view.zoom * Math.min(c.width / m.width, c.height / m.height); };
function draw_cross(context, scale, width, height) {
  const x = (view.cross.x + .5 - view.x) * scale + width / 2, y = (view.cross.y + .5 - view.y) * scale + height / 2, r = Math.max(scale / 2, 4) + 2;
  for (const [colour, line] of [["#000", 4], ["#fff", 2]]) {
    context.strokeStyle = colour;
    context.lineWidth = line;
    context.strokeRect(x - r, y - r, 2 * r, 2 * r);
  }
}
/// The page's pixel under a pointer, or null.
function pixel_under(event) {
  const canvas = $("picture"), m = maps_now(), box = canvas.getBoundingClientRect(), ratio = canvas.width / box.width, scale = scale_now();
  const x = Math.floor(((event.clientX - box.left) * ratio - canvas.width / 2) / scale + view.x), y = Math.floor(((event.clientY - box.top) * ratio - canvas.height / 2) / scale + view.y);
  return x >= 0 && y >= 0 && x < m.width && y < m.height ? { x, y } : null;
}
function zoom_by(factor, event = null) {
  const m = maps_now(), at = event ? pixel_under(event) : null, before = view.zoom;
  view.zoom = Math.max(1, Math.min(64, view.zoom * factor));
  if (at) { const f = before / view.zoom; view.x = at.x + (view.x - at.x) * f; view.y = at.y + (view.y - at.y) * f; }
  if (view.zoom === 1) { view.x = m.width / 2; view.y = m.height / 2; }
  show_view();
}
function zoom_to_fit() { view.zoom = 1; zoom_by(1); }

function set_mode(mode) {
  view.mode = mode;
  for (const button of $("modes").children) button.setAttribute("aria-checked", button.dataset.mode === mode), button.setAttribute("aria-pressed", button.dataset.mode === mode);
  $("winner-rule").hidden = mode !== "winner";
  $("tone").hidden = mode !== "picture";
  if (mode !== "picture" && mode !== "winner") set_layer(picture_layer());
  else repaint();
}
function set_layer(layer) {
  if (layer !== view.layer && view.layer !== "reference") view.before = view.layer;
  view.layer = layer;
  const radio = document.querySelector(`#layers input[value="${layer}"]`);
  if (radio) { radio.checked = true; keep_in_sight(radio.parentElement, $("layers")); }
  return repaint();
}
/// Scrolls a list, and nothing else, so that an entry is seen.
function keep_in_sight(entry, list) {
  const top = entry.offsetTop - list.offsetTop;
  if (top < list.scrollTop) list.scrollTop = top;
  if (top + entry.offsetHeight > list.scrollTop + list.clientHeight) list.scrollTop = top + entry.offsetHeight - list.clientHeight;
}
function flip(step) {
  const order = maps_now().strategies.map((s) => s.strategy), at = order.indexOf(view.layer);
  set_layer(order[(at + step + order.length + (at < 0 && step < 0 ? 1 : 0)) % order.length]);
}

/// The legend of the colours.
function draw_scale(measures) {
  const place = $("scale");
  place.replaceChildren();
  if (view.mode === "picture") return;
  if (view.mode === "winner") return draw_winner_key(place);
  const width = Math.max(280, Math.min(560, place.clientWidth)), svg = d3.create("svg").attr("viewBox", `0 0 ${width} 50`).attr("role", "img");
  const is_variance = view.mode === "variance", x = is_variance ? d3.scaleLog().domain(measures.variances) : d3.scaleLinear().domain([-difference_range, difference_range]);
  x.range([24, width - 24]);
  const scale = is_variance ? d3.interpolateViridis : difference_scale;
  for (let i = 0; i < 128; ++i) svg.append("rect").attr("x", 24 + i * (width - 48) / 128).attr("width", (width - 48) / 128 + .6).attr("height", 12).attr("fill", scale(i / 127));
  svg.append("g").attr("class", "axis").attr("transform", "translate(0,12)").call(is_variance ? log_axis(d3.axisBottom, x, width - 48, (v) => number(v)) : d3.axisBottom(x).ticks(5).tickFormat((v) => (v > 0 ? "+" : "") + percent(v)));
  const text = is_variance ? "variance of one sample, luminance²" : "blue: darker than the reference, orange: brighter; relative to √(reference² + ε²); past the ends the colour stays";
  svg.append("text").attr("class", "soft").attr("x", width / 2).attr("y", 46).attr("text-anchor", "middle").text(text);
  svg.attr("aria-label", text);
  place.append(svg.node());
}
/// The winners' colours and shares: strategies that are sure, policies that are, with no strategy of theirs; undecided.
async function draw_winner_key(place) {
  const m = maps_now(), by = $("winner-by").value, scene = scene_now(), strategies = scene.strategies, shares = await winner_shares(by);
  if (view.mode !== "winner" || m !== maps_now()) return;
  const swatch = (colour) => { const s = make("span", { className: "swatch" }); s.style.background = colour; return s; };
  const entry = (colour, name, share) => [swatch(colour), make("bdi", {}, name), make("small", {}, " " + percent(share, 3))];
  const sure = strategies.map((s, i) => ({ s, share: shares.strategy[i] ?? 0 })).filter((e) => e.share > 0).sort((a, b) => b.share - a.share);
  const policies = m.policies.map((policy, i) => ({ policy, share: shares.policy[i] ?? 0 })).filter((e) => e.share > 0).sort((a, b) => b.share - a.share);
  const key = make("div", { className: "key" }, ...sure.map(({ s, share }) => make("button", { type: "button", "data-strategy": s.name, onclick: () => choose(s.name) }, ...entry(winner_colour(s), s.name, share))),
    ...policies.map(({ policy, share }) => make("span", {}, ...entry(policy_winner_colour(strategies, policy), by_name(scene, policy) ? policy : policy + "/?", share))),
    make("span", {}, swatch(d3.rgb(...undecided_colour)), ` undecided ${percent(shares.undecided, 3)}`));
  place.replaceChildren(key, make("p", { className: "note" }, "Shares are of the lit pixels. “policy/?”: the policy is sure, the heuristic is not. " + (m.winner_square > 1 ? `Told for squares of ${m.winner_square} × ${m.winner_square} pixels, since one pixel has too few samples. ` : "") +
    `Of what is coloured at most ${percent(m.false_winners)} is wrong, in expectation; grey is where the least is not sure, dark grey where it is dark, black where there is no surface.`));
  apply_choice();
}
/// Shares of the pixels: of strategies from the full size, of policies what strategies leave of theirs, on the page's pixels.
async function winner_shares(by) {
  const m = maps_now(), winners = await layer_of(shown.scene, "winners"), policy = m.policies.map(() => 0);
  let lit = 0;
  for (let i = 0; i < winners.kind.length; ++i) {
    if (winners.kind[i] !== 2) continue;
    ++lit;
    if (winners[by].strategy[i] < 0 && winners[by].policy[i] >= 0) ++policy[winners[by].policy[i]];
  }
  const share = policy.map((n) => n / Math.max(lit, 1));
  return { strategy: m.wins[by].strategy, policy: share, undecided: Math.max(0, 1 - d3.sum(m.wins[by].strategy) - d3.sum(share)) };
}
