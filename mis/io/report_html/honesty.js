// What was simulated, and how it was measured.

function draw_run() {
  const s = scene_now(), lines = [
    ["Command", report.command, "code"], ["Scene", s.file], ["Program", `mis ${report.version}, ${report.instruction_set} kernels`], ["Machine", `${report.machine}; ${report.threads} ${report.threads === 1 ? "thread" : "threads"}`], ["Seed", String(report.seed)],
    ["Shading points", number(s.shading_points) + (s.resolution ? ` of ${s.resolution[0]} × ${s.resolution[1]} pixels (${number(s.background_pixels)} background)` : " (probes)")],
    ["Samples", samples_words(s)], ["Replicates", `${s.replicates} independent repetitions${s.directions > 0 ? ", turns of shared directions" : ""}, which the intervals come from`],
    ["Took", duration(s.seconds) + (s.settled ? ", settled: it is decided which to use, and every variance is known to ± 25\u00a0%" : s.decided ? ", decided which to use; some variances are not known to ± 25\u00a0%" : ", not decided which to use") + (s.partial ? ", stopped early" : "")],
  ];
  $("run").replaceChildren(...lines.flatMap(([what, value, className]) => [make("dt", {}, what), make("dd", { className: className ?? "" }, className === "code" ? command_text(value) : make("bdi", {}, value))]));
  $("at").textContent = number(report.at);
  $("margin").textContent = percent(report.margin);
}
function samples_words(s) {
  const counts = s.strategies.filter((t) => t.samples > 0 && s.shading_points > 0).map((t) => t.samples / s.shading_points);
  if (counts.length === 0) return "none";
  const low = number(Math.min(...counts)), high = number(Math.max(...counts));
  return (low === high ? low : `${low} to ${high}`) + " per shading point and strategy" + (s.directions > 0 ? `; variances come from ${number(s.directions)} directions per point that all strategies share` : "");
}

function draw_effects() {
  const effects = Object.entries(scene_now().effects).sort((a, b) => b[1].on - a[1].on);
  const saved = (e) => [e.saved_rays_per_sample ? `${number(e.saved_rays_per_sample)}\u00a0rays` : "", e.saved_seconds_per_sample === null ? "" : `${number(1e9 * e.saved_seconds_per_sample)}\u00a0ns`].filter((figure) => figure !== "").join(", ");
  const any_saved = effects.some(([, e]) => saved(e) !== "");
  const heads = [{ text: "Effect", className: "text" }, { text: "Why", className: "text" }];
  if (any_saved) heads.push({ text: "Saved", className: "saved" });
  $("effects").replaceChildren(table_of("Effects", heads, effects.map(([name, e]) => make("tr", { className: e.on ? "" : "out" }, cell([name.replaceAll("_", " "), make("small", { className: "below" }, e.on ? e.share < 1 ? `on ${percent(e.share)} of tiles` : "simulated" : "left out")], "text"),
    cell(e.why, "text wrap"), ...(any_saved ? [cell(saved(e), "saved")] : [])))),
    any_saved ? make("p", { className: "note" }, "Saved: per sample of uniform/power, by leaving the effect out of the tiles that do not call for it; no time where noise hides it.") : "");
}

function draw_checks() {
  const heads = [{ text: "Strategy", className: "text" }, { text: "State", className: "text" }, { text: "Samples" }, { text: "Mean" }, { text: "Bias p-value" }, { text: "Effective samples" }, { text: "Rare share" }, { text: "Not a number" }];
  const rows = scene_now().strategies.map((s) => make("tr", { "data-strategy": s.name, className: is_ranked(s) ? "" : "out" }, cell(pick_button(s), "text"), cell(is_ranked(s) ? s.exact ? "exact" : "ranked" : status_words[s.status], "text"),
    cell(s.samples ? number(s.samples) : "–"), cell([number(s.mean, 4), note(mean_error(s.mean_se, 2))]), cell(s.status === "not_run" ? "–" : number(s.bias_p_value, 2)), cell(s.exact || s.status === "not_run" ? "–" : number(s.effective_samples)), cell(s.exact || s.status === "not_run" ? "–" : percent(s.rare_share)), cell(String(s.invalid_samples))));
  $("checks").replaceChildren(table_of("Checks of each strategy", heads, rows));
}
