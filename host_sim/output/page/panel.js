'use strict';

// A chart in its figure: drawn, zoomed and read by mouse, touch and keyboard.
class Panel {
  constructor(figure, data) {
    this.figure = figure;
    this.chart = new Chart(figure, data);
    this.reading = new Reading(this.chart);
    figure.chart = this.chart;
    figure.append(this.reading.legend);
    this.yName = this.reading.add(figure, 'div', 'axis-name y');
    this.box = this.reading.add(figure, 'div', 'chart');
    this.xName = this.reading.add(figure, 'div', 'axis-name x');
    this.box.tabIndex = 0;
    this.box.setAttribute('role', 'group');
    this.box.setAttribute('aria-roledescription', 'chart');
    this.box.setAttribute('aria-label', [data.title, `${data.y.label} over ${data.x.label}`].filter((part) => part !== '').join(': '));
    this.box.setAttribute('aria-describedby', 'chart-keys');
    this.reset = this.reading.add(figure.querySelector('figcaption'), 'button', 'reset', 'Reset zoom');
    this.reset.type = 'button';
    this.reset.addEventListener('click', () => { this.showWhole(); this.box.focus(); });
    this.listen();
    new ResizeObserver(() => { if (this.box.clientWidth !== this.width) this.draw(); }).observe(this.box);
    this.draw();
  }

  draw(width = this.box.clientWidth || 680) {
    const {chart} = this;
    this.width = width;
    this.height = this.width < 600 ? 240 : 280;
    this.box.innerHTML = chart.draw(this.width, this.height);
    this.reading.clear();
    const name = ({axis, ticks}) => Look.html(Numbers.axisName(chart.axes[axis].quantity, ticks.scale), chart.axes[axis].verbatim);
    this.xName.innerHTML = name({axis: 'x', ticks: chart.xTicks});
    this.yName.innerHTML = name({axis: 'y', ticks: chart.yTicks});
    this.reset.hidden = !chart.isZoomed();
  }

  partners() {
    const {group} = this.chart.data;
    return Panel.all.filter((panel) => panel !== this && group !== '' && panel.chart.data.group === group);
  }

  // @param shown  ranges in the axes' own measures; y: null follows x
  show({x, y}) {
    const inside = (range) => Math.abs(range[1] - range[0]) > 1e-12 * Math.max(1e-300, Numbers.largestOf(range));
    if (!inside(x) || (y && !inside(y))) return;
    this.chart.shown = {x, y};
    this.draw();
    for (const partner of this.partners()) {
      partner.chart.shown = {...partner.chart.shown, x};
      partner.draw();
    }
  }

  showWhole() {
    for (const panel of [this, ...this.partners()]) {
      panel.chart.shown = {x: panel.chart.whole.x, y: null};
      panel.draw();
    }
  }

  // Both axes where neither follows the other.
  get free() {
    return this.chart.hasTiles || this.chart.series.some(({sorted}) => !sorted);
  }

  // @param factor  below 1 nearer
  zoom(factor, center = {}) {
    const {chart} = this;
    const about = (range, middle) => range.map((end) => middle + factor * (end - middle));
    const mid = ([low, high]) => (low + high) / 2;
    const x = about(chart.shown.x, center.x === undefined ? mid(chart.shown.x) : center.x);
    const y = this.free || chart.shown.y ? about(chart.yRange(), center.y === undefined ? mid(chart.yRange()) : center.y) : null;
    this.show({x, y});
  }

  pan(xPart, yPart) {
    const {chart} = this;
    const moved = (range, part) => range.map((end) => end + part * (range[1] - range[0]));
    this.show({x: moved(chart.shown.x, xPart),
               y: yPart !== 0 || chart.shown.y ? moved(chart.yRange(), yPart) : null});
  }

  read(x, pixel) {
    this.reading.show(x, pixel);
    for (const partner of this.partners()) partner.reading.show(x);
  }

  leave() { [this, ...this.partners()].forEach(({reading}) => reading.clear()); }

  // ---- Mouse ---------------------------------------------------------------------------------

  pixel({clientX, clientY}) {
    const frame = this.box.getBoundingClientRect();
    return {x: clientX - frame.left, y: clientY - frame.top};
  }

  listen() {
    const on = (type, take, options) => this.box.addEventListener(type, take.bind(this), options);
    on('mousedown', this.mouseDown);
    on('mousemove', this.mouseMove);
    on('mouseleave', () => { if (!this.drag) this.leave(); });
    on('dblclick', this.showWhole);
    on('keydown', this.key);
    on('touchstart', this.touchStart, {passive: false});
    on('touchmove', this.touchMove, {passive: false});
    on('touchend', () => { this.pinch = null; });
    window.addEventListener('mousemove', (event) => { if (this.drag) this.dragTo(event); });
    window.addEventListener('mouseup', (event) => { if (this.drag) this.drop(event); });
  }

  mouseDown(event) {
    if (event.button !== 0) return;
    event.preventDefault();
    this.box.focus({preventScroll: true});
    const {chart} = this;
    this.drag = {from: this.pixel(event), pans: event.shiftKey, x: chart.shown.x, y: chart.yRange(), own: chart.shown.y};
  }

  mouseMove(event) {
    if (this.drag) return;
    const pixel = this.pixel(event);
    const {left, width} = this.chart.area;
    if (pixel.x < left || pixel.x > left + width) this.leave();
    else this.read(this.chart.value('x', this.chart.xAt(pixel.x)), pixel);
  }

