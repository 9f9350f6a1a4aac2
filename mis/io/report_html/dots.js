// Dot plots of one figure with its interval, strategies grouped by policy.

function draw_dots(id, title, text, figure, unit) {
  const scene = scene_now();
  const all = ranked(scene).filter((s) => figure(s).value > 0 && isFinite(figure(s).value));
  const groups = grouped(all), row = 21, gap = 10, top = 24;
  const height = top + groups.reduce((sum, [, list]) => sum + list.length * row + gap, 0) + 16;
  const { svg, width } = frame(id, title, text, Math.max(height, 80));
  if (all.length === 0) {
    svg.append("text").attr("x", 0).attr("y", 40).attr("class", "soft").text("No ranked strategy has this figure.");
    return;
  }
  const left = Math.min(width * .48, 8 + 7.1 * Math.max(...all.map((s) => s.name.length)));
  const x = d3.scaleLog().domain(log_domain(all.flatMap((s) => [figure(s).value, figure(s).low, figure(s).high]).filter((v) => v !== null))).range([left + 8, width - 12]);
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${top})`)
    .call(log_axis(d3.axisTop, x, width - left - 20, axis_number).tickSize(-(height - top - 16))).call((g) => g.select(".domain").remove());
  let y = top + gap / 2 + row / 2;
  const rows = [];
  for (const [, list] of groups) {
    for (const s of list) {
      const f = figure(s), g = svg.append("g").attr("data-strategy", s.name);
      g.append("text").attr("x", left - 6).attr("y", y).attr("dy", ".34em").attr("text-anchor", "end").text(s.name)
        .attr("textLength", 7.1 * s.name.length > left ? left - 8 : null).attr("lengthAdjust", "spacingAndGlyphs");
      if (f.low > 0) {
        g.append("path").attr("class", "span").attr("stroke", colour_of(s)).attr("d", `M${x(f.low)},${y}H${x(f.high)}M${x(f.low)},${y - 4}v8M${x(f.high)},${y - 4}v8`);
      }
      add_mark(g, s, x(f.value), y);
      rows.push({ strategy: s, x: x(f.value), y, tip: `${s.name}\n${unit} ${number(f.value, 4)}\n95 %: ${between(f, (v) => number(v, 4))}`,
        target: svg.append("rect").attr("class", "target").attr("x", 0).attr("width", width).attr("y", y - row / 2).attr("height", row) });
      y += row;
    }
    y += gap;
    svg.append("path").attr("class", "rule").attr("d", `M0,${y - gap / 2 - row / 2}H${width}`);
  }
  make_live(svg, rows);
}
const draw_variances = () => draw_dots("plot-variance", "Variance per sample", "With 95 % intervals; further left is better. By policy.", (s) => s.variance, "variance");
const draw_efficiencies = () => draw_dots("plot-efficiency", "Efficiency", `1/(variance × CPU seconds) at ${number(report.at)} samples per point; further right is better.`, (s) => s.efficiency, "efficiency");
