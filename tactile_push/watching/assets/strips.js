// SPDX-FileCopyrightText: 2026 The tactile_push authors
// SPDX-License-Identifier: Apache-2.0
// Lines against time that move: one canvas a panel.

const STRIPS_EVERY = 95; // ten times a second [ms]
const LEFT = 44; // of the plot: numbers of the axis [px], as all below
const RIGHT = 6;
const BELOW = 18; // numbers of the time
const ROOM = 8; // above the plot
const TICKS = 3; // about so many gaps between lines of the grid
const WEIGHT = 12; // height of letters

let strips = []; // panel, canvas and what draws on it
const colors = {};

function takeColors() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['blue', 'orange', 'green', 'note', 'band', 'faint', 'grid', 'rule', 'muted']) {
    colors[name] = style.getPropertyValue(`--${name}`).trim();
  }
}

function prepareStrips() {
  takeColors();
  strips = PANELS.map((panel) => {
    const lines = panel.lines.filter(([key]) => key in series);
    const figure = Object.assign(document.createElement('figure'), { className: 'strip' });
    const caption = document.createElement('figcaption');
    const canvas = document.createElement('canvas');
    const title = document.createElement('b');
    title.innerHTML = panel.title; // ours, with an index
    caption.append(title, ...lines.filter(([key]) => !FIRST_OF_BANDS.includes(key)).map(legend));
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', `${title.textContent} over the last ${seconds} seconds`);
    figure.append(caption, canvas);
    return { panel, lines, figure, canvas, pen: canvas.getContext('2d') };
  });
  element('strips').replaceChildren(...strips.map(({ figure }) => figure));
}

function legend([key, name, tint, , short]) {
  const item = document.createElement('span');
  item.innerHTML = short ?? name; // ours, with an index
  item.style.setProperty('--key', `var(--${BANDS[key] ?? tint})`);
  return item;
}

function drawStrips() {
  for (const strip of strips) drawStrip(strip);
}

// Limits of an axis that hold still while the values move a little: on lines of the grid.
function limits({ panel, lines }) {
  const range = seenRange(panel);
  const of = range ? [] : lines.map(([key]) => key);
  let [low, high] = range ?? [Infinity, -Infinity];
  for (const key of of) {
    for (const value of series[key].values) {
      if (value === null) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (!(low <= high)) [low, high] = [-1, 1];
  if (high - low < 1e-3) [low, high] = [low - 0.5, high + 0.5];
  const power = 10 ** Math.floor(Math.log10((high - low) / TICKS));
  const step = power * [1, 2, 5, 10].find((times) => times * power * TICKS >= high - low);
  return { low: Math.floor(low / step) * step, high: Math.ceil(high / step) * step, step };
}

function drawStrip(strip) {
  const { canvas, pen, lines } = strip;
  const scale = devicePixelRatio;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const pixels = [Math.round(width * scale), Math.round(height * scale)];
  if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, width, height);
  const { low, high, step } = limits(strip);
  const times = series.time.values;
  const last = times.at(-1) ?? 0;
  const x = (time) => LEFT + (width - LEFT - RIGHT) * (1 + (time - last) / seconds);
  const y = (value) => height - BELOW - (height - BELOW - ROOM) * (value - low) / (high - low);
  drawGrid(pen, { low, high, step, width, height, x: (ago) => x(last - ago), y });
  pen.save();
  pen.beginPath();
  pen.rect(LEFT, 0, width - LEFT - RIGHT, height - BELOW + 1);
  pen.clip();
  let lower = null;
  for (const [key, , tint, look] of lines) {
    const { values } = series[key];
    if (key in BANDS) fillBand(pen, colors[BANDS[key]], times, lower, values, x, y);
    lower = values;
    if (look.width) drawLine(pen, colors[tint], look, times, values, x, y);
  }
  pen.restore();
}

function drawGrid(pen, { low, high, step, width, height, x, y }) {
  pen.font = `${WEIGHT}px system-ui, sans-serif`;
  pen.lineWidth = 1;
  pen.fillStyle = colors.muted;
  pen.textAlign = 'right';
  pen.textBaseline = 'middle';
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  for (let k = 0; low + k * step <= high + step / 2; k += 1) {
    const value = low + k * step;
    pen.strokeStyle = Math.abs(value) < step / 2 ? colors.rule : colors.grid;
    stroke(pen, LEFT, y(value), width - RIGHT, y(value));
    const text = value.toFixed(digits).replace(/^-(?=0(\.0*)?$)/, '').replace('-', '−');
    pen.fillText(text, LEFT - 4, Math.min(y(value), height - BELOW - 2));
  }
  pen.textBaseline = 'alphabetic';
  pen.strokeStyle = colors.grid;
  for (let ago = 0; ago <= seconds; ago += seconds / 6) {
    stroke(pen, x(ago), ROOM, x(ago), height - BELOW);
    pen.textAlign = ago === 0 ? 'right' : ago === seconds ? 'left' : 'center';
    if (ago === 0 || ago === seconds || Math.round(ago * 6 / seconds) % 2 === 0) {
      pen.fillText(ago === 0 ? 'now' : `−${Number(ago.toFixed(1))} s`, x(ago), height - 4);
    }
  }
}

function stroke(pen, x1, y1, x2, y2) {
  pen.beginPath();
  pen.moveTo(x1, y1);
  pen.lineTo(x2, y2);
  pen.stroke();
}

function drawLine(pen, color, { width, dash, shape }, times, values, x, y) {
  pen.strokeStyle = color;
  pen.lineWidth = width;
  pen.setLineDash(dash ? [6, 4] : []);
  pen.beginPath();
  let before = null;
  for (let i = 0; i < values.length; i += 1) {
    const value = values[i];
    if (value !== null) {
      if (before === null) pen.moveTo(x(times[i]), y(value));
      else if (shape === 'hv') pen.lineTo(x(times[i]), y(before));
      pen.lineTo(x(times[i]), y(value));
    }
    before = value;
  }
  pen.stroke();
  pen.setLineDash([]);
}

// What lies between two lines, piece by piece where both have values.
function fillBand(pen, color, times, lower, upper, x, y) {
  pen.fillStyle = color;
  for (let first = 0; first < times.length; first += 1) {
    let after = first;
    while (after < times.length && lower[after] !== null && upper[after] !== null) after += 1;
    if (after > first) {
      pen.beginPath();
      for (let i = first; i < after; i += 1) pen.lineTo(x(times[i]), y(upper[i]));
      for (let i = after - 1; i >= first; i -= 1) pen.lineTo(x(times[i]), y(lower[i]));
      pen.fill();
    }
    first = Math.max(first, after - 1);
  }
}
