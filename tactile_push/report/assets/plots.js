// SPDX-FileCopyrightText: 2026 The tactile_push authors
// SPDX-License-Identifier: Apache-2.0
// Plots against time, by Plotly.

const MARGIN = { l: 54, r: 10, b: 42 };
const PANEL_HEIGHT = 128; // [px], as all below
const LANE_HEIGHT = 30;
const NARROW = 480; // plots: there the buttons need a line of their own
const GAP = 36; // between panels, where the names of the lines stand
const PRINT_WIDTH = 690; // of A4 and Letter less their margins

for (const panel of PANELS) panel.lines = panel.lines.filter(([key]) => key in series);
const panels = PANELS.filter((panel) => panel.lines.length);

let printing = false;

// Plotly takes some HTML in its texts; what a bag says is text alone.
function plain(text) {
  return text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;');
}

function axis(name, row) {
  return row ? `${name}${row + 1}` : name;
}

function lineTraces() {
  return panels.flatMap((panel, row) => panel.lines.map(([key, name, tint, look, short]) => ({
    type: 'scatter',
    mode: 'lines',
    name: short ?? name,
    showlegend: !FIRST_OF_BANDS.includes(key),
    x: series[key].time,
    y: series[key].values,
    yaxis: axis('y', row),
    legend: axis('legend', row),
    line: { color: color(tint), simplify: false, ...look },
    fill: key in BANDS ? 'tonexty' : 'none',
    fillcolor: color(BANDS[key] ?? 'band'),
    hovertemplate: `%{y:.${panel.digits}f}${panel.unit}<extra>${panel.of}${name}</extra>`,
  })));
}

function episodeTraces() {
  return LEVELS.flatMap((level) => {
    const episodes = report.episodes.filter((episode) => episode.level === level);
    if (!episodes.length) return [];
    const trace = { x: [], y: [], text: [] };
    for (const { start, end, lane, text } of episodes) {
      // So close that the pointer finds the middle of a long one, too.
      const steps = Math.ceil((end - start) / report.duration * 200);
      for (let i = 0; i <= steps; i += 1) {
        trace.x.push(start + (end - start) * (steps ? i / steps : 0));
        trace.y.push(-report.lanes.indexOf(lane));
        trace.text.push(plain(`${lane}: ${text}`));
      }
      trace.x.push(null);
      trace.y.push(null);
      trace.text.push(null);
    }
    return [{
      type: 'scatter',
      mode: 'lines+markers',
      name: level,
      ...trace,
      yaxis: axis('y', panels.length),
      legend: axis('legend', panels.length),
      line: { color: color(level), width: 8 },
      marker: { color: color(level), size: 8, symbol: 'square' },
      hovertemplate: '%{text}<extra></extra>',
    }];
  });
}

function layout() {
  const lanes = report.lanes.length;
  const heights = panels.map(() => PANEL_HEIGHT);
  if (lanes) heights.push(lanes * LANE_HEIGHT);
  const inside = heights.reduce((sum, height) => sum + height + GAP, -GAP);
  const lines = { gridcolor: color('grid'), linecolor: color('rule'), zerolinecolor: color('rule') };
  const narrow = !printing && plots.clientWidth < NARROW;
  const margin = { ...MARGIN, t: narrow ? 64 : 34 };
  const made = {
    autosize: !printing,
    width: printing ? PRINT_WIDTH : undefined,
    height: inside + margin.t + margin.b,
    margin,
    paper_bgcolor: color('paper'),
    plot_bgcolor: color('paper'),
    font: { color: color('text'), family: getComputedStyle(document.body).fontFamily, size: 12 },
    hovermode: narrow ? 'x' : 'x unified',
    hoversubplots: 'axis',
    hoverlabel: { bgcolor: color('panel'), bordercolor: color('rule'), font: { color: color('text') } },
    // A finger that wipes over a plot on a phone scrolls the page.
    dragmode: matchMedia('(pointer: coarse)').matches ? false : 'zoom',
    uirevision: 'kept',
    xaxis: {
      ...lines,
      title: { text: 'time [s]', standoff: 8 },
      range: [0, report.duration],
      anchor: axis('y', heights.length - 1),
      zeroline: false,
      showspikes: false,
      unifiedhovertitle: { text: 't: %{x:.2f} s' },
    },
  };
  let top = inside;
  heights.forEach((height, row) => {
    const domain = [Math.max(0, (top - height) / inside), top / inside];
    made[axis('yaxis', row)] = {
      ...lines,
      domain,
      fixedrange: true,
      title: { text: row < panels.length ? panels[row].title : '', standoff: 4 },
      nticks: 6,
      range: row < panels.length ? seenRange(panels[row]) : undefined,
    };
    made[axis('legend', row)] = {
      orientation: 'h', x: 0, xanchor: 'left', y: domain[1], yanchor: 'bottom', bgcolor: 'rgba(0,0,0,0)',
    };
    top -= height + GAP;
  });
  if (lanes) {
    const row = panels.length;
    Object.assign(made[axis('yaxis', row)], {
      range: [0.5 - lanes, 0.9], showticklabels: false, showgrid: false, zeroline: false,
    });
    made.annotations = report.lanes.map((lane, i) => ({
      text: plain(lane), xref: 'paper', x: 0, xanchor: 'left', yref: axis('y', row), y: -i,
      yanchor: 'bottom', yshift: 3, showarrow: false, font: { size: 11 },
    }));
  }
  return made;
}

function draw() {
  return Plotly.react(plots, [...lineTraces(), ...episodeTraces()], layout(), {
    responsive: true,
    displaylogo: false,
    displayModeBar: true,
    modeBarButtons: [['zoom2d', 'pan2d'], ['zoomIn2d', 'zoomOut2d', 'resetScale2d'], ['toImage']],
    toImageButtonOptions: { filename: document.title },
  }).then(placeCursor);
}

// Where the time axis lies in the plots [px].
function timeAxis() {
  const [from, to] = plots.layout.xaxis.range;
  return { from, to, left: MARGIN.l, width: plots.clientWidth - MARGIN.l - MARGIN.r };
}

function placeCursor() {
  if (!plots.layout) return; // not drawn yet
  const { from, to, left, width } = timeAxis();
  const part = (time - from) / (to - from);
  element('cursor').hidden = !(part >= 0 && part <= 1);
  element('cursor').style.left = `${left + part * width}px`;
}

function onPlotClick(event) {
  const box = plots.getBoundingClientRect();
  const { from, to, left, width } = timeAxis();
  const part = (event.clientX - box.left - left) / width;
  if (part < 0 || part > 1 || event.target.closest('.legend, .modebar')) return;
  stop();
  show(from + part * (to - from));
}

function print(on) {
  if (printing === on) return;
  printing = on;
  document.documentElement.classList.toggle('printing', on);
  for (const details of document.querySelectorAll('details')) {
    if (on) details.dataset.open = details.open;
    details.open = on || details.dataset.open === 'true';
  }
  draw();
}
