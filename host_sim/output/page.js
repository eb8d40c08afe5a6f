'use strict';

// Draws every <figure class="panel"> from the JSON inside it.
(() => {
  // Okabe and Ito's colours: apart for every kind of colour vision.
  const lightScheme = {
    series: ['#0072b2', '#d55e00', '#009e73', '#b0578d', '#e69f00', '#56b4e9'],
    axis: '#5a636e',
    grid: '#e3e7eb',
  };
  const darkScheme = {
    series: ['#56b4e9', '#e69f00', '#00b386', '#d98fb8', '#f0e442', '#e8702a'],
    axis: '#9aa5b1',
    grid: '#2b323b',
  };
  const secondRoundDashes = [7, 4];  // once the colours are used up

  const darkDesktop = window.matchMedia('(prefers-color-scheme: dark)');
  const currentScheme = () =>
      darkDesktop.matches && !document.body.classList.contains('printing') ? darkScheme :
                                                                             lightScheme;

  // ---- Numbers and units --------------------------------------------------------------------

  const prefixes = {
    '-15': 'f', '-12': 'p', '-9': 'n', '-6': 'µ', '-3': 'm', '3': 'k', '6': 'M', '9': 'G',
  };
  const takesPrefix = /^(m|s|N|Hz|V|A|W|J|Pa)(?=$|[/·])/;

  const superscript = (integer) =>
      String(integer).replace(/[-0-9]/g, (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
  const withMinus = (text) => text.replace('-', '−');

  const parseLabel = (label) => {
    const parts = /^(.*?)\s*\[([^\]]*)\]\s*$/.exec(label);
    return parts ? {name: parts[1], unit: parts[2]} : {name: label, unit: ''};
  };

  // The power of ten to divide by so that numbers up to `largest` stay short, and the unit that
  // then belongs to them.
  const scaleFor = (largest, unit) => {
    const exponent = largest > 0 ? 3 * Math.floor(Math.floor(Math.log10(largest) + 1e-9) / 3) : 0;
    const prefixed = takesPrefix.test(unit);
    const short = prefixed ? largest >= 0.1 && largest < 1e4 : largest >= 1e-3 && largest < 1e5;
    if (exponent === 0 || short) return {exponent: 0, unit};
    if (prefixed && exponent in prefixes) return {exponent, unit: prefixes[exponent] + unit};
    const power = '10' + superscript(exponent);
    return {exponent, unit: unit === '' || unit === '-' ? power : `${power} ${unit}`};
  };

  const scaled = (value, scale) => value / Number(`1e${scale.exponent}`);

  const axisName = (quantity, scale) =>
      scale.unit === '' ? quantity.name : `${quantity.name} [${scale.unit}]`;

  const largestOf = ([min, max]) => Math.max(Math.abs(min), Math.abs(max));

  // A value in the unit of an axis that shows `range`, to a ten-thousandth of its width.
  const reading = (value, range, unit) => {
    if (value === null) return '–';
    const scale = scaleFor(largestOf(range), unit);
    const span = scaled(range[1] - range[0] || largestOf(range) || 1, scale);
    const decimals = Math.min(Math.max(4 - Math.floor(Math.log10(span)), 0), 12);
    const shownUnit = scale.unit === '-' ? '' : ` ${scale.unit}`;
    return withMinus(scaled(value, scale).toFixed(decimals)) + shownUnit;
  };

  // ---- Ticks --------------------------------------------------------------------------------

  const niceStep = (rough) => {
    const decade = Math.pow(10, Math.floor(Math.log10(rough)));
    return [1, 2, 5, 10].map((m) => m * decade).find((step) => step >= rough * 0.999);
  };

  const linearTicks = (min, max, count, scale) => {
    if (!(max > min)) return [{v: min, label: withMinus(String(scaled(min, scale)))}];
    const step = niceStep((max - min) / count);
    const decimals = Math.max(0, -Math.floor(Math.log10(scaled(step, scale)) + 1e-9));
    const ticks = [];
    for (let i = Math.ceil(min / step - 1e-9); i <= max / step + 1e-9; ++i) {
      const label = scaled(i * step, scale).toFixed(Math.min(decimals, 12));
      ticks.push({v: i * step, label: withMinus(label)});
    }
    return ticks;
  };

  const decadeTicks = (min, max, count) => {
    const first = Math.ceil(Math.log10(min) - 1e-9);
    const last = Math.floor(Math.log10(max) + 1e-9);
    const stride = Math.ceil((last - first + 1) / count);
    const ticks = [];
    for (let exponent = first; exponent <= last; ++exponent) {
      const labelled = exponent % stride === 0;
      ticks.push({
        v: Number(`1e${exponent}`),
        label: labelled ? '10' + superscript(exponent) : undefined,
      });
    }
    return ticks;
  };

  const oneTwoFiveTicks = (min, max, scale) => {
    const ticks = [];
    for (let e = Math.floor(Math.log10(min)); e <= Math.log10(max); ++e) {
      for (const mantissa of [1, 2, 5]) {
        const v = Number(`${mantissa}e${e}`);
        if (v >= min && v <= max) {
          ticks.push({v, label: String(Number(scaled(v, scale).toPrecision(6)))});
        }
      }
    }
    return ticks;
  };

  // Over decades, powers of ten without a prefix.
  const logarithmicTicks = (panel, scaleName, unit, min, max, count) => {
    if (max / min >= 1e3) {
      panel[scaleName] = {exponent: 0, unit};
      return decadeTicks(min, max, 1.5 * count);
    }
    const ticks = oneTwoFiveTicks(min, max, panel[scaleName]);
    return ticks.length >= 2 ? ticks : linearTicks(min, max, Math.max(2, count), panel[scaleName]);
  };

  // Each ticker also settles the scale of its axis, which names the axis after the drawing.
  const xTicker = (panel) => (min, max, pixels) => {
    panel.xScale = scaleFor(largestOf([min, max]), panel.xQuantity.unit);
    if (panel.data.logarithmicX) {
      return logarithmicTicks(panel, 'xScale', panel.xQuantity.unit, min, max, pixels / 90);
    }
    let ticks = linearTicks(min, max, Math.max(2, pixels / 90), panel.xScale);
    const width = 8 * Math.max(...ticks.map((tick) => tick.label.length)) + 24;
    if (width > 90) ticks = linearTicks(min, max, Math.max(2, pixels / width), panel.xScale);
    // Dygraphs drops a tick on the very end of the axis.
    const justInside = max - 1e-6 * (max - min);
    return ticks.map(({v, label}) => ({v: Math.min(v, justInside), label}));
  };

  const yTicker = (panel) => (min, max, pixels) => {
    const unit = panel.yQuantity.unit;
    const count = Math.max(2, pixels / 36);
    panel.yScale = scaleFor(largestOf([min, max]), unit);
    if (!panel.data.logarithmicY) return linearTicks(min, max, count, panel.yScale);
    return logarithmicTicks(panel, 'yScale', unit, min, max, count);
  };

  // ---- Reading values -----------------------------------------------------------------------

  const nearestRow = (x, wanted) => {
    let low = 0;
    let high = x.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (x[middle] <= wanted) low = middle;
      else high = middle;
    }
    return wanted - x[low] <= x[high] - wanted ? low : high;
  };

  // A joined series has a value at every x between its own points: take the nearest of those.
  const valueAt = (series, row) => {
    if (!series.connectGaps || series.y[row] !== null) return series.y[row];
    for (let distance = 1; distance < series.y.length; ++distance) {
      for (const value of [series.y[row - distance], series.y[row + distance]]) {
        if (typeof value === 'number') return value;
      }
    }
    return null;
  };

  const showReading = (panel, row) => {
    const x = panel.data.x[row];
    const range = panel.chart.xAxisRange();
    const xRange = panel.data.logarithmicX ? [0, x] : range;
    panel.abscissa.textContent =
        `${panel.xQuantity.name} ${reading(x, xRange, panel.xQuantity.unit)}`;
    panel.data.series.forEach((series, i) => {
      const y = valueAt(series, row);
      const yRange = panel.data.logarithmicY ? [0, y] : panel.chart.yAxisRange();
      panel.values[i].textContent = reading(y, yRange, panel.yQuantity.unit);
    });
    panel.cursor.hidden = x < range[0] || x > range[1];
    panel.cursor.style.left = `${panel.chart.toDomXCoord(x)}px`;
  };

  const clearReading = (panel) => {
    panel.abscissa.textContent = '';
    panel.values.forEach((value) => { value.textContent = ''; });
    panel.cursor.hidden = true;
  };

  // ---- Panels of one group ------------------------------------------------------------------

  const panels = [];
  const partners = (panel) =>
      panels.filter((p) => p !== panel && panel.data.group !== '' && p.data.group === panel.data.group);

  const hover = (panel, row) => {
    showReading(panel, row);
    const wanted = panel.data.x[row];
    for (const partner of partners(panel)) {
      const x = partner.data.x;
      if (wanted < x[0] || wanted > x[x.length - 1]) {
        leave(partner);
        continue;
      }
      const partnerRow = nearestRow(x, wanted);
      partner.chart.setSelection(partnerRow);
      showReading(partner, partnerRow);
    }
  };

  const leave = (panel) => {
    panel.chart.clearSelection();
    clearReading(panel);
  };

  let following = false;
  const followZoom = (panel) => {
    if (following) return;
    following = true;
    const range = panel.chart.isZoomed('x') ? panel.chart.xAxisRange() : null;
    for (const {chart} of partners(panel)) {
      const now = chart.isZoomed('x') ? chart.xAxisRange() : null;
      if (String(now) !== String(range)) chart.updateOptions({dateWindow: range});
    }
    following = false;
  };

  // ---- Drawing ------------------------------------------------------------------------------

  const child = (parent, tag, className, text = '') => {
    const element = document.createElement(tag);
    element.className = className;
    element.textContent = text;
    parent.append(element);
    return element;
  };

  const seriesColour = (i) => {
    const colours = currentScheme().series;
    return colours[i % colours.length];
  };

  const isSecondRound = (i) => i >= lightScheme.series.length;

  const addLegend = (panel) => {
    const legend = child(panel.figure, 'div', 'legend');
    panel.swatches = [];
    panel.values = [];
    panel.data.series.forEach((series, i) => {
      const entry = child(legend, 'span', 'entry');
      const swatch = child(entry, 'span', 'swatch');
      if (isSecondRound(i)) swatch.style.borderTopStyle = 'dashed';
      panel.swatches.push(swatch);
      child(entry, 'span', 'label', series.label);
      panel.values.push(child(entry, 'span', 'value'));
    });
    panel.abscissa = child(legend, 'span', 'abscissa');
  };

  const colourOptions = (panel) => {
    const scheme = currentScheme();
    return {
      colors: panel.data.series.map((series, i) => seriesColour(i)),
      axisLineColor: scheme.axis,
      gridLineColor: scheme.grid,
    };
  };

  const colourSwatches = (panel) => {
    panel.swatches.forEach((swatch, i) => { swatch.style.borderTopColor = seriesColour(i); });
  };

  // Series are told apart by number, since two may bear one label.
  const seriesName = (i) => `series ${i}`;

  const seriesOptions = (data) => Object.fromEntries(data.series.map((series, i) => [
    seriesName(i),
    {
      stepPlot: series.stepped,
      connectSeparatedPoints: series.connectGaps,
      drawPoints: series.marked,
      ...(series.marked ? {pointSize: 6} : {}),
      strokePattern: isSecondRound(i) ? secondRoundDashes : null,
    },
  ]));

  const chartOptions = (panel) => ({
    labels: ['x', ...panel.data.series.map((series, i) => seriesName(i))],
    series: seriesOptions(panel.data),
    ...colourOptions(panel),
    legend: 'never',
    logscale: panel.data.logarithmicY,
    yRangePad: 12,
    rightGap: 20,
    strokeWidth: 1.5,
    pointSize: 2.5,
    highlightCircleSize: 4,
    axisLineWidth: 1,
    gridLineWidth: 1,
    axisLabelFontSize: 13,
    axes: {
      x: {ticker: xTicker(panel), axisLabelWidth: 40, logscale: panel.data.logarithmicX},
      y: {ticker: yTicker(panel), axisLabelWidth: 64},
    },
    highlightCallback: (event, x, points, row) => hover(panel, row),
    unhighlightCallback: () => [panel, ...partners(panel)].forEach(leave),
    drawCallback: (chart, initial) => {
      panel.xName.textContent = axisName(panel.xQuantity, panel.xScale);
      panel.yName.textContent = axisName(panel.yQuantity, panel.yScale);
      clearReading(panel);
      if (!initial) followZoom(panel);
    },
  });

  const draw = (figure) => {
    const data = JSON.parse(figure.querySelector('script[type="application/json"]').textContent);
    const panel = {
      figure, data, xQuantity: parseLabel(data.xLabel), yQuantity: parseLabel(data.yLabel),
    };
    addLegend(panel);
    colourSwatches(panel);
    panel.yName = child(figure, 'div', 'axis-name y');
    const area = child(figure, 'div', 'chart');
    area.setAttribute('role', 'img');
    area.setAttribute('aria-label', data.title);
    panel.xName = child(figure, 'div', 'axis-name x');
    panel.cursor = child(figure, 'div', 'cursor');
    panel.cursor.hidden = true;
    const rows = data.x.map((x, row) => [x, ...data.series.map((series) => series.y[row])]);
    panel.chart = new Dygraph(area, rows, chartOptions(panel));
    area.append(panel.cursor);
    figure.chart = panel.chart;
    panels.push(panel);
  };

  // ---- What really reached the canvas -------------------------------------------------------

  const channels = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));

  const isPainted = (panel) => {
    const canvas = panel.figure.querySelector('canvas');
    const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    const colours = panel.data.series.map((series, i) => channels(seriesColour(i)));
    const near = (i, colour) => Math.abs(pixels[i] - colour[0]) < 24 &&
        Math.abs(pixels[i + 1] - colour[1]) < 24 && Math.abs(pixels[i + 2] - colour[2]) < 24;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i + 3] >= 64 && colours.some((colour) => near(i, colour))) return true;
    }
    return false;
  };

  // ---- The page -----------------------------------------------------------------------------

  const recolour = () => panels.forEach((panel) => {
    colourSwatches(panel);
    panel.chart.updateOptions(colourOptions(panel));
  });

  const setPrinting = (printing) => {
    document.body.classList.toggle('printing', printing);
    recolour();
    panels.forEach((panel) => panel.chart.resize());
  };

  const figures = [...document.querySelectorAll('figure.panel')].filter(
      (figure) => figure.querySelector('script[type="application/json"]'));
  figures.forEach(draw);
  darkDesktop.addEventListener('change', recolour);
  window.addEventListener('beforeprint', () => setPrinting(true));
  window.addEventListener('afterprint', () => setPrinting(false));
  document.body.dataset.panels = String(figures.length);
  document.body.dataset.drawn = String(panels.filter(isPainted).length);
})();
