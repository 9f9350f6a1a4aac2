// Several scenes in one report.

function draw_scene_tabs() {
  const nav = $("scenes");
  if (report.scenes.length < 2) return;
  nav.hidden = false;
  const tab = (text, scene) => {
    const button = make("button", { type: "button", onclick: () => show_scene(scene) }, make("bdi", {}, text));
    if (scene === shown.scene) button.setAttribute("aria-current", "page");
    return button;
  };
  nav.replaceChildren(tab("All scenes", -1), ...report.scenes.map((s, i) => tab(s.name || s.file, i)));
}

const matrix_figures = [
  { name: "time to 1 %", of: (s) => s.seconds_to_1_percent, show: duration },
  { name: "variance", of: (s) => s.exact ? 0 : s.variance.value, show: (v) => number(v) },
  { name: "relative variance", of: (s) => s.exact ? 0 : s.relative_variance.value, show: (v) => number(v) },
  { name: "variance × time (1/efficiency)", of: (s) => s.exact ? 0 : s.efficiency.value === null ? null : 1 / s.efficiency.value, show: (v) => number(v) },
];

/// Pale to strong orange, ink stays readable on all of it.
const matrix_colour = (ratio) => d3.interpolateRgb("#e4f3ec", "#f2a65a")(Math.min(1, Math.log(ratio) / Math.log(10)));

function draw_matrix() {
  const figure = matrix_figures[Number($("matrix-figure").value)];
  const names = [...new Set(report.scenes.flatMap((s) => s.strategies.map((t) => t.name)))];
  const order = new Map(report.overall.map((o) => [o.name, o.rank_by_efficiency]));
  names.sort((a, b) => (order.get(a) ?? 1e9) - (order.get(b) ?? 1e9));
  const least = report.scenes.map((scene) => Math.min(...ranked(scene).map(figure.of).filter((v) => v !== null)));
  const heads = [{ text: "Strategy", className: "text" }, ...report.scenes.map((scene, i) => ({ className: "scene", text: make("button", { type: "button", onclick: () => show_scene(i) }, make("bdi", {}, scene.name || scene.file)) }))];
  const rows = names.map((n) => make("tr", {}, cell(name_text(n), "text"), ...report.scenes.map((scene, i) => matrix_cell(by_name(scene, n), figure, least[i]))));
  const table = table_of(`Scenes and strategies: ${figure.name}`, heads, rows);
  table.classList.add("matrix");
  $("matrix").replaceChildren(table);
}
function matrix_cell(s, figure, least) {
  if (!s || !is_ranked(s)) return make("td", { className: "none", title: s ? s.reason ?? "" : "" }, s ? status_words[s.status] : "–");
  const value = figure.of(s);
  if (value === null) return make("td", { className: "none" }, "–");
  const ratio = least > 0 ? value / least : value === 0 ? 1 : Infinity;
  const element = make("td", { className: "cell", title: `${s.name}: ${figure.show(value)}` }, value === 0 ? "exact" : isFinite(ratio) ? number(ratio) + " ×" : "∞");
  element.style.background = matrix_colour(ratio);
  return element;
}

function draw_over_all() {
  $("over-all-verdict").replaceChildren(...sentence_parts(report.sentences[0] ?? "", new Set(report.overall.map((o) => o.name))));
  const list = report.overall.slice().sort((a, b) => a.rank_by_efficiency - b.rank_by_efficiency);
  const ratio = (x) => x.value === null ? "–" : [number(x.value) + " ×", note(error_of(x))];
  $("over-all-table").replaceChildren(list.length === 0 ? "" : table_of("Overall ranking", [{ text: "Rank", className: "text" }, { text: "Strategy", className: "text" }, { text: "Time to 1 %" }, { text: "Variance × time" }, { text: "Variance" }, { text: "Rank by variance" }],
    list.map((o, i) => make("tr", { className: i === 0 ? "best" : "" }, cell(String(o.rank_by_efficiency), "text"), cell(name_text(o.name), "text"), cell(ratio(o.time_ratio)), cell(ratio(o.cost_ratio)), cell(ratio(o.variance_ratio)), cell(String(o.rank))))));
  $("over-all-rule").textContent = "Rule: strategies that are ranked on every scene, ordered by variance × time (efficiency). Each figure is the geometric mean, over the scenes, of the strategy's figure over the best one's of that scene: every scene counts alike, and 1 × would be the best everywhere." +
    (list.some((o) => o.beaten_by_exact > 0) ? " Scenes on which others are exact, and the strategy is not, decide first." : "");
  if ($("matrix-figure").children.length === 0) {
    $("matrix-figure").append(...matrix_figures.map((f, i) => make("option", { value: String(i) }, f.name)));
    $("matrix-figure").onchange = draw_matrix;
  }
  draw_matrix();
}
