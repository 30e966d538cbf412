// SPDX-FileCopyrightText: 2026 The tactile_push authors
// SPDX-License-Identifier: Apache-2.0
// Which quantities stand in which panel against time, and how each looks.

// What the panels show: key of the series, name, colour, the rest of the line's look, and what
// the legend calls it if not by its name. A panel may have series that have to be seen, while others
// may run out of it.
const PANELS = [
  { title: 'angle [°]', of: '', unit: '°', digits: 1, lines: [
    ['phi', 'φ − 90°', 'orange', { width: 2.5 }],
    ['theta', 'θ', 'blue', { width: 1.5 }],
    ['theta_desired', 'θ<sub>d</sub>', 'note', { width: 1.2, dash: 'dash' }],
  ] },
  { title: 'v<sub>x</sub> [mm/s]', of: 'v<sub>x</sub> ', unit: ' mm/s', digits: 2, lines: [
    ['v_x_true', 'finger', 'orange', { width: 2.5 }],
    ['v_x', 'commanded', 'blue', { width: 1.5, shape: 'hv' }],
  ] },
  { title: 'tip [°]', of: 'tip ', unit: '°', digits: 1, lines: [
    ['psi', 'ψ − 90°', 'blue', { width: 1.5 }],
  ] },
  { title: 'd [mm]', of: 'd ', unit: ' mm', digits: 2, seen: ['d', 'd_true'], lines: [
    ['d_least', 'guaranteed from', 'blue', { width: 0 }],
    ['d_most', 'guaranteed to', 'blue', { width: 0 }, 'guaranteed'],
    ['d_lower', '95 % from', 'blue', { width: 0.5 }],
    ['d_upper', '95 % to', 'blue', { width: 0.5 }, '95 %'],
    ['d', 'estimated', 'blue', { width: 1.5 }],
    ['d_true', 'true', 'green', { width: 1.5 }],
  ] },
  { title: 'silence [s]', of: 'silence of ', unit: ' s', digits: 3, lines: [
    ['interval', 'sensor', 'note', { width: 0.8 }],
    ['silence', 'contact', 'blue', { width: 1.5 }],
  ] },
];
// Bounds: the band between two lines, by the upper one.
const BANDS = { d_most: 'faint', d_upper: 'band' };
const FIRST_OF_BANDS = ['d_least', 'd_lower'];
const LEVELS = ['error', 'warning', 'note'];

// The range of a panel's axis: what has to be seen with room around it. Before anything is known
// of d its bounds are as wide as the object.
function seenRange({ seen = [] }) {
  if (!(seen[0] in series)) return undefined;
  const values = seen.flatMap((key) => series[key]?.values ?? []).filter((value) => value !== null);
  if (!values.length) return undefined;
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const room = Math.max(2, (high - low) / 3);
  return [low - room, high + room];
}
