// Figures in words, and what follows from them.

/// Three significant digits: "0.0123", "1.2e-5", "1234"; "–" for what is not known.
function number(value, digits = 3) {
  if (value === null || value === undefined || !isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e");
  return size >= 1000 ? String(Math.round(value)) : String(Number(value.toPrecision(digits)));
}
function percent(share, digits = 2) { return number(100 * share, digits) + "\u00a0%"; }
function duration(seconds) {
  if (seconds === null || !isFinite(seconds)) return "–";
  for (const [unit, size] of [["h", 3600], ["min", 60], ["s", 1], ["ms", 1e-3], ["µs", 1e-6]])
    if (seconds >= size * (unit === "min" ? 2 : 1)) return number(seconds / size) + "\u00a0" + unit;
  return number(seconds * 1e9) + "\u00a0ns";
}
/// "±3 %": the larger half of an interval, rounded up; "2 to 9" where that says too little.
function error_of(x, show = number) {
  if (!x || x.low === null || !x.value) return "";
  const half = 100 * Math.max(x.high - x.value, x.value - x.low) / x.value;
  if (half > 50) return between(x, show);
  return "±" + (half < 1 ? Math.ceil(half * 10) / 10 : Math.ceil(half)) + "\u00a0%";
}
/// A figure and its interval, for a cell.
function figure_of(x, show = number) {
  const error = note(error_of(x, show));
  if (error.textContent.includes(" to ")) error.className = "below";
  return [show(x.value), error];
}
/// The interval, at 95 %, of a mean of many samples.
const mean_error = (se, digits = 1) => se ? "±" + number(1.96 * se, digits) : "";
const between = (x, show = number) => x.low === null ? "interval not known" : `${show(x.low)} to ${show(x.high)}`;

const is_ranked = (s) => s.status === "ranked";
const ranked = (scene) => scene.strategies.filter(is_ranked);
const by_name = (scene, name) => scene.strategies.find((s) => s.name === name);
const status_words = { not_run: "not run", not_resolved: "not resolved", biased: "biased" };

/// The strategy to use: what the report says; in older ones soonest at 1 % error, without times of least variance.
function best_of(scene) {
  const time = (s) => s.seconds_to_1_percent ?? Infinity;
  return ranked(scene).find((s) => s.name === scene.leader) ?? ranked(scene).sort((a, b) => time(a) - time(b) || a.rank - b.rank)[0];
}
/// Those that the strategy is neither apart from nor tied with, in variance.
const undecided_with = (scene, s) => scene.pairs.filter((p) => p.verdict === "undecided" && (p.a === s.name || p.b === s.name)).map((p) => p.a === s.name ? p.b : p.a);
const is_undecided = (scene, s) => undecided_with(scene, s).length > 0;
const pair_of = (scene, a, b) => scene.pairs.find((p) => (p.a === a && p.b === b) || (p.a === b && p.b === a));

/// How many times sooner a is at 1 % than b, as an interval.
function sooner(scene, a, b) {
  const p = pair_of(scene, a, b);
  if (!p || p.time_ratio.value === null) return null;
  if (p.b === a) return p.time_ratio;
  const over = (x) => x === null ? null : 1 / x;
  return { value: over(p.time_ratio.value), low: over(p.time_ratio.high), high: over(p.time_ratio.low) };
}

/// Error against wall time: `samples` per point take scale·(samples·per_sample + per_point) seconds, and then the error is
/// sqrt(relative variance/samples). The scale makes the curve go through the report's time to 1 %. Null where a figure lacks.
function curve_of(s) {
  const variance = s.relative_variance.value, per_sample = s.seconds_per_sample.value,
    per_point = s.seconds_per_point.value ?? 0;
  if (!is_ranked(s) || !(variance > 0) || !(per_sample > 0) || s.seconds_to_1_percent === null) return null;
  const scale = s.seconds_to_1_percent / (Math.max(1, variance / 1e-4) * per_sample + per_point);
  return {
    strategy: s, variance, per_sample, per_point, scale,
    seconds: (error) => scale * (Math.max(1, variance / (error * error)) * per_sample + per_point),
    first: scale * (per_sample + per_point), first_error: Math.sqrt(variance),
    error: (seconds) => Math.sqrt(variance * per_sample / (seconds / scale - per_point)),
  };
}

/// Where the curve that is lowest changes: [{ seconds, before, after }], by time.
function crossings_of(curves) {
  const found = [];
  for (const a of curves)
    for (const b of curves) {
      const A = a.variance * a.per_sample, B = b.variance * b.per_sample;
      const t = (A * b.per_point - B * a.per_point) / (A / b.scale - B / a.scale);
      if (!(t > a.first && t > b.first) || !isFinite(t)) continue;
      if (!(a.error(t * 1.001) < b.error(t * 1.001))) continue;  // a overtakes b
      if (curves.some((c) => c !== a && c !== b && c.first < t && c.error(t) < a.error(t))) continue;
      found.push({ seconds: t, before: b, after: a });
    }
  return found.sort((x, y) => x.seconds - y.seconds);
}
