// Pictures of the page → numbers. A picture is planes of bytes in a grey PNG (mis/io/page_pictures.h).

const bytes_read = new Map();  // id → promise of the planes

/// The planes of a picture: arrays of bytes, width × height each.
function planes_of(picture, width, height) {
  if (!bytes_read.has(picture.id)) bytes_read.set(picture.id, read_planes(picture, width, height));
  return bytes_read.get(picture.id);
}
/// Waits until the browser, which reads the page from its top, is past a picture: the scene's own come first.
async function when_read(picture) {
  while (document.readyState === "loading" && !$("picture-" + picture.id)?.nextSibling) await new Promise((resolve) => setTimeout(resolve, 10));
}
function bytes_of(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}
async function read_planes(picture, width, height) {
  const bytes = bytes_of($("picture-" + picture.id).textContent);
  const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }), { premultiplyAlpha: "none", colorSpaceConversion: "none" });
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  const planes = [];
  for (let k = 0; k < picture.planes; ++k) {
    const left = (k % picture.columns) * width, top = Math.floor(k / picture.columns) * height;
    const pixels = new Uint32Array(context.getImageData(left, top, width, height).data.buffer), plane = new Uint8Array(width * height);
    for (let i = 0; i < plane.length; ++i) plane[i] = pixels[i];  // its lowest byte, as grey as the others
    planes.push(plane);
  }
  return planes;
}

/// 16-bit steps of a logarithm → values; 0 is 0, 65535 NaN.
function values_of(high, low, code) {
  const table = new Float32Array(65536).map((_, k) => k === 0 ? 0 : k === 65535 ? NaN : 2 ** (code.low + (k - 1) * code.step));
  const values = new Float32Array(high.length);
  for (let i = 0; i < values.length; ++i) values[i] = table[high[i] * 256 + low[i]];
  return values;
}

const layers_read = new Map();
/// A layer of a scene's maps: "reference" → { mean, red, blue }, a strategy's number → { mean, variance, bad }, "winners" →
/// { kind, variance, efficiency }, the latter two { strategy, policy } (−1: undecided).
function layer_of(scene, layer) {
  const key = scene + ":" + layer;
  if (!layers_read.has(key)) layers_read.set(key, read_layer(maps[scene], layer));
  return layers_read.get(key);
}
async function read_layer(m, layer) {
  const picture = layer === "reference" ? m.reference : layer === "winners" ? m.winners : m.strategies.find((s) => s.strategy === layer);
  const planes = await planes_of(picture, m.width, m.height);
  bytes_read.delete(picture.id);
  if (layer === "winners") {
    const winner = (high, low) => {
      const numbers = new Int16Array(high.length);  // a loop: Int16Array.from with a function takes ten times as long
      for (let i = 0; i < high.length; ++i) numbers[i] = high[i] * 256 + low[i] - 1;
      return numbers;
    };
    const by = (k) => ({ strategy: winner(planes[k], planes[k + 1]), policy: winner(planes[k + 2], planes[k + 3]) });
    return { kind: planes[0], variance: by(1), efficiency: by(5) };
  }
  const mean = values_of(planes[0], planes[1], picture.mean);
  if (layer === "reference") return { mean, red: planes[2], blue: planes[3] };
  return { mean, variance: values_of(planes[2], planes[3], picture.variance), bad: planes[4] ?? null };
}

/// The lights that matter most at a pixel of the page: [{ light, share }].
async function lights_at(m, x, y) {
  const map = m.lights, planes = await planes_of(map, map.width, map.height), found = [];
  const i = Math.min(map.height - 1, Math.floor(y / map.stride)) * map.width + Math.min(map.width - 1, Math.floor(x / map.stride));
  for (let k = 0; k < planes.length; k += 4) {
    const light = planes[k][i] * 65536 + planes[k + 1][i] * 256 + planes[k + 2][i] - 1;
    if (light >= 0) found.push({ light, share: planes[k + 3][i] / 255 });
  }
  return found;
}
