// Tables: the ranking, and any other.

/// A table of cells. heads: [{ text, className, sort, state }]; rows: elements.
function table_of(caption, heads, rows) {
  const head = make("tr", {}, ...heads.map((h) => {
    const cell = make("th", { scope: "col", className: h.className ?? "" });
    if (h.sort) {
      cell.setAttribute("aria-sort", h.state ?? "none");
      cell.append(make("button", { type: "button", onclick: h.sort, title: h.title ?? "" }, h.text));
    } else cell.append(h.text);
    return cell;
  }));
  return make("table", { "aria-label": caption }, make("thead", {}, head), make("tbody", {}, ...rows));
}
const cell = (content, className = "") => make("td", { className }, ...[content].flat());
const note = (text) => make("small", {}, text ? " " + text : "");

/// A strategy's name as a button that singles it out, with its mark.
function pick_button(s) {
  return make("button", { type: "button", className: "pick", ariaPressed: "false", onclick: () => choose(s.name) },
    mark_icon(s), make("bdi", {}, ...name_parts(s.name)));
}

const reason_words = (s) => status_words[s.status] + (s.reason ? ": " + s.reason : "") +
  (s.estimated_seconds ? `; it would take about ${duration(s.estimated_seconds)} of CPU time` : "");
const place = (rank, low, high) => rank === null ? "–" : low === high ? String(rank) : `${low}–${high}`;
const ranking_columns = [
  { key: "variance", text: "Variance", title: "of one sample", of: (s) => s.exact ? 0 : s.variance.value,
    show: (s) => s.exact ? "exact" : figure_of(s.variance) },
  { key: "relative", text: "Rel. variance", title: "relative variance of one sample", of: (s) => s.exact ? 0 : s.relative_variance.value,
    show: (s) => s.exact ? "exact" : figure_of(s.relative_variance) },
  { key: "cost", text: "ns/sample", title: "CPU time", of: (s) => s.seconds_per_sample.value,
    show: (s) => s.seconds_per_sample.value === null ? "–" : number(1e9 * s.seconds_per_sample.value) },
  { key: "rays", text: "Rays/sample", title: "shadow rays", of: (s) => s.rays_per_sample, show: (s) => number(s.rays_per_sample) },
  { key: "efficiency", text: "Efficiency", title: "1/(variance × time)", falls: true,
    of: (s) => s.exact ? Infinity : s.efficiency.value, show: (s) => s.exact ? "exact" : figure_of(s.efficiency) },
  { key: "time", text: "Time to 1 %", title: "wall time", of: (s) => s.seconds_to_1_percent,
    show: (s) => figure_of(s.seconds_to_1_percent_interval, duration) },
];
let sorted_by = "time", reversed = false;

function ranking_row(scene, s, best) {
  const row = make("tr", { className: s === best ? "best" : is_ranked(s) ? "" : "out", "data-strategy": s.name });
  const name = cell(pick_button(s), "text"), tied = s.tied_with;
  if (is_undecided(scene, s)) name.append(make("small", { title: "not decided in variance against: " + undecided_with(scene, s).join(", ") }, " ~"));
  if (tied.length > 0) name.append(make("small", { className: "below", title: "tied in variance with: " + tied.join(", ") }, "= " + (tied.length < 3 ? tied.join(", ") : `${tied.length} others`)));
  row.append(name);
  if (!is_ranked(s)) {
    row.append(make("td", { className: "text wrap reason", colSpan: ranking_columns.length + 2 }, make("span", {}, reason_words(s))));
    return row;
  }
  row.append(cell(place(s.rank, s.rank_low, s.rank_high)));
  for (const column of ranking_columns) {
    const shown_cell = cell(column.show(s));
    shown_cell.dataset.figure = column.key;
    row.append(shown_cell);
  }
  const times = sooner(scene, best.name, s.name);
  row.append(cell(s === best ? "1" : times ? figure_of(times) : "–"));
  return row;
}

/// Figures where a point gets more samples or fewer, if several numbers were asked for.
function draw_at_counts() {
  const scene = scene_now(), of = scene.strategies.filter((s) => (s.at_counts ?? []).length > 1);
  const section = $("at-counts");
  section.hidden = of.length === 0;
  if (section.hidden) return;
  const order = of.slice().sort((a, b) => a.rank - b.rank), counts = order[0].at_counts.map((c) => c.n);
  const shown = (s, c) => c.status !== "ranked"
    ? make("td", { className: "none", title: c.reason ?? "" }, status_words[c.status])
    : make("td", { title: `relative error ${percent(c.relative_error.value)}, ${number(1e9 * c.seconds_per_sample.value)} ns/sample` },
      ...[s.exact ? "exact" : figure_of(c.relative_variance)].flat());
  $("at-counts-table").replaceChildren(table_of("Relative variance per draw at n samples per point",
    [{ text: "Strategy", className: "text" }, ...counts.map((n) => ({ text: `n = ${n}` }))],
    order.map((s) => make("tr", { "data-strategy": s.name }, cell(name_text(s.name), "text"), ...s.at_counts.map((c) => shown(s, c))))));
}

function draw_ranking() {
  const scene = scene_now(), best = best_of(scene), column = ranking_columns.find((c) => c.key === sorted_by);
  const value = (s) => { const v = column.of(s); return v === null ? Infinity : column.falls ? -v : v; };
  const order = scene.strategies.slice().sort((a, b) => is_ranked(b) - is_ranked(a) ||
    (reversed ? value(b) - value(a) : value(a) - value(b)) || (a.rank ?? 1e9) - (b.rank ?? 1e9));
  const heads = [{ text: "Strategy", className: "text" }, { text: "Rank" },
    ...ranking_columns.map((c) => ({
      text: c.text, title: c.title,
      state: c.key !== sorted_by ? "none" : Boolean(c.falls) !== reversed ? "descending" : "ascending",
      sort: () => { reversed = sorted_by === c.key && !reversed; sorted_by = c.key; draw_ranking(); refocus(c.text); },
    })), { text: "× the best" }];
  $("table").replaceChildren(table_of("Ranking of strategies", heads, order.map((s) => ranking_row(scene, s, best))));
  const notes = ["Rank: by variance of one sample, with the ranks that a strategy may hold. × the best: how many times as long it takes to 1 % error."];
  if (scene.strategies.some((s) => is_undecided(scene, s))) notes.push("~ not decided against some other, so that its rank is not settled.");
  if (scene.strategies.some((s) => s.tied_with.length > 0)) notes.push(`= tied in variance within ${percent(report.margin)}.`);
  $("table-notes").textContent = notes.join(" ");
  apply_choice();
}
function refocus(text) {
  for (const button of $("table").querySelectorAll("th button")) if (button.textContent === text) button.focus();
}

/// The scene's probes: mean and variance of each strategy.
function draw_probes() {
  const scene = scene_now(), count = Math.max(0, ...scene.strategies.map((s) => s.probes.length));
  $("probes").replaceChildren();
  if (count === 0) return;
  const heads = [{ text: "Strategy", className: "text" }];
  for (let i = 0; i < count; ++i) heads.push({ text: `Probe ${i}: mean` }, { text: "variance" });
  const rows = scene.strategies.filter((s) => s.probes.length > 0).map((s) => make("tr", { "data-strategy": s.name }, cell(pick_button(s), "text"),
    ...s.probes.flatMap((p) => [cell([number(p.mean), note(mean_error(p.mean_se))]), cell(figure_of(p.variance))])));
  $("probes").append(make("h3", {}, count === 1 ? "At the probe" : "At the probes"), make("div", { className: "scroll" }, table_of("Figures at the probes", heads, rows)));
}
