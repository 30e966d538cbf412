// SPDX-FileCopyrightText: 2026 The tactile_push authors
// SPDX-License-Identifier: Apache-2.0
// The view from above, and the numbers beside it.

const RAY = 26; // length of the contact normal, of a view that is 100 high
let unit = 1; // a hundredth of the height of the view [mm]

function set(id, attributes) {
  const shape = element(id);
  for (const [name, value] of Object.entries(attributes)) shape.setAttribute(name, value);
}

function ray(angle, length, start = [0, 0]) {
  return [start[0] + length * Math.cos(angle), start[1] + length * Math.sin(angle)];
}

function line(id, [x1, y1], [x2, y2]) {
  set(id, { x1, y1, x2, y2 });
}

function visible(ids, on) {
  for (const id of ids) element(id).style.display = on ? '' : 'none';
}

function drawContact(theta, phi) {
  visible(['normal', 'edge'], theta !== null);
  visible(['cone'], theta !== null && scene.mu_c !== null);
  visible(['push'], theta !== null && phi !== null);
  if (theta === null) return;
  const normal = (theta + 90) * Math.PI / 180;
  const contact = ray(normal, scene.radius);
  line('normal', contact, ray(normal, RAY * unit, contact));
  const half = 20 * unit;
  line('edge', ray(normal - Math.PI / 2, half, contact), ray(normal + Math.PI / 2, half, contact));
  if (phi !== null) line('push', contact, ray((phi + 90) * Math.PI / 180, 1.4 * RAY * unit, contact));
  if (scene.mu_c !== null) {
    const alpha = scene.mu_c === 'infinite' ? Math.PI / 2 : Math.atan(scene.mu_c);
    const length = 0.7 * RAY * unit;
    const [right, left] = [ray(normal - alpha, length, contact), ray(normal + alpha, length, contact)];
    set('cone', { d: `M${contact} L${right} A${length} ${length} 0 0 1 ${left}Z` });
  }
}

function at(k, ...names) {
  return names.map((name) => frames[name][k]);
}

// Where the centre of mass may lie: along the edge, as d may.
function drawInterval(id, [x, y, theta, d, ...bounds]) {
  const known = ![x, y, theta, d, ...bounds].includes(null);
  visible([id], known);
  if (known) line(id, ...bounds.map((bound) => ray(theta * Math.PI / 180, d - bound, [x, y])));
}

function drawFrame(k) {
  drawContact(frames.theta[k], frames.phi[k]);
  const estimate = at(k, 'estimate_x', 'estimate_y', 'estimate_angle');
  const pose = simulated() ? at(k, 'object_x', 'object_y', 'object_angle') : estimate;
  const placed = !pose.includes(null) && (simulated() || scene.outline.length > 0);
  visible(['object'], placed);
  if (placed) {
    const [x, y, angle] = pose;
    set('object', { transform: `translate(${x} ${y}) rotate(${angle})` });
  }
  const [x, y] = estimate;
  visible(['estimate'], x !== null && y !== null);
  if (x !== null && y !== null) set('estimate', { transform: `translate(${x},${y})` });
  const centre = at(k, 'estimate_x', 'estimate_y', 'theta', 'd');
  drawInterval('likely', [...centre, ...at(k, 'd_lower', 'd_upper')]);
  drawInterval('guaranteed', [...centre, ...at(k, 'd_least', 'd_most')]);
  // The belt passes under the finger, and the finger moves across it.
  const shift = [-(frames.finger_x[k] ?? 0), frames.belt_travel[k] ?? 0];
  set('belt', { patternTransform: `translate(${shift})` });
}

// Whether somebody tells where the object is.
function simulated() {
  return frames.object_x.some((x) => x !== null);
}

// Make room for the object wherever it touches, and a scale that fits.
function prepareView() {
  const reach = 2 * Math.max(30, ...scene.outline.map(([x, y]) => Math.hypot(x, y)));
  const width = 1.6 * reach;
  const height = 2.3 * scene.radius + 1.08 * reach;
  const [left, top] = [-width / 2, 1.3 * scene.radius - height];
  set('view', { viewBox: [left, top, width, height] });
  set('ground', { x: left, y: top, width, height });
  unit = height / 100;
  element('view').style.setProperty('--unit', `${unit}px`);
  const scale = 10 ** Math.round(Math.log10(width / 8));
  const [x, y] = [left + 4 * unit, top + height - 5 * unit];
  line('scale-bar', [x, y], [x + scale, y]);
  set('scale-text', { x: x + scale / 2, y: y - 2 * unit });
  element('scale-text').textContent = scale < 10 ? `${scale} mm` : `${scale / 10} cm`;
  set('finger', { r: scene.radius });
  set('outline', { d: scene.outline.length ? `M${scene.outline.join('L')}Z` : '' });
  element('object').classList.toggle('estimated', !simulated());
  const estimated = frames.estimate_x.some((x) => x !== null);
  const entries = [
    [true, 'blue', '', 'contact normal'],
    [true, 'orange', '', 'push ray, φ'],
    [true, 'green', 'dashed', 'pushed edge or tangent, θ'],
    [scene.mu_c !== null, 'warning', 'area', 'friction cone'],
    [scene.outline.length && simulated(), 'text', '', 'object and its centre of mass (simulator)'],
    [scene.outline.length && estimated && !simulated(), 'green', 'dashed', 'object, estimated'],
    [estimated, 'green', '', '× centre of mass, estimated, with the 95 % and the guaranteed interval'],
  ];
  for (const [there, tint, look, text] of entries) {
    if (!there) continue;
    const item = document.createElement('li');
    item.textContent = text;
    item.className = look;
    item.style.setProperty('--key', `var(--${tint})`);
    element('key').append(item);
  }
}

// Numbers beside the view: key, name with an index, digits, unit.
const READOUT = [
  ['time', 't', '', 2, ' s'],
  ['theta', 'θ', '', 1, '°'],
  ['phi', 'φ − 90°', '', 1, '°'],
  ['psi', 'ψ − 90°', '', 1, '°'],
  ['v_x', 'v', 'x', 2, ' mm/s'],
  ['d', 'd', 'est.', 2, ' mm'],
  ['d_true', 'd', 'true', 2, ' mm'],
  ['finger_x', 'x', 'finger', 1, ' mm'],
];

function prepareReadout() {
  for (const [key, name, index] of READOUT.filter(([name]) => name === 'time' || name in series)) {
    addReading(key, name, index);
  }
  if (report.states.length) addReading('state', 'controller', '', 'wide');
}

function addReading(key, name, index, look = '') {
  const [group, term, value] = ['div', 'dt', 'dd'].map((tag) => document.createElement(tag));
  group.className = look;
  term.textContent = name;
  if (index) term.append(Object.assign(document.createElement('sub'), { textContent: index }));
  value.id = `at-${key}`;
  group.append(term, value);
  element('readout').append(group);
}

function readOut(k) {
  for (const [key, , , digits, unit] of READOUT) {
    const value = frames[key]?.[k] ?? null;
    const place = element(`at-${key}`);
    if (place) place.textContent = value === null ? '–' : value.toFixed(digits).replace('-', '−') + unit;
  }
  if (report.states.length) element('at-state').textContent = report.states[frames.state[k]] ?? '–';
}
