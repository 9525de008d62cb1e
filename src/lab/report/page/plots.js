// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
'use strict';

// Common parts of all plots: page colours, appearance of series, whiskers, redrawing.

const data = JSON.parse(document.getElementById('plot-data').textContent);

const page_color = (name) =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

const percent = (ratio) => (ratio === null ? null : 100 * ratio);

// Colours repeat after nine series, shapes after seven and dashes after four, so that all series of
// a plot differ.
function look(series) {
  const color = page_color(`series-${(series % 9) + 1}`);
  const shapes = ['circle', 'triangle', 'rect', 'rectRot', 'star', 'crossRot', 'cross'];
  const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3]];
  return {
    borderColor: color,
    backgroundColor: color,
    pointStyle: shapes[series % shapes.length],
    borderDash: dashes[series % dashes.length],
    borderWidth: 2,
    pointBorderWidth: 2,
    pointRadius: 5,
    pointHoverRadius: 7,
  };
}

// Round bounds in per cent around all values, with a margin, clamped to 0 to 100.
function percent_bounds(values) {
  const numbers = values.filter((value) => value !== null);
  if (numbers.length === 0) return {min: 0, max: 100};
  const low = Math.min(...numbers);
  const high = Math.max(...numbers);
  const margin = Math.max(0.5, 0.05 * (high - low));
  const step = [1, 2, 5, 10].find((size) => high - low < 8 * size) ?? 20;
  return {
    min: Math.max(0, step * Math.floor((low - margin) / step)),
    max: Math.min(100, step * Math.ceil((high + margin) / step)),
  };
}

// `intervals` of a dataset contains [low, high] or null per point, in units of the value axis.
const whiskers = {
  id: 'whiskers',
  beforeDatasetsDraw(chart) {
    const along_x = chart.options.indexAxis === 'y';
    const scale = along_x ? chart.scales.x : chart.scales.y;
    const context = chart.ctx;
    context.save();
    context.lineWidth = 1.5;
    for (const {index} of chart.getSortedVisibleDatasetMetas()) {
      const dataset = chart.data.datasets[index];
      (dataset.intervals ?? []).forEach((interval, i) => {
        if (interval === null) return;
        const point = chart.getDatasetMeta(index).data[i];
        const color = dataset.borderColor;
        context.strokeStyle = Array.isArray(color) ? color[i] : color;
        context.beginPath();
        draw_whisker(context, interval.map((end) => scale.getPixelForValue(end)),
                     along_x ? point.y : point.x, along_x);
        context.stroke();
      });
    }
    context.restore();
  },
};

function draw_whisker(context, ends, across, along_x) {
  const cap = 5;
  const line = (x1, y1, x2, y2) => {
    context.moveTo(x1, y1);
    context.lineTo(x2, y2);
  };
  if (along_x) line(ends[0], across, ends[1], across);
  else line(across, ends[0], across, ends[1]);
  for (const end of ends) {
    if (along_x) line(end, across - cap, end, across + cap);
    else line(across - cap, end, across + cap, end);
  }
}

// An axis in the colours of the page; `more` overrides its options.
const axis = (title, more = {}) => ({
  title: {display: title !== '', text: title, color: page_color('muted')},
  grid: {color: page_color('line'), borderColor: page_color('line')},
  ...more,
  ticks: {color: page_color('muted'), ...more.ticks},
});

const legend = () => ({
  position: 'bottom',
  labels: {usePointStyle: true, color: page_color('text'), padding: 14, boxHeight: 7},
});

const no_legend = {display: false};

// `plots` maps canvas ids to functions that return a Chart.js configuration. Draws the plots now,
// and again when the colour scheme changes or the page is printed.
function show_plots(plots) {
  let charts = [];
  const draw = () => {
    charts.forEach((chart) => chart.destroy());
    Chart.defaults.animation = false;
    Chart.defaults.maintainAspectRatio = false;
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    charts = Object.entries(plots).map(([id, configuration]) =>
      new Chart(document.getElementById(id), configuration()));
  };
  draw();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
  addEventListener('beforeprint', () => {
    document.documentElement.dataset.paper = '';
    draw();
  });
  addEventListener('afterprint', () => {
    delete document.documentElement.dataset.paper;
    draw();
  });
}
