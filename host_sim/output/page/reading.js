'use strict';

// What a chart shows at a place: the legend, the values in it, and the line through them.
class Reading {
  constructor(chart) {
    this.chart = chart;
    this.legend = document.createElement('div');
    this.legend.className = 'legend';
    this.values = chart.series.map((series) => this.entry(Reading.swatch(series), series.label, series.verbatim));
    chart.data.tiles.forEach((tiles, i) => this.tileEntry(tiles, i));
    this.place = this.add(this.legend, 'span', 'abscissa');
    this.legend.setAttribute('aria-live', 'polite');  // names and values together
    this.legend.setAttribute('aria-atomic', 'true');
  }

  add(parent, tag, className, html = '') {
    const element = document.createElement(tag);
    element.className = className;
    element.innerHTML = html;
    parent.append(element);
    return element;
  }

  entry(swatch, label, verbatim) {
    const entry = this.add(this.legend, 'span', 'entry', swatch);
    this.add(entry, 'span', 'label', Look.html(label, verbatim));
    entry.hidden = label === '';
    return this.add(entry, 'span', 'value');
  }

  static swatch({line, style}) {
    const filled = {bar: 1, area: 0.3, band: 0.22}[line];
    const dash = style.dash === '' ? '' : ` stroke-dasharray="${style.dash}"`;
    const drawn = filled ? `<rect y="1" width="28" height="10" fill="${style.colour}" opacity="${filled}"/>` :
        (line === 'dots' ? '' : `<path d="M0 6H28" stroke="${style.colour}" stroke-width="2.4"${dash}/>`) +
        (style.symbol > 0 ? `<path d="${Look.marker(style.symbol, 14, 6, 3.5)}" stroke="${style.colour}" ` +
            `fill="${Look.isFilled(style.symbol) ? style.colour : 'var(--paper)'}"/>` : '');
    return `<svg class="swatch" width="28" height="12" aria-hidden="true">${drawn}</svg>`;
  }

  tileEntry(tiles, i) {
    const {chart} = this;
    const {colour, label, behind, all} = tiles;
    if (all.length === 0) return;
    const range = chart.valueRange();
    if (colour === '' && range !== null) {
      const [low, high] = range.map((end) => Numbers.reading(end, range, '-'));
      const bar = Array.from({length: 28}, (_, k) =>
          `<rect x="${3 * k}" width="3.5" height="12" fill="${Look.heat(k / 27)}"/>`).join('');
      this.add(this.legend, 'span', 'entry',
               `${low} <svg width="84" height="12" aria-hidden="true">${bar}</svg> ${high}`);
    } else if (label !== '') {
      this.entry(`<svg class="swatch" width="28" height="12" aria-hidden="true"><rect width="28" height="12" ` +
                 `class="${behind ? 'ground' : 'tile'}" fill="${chart.fill(tiles, i)}"/></svg>`, label);
    }
  }

  text(axis, value) {
    const own = this.chart.axes[axis];
    const name = own.ticks.find(({at}) => at === value);
    if (name) return name.text;
    const range = own.logarithmic ? [0, value] : this.chart[`${axis}AxisRange`]();
    return Numbers.reading(value, range, own.quantity.unit);
  }

  nearestInOrder({x}, wanted) {
    const i = Chart.firstAtLeast(x, wanted);
    if (i === 0) return 0;
    return i === x.length || wanted - x[i - 1] <= x[i] - wanted ? i - 1 : i;
  }

  // Of curves whose abscissae go back and forth the point that is nearest on the sheet.
  nearestOnSheet(pixel) {
    const {chart} = this;
    let best = {distance: Infinity};
    chart.series.forEach((series, s) => {
      if (series.sorted && series.x.length > 1) return;
      for (let i = 0; i < series.y.length; ++i) {
        if (!chart.canShow('y', series.y[i]) || !chart.canShow('x', series.x[i])) continue;
        const distance = Math.hypot(chart.px(series.x[i]) - pixel.x, chart.py(series.y[i]) - pixel.y);
        if (distance < best.distance) best = {distance, s, i};
      }
    });
    return best;
  }

  // @param x      value on the axis
  // @param pixel  of the pointer; absent where another chart of the group was pointed at
  show(x, pixel) {
    const {chart} = this;
    this.clear();
    const read = [];
    chart.series.forEach((series, s) => {
      if (series.sorted && series.x.length > 1 && series.line !== 'full_height') read.push({s, i: this.nearestInOrder(series, x)});
    });
    const near = pixel ? this.nearestOnSheet(pixel) : {distance: Infinity};
    if (near.distance < Infinity && (read.length === 0 || near.distance < 25)) read.push(near);
    for (const {s, i} of read) this.values[s].textContent = this.text('y', chart.series[s].y[i]);
    const tile = pixel && this.tileAt(chart.value('x', chart.xAt(pixel.x)), chart.value('y', chart.yAt(pixel.y)));
    if (tile) {
      this.showTile(tile);
    } else if (read.length > 0) {
      const {s, i} = near.distance < 25 || read[0].s === near.s ? near : read[0];
      this.x = chart.series[s].x[i];
      this.name(`${chart.axes.x.quantity.name} ${this.text('x', this.x)}`);
      this.draw(read);
    }
  }

