// Numbers → colours of the viewer.

const bad_colour = [255, 0, 255];  // samples there that are no numbers
const away_colour = [24, 26, 30];  // no surface

/// 256 colours of a scale on [0, 1].
function colour_table(scale) {
  const table = new Uint8Array(768);
  for (let i = 0; i < 256; ++i) {
    const c = d3.rgb(scale(i / 255));
    table.set([c.r, c.g, c.b], 3 * i);
  }
  return table;
}
const variance_colours = colour_table(d3.interpolateViridis);
/// Blue: too dark, orange: too bright, white: equal.
const difference_scale = d3.interpolateRgbBasis(["#08306b", "#2f7fbd", "#a9cfe6", "#f7f7f5", "#fbc98d", "#e0782b", "#7f2704"]);
const difference_colours = colour_table(difference_scale);

/// A strategy's colour as winner: its policy's, the heuristics lighter and darker.
function winner_colour(s) {
  const colour = d3.lab(colour_of(s));
  colour.l += 13 * (mark_of(s)?.lighter ?? 0) + (is_hollow(s) ? 6 : 0);
  return d3.rgb(colour);
}
/// Where the policy alone is sure: its colour, paler.
const policy_winner_colour = (strategies, policy) => d3.rgb(d3.interpolateLab(colour_of(strategies.find((s) => (s.policy ?? s.technique) === policy)), "#ffffff")(.42));

/// The share of pixels below which `share` of the positive values lie.
function quantile_of(values, share, is_counted = () => true) {
  const step = Math.max(1, Math.floor(values.length / 50000)), some = new Float32Array(Math.ceil(values.length / step));
  let count = 0;
  for (let i = 0; i < values.length; i += step) if (values[i] > 0 && is_counted(i)) some[count++] = values[i];
  return count === 0 ? 1 : some.subarray(0, count).sort()[Math.min(count - 1, Math.floor(share * count))];
}

/// Fills RGBA pixels: colour(i, out) puts three bytes.
function paint(width, height, colour) {
  const image = new ImageData(width, height), rgb = [0, 0, 0];
  for (let i = 0; i < width * height; ++i) {
    colour(i, rgb);
    image.data[4 * i] = rgb[0]; image.data[4 * i + 1] = rgb[1]; image.data[4 * i + 2] = rgb[2]; image.data[4 * i + 3] = 255;
  }
  return image;
}
function from_table(table, share, rgb) {
  const k = 3 * Math.max(0, Math.min(255, Math.round(255 * share)));
  rgb[0] = table[k]; rgb[1] = table[k + 1]; rgb[2] = table[k + 2];
}
/// Diagonal stripes: where a layer has no number.
const stripe = (i, width, rgb) => { const on = ((i % width) + Math.floor(i / width)) % 6 < 3; [rgb[0], rgb[1], rgb[2]] = on ? bad_colour : [0, 0, 0]; };

/// A mean as a picture: linear luminance × exposure, in the reference's colour there, raised to 1/gamma.
function paint_mean(m, mean, reference, bad, gain, gamma) {
  const tone = new Uint8Array(4097);
  for (let i = 0; i <= 4096; ++i) tone[i] = Math.round(255 * (i / 4096) ** (1 / gamma));
  const byte = (v) => tone[Math.max(0, Math.min(4096, Math.round(4096 * v)))];
  return paint(m.width, m.height, (i, rgb) => {
    if (!isFinite(mean[i]) || (bad && bad[i])) return stripe(i, m.width, rgb);
    const r = reference.red[i] / 255, b = reference.blue[i] / 255, g = Math.max(0, 1 - r - b);
    const sum = gain * mean[i] / (.2126 * r + .7152 * g + .0722 * b);
    rgb[0] = byte(r * sum); rgb[1] = byte(g * sum); rgb[2] = byte(b * sum);
  });
}
/// (mean − reference)/√(reference² + ε²), ± range.
const difference_at = (mean, reference, epsilon, i) => (mean[i] - reference[i]) / Math.hypot(reference[i], epsilon || 1e-30);
function paint_difference(m, layer, reference, kind, epsilon, range) {
  return paint(m.width, m.height, (i, rgb) => {
    if (!isFinite(layer.mean[i]) || (layer.bad && layer.bad[i])) return stripe(i, m.width, rgb);
    if (kind[i] === 0) [rgb[0], rgb[1], rgb[2]] = away_colour;
    else from_table(difference_colours, .5 + .5 * difference_at(layer.mean, reference, epsilon, i) / range, rgb);
  });
}
function paint_variance(m, layer, kind, domain) {
  const low = Math.log(domain[0]), span = Math.log(domain[1]) - low;
  return paint(m.width, m.height, (i, rgb) => {
    if (layer.bad && layer.bad[i]) return stripe(i, m.width, rgb);
    if (kind[i] === 0) [rgb[0], rgb[1], rgb[2]] = away_colour;
    else if (!isFinite(layer.variance[i])) return stripe(i, m.width, rgb);
    else from_table(variance_colours, layer.variance[i] > 0 ? (Math.log(layer.variance[i]) - low) / span : 0, rgb);
  });
}
const undecided_colour = [140, 144, 150];
function paint_winners(m, winners, kind, strategies, chosen) {
  const bytes = (c) => [c.r, c.g, c.b], of_strategy = strategies.map((s) => bytes(winner_colour(s)));
  const of_policy = m.policies.map((p) => bytes(policy_winner_colour(strategies, p)));
  const one = strategies.findIndex((s) => s.name === chosen), its_policy = one < 0 ? -1 : m.policies.indexOf(strategies[one].policy ?? strategies[one].technique);
  return paint(m.width, m.height, (i, rgb) => {
    const s = winners.strategy[i], p = winners.policy[i];
    const faded = one >= 0 && (s >= 0 ? s !== one : p >= 0 && p !== its_policy);
    const c = kind[i] === 0 ? away_colour : kind[i] === 1 ? [60, 63, 68] : s >= 0 ? of_strategy[s] : p >= 0 ? of_policy[p] : undecided_colour;
    for (let k = 0; k < 3; ++k) rgb[k] = faded ? Math.round(.18 * c[k] + .82 * 90) : c[k];
  });
}
