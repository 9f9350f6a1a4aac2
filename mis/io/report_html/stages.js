// Where the time of a sample goes.

const stage_groups = [
  { name: "preparing the point", stages: [], colour: "#96673B" },
  { name: "random numbers", stages: ["rows", "numbers"], colour: "#8A929A" },
  { name: "choosing a light", stages: ["choose"], colour: "#2E93CC" },
  { name: "drawing a direction", stages: ["draw", "bsdf"], colour: "#009E73" },
  { name: "meeting and weighing lights", stages: ["meet", "weigh", "add"], colour: "#C27E00" },
  { name: "rays and occlusion", stages: ["light_occlusion", "rays"], colour: "#0072B2" },
];
const rest_of_sample = { name: "moments and the rest", stages: [], colour: "#B04A6A" };

function draw_stages() {
  const all = scene_now().strategies.filter((s) => Object.keys(s.stage_seconds).length > 0);
  const known = [...stage_groups.flatMap((g) => g.stages), "prepare"];
  const other = { name: "other", stages: [...new Set(all.flatMap((s) => Object.keys(s.stage_seconds)))].filter((k) => !known.includes(k)), colour: "#4D7F2B" };
  const groups = [...stage_groups, other, rest_of_sample];
  const in_stages = (s, group) => group.stages.reduce((sum, k) => sum + (s.stage_seconds[k] ?? 0), 0);
  const seconds = (s, group) => group === stage_groups[0] ? (s.seconds_per_point.value ?? 0) / report.at
    : group === rest_of_sample ? Math.max(0, (s.seconds_per_sample.value ?? 0) - groups.reduce((sum, g) => sum + in_stages(s, g), 0)) : in_stages(s, group);
  const total = (s) => groups.reduce((sum, g) => sum + seconds(s, g), 0);
  all.sort((a, b) => total(a) - total(b));
  const row = 21, top = 46, height = top + all.length * row + 30;
  const { svg, width } = frame("plot-stages", "Where the time goes", `CPU time of one sample; of what is prepared once per point, one part in ${number(report.at)}.`, Math.max(height, 80));
  if (all.length === 0) return;
  const left = Math.min(width * .42, 8 + 7.1 * Math.max(...all.map((s) => s.name.length)));
  const x = d3.scaleLinear().domain([0, 1e9 * Math.max(...all.map(total))]).nice(5).range([left, width - 30]);
  let key = 0, line = 0;
  for (const g of groups.filter((g) => all.some((s) => seconds(s, g) > 0))) {
    if (key + 22 + 6.6 * g.name.length > width) key = 0, line += 18;
    svg.append("rect").attr("x", key).attr("y", 4 + line).attr("width", 12).attr("height", 12).attr("rx", 2).attr("fill", g.colour);
    svg.append("text").attr("x", key + 17).attr("y", 14 + line).text(g.name);
    key += 34 + 6.6 * g.name.length;
  }
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${height - 26})`).call(d3.axisBottom(x).ticks(Math.max(2, (width - left) / 90)).tickSize(-(height - top - 26)).tickFormat((v) => number(v) + " ns").tickSizeOuter(0)).call((g) => g.select(".domain").remove());
  const rows = all.map((s, i) => {
    const y = top + i * row, g = svg.append("g").attr("data-strategy", s.name);
    g.append("text").attr("x", left - 6).attr("y", y + row / 2).attr("dy", ".34em").attr("text-anchor", "end").text(s.name)
      .attr("textLength", 7.1 * s.name.length > left ? left - 8 : null).attr("lengthAdjust", "spacingAndGlyphs");
    let at = 0;
    const lines = [];
    for (const group of groups) {
      const ns = 1e9 * seconds(s, group);
      if (ns <= 0) continue;
      g.append("rect").attr("x", x(at)).attr("y", y + 3).attr("width", Math.max(.5, x(at + ns) - x(at) - 1)).attr("height", row - 6).attr("fill", group.colour);
      lines.push(`${group.name}: ${number(ns)} ns`);
      at += ns;
    }
    return { strategy: s, x: x(at), y: y + row / 2, tip: `${s.name}: ${number(at)} ns per sample\n${lines.join("\n")}`,
      target: svg.append("rect").attr("class", "target").attr("x", 0).attr("width", width).attr("y", y).attr("height", row) };
  });
  make_live(svg, rows);
}
