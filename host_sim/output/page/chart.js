'use strict';

// One chart: its data, what of it is on show, and its drawing as SVG.
class Chart {
  static letter = 8.3;      // width of one in a wide font, px
  static rightMargin = 14;  // px

  // @param data  as chart_json() writes it
  constructor(figure, data) {
    this.figure = figure;
    this.data = data;
    this.axes = {x: Chart.axisOf(data.x), y: Chart.axisOf(data.y)};
    this.styles = Look.styles(data.series);
    this.series = data.series.map((series, i) => this.prepared(series, this.styles[i]));
    this.whole = {x: this.wholeX(), y: null};
    this.shown = {x: this.whole.x, y: null};  // y: null follows what x shows
    this.id = `chart-${++Chart.count}`;
  }

  static axisOf(axis) {
    return {...axis, quantity: Numbers.parseLabel(axis.label)};
  }

  prepared(series, style) {
    const x = series.x || this.data.abscissae;
    let sorted = true;
    for (let i = 1; i < x.length && sorted; ++i) sorted = x[i] >= x[i - 1];
    return {...series, x, sorted, style, held: series.line === 'stepped' || series.line === 'band'};
  }

  // Where a level that is held from a point on ends; the last lasts as long as the one before it.
  static endOfLevel({x}, i) {
    return i + 1 < x.length ? x[i + 1] : i > 0 ? 2 * x[i] - x[i - 1] : x[i];
  }

  // ---- Ranges, in the axis' own measure: the logarithm on a logarithmic axis -----------------

  measure(axis, value) { return this.axes[axis].logarithmic ? Math.log10(value) : value; }
  value(axis, measure) { return this.axes[axis].logarithmic ? Math.pow(10, measure) : measure; }
  canShow(axis, value) {
    return value !== null && Number.isFinite(value) && (!this.axes[axis].logarithmic || value > 0);
  }

  // The range of values with the ends that the axis has of its own, about `pad` of it wider.
  rangeOf(axis, values, pad) {
    let low = Infinity;
    let high = -Infinity;
    for (const value of values) {
      if (!this.canShow(axis, value)) continue;
      const measure = this.measure(axis, value);
      if (measure < low) low = measure;
      if (measure > high) high = measure;
    }
    if (!(low <= high)) [low, high] = [0, 1];
    let margin = pad * (high - low);
    if (high - low <= 1e-12 * Math.max(Math.abs(low), Math.abs(high))) {
      margin = this.axes[axis].logarithmic ? 0.5 : 0.5 * Math.abs(low) || 0.5;
    }
    const own = this.axes[axis];
    const [first, last] = own.ends;
    return [this.canShow(axis, first) ? this.measure(axis, first) : low - margin,
            this.canShow(axis, last) ? this.measure(axis, last) : high + margin];
  }

  // @param first  0 of x, 2 of y
  *tileEnds(first) {
    for (const {all, behind} of this.data.tiles) {
      if (!behind) for (const tile of all) yield* [tile[first], tile[first + 1]];
    }
  }

  get hasTiles() { return this.data.tiles.some(({all, behind}) => !behind && all.length > 0); }

  *abscissae() {
    for (const series of this.series) {
      for (let i = 0; i < series.y.length; ++i) {
        if (series.y[i] === null) continue;
        yield series.x[i];
        if (series.held) yield Chart.endOfLevel(series, i);
        if (series.line === 'bar') yield* [series.x[i] - 0.5, series.x[i] + 0.5];
      }
    }
    yield* this.tileEnds(0);
    for (const mark of this.data.marks) yield mark.x;
  }

  *ordinates() {
    const [low, high] = this.shown.x;
    for (const series of this.series) {
      if (series.line === 'full_height') continue;
      if (series.line === 'bar') yield 0;
      for (let i = 0; i < series.y.length; ++i) {
        const y = series.y[i];
        const x = this.measure('x', series.x[i]);
        if (y === null || x < low || x > high) continue;
        yield y;
        if (series.halfWidth) yield* [y - series.halfWidth[i], y + series.halfWidth[i]];
      }
    }
    if (this.axes.y.hasZero) yield 0;
    yield* this.tileEnds(2);
    for (const mark of this.data.marks) yield mark.y;
  }

  wholeX() {
    const apart = this.series.some(({style, sorted}) => style.symbol > 0 || !sorted);
    return this.rangeOf('x', this.abscissae(), apart && !this.hasTiles ? 0.03 : 0);
  }

  yRange() {
    return this.shown.y || this.rangeOf('y', this.ordinates(), this.hasTiles ? 0 : 0.06);
  }

