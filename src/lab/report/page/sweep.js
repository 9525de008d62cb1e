// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Lines over the first key. Lines for different values of the second key are shifted slightly, so
// that their whiskers do not overlap.
function sweep_plot(metric) {
  const [labels, seconds] = data.values;
  const middle = (data.series.length - 1) / 2;
  const apart = Math.min(0.08, 0.6 / data.series.length);
  const datasets = data.series.map((series, i) => ({
    ...look(i),
    label: seconds ? `${data.keys[1]} = ${seconds[i]}` : data.keys[0],
    clip: false,
    data: series[metric].map((cell, column) => ({x: column + apart * (i - middle), y: percent(cell.mean)})),
    intervals: series[metric].map((cell) => cell.mean === null || cell.std === null
      ? null : [100 * (cell.mean - cell.std), 100 * (cell.mean + cell.std)]),
  }));
  const ends = datasets.flatMap((dataset) => dataset.data.map((point) => point.y)
    .concat(...dataset.intervals.filter((interval) => interval !== null)));
  return {
    type: 'line',
    data: {datasets},
    options: {
      interaction: {mode: 'nearest'},
      plugins: {
        legend: seconds ? legend() : no_legend,
        tooltip: {callbacks: {
          title: ([item]) => `${data.keys[0]} = ${labels[item.dataIndex]}`,
          label: ({dataset, raw}) => `${dataset.label}: ${raw.y.toFixed(2)} %`,
        }},
      },
      scales: {
        x: axis(data.keys[0], {
          type: 'linear',
          min: -0.5,
          max: labels.length - 0.5,
          afterBuildTicks: (scale) => {
            scale.ticks = labels.map((_, value) => ({value}));
          },
          ticks: {callback: (value) => labels[value], autoSkip: true},
        }),
        y: axis('', percent_bounds(ends)),
      },
    },
    plugins: [whiskers],
  };
}

if (data.series) {
  show_plots(Object.fromEntries(['f1', 'precision', 'recall'].map((metric) =>
    [metric, () => sweep_plot(metric)])));
}
