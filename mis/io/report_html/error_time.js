// Error against wall time, on log axes: lines of slope −½, but for what is prepared once per point.

function draw_error_time() {
  const curves = scene_now().strategies.map(curve_of).filter((c) => c !== null);
  const height = 380, low = .002;
  const { svg, width } = frame("plot-error", "Error against time",
    "From the variances and times of the table: what a render of all shading points takes until this error is left. Lower left is better.", height);
  if (curves.length === 0) {
    svg.append("text").attr("x", 0).attr("y", 40).attr("class", "soft").text("No ranked strategy has variance and time.");
    return;
  }
  const left = 56, right = 24, top = 26, bottom = 44, high = Math.min(10, Math.max(.05, ...curves.map((c) => c.first_error)) * 1.2);
  const starts = curves.map((c) => Math.max(c.first, c.seconds(high)));
  const x = d3.scaleLog().domain([Math.min(...starts) / 1.3, Math.max(...curves.map((c) => c.seconds(.01))) * 5]).range([left, width - right]);
  const y = d3.scaleLog().domain([low, high]).range([height - bottom, top]);
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${height - bottom})`).call(time_axis(d3.axisBottom, x).tickSize(-(height - top - bottom)));
  svg.append("g").attr("class", "axis").attr("transform", `translate(${left},0)`).call(log_axis(d3.axisLeft, y, height - top - bottom, (v) => percent(v, 2)).tickSize(-(width - left - right)));
  svg.append("text").attr("class", "soft").attr("x", width - right).attr("y", height - 6).attr("text-anchor", "end").text(`wall time on ${report.threads} ${report.threads === 1 ? "thread" : "threads"}`);
  svg.append("text").attr("class", "soft").attr("x", left).attr("y", 15).text("error (root of mean relative variance)");
  const clip = svg.append("clipPath").attr("id", "error-clip").append("rect").attr("x", left).attr("y", top);
  clip.attr("width", width - left - right).attr("height", height - top - bottom);
  const inside = svg.append("g").attr("clip-path", "url(#error-clip)");
  draw_guides(inside, x, y, curves);
  const rows = curves.map((c) => draw_curve(inside, c, x, y, high, low));
  const changes = crossings_of(curves);
  for (const change of changes)
    inside.append("circle").attr("cx", x(change.seconds)).attr("cy", y(change.after.error(change.seconds))).attr("r", 5).attr("fill", "none").attr("stroke", "currentColor").attr("stroke-width", 1.5);
  make_live(svg, rows);
  $("plot-error").append(make("p", { className: "note", id: "crossings" }, changes.length === 0 ? "The order of the strategies' curves at the front does not change with time. " :
    make("span", {}, ...changes.flatMap((c) => [`From ${duration(c.seconds)} on (error ${percent(c.after.error(c.seconds))}, ○) `, name_text(c.after.strategy.name), " is ahead of ", name_text(c.before.strategy.name), ". "]))));
}

/// The 1 % line, and below all curves one of slope −½.
function draw_guides(parent, x, y, curves) {
  parent.append("path").attr("class", "guide").attr("stroke-width", 1.5).attr("d", `M${x.range()[0]},${y(.01)}H${x.range()[1]}`);
  const [from, to] = x.domain(), times_root = .6 * Math.min(...curves.map((c) => Math.sqrt(c.variance * c.per_sample * c.scale)));
  const error = (t) => times_root / Math.sqrt(t), at = from * (to / from) ** .3;
  parent.append("path").attr("class", "guide").attr("d", `M${x(from)},${y(error(from))}L${x(to)},${y(error(to))}`);
  parent.append("text").attr("class", "soft").attr("text-anchor", "end").attr("x", x(at) - 8).attr("y", y(error(at)) + 12).text("slope −½");
}

function draw_curve(parent, c, x, y, high, low) {
  const s = c.strategy, end = c.seconds(low / 2), begin = Math.max(c.first, c.seconds(high * 1.5)), points = [];
  for (let i = 0; i <= 80; ++i) {
    const t = begin * (end / begin) ** (i / 80);
    points.push([x(t), y(Math.min(c.error(t), high * 2))]);
  }
  const d = d3.line()(points.filter((p) => p.every(isFinite)));
  parent.append("path").attr("class", "curve").attr("data-strategy", s.name).attr("stroke", colour_of(s)).attr("stroke-dasharray", mark_of(s)?.dash ?? null).attr("d", d);
  const t = s.seconds_to_1_percent, at = Math.sqrt(Math.min(1e-4, c.variance));
  add_mark(parent, s, x(t), y(at), 90);
  const interval = s.seconds_to_1_percent_interval;
  return { strategy: s, x: x(t), y: y(at),
    tip: `${s.name}\n1 % error in ${duration(t)}\n95 %: ${between(interval, duration)}\n10 % in ${duration(c.seconds(.1))}, 0.1 % in ${duration(c.seconds(.001))}`,
    target: parent.append("path").attr("class", "target").attr("d", d).attr("fill", "none").attr("style", null).attr("pointer-events", "stroke").attr("stroke-width", 12).attr("stroke", "transparent") };
}
