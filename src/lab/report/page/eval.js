// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

const methods = data.methods;
const titles = methods.map((method) => method.title);
const looks = () => methods.map((_, series) => look(series));

// One point per method, each on a separate line and with a whisker.
function dots(name, values, intervals, scale, number) {
  const series = looks();
  return {
    type: 'line',
    data: {
      labels: titles,
      datasets: [{
        label: name,
        data: values,
        intervals,
        showLine: false,
        borderColor: series.map((each) => each.borderColor),
        pointBorderColor: series.map((each) => each.borderColor),
        pointBackgroundColor: series.map((each) => each.borderColor),
        pointStyle: series.map((each) => each.pointStyle),
        pointBorderWidth: 2,
        pointRadius: 5,
        pointHoverRadius: 7,
        clip: false,
      }],
    },
    options: {
      indexAxis: 'y',
      plugins: {
        legend: no_legend,
        tooltip: {callbacks: {label: (item) => number(values[item.dataIndex], intervals[item.dataIndex])}},
      },
      scales: {
        x: scale,
        y: axis('', {offset: true, ticks: {color: page_color('text'), autoSkip: false}}),
      },
    },
    plugins: [whiskers],
  };
}

function f1_plot() {
  const values = methods.map((method) => percent(method.f1));
  const intervals = methods.map((method) => method.f1 === null || method.ci95 === null
    ? null : [100 * (method.f1 - method.ci95), 100 * (method.f1 + method.ci95)]);
  const ends = values.concat(...intervals.filter((interval) => interval !== null));
  return dots('F1', values, intervals, axis('', percent_bounds(ends)), (value, interval) =>
    `F1 ${value.toFixed(2)} %` + (interval ? ` ± ${(interval[1] - value).toFixed(2)}` : ''));
}

function speed_plot() {
  const values = methods.map((method) => method.hz);
  const intervals = methods.map((method) => method.hz === null || method.hz_slowest === null
    ? null : [method.hz_slowest, method.hz]);
  const rates = values.concat(...intervals.filter((interval) => interval !== null))
    .filter((rate) => rate !== null && rate > 0);
  const decades = rates.map(Math.log10);
  const bounds = rates.length === 0 ? {min: 1, max: 1000}
    : {min: 10 ** Math.floor(Math.min(...decades)), max: 10 ** Math.ceil(Math.max(...decades) + 0.01)};
  const is_decade = (rate) => Number.isInteger(Math.log10(rate));
  const scale = axis('', {
    type: 'logarithmic',
    ...bounds,
    grid: {color: ({tick}) => (is_decade(tick.value) ? page_color('line') : 'transparent')},
    ticks: {
      maxRotation: 0,
      autoSkip: false,
      callback: (rate) => (is_decade(rate) ? `${rate} Hz` : ''),
    },
  });
  return dots('Speed', values, intervals, scale, (value, interval) =>
    `${value.toFixed(1)} Hz` + (interval ? `, slowest 1 % ${interval[0].toFixed(1)} Hz` : ''));
}

// Curves of constant F1 behind the points: recall r, precision f r / (2 r - f).
const f1_contours = {
  id: 'f1_contours',
  beforeDatasetsDraw(chart) {
    const {ctx: context, chartArea: area, scales: {x, y}} = chart;
    const widest = Math.max(x.max - x.min, y.max - y.min);
    const step = widest <= 30 ? 2 : widest <= 60 ? 5 : 10;
    context.save();
    context.beginPath();
    context.rect(area.left, area.top, area.width, area.height);
    context.clip();
    context.strokeStyle = page_color('muted');
    context.fillStyle = page_color('muted');
    context.globalAlpha = 0.6;
    context.textAlign = 'right';
    context.textBaseline = 'top';
    for (let f1 = step; f1 < 100; f1 += step) draw_contour(context, f1, x, y);
    context.restore();
  },
};

function draw_contour(context, f1, x, y) {
  context.beginPath();
  for (let step = 0; step <= 100; ++step) {
    const recall = x.min + (x.max - x.min) * step / 100;
    if (2 * recall <= f1) continue;
    const precision = f1 * recall / (2 * recall - f1);
    context.lineTo(x.getPixelForValue(recall), y.getPixelForValue(precision));
  }
  context.stroke();
  const at_right = f1 * x.max / (2 * x.max - f1);
  if (at_right > y.min && at_right < y.max)
    context.fillText(`F1 ${f1}`, x.right - 4, y.getPixelForValue(at_right) + 3);
}

function precision_recall_plot() {
  const series = looks();
  return {
    type: 'scatter',
    data: {
      datasets: methods.map((method, i) => ({
        ...series[i],
        label: method.title,
        pointRadius: 7,
        clip: false,
        data: method.recall === null || method.precision === null
          ? [] : [{x: percent(method.recall), y: percent(method.precision)}],
      })),
    },
    options: {
      plugins: {
        legend: legend(),
        tooltip: {callbacks: {label: ({dataset, raw}) =>
          `${dataset.label}: precision ${raw.y.toFixed(2)} %, recall ${raw.x.toFixed(2)} %`}},
      },
      scales: {
        x: axis('Recall, %', percent_bounds(methods.map((method) => percent(method.recall)))),
        y: axis('Precision, %', percent_bounds(methods.map((method) => percent(method.precision)))),
      },
    },
    plugins: [f1_contours],
  };
}

function range_plot() {
  const series = looks();
  const values = methods.flatMap((method) => method.by_range.map(percent));
  return {
    type: 'line',
    data: {
      labels: data.bands,
      datasets: methods.map((method, i) => ({
        ...series[i],
        label: method.title,
        clip: false,
        data: method.by_range.map(percent),
      })),
    },
    options: {
      plugins: {
        legend: legend(),
        tooltip: {callbacks: {label: ({dataset, raw}) => `${dataset.label}: ${raw.toFixed(2)} %`}},
      },
      scales: {x: axis('Distance', {offset: true}), y: axis('F1, %', percent_bounds(values))},
    },
  };
}

function sorted_scans(method) {
  const scans = method.scans.map((f1, i) => ({y: percent(f1), name: data.scans[i]}))
    .filter((scan) => scan.y !== null)
    .sort((a, b) => a.y - b.y);
  scans.forEach((scan, rank) => {
    scan.x = 100 * (rank + 0.5) / scans.length;
  });
  return scans;
}

function scans_plot() {
  const series = looks();
  const few = data.scans.length <= 100;
  return {
    type: 'line',
    data: {
      datasets: methods.map((method, i) => ({
        ...series[i],
        label: method.title,
        data: sorted_scans(method),
        parsing: false,
        borderWidth: 1.5,
        pointRadius: few ? 4 : 0,
        pointHitRadius: 6,
        clip: false,
      })),
    },
    options: {
      interaction: {mode: 'nearest'},
      plugins: {
        decimation: {enabled: true, algorithm: 'min-max'},
        legend: legend(),
        tooltip: {callbacks: {
          title: () => '',
          label: ({dataset, raw}) => `${dataset.label}: ${raw.y.toFixed(2)} %, ${raw.name}`,
        }},
      },
      scales: {
        x: axis('Fraction of the scans, %', {type: 'linear', min: 0, max: 100}),
        y: axis('F1, %'),
      },
    },
  };
}

show_plots({
  'f1': f1_plot,
  'speed': speed_plot,
  'precision-recall': precision_recall_plot,
  'range': range_plot,
  'scans': scans_plot,
});