  dragTo(event) {
    const {from, pans, x, y, own} = this.drag;
    const to = this.pixel(event);
    const {area} = this.chart;
    if (pans) {
      const moved = (range, part) => range.map((end) => end + part * (range[1] - range[0]));
      this.show({x: moved(x, (from.x - to.x) / area.width),
                 y: own || this.free ? moved(y, (to.y - from.y) / area.height) : null});
      return;
    }
    const frame = this.frame(from, to);
    const box = this.box.querySelector('.zoom-box');
    for (const [name, value] of Object.entries(frame)) box.setAttribute(name, Math.max(0, value));
  }

  // Where the pointer goes along one axis alone, all of the other.
  frame(from, to) {
    const {area} = this.chart;
    const inside = (value, low, size) => Math.min(Math.max(value, low), low + size);
    const [x0, x1] = [from.x, to.x].map((x) => inside(x, area.left, area.width)).sort((a, b) => a - b);
    const [y0, y1] = [from.y, to.y].map((y) => inside(y, area.top, area.height)).sort((a, b) => a - b);
    const wide = x1 - x0 > 8;
    const high = y1 - y0 > 8 && (y1 - y0 > 0.3 * (x1 - x0));
    return {x: wide ? x0 : area.left, width: wide ? x1 - x0 : high ? area.width : 0,
            y: high ? y0 : area.top, height: high ? y1 - y0 : area.height};
  }

  drop(event) {
    const {from, pans} = this.drag;
    this.drag = null;
    if (pans) return;
    const {chart} = this;
    const {x, width, y, height} = this.frame(from, this.pixel(event));
    this.box.querySelector('.zoom-box').setAttribute('width', 0);
    if (width === 0) return;
    const all = height === chart.area.height;
    this.show({x: width === chart.area.width ? chart.shown.x : [chart.xAt(x), chart.xAt(x + width)],
               y: all ? chart.shown.y : [chart.yAt(y + height), chart.yAt(y)]});
  }

  // ---- Touch: one finger is the page's, two are the chart's ----------------------------------

  static fingers({touches}, pixel) {
    const [a, b] = [touches[0], touches[1]].map(pixel);
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.max(20, Math.hypot(a.x - b.x, a.y - b.y)),
            upright: Math.abs(a.y - b.y) > Math.abs(a.x - b.x)};
  }

  touchStart(event) {
    if (event.touches.length !== 2) return;
    event.preventDefault();
    const {chart} = this;
    const fingers = Panel.fingers(event, (touch) => this.pixel(touch));
    this.pinch = {fingers, area: chart.area, x: chart.shown.x, y: chart.yRange(),
                  zoomsY: fingers.upright || this.free || chart.shown.y !== null};
  }

  // What was between the fingers stays between them.
  touchMove(event) {
    if (event.touches.length !== 2 || !this.pinch) return;
    event.preventDefault();
    const {fingers, area, x, y, zoomsY} = this.pinch;
    const now = Panel.fingers(event, (touch) => this.pixel(touch));
    const factor = fingers.apart / now.apart;
    const held = (range, was, is) => {
      const width = range[1] - range[0];
      const low = range[0] + width * (was - factor * is);
      return [low, low + factor * width];
    };
    const along = (at) => (at - area.left) / area.width;
    const up = (at) => 1 - (at - area.top) / area.height;
    this.show({x: fingers.upright && !this.free ? x : held(x, along(fingers.x), along(now.x)),
               y: zoomsY ? held(y, up(fingers.y), up(now.y)) : null});
  }

  // ---- Keyboard ------------------------------------------------------------------------------

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const {chart, reading} = this;
    const center = {x: reading.x === undefined ? undefined : chart.measure('x', reading.x)};
    if (center.x < chart.shown.x[0] || center.x > chart.shown.x[1]) center.x = undefined;
    const step = (direction) => {
      const x = reading.step(direction);
      if (x === null) return;
      const series = chart.series.find((one) => one.x.includes(x));
      const y = series.y[series.x.indexOf(x)];
      this.read(x, {x: chart.px(x), y: chart.canShow('y', y) ? chart.py(y) : chart.area.top});
    };
    const arrow = (across, upward) => {
      if (event.shiftKey) return () => this.pan(0.2 * across, 0.2 * upward);
      if (chart.hasTiles) return () => reading.stepTile(across, upward);
      return across === 0 ? null : () => step(across);
    };
    const actions = {
      ArrowRight: arrow(1, 0),
      ArrowLeft: arrow(-1, 0),
      ArrowUp: arrow(0, 1),
      ArrowDown: arrow(0, -1),
      '+': () => this.zoom(0.5, center),
      '=': () => this.zoom(0.5, center),
      '-': () => this.zoom(2, center),
      '0': () => this.showWhole(),
      Escape: () => { this.showWhole(); this.leave(); },
    };
    const action = actions[event.key];
    if (action) {
      event.preventDefault();
      action();
    }
  }

  // Whether something of the data is on the sheet.
  isDrawn() {
    return [...this.box.querySelectorAll('.data path, .data rect, .data circle')].some((shape) => {
      const {width, height} = shape.getBoundingClientRect();
      return width > 0 || height > 0;
    });
  }
}
Panel.all = [];
