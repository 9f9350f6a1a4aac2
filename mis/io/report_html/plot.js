// What all plots share: marks, frames, axes, and saving.

/// Strategies of one policy and heuristic, told apart by hollow marks: another technique, model or counts.
const is_hollow = (s) => s.policy !== null && (s.technique !== "cone" || s.model !== "multi" || Math.max(...s.counts) > 1);

function mark_icon(s) {
  const svg = d3.create("svg").attr("width", 14).attr("height", 14).attr("viewBox", "-7 -7 14 14").attr("aria-hidden", "true");
  svg.append("path").attr("d", mark_path(s, 60)).attr("fill", is_hollow(s) ? "none" : colour_of(s)).attr("stroke", colour_of(s)).attr("stroke-width", is_hollow(s) ? 2 : 0);
  return svg.node();
}
/// A mark in a plot at (x, y).
function add_mark(parent, s, x, y, size = 80) {
  return parent.append("path").attr("class", "mark" + (is_hollow(s) ? " hollow" : "")).attr("data-strategy", s.name)
    .attr("transform", `translate(${x},${y})`).attr("d", mark_path(s, size))
    .attr("fill", is_hollow(s) ? null : colour_of(s)).attr("stroke", is_hollow(s) ? colour_of(s) : null);
}

/// A plot's frame: heading, button to save it, a sentence, and an SVG of that height, as wide as there is room.
function frame(id, title, text, height) {
  const place = $(id), width = Math.max(280, Math.floor(place.clientWidth));
  const save = make("button", { type: "button", onclick: () => save_svg(svg.node(), id), ariaLabel: `Save ${title} as SVG` }, "Save SVG");
  const svg = d3.create("svg").attr("viewBox", `0 0 ${width} ${height}`).attr("role", "img").attr("tabindex", 0)
    .attr("aria-label", `${title}. ${text} Arrow keys go through the strategies, Enter singles one out.`);
  place.replaceChildren(make("div", { className: "plot-head" }, make("h3", {}, title), save), make("p", { className: "note" }, text), svg.node());
  return { svg, width, height };
}

/// Pointer and keys: `rows` are { strategy, tip, x, y } in viewBox coordinates; each gets its target, an SVG selection or null.
function make_live(svg, rows) {
  let at = -1;
  const show = (k) => {
    at = (k + rows.length) % rows.length;
    const box = svg.node().getBoundingClientRect(), scale = box.width / svg.node().viewBox.baseVal.width;
    show_tip(rows[at].tip, box.left + rows[at].x * scale, box.top + rows[at].y * scale);
  };
  for (const row of rows)
    row.target?.attr("data-target", row.strategy.name).on("mousemove", () => show_tip(row.tip, d3.event.clientX, d3.event.clientY))
      .on("mouseleave", hide_tip).on("click", () => choose(row.strategy.name));
  svg.on("keydown", () => {
    const key = d3.event.key;
    if (key === "ArrowDown" || key === "ArrowRight") show(at + 1);
    else if (key === "ArrowUp" || key === "ArrowLeft") show(at < 0 ? rows.length - 1 : at - 1);
    else if (key === "Enter" && at >= 0) choose(rows[at].strategy.name);
    else if (key === "Escape") hide_tip();
    else return;
    d3.event.preventDefault();
  }).on("blur", () => { at = -1; hide_tip(); });
}

/// Ticks of a log axis that leave room for their labels.
function log_axis(axis, scale, pixels, format) {
  const decades = Math.log10(scale.domain()[1] / scale.domain()[0]);
  const room = pixels / Math.max(decades, .1);
  const wanted = room > 300 ? [1, 2, 3, 5] : room > 110 ? [1, 2, 5] : [1];
  const step = Math.max(1, Math.ceil(46 / room));
  const values = [];
  for (let e = Math.floor(Math.log10(scale.domain()[0])) - 1; e <= Math.ceil(Math.log10(scale.domain()[1])); ++e)
    if (step === 1 || e % step === 0) for (const m of wanted) values.push(Number(`${m}e${e}`));
  return axis(scale).tickValues(values.filter((v) => v >= scale.domain()[0] * .9999 && v <= scale.domain()[1] * 1.0001)).tickFormat(format).tickSizeOuter(0);
}
/// Short numbers for axes: "200k", "0.05".
const axis_number = (v) => v >= 1e4 ? d3.format("~s")(v) : number(v);

/// Ticks of a log axis of seconds: in each unit at round numbers of it.
function time_axis(axis, scale) {
  const first = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, .1, 1, 10, 60, 600, 3600, 36000, 360000], then = first.slice(0, 7).flatMap((d) => [2 * d, 5 * d]).concat([20, 120, 300, 1800, 7200, 18000, 86400]);
  const values = [];  // the rounder ones first, as far as there is room
  for (const v of [...first, ...then])
    if (v >= scale.domain()[0] && v <= scale.domain()[1] && values.every((other) => Math.abs(scale(v) - scale(other)) > 52)) values.push(v);
  return axis(scale).tickValues(values).tickFormat((v) => v === 60 ? "1\u00a0min" : duration(v)).tickSizeOuter(0);
}
/// The range of positive numbers, with some room.
function log_domain(values, room = 1.25) {
  const good = values.filter((v) => v > 0 && isFinite(v));
  if (good.length === 0) return [.1, 1];
  const low = Math.min(...good) / room, high = Math.max(...good) * room;
  return high / low < 1.5 ? [low / 1.25, high * 1.25] : [low, high];
}

/// The plot as a file of its own, with its present colours.
function save_svg(svg, name) {
  const copy = svg.cloneNode(true), kept = ["fill", "stroke", "stroke-width", "stroke-dasharray", "opacity", "font-size", "font-family", "font-weight"];
  const originals = [svg, ...svg.querySelectorAll("*")], copies = [copy, ...copy.querySelectorAll("*")];
  originals.forEach((element, i) => {
    const style = getComputedStyle(element);
    for (const key of kept) copies[i].setAttribute(key, style.getPropertyValue(key));
    copies[i].removeAttribute("tabindex");
  });
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  const ground = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  for (const [key, value] of [["width", "100%"], ["height", "100%"], ["fill", getComputedStyle(document.body).backgroundColor]]) ground.setAttribute(key, value);
  copy.prepend(ground);
  const url = URL.createObjectURL(new Blob([new XMLSerializer().serializeToString(copy)], { type: "image/svg+xml" }));
  make("a", { href: url, download: name + ".svg" }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/// The strategies of the scene that have a figure, grouped by policy, heuristics in the order given.
function grouped(strategies) {
  const groups = new Map();
  for (const s of strategies) {
    const key = s.policy ?? "no light chosen";
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(s);
  }
  return [...groups];
}

function draw_legend() {
  const strategies = scene_now().strategies;
  $("legend").replaceChildren(...strategies.map((s) => make("button", { type: "button", ariaPressed: "false", "data-strategy": s.name, onclick: () => choose(s.name) }, mark_icon(s), make("bdi", {}, s.name))));
  const used = Object.keys(heuristic_marks).filter((h) => strategies.some((s) => s.heuristic === h));
  $("mark-key").textContent = "Colour: which light is drawn (policy). Shape and dash: how draws are combined (heuristic) – " +
    used.map((h) => `${heuristic_marks[h].word} ${h}`).join(", ") + ", cross: no light is chosen" +
    (strategies.some(is_hollow) ? "; hollow: another technique, model or count of draws." : ".");
}