  isZoomed() { return this.shown.x !== this.whole.x || this.shown.y !== null; }
  xAxisRange() { return this.shown.x.map((end) => this.value('x', end)); }
  yAxisRange() { return this.yRange().map((end) => this.value('y', end)); }

  // ---- Layout --------------------------------------------------------------------------------

  px(x) { return this.area.left + this.area.width * (this.measure('x', x) - this.x[0]) / (this.x[1] - this.x[0]); }
  py(y) { return this.area.top + this.area.height * (this.y[1] - this.measure('y', y)) / (this.y[1] - this.y[0]); }
  xAt(pixel) { return this.x[0] + (pixel - this.area.left) / this.area.width * (this.x[1] - this.x[0]); }
  yAt(pixel) { return this.y[1] - (pixel - this.area.top) / this.area.height * (this.y[1] - this.y[0]); }

  // Names at places stand in for numbers.
  ticks(axis, range, count) {
    const own = this.axes[axis];
    if (own.ticks.length === 0) return Numbers.ticksOf(own, range, count);
    const inside = own.ticks.filter(({at}) => at >= range[0] && at <= range[1]);
    return {scale: {exponent: 0, unit: own.quantity.unit}, ticks: inside};
  }

  layOut(width, height) {
    const values = (axis) => this[axis].map((end) => this.value(axis, end));
    this.x = this.shown.x;
    this.y = this.yRange();
    if (this.data.equalScales) this.makeScalesEqual((width - 70) / (height - 34));
    this.yTicks = this.ticks('y', values('y'), height / 40);
    const longest = (ticks) => Math.max(0, ...ticks.map(({text}) => text.length));
    const left = Math.min(Math.max(34, Chart.letter * longest(this.yTicks.ticks) + 8), 0.4 * width);
    this.area = {left, top: 8, width: Math.max(40, width - left - Chart.rightMargin), height: height - 34};
    this.xTicks = this.ticks('x', values('x'), this.area.width / 80);
    const wanted = Chart.letter * longest(this.xTicks.ticks) + 14;
    if (this.axes.x.ticks.length === 0 && wanted > 80) {
      this.xTicks = this.ticks('x', values('x'), this.area.width / wanted);
    }
    // Names that do not fit side by side stand aslant.
    this.aslant = this.axes.x.ticks.length > 0 && wanted * this.xTicks.ticks.length > this.area.width;
    if (this.aslant) this.area.height = height - 18 - Math.min(90, 0.7 * wanted);
  }

  // Widens the axis that has less on its length. @param shape  width over height
  makeScalesEqual(shape) {
    const [across, upward] = [this.x, this.y].map(([low, high]) => high - low);
    const widened = ([low, high], size) => [(low + high - size) / 2, (low + high + size) / 2];
    if (across > shape * upward) this.y = widened(this.y, across / shape);
    else this.x = widened(this.x, shape * upward);
  }

  // ---- Drawing -------------------------------------------------------------------------------

  draw(width, height) {
    this.layOut(width, height);
    const {left, top, width: w, height: h} = this.area;
    return `<svg class="plot" viewBox="0 0 ${width} ${height}" aria-hidden="true">` +
        `<defs><clipPath id="${this.id}"><rect x="${left}" y="${top}" width="${w}" height="${h}"/></clipPath>` +
        `${this.data.tiles.map((tiles, i) => this.pattern(tiles, i)).join('')}</defs>` +
        `<g class="grid">${this.grid()}</g>` +
        `<g class="data" clip-path="url(#${this.id})">${this.tiles()}` +
        `${this.series.map((series, i) => this.curve(series, i)).join('')}${this.marks()}</g>` +
        `<g class="axis">${this.axisTexts()}<path d="M${left} ${top}V${top + h}H${left + w}"/></g>` +
        '<g class="cursor"></g><rect class="zoom-box" width="0" height="0"/></svg>';
  }

  grid() {
    const {left, top, width, height} = this.area;
    return this.xTicks.ticks.map(({at}) => `<path d="M${this.px(at).toFixed(1)} ${top}v${height}"/>`).join('') +
        this.yTicks.ticks.map(({at}) => `<path d="M${left} ${this.py(at).toFixed(1)}h${width}"/>`).join('');
  }

