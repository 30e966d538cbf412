// SPDX-FileCopyrightText: 2026 The tactile_push authors
// SPDX-License-Identifier: Apache-2.0
// The page of `tactile_push report`: what it shows, and the time that plots and view share.
'use strict';

const report = JSON.parse(document.getElementById('data').textContent);
const { frames, scene, series } = report;
const element = (id) => document.getElementById(id);
const plots = element('plots');
const slider = element('time');
const play = element('play');

let time = frames.time[0];

function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

function show(seconds) {
  const last = frames.time.length - 1;
  time = Math.min(Math.max(seconds, 0), frames.time[last]);
  const k = Math.round(time / report.duration * last);
  slider.value = k;
  slider.setAttribute('aria-valuetext', `${frames.time[k].toFixed(1)} seconds`);
  drawFrame(k);
  readOut(k);
  placeCursor();
}

let playing = null; // the pending animation frame

function stop() {
  cancelAnimationFrame(playing);
  playing = null;
  play.textContent = 'Play';
}

function start() {
  play.textContent = 'Pause';
  const end = frames.time.at(-1);
  if (time >= end) show(0);
  let before = performance.now();
  const advance = (now) => {
    show(time + Math.max(0, now - before) / 1000 * Number(element('speed').value));
    before = now;
    if (time >= end) stop();
    else playing = requestAnimationFrame(advance);
  };
  playing = requestAnimationFrame(advance);
}

function begin() {
  slider.max = frames.time.length - 1;
  slider.addEventListener('input', () => {
    stop();
    show(frames.time[slider.value]);
  });
  play.addEventListener('click', () => (playing === null ? start() : stop()));
  plots.addEventListener('click', onPlotClick);

  element('hint').textContent = matchMedia('(pointer: coarse)').matches
    ? 'Tap to move the time. The buttons zoom; a tap on a name hides its line.'
    : 'Drag to zoom, double-click to see all, click to move the time; a click on a name hides its line.';
  prepareView();
  prepareReadout();
  show(frames.time[Math.max(0, frames.theta.findIndex((theta) => theta !== null))]);
  // The view is there while the browser still reads Plotly, which follows this script.
  addEventListener('DOMContentLoaded', async () => {
    if (panels.length || report.lanes.length) await draw();
    else element('plots-section').hidden = true;
    performance.mark('ready');
    if (!plots.layout) return;
    plots.on('plotly_afterplot', placeCursor);
    plots.on('plotly_relayout', placeCursor);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
    addEventListener('beforeprint', () => print(true));
    addEventListener('afterprint', () => print(false));
    matchMedia('print').addEventListener('change', (change) => print(change.matches));
  });
}

queueMicrotask(begin); // when the rest of this script, which follows, has been read
