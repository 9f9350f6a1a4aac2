// Colours of policies and marks of heuristics, each by its place in the registry: what the registry gains has one by itself.

/// How bright a colour is beside another, at least 1 (WCAG 2.1, "contrast ratio").
function contrast(a, b) {
  const linear = (v) => v / 255 <= .04045 ? v / 255 / 12.92 : ((v / 255 + .055) / 1.055) ** 2.4;
  const [p, q] = [a, b].map((c) => { const k = d3.rgb(c); return .2126 * linear(k.r) + .7152 * linear(k.g) + .0722 * linear(k.b) + .05; });
  return Math.max(p, q) / Math.min(p, q);
}
const grounds = ["#ffffff", "#14171a"];
const stands_out = (colour) => grounds.every((ground) => contrast(colour, ground) >= 3);
/// How different two colours look, in CIE Lab.
function difference(a, b) {
  const [p, q] = [d3.lab(a), d3.lab(b)];
  return Math.hypot(p.l - q.l, p.a - q.a, p.b - q.b);
}

/// Okabe and Ito's colours, which colour-blind eyes tell apart, and more; darker where they would be pale on white:
/// each is 3 to 1 against a light ground and a dark one.
const first_colours = ["#C27E00", "#2E93CC", "#009E73", "#D55E00", "#CC79A7", "#0072B2", "#7466B4", "#B04A6A", "#4D7F2B", "#8C6D1F"], no_policy_colour = "#96673B";
/// The first colours, and after them, of all that stand out from both grounds, whichever differs most from those before it.
function colours(count) {
  const taken = first_colours.slice(0, count);
  if (taken.length === count) return taken;
  const free = d3.cross(d3.cross(d3.range(0, 360, 8), [15, 35, 60]), [44, 49, 54, 59], ([h, c], l) => d3.rgb(d3.hcl(h, c, l).toString()).hex()).filter(stands_out);
  const apart = free.map((colour) => Math.min(...[...taken, no_policy_colour].map((other) => difference(colour, other))));
  while (taken.length < count) {
    const next = free[d3.scan(apart, d3.descending)];
    taken.push(next);
    free.forEach((colour, i) => { apart[i] = Math.min(apart[i], difference(colour, next)); });
  }
  return taken;
}

/// A regular polygon on its tip, as a symbol.
const polygon = (corners) => ({ draw(context, size) {
  const r = Math.sqrt(2 * size / (corners * Math.sin(2 * Math.PI / corners)));
  for (let k = 0; k < corners; ++k) context[k === 0 ? "moveTo" : "lineTo"](r * Math.sin(2 * Math.PI * k / corners), r * Math.cos(2 * Math.PI * k / corners));
  context.closePath();
} });
/// Shape and its word, dash of a curve, and how much lighter than the policy's colour a win is painted, in steps.
const first_marks = [
  { word: "circle", symbol: d3.symbolCircle, dash: "1 4", lighter: 1 },
  { word: "square", symbol: d3.symbolSquare, dash: "7 3", lighter: 0 },
  { word: "triangle", symbol: d3.symbolTriangle, dash: null, lighter: -1 },
  { word: "diamond", symbol: d3.symbolDiamond, dash: "7 3 1 3", lighter: 1.8 },
  { word: "star", symbol: d3.symbolStar, dash: "2 2", lighter: -1.8 }];
const mark_at = (i) => first_marks[i] ?? { word: `polygon of ${i}`, symbol: polygon(i), dash: `${4 * i - 10} 3`, lighter: [.5, -.5, 1.4, -1.4][(i - first_marks.length) % 4] };

/// Names of a registry in its order; a report that knows more appends them.
const registered = (kind) => [...new Set([...Object.keys(glossary[kind]), ...report.scenes.flatMap((scene) => scene.strategies.map((s) => s[kind]).filter((name) => name !== null))])];
const by_name_of = (names, values) => Object.fromEntries(names.map((name, i) => [name, values[i]]));
const policy_colours = by_name_of(registered("policy"), colours(registered("policy").length));
const heuristic_marks = by_name_of(registered("heuristic"), registered("heuristic").map((_, i) => mark_at(i)));

const colour_of = (s) => s.policy === null ? no_policy_colour : policy_colours[s.policy];
/// Nothing where no light is chosen.
const mark_of = (s) => heuristic_marks[s.heuristic];
const mark_path = (s, size = 70) => d3.symbol().type(mark_of(s)?.symbol ?? d3.symbolCross).size(size)();