  axisTexts() {
    const {left, top, width, height} = this.area;
    const bottom = top + height;
    // The last number stays whole at the edge of the chart.
    const middle = (at, text) =>
      Math.min(this.px(at), left + width + Chart.rightMargin - Chart.letter * text.length / 2);
    const aslant = (x) => this.aslant ? ` transform="rotate(-35 ${x} ${bottom + 16})"` : '';
    return this.xTicks.ticks.filter(({text}) => text !== '').map(({at, text}) => {
      const x = (this.aslant ? this.px(at) : middle(at, text)).toFixed(1);
      return `<text x="${x}" y="${bottom + 18}" text-anchor="${this.aslant ? 'end' : 'middle'}"${aslant(x)}>` +
          `${Look.svg(text, this.axes.x.verbatim)}</text>`;
    }).join('') + this.yTicks.ticks.filter(({text}) => text !== '').map(({at, text}) =>
      `<text x="${left - 7}" y="${(this.py(at) + 4).toFixed(1)}" text-anchor="end">` +
      `${Look.svg(text, this.axes.y.verbatim)}</text>`).join('');
  }

  valueRange() {
    let low = Infinity;
    let high = -Infinity;
    for (const {all, colour, behind} of this.data.tiles) {
      if (colour !== '' || behind) continue;
      for (const [, , , , value] of all) {
        if (value === null) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    return low <= high ? [low, high] : null;
  }

  // Tiles of one colour have lines across them, in another direction each: colour is not all.
  isHatched({colour, behind}, i) { return colour !== '' && !behind && i > 0; }

  fill(tiles, i) { return this.isHatched(tiles, i) ? `url(#${this.id}-${i})` : Chart.shade(tiles.colour); }

  // Black in print is the colour of letters on a page.
  static shade(colour) { return colour === '#000000' ? 'var(--ink)' : colour; }

  pattern(tiles, i) {
    return !this.isHatched(tiles, i) ? '' :
        `<pattern id="${this.id}-${i}" width="7" height="7" patternUnits="userSpaceOnUse" ` +
        `patternTransform="rotate(${(35 * i) % 180})"><rect width="7" height="7" fill="${Chart.shade(tiles.colour)}"/>` +
        '<path d="M0 0V7" class="hatch"/></pattern>';
  }

  // An end left open is that of the chart.
  tilePath([x0, x1, y0, y1]) {
    const {left, top, width, height} = this.area;
    const at = (place, end) => (Number.isFinite(place) && !Number.isNaN(place) ? place : end).toFixed(1);
    const x = (value, end) => at(this.canShow('x', value) ? this.px(value) : NaN, end);
    const y = (value, end) => at(this.canShow('y', value) ? this.py(value) : NaN, end);
    return `M${x(x0, left)} ${y(y1, top)}H${x(x1, left + width)}V${y(y0, top + height)}H${x(x0, left)}z`;
  }

  tiles() {
    const range = this.valueRange();
    const levels = 96;
    return this.data.tiles.map((tiles, i) => {
      const paths = new Map();
      for (const tile of tiles.all) {
        const part = range === null || range[1] === range[0] ? 0.5 : (tile[4] - range[0]) / (range[1] - range[0]);
        const fill = tiles.colour === '' ? Look.heat(Math.round(part * levels) / levels) : this.fill(tiles, i);
        paths.set(fill, (paths.get(fill) || '') + this.tilePath(tile));
      }
      return [...paths].map(([fill, d]) =>
        `<path class="${tiles.behind ? 'ground' : 'tile'}" fill="${fill}" d="${d}"/>`).join('');
    }).join('');
  }

  // The points on show and one beyond either end, a gap at i as ~i, which is below 0; of more than the
  // chart has columns the smallest and the largest of each column.
  *points(series) {
    const {x, y, sorted} = series;
    let [from, to] = [0, y.length];
    if (sorted) {
      const [low, high] = this.shown.x.map((end) => this.value('x', end));
      from = Math.max(0, Chart.firstAtLeast(x, low) - 1);
      to = Math.min(y.length, Chart.firstAtLeast(x, high) + 2);
    }
    const point = (i) => this.canShow('y', y[i]) && this.canShow('x', x[i]) ? i : ~i;
    const column = (to - from) / (3 * this.area.width);
    if (!sorted || column < 2) {
      for (let i = from; i < to; ++i) yield point(i);
      return;
    }
    for (let begin = from; begin < to; begin += column) {
      let [least, most] = [-1, -1];
      const end = Math.min(begin + column, to);
      for (let i = Math.floor(begin); i < end; ++i) {
        if (point(i) < 0) continue;
        if (least < 0 || y[i] < y[least]) least = i;
        if (most < 0 || y[i] > y[most]) most = i;
      }
      yield* least === most ? [least] : [Math.min(least, most), Math.max(least, most)];
    }
  }

  static firstAtLeast(x, wanted) {
    let low = 0;
    let high = x.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (x[middle] < wanted) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  // A point alone shows as a dot, by its round ends.
  linePath(series) {
    let d = '';
    let last = -1;
    for (const i of this.points(series)) {
      if (i < 0) {
        if (series.line === 'bridged') continue;
        if (series.held && last >= 0) d += `H${this.px(series.x[~i]).toFixed(1)}`;
        last = -1;
        continue;
      }
      const x = this.px(series.x[i]).toFixed(1);
      const y = this.py(series.y[i]).toFixed(1);
      if (last < 0) d += `M${x} ${y}h.01`;
      else if (series.held) d += `H${x}V${y}`;
      else d += `L${x} ${y}`;
      last = i;
    }
    return series.held && last >= 0 ? `${d}H${this.px(Chart.endOfLevel(series, last)).toFixed(1)}` : d;
  }

  bandPath(series) {
    let d = '';
    let last = -1;
    const hold = (end) => {
      if (last < 0) return;
      const [left, right] = [series.x[last], end].map((x) => this.px(x).toFixed(1));
      const [y, half] = [series.y[last], series.halfWidth[last]];
      d += `M${left} ${this.py(y + half).toFixed(1)}H${right}V${this.py(y - half).toFixed(1)}H${left}z`;
    };
    for (const i of this.points(series)) {
      hold(series.x[i < 0 ? ~i : i]);
      last = i;
    }
    hold(Chart.endOfLevel(series, last));
    return d;
  }

  errorBars(series) {
    let d = '';
    for (const i of this.points(series)) {
      if (i < 0 || !(series.halfWidth[i] > 0)) continue;
      const x = this.px(series.x[i]);
      const low = series.y[i] - series.halfWidth[i];
      const bottom = this.canShow('y', low) ? this.py(low) : this.area.top + this.area.height;
      const top = this.py(series.y[i] + series.halfWidth[i]);
      d += `M${(x - 4).toFixed(1)} ${top.toFixed(1)}h8m-4 0V${bottom.toFixed(1)}m-4 0h8`;
    }
    return d;
  }

  markers(series) {
    const {symbol, every} = series.style;
    const r = Look.radius(series.style);
    let d = '';
    let count = 0;
    for (const i of this.points(series)) {
      if (i < 0 || count++ % every !== 0) continue;
      d += Look.marker(symbol, this.px(series.x[i]), this.py(series.y[i]), r);
    }
    return d;
  }

  bars(series, index) {
    const all = this.series.filter(({line}) => line === 'bar');
    const width = 0.8 / all.length;
    const left = -0.4 + width * all.indexOf(series);
    const zero = this.py(0);
    return series.y.map((y, i) => y === null ? '' :
        `M${this.px(series.x[i] + left).toFixed(1)} ${zero.toFixed(1)}H${this.px(series.x[i] + left + 0.92 * width).toFixed(1)}` +
        `V${this.py(y).toFixed(1)}H${this.px(series.x[i] + left).toFixed(1)}z`).join('');
  }

  curve(series, index) {
    const {style, line} = series;
    const stroke = `stroke="${style.colour}" stroke-width="${style.width}"`;
    const dashed = style.dash === '' ? '' : ` stroke-dasharray="${style.dash}"`;
    if (line === 'bar') return `<path class="bar" fill="${style.colour}" d="${this.bars(series, index)}"/>`;
    if (line === 'band') return `<path class="band" fill="${style.colour}" d="${this.bandPath(series)}"/>`;
    if (line === 'area') return `<path class="area" fill="${style.colour}" d="${this.linePath(series)}z"/>`;
    if (line === 'full_height') {
      const {top, height} = this.area;
      const d = series.x.map((x) => `M${this.px(x).toFixed(1)} ${top}v${height}`).join('');
      return `<path class="line" ${stroke}${dashed} d="${d}"/>`;
    }
    let text = line === 'dots' ? '' : `<path class="line" ${stroke}${dashed} d="${this.linePath(series)}"/>`;
    if (series.halfWidth) text += `<path class="line" stroke="${style.colour}" stroke-width="1.2" d="${this.errorBars(series)}"/>`;
    if (style.symbol > 0) {
      const fill = Look.isFilled(style.symbol) ? style.colour : 'var(--paper)';
      text += `<path class="marker" fill="${fill}" stroke="${style.colour}" d="${this.markers(series)}"/>`;
    }
    return text;
  }

  marks() {
    return this.data.marks.map(({text, x, y}) => {
      const [at, up] = [this.px(x).toFixed(1), this.py(y).toFixed(1)];
      return `<circle class="mark-point" cx="${at}" cy="${up}" r="2"/>` +
          `<text class="mark" x="${at}" y="${up}" transform="rotate(-90 ${at} ${up})" dx="6" dy="4">${Look.svg(text)}</text>`;
    }).join('');
  }
}
Chart.count = 0;