  showTile(tile) {
    const {chart} = this;
    const [x0, x1, y0, y1, number, word] = tile;
    const middle = (axis, a, b) => this.text(axis, chart.value(axis, (chart.measure(axis, a) + chart.measure(axis, b)) / 2));
    const value = word || Numbers.reading(number, chart.valueRange() || [0, 1], '-');
    this.name(`${chart.axes.x.quantity.name} ${middle('x', x0, x1)}, ${chart.axes.y.quantity.name} ${middle('y', y0, y1)}: ${value}`);
    this.cursor.innerHTML = ['frame edge', 'frame'].map((name) => `<path class="${name}" d="${chart.tilePath(tile)}"/>`).join('');
  }

  // Reads the tile beside the one that was read last, for the keyboard; begins in the middle.
  // @param across, upward  -1, 0 or 1
  stepTile(across, upward) {
    const {chart} = this;
    const now = this.at && this.tileAt(this.at.x, this.at.y);
    const inside = (axis, value) => {
      const [first, last] = chart[`${axis}AxisRange`]();
      return value >= Math.min(first, last) && value <= Math.max(first, last);
    };
    const middle = (axis, low, high) => chart.value(axis, (chart.measure(axis, low) + chart.measure(axis, high)) / 2);
    if (!now || !inside('x', this.at.x) || !inside('y', this.at.y)) {
      this.at = {x: middle('x', ...chart.xAxisRange()), y: middle('y', ...chart.yAxisRange())};
    } else {
      const beside = {...this.at};
      const move = (axis, direction, low, high) => {
        if (direction === 0) return;
        const step = direction * 1e-6 * (chart[axis][1] - chart[axis][0]);
        beside[axis] = chart.value(axis, chart.measure(axis, step > 0 ? high : low) + step);
      };
      move('x', across, now[0], now[1]);
      move('y', upward, now[2], now[3]);
      const next = this.tileAt(beside.x, beside.y);
      if (!next || !inside('x', beside.x) || !inside('y', beside.y)) return;
      this.at = {x: across ? middle('x', next[0], next[1]) : beside.x, y: upward ? middle('y', next[2], next[3]) : beside.y};
    }
    const tile = this.tileAt(this.at.x, this.at.y);
    if (tile) this.showTile(tile);
  }

  get cursor() { return this.chart.figure.querySelector('.plot .cursor'); }

  name(text) { this.place.innerHTML = Look.html(text, this.chart.axes.x.verbatim); }

  tileAt(x, y) {
    for (const {all, colour, label, behind} of this.chart.data.tiles) {
      if (behind) continue;
      const tile = all.find(([x0, x1, y0, y1]) => x >= x0 && x < x1 && y >= y0 && y < y1);
      if (tile) return colour === '' ? tile : [...tile, label || '–'];
    }
    return null;
  }

  draw(read) {
    const {chart} = this;
    const at = chart.px(this.x);
    const {left, top, width, height} = chart.area;
    if (at < left - 1 || at > left + width + 1) return;
    const dots = read.map(({s, i}) => {
      const {x, y, style} = chart.series[s];
      return chart.canShow('y', y[i]) && Math.abs(chart.px(x[i]) - at) < 12 ?
          `<circle cx="${chart.px(x[i])}" cy="${chart.py(y[i])}" r="4" fill="${style.colour}"/>` : '';
    }).join('');
    this.cursor.innerHTML = `<path d="M${at} ${top}v${height}"/>${dots}`;
  }

  clear() {
    this.place.textContent = '';
    this.values.forEach((value) => { value.textContent = ''; });
    if (this.cursor) this.cursor.innerHTML = '';
  }

  // The next point to the right or left of the one that is read, for the keyboard.
  step(direction) {
    const {chart} = this;
    const points = chart.series.filter(({line}) => line !== 'full_height')
        .flatMap(({x, y}) => x.filter((value, i) => y[i] !== null));
    const [low, high] = chart.xAxisRange();
    const inside = [...new Set(points)].filter((x) => x >= low && x <= high).sort((a, b) => a - b);
    if (inside.length === 0) return null;
    if (this.x === undefined || this.x < low || this.x > high) return inside[direction > 0 ? 0 : inside.length - 1];
    const stride = Math.max(1, Math.round(inside.length / 100));
    const now = Chart.firstAtLeast(inside, this.x);
    return inside[Math.min(Math.max(now + direction * stride, 0), inside.length - 1)];
  }
}
