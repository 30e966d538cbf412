// SPDX-FileCopyrightText: 2026 The tactile_push authors
// SPDX-License-Identifier: Apache-2.0
// The page of `tactile_push watch`: what the server sends, and when it is drawn.
'use strict';

const AGAIN = 1000; // after a lost connection, before the next attempt [ms]
const element = (id) => document.getElementById(id);

// By name, as the scripts of the report have them: lines against time, and the newest frame.
let series = {};
let frames = {};
let report = { states: [] };
let scene = { radius: 0, outline: [], mu_c: null };
let seconds = 60; // that the strips show
let events = [];
const drawn = { frame: true, events: true, strips: true }; // whether the newest is
let stripsAt = -Infinity; // when the strips were drawn [ms]

function onHello(hello) {
  seconds = hello.seconds;
  report = { states: hello.states };
  series = Object.fromEntries(hello.names.map((name) => [name, { values: [] }]));
  frames = Object.fromEntries(hello.names.map((name) => [name, [null]]));
  for (const row of hello.rows) onFrame(row);
  element('readout').replaceChildren();
  prepareReadout();
  prepareStrips();
  prepare();
  performance.mark('ready');
}

function onFrame(row) {
  Object.keys(series).forEach((name, i) => {
    series[name].values.push(row[i]);
    frames[name][0] = row[i];
  });
  const times = series.time.values;
  while (times[0] < row[0] - seconds) {
    for (const { values } of Object.values(series)) values.shift();
  }
  drawn.frame = false;
}

// What the view has beside a frame. Some of it becomes known late.
let prepared = '';

function kind() {
  return `${simulated()} ${frames.estimate_x[0] !== null}`;
}

function prepare() {
  element('key').replaceChildren();
  prepareView();
  prepared = kind();
  drawn.frame = false;
}

function listEvents() {
  const now = Date.now() - 1000 * frames.time[0];
  const clock = (time) => new Date(now + 1000 * time).toLocaleTimeString();
  element('events').replaceChildren(...events.map(({ lane, level, text, times, start, end }) => {
    const row = document.createElement('tr');
    row.className = end === null ? '' : 'ended';
    const what = Object.assign(document.createElement('th'), { scope: 'row' });
    const mark = Object.assign(document.createElement('span'), { className: `level ${level}` });
    mark.textContent = level;
    what.append(mark, ` ${lane}: ${text}`);
    const lasted = end === null ? 'now' : `${(end - start).toFixed(1)} s`;
    row.append(what, ...[times, clock(start), lasted].map((cell) => {
      return Object.assign(document.createElement('td'), { textContent: cell });
    }));
    return row;
  }));
  const alarms = events.filter(({ level, end }) => level === 'error' && end === null);
  const words = alarms.map(({ lane, text }) => `${lane}: ${text}`).join(' · ');
  if (element('alarm').textContent !== words) element('alarm').textContent = words;
}

function say(words, live) {
  element('connection').textContent = words;
  element('connection').className = live ? 'facts live' : 'facts';
}

function connect() {
  const address = new URL('live', location.href);
  address.protocol = address.protocol.replace('http', 'ws');
  const socket = new WebSocket(address);
  socket.onmessage = ({ data }) => {
    const message = JSON.parse(data);
    if (message.hello) onHello(message.hello);
    if (message.frame) onFrame(message.frame);
    if (message.scene) {
      scene = message.scene;
      prepare();
    }
    if (message.events) {
      events = message.events;
      drawn.events = false;
    }
  };
  socket.onopen = () => say('live', true);
  socket.onclose = () => {
    say('no connection; the page tries again every second', false);
    setTimeout(connect, AGAIN);
  };
}

function draw(now) {
  requestAnimationFrame(draw);
  if ((frames.time?.[0] ?? null) === null) return; // before the first frame
  if (!drawn.frame) {
    if (kind() !== prepared) prepare();
    drawFrame(0);
    readOut(0);
    drawn.frame = true;
    drawn.strips = false;
  }
  if (!drawn.events) {
    listEvents();
    drawn.events = true;
  }
  if (!drawn.strips && now - stripsAt >= STRIPS_EVERY) {
    drawStrips();
    drawn.strips = true;
    stripsAt = now;
  }
}

queueMicrotask(() => { // when the rest of this script, which follows, has been read
  connect();
  requestAnimationFrame(draw);
  addEventListener('resize', () => {
    drawn.frame = false;
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    takeColors();
    drawn.frame = false;
  });
});
