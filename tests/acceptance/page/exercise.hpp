/// Scripts that use every chart of a report as a reader would, and note what happened.
#pragma once

namespace sonoglide::browser {

/// For load(). Of each chart: drags across its middle, hovers over it, shift-drags it and
/// double-clicks it. Leaves on <body> the number of charts that passed, to be held against
/// data-panels: data-zoomed (the range became the dragged one), data-read (each legend entry that
/// has a value at the pointer shows one), data-panned (the range moved, its width unchanged),
/// data-reset (the full range is back); and data-followed, counted where all other charts of the
/// group took part in the zoom, the hover and the reset.
inline constexpr const char* exercise_script = R"js(
(() => {
  const figures = [...document.querySelectorAll('figure.panel')].filter((f) => f.chart);
  const dataOf = (figure) => JSON.parse(figure.querySelector('script').textContent);
  const groupOf = (figure) => dataOf(figure).group;
  const partnersOf = (figure) => figures.filter(
      (f) => f !== figure && groupOf(figure) !== '' && groupOf(f) === groupOf(figure));

  const send = (figure, type, fraction, options = {}) => {
    const target = figure.querySelector('.chart');
    const box = target.getBoundingClientRect();
    const {left, top, width, height} = figure.chart.area;
    target.dispatchEvent(new MouseEvent(type, {
      bubbles: true, cancelable: true, view: window, button: 0, detail: 1,
      clientX: box.left + left + fraction * width, clientY: box.top + top + height / 2,
      ...options,
    }));
  };
  const drag = (figure, from, to, options = {}) => {
    send(figure, 'mousedown', from, options);
    for (let i = 1; i <= 4; ++i) send(figure, 'mousemove', from + (to - from) * i / 4, options);
    send(figure, 'mouseup', to, options);
  };

  const range = (figure) => figure.chart.xAxisRange();
  const width = ([from, to]) => to - from;
  const close = (a, b, tolerance) =>
      Math.abs(a[0] - b[0]) <= tolerance && Math.abs(a[1] - b[1]) <= tolerance;
  const readings = (figure) =>
      [...figure.querySelectorAll('.legend .value')].map((value) => value.textContent);
  const hasReading = (figure) => (figure.chart.hasTiles || readings(figure).some((text) => /[0-9]/.test(text))) &&
      /[0-9]/.test(figure.querySelector('.legend .abscissa').textContent);

  const counts = {zoomed: 0, read: 0, panned: 0, reset: 0, followed: 0};
  for (const figure of figures) {
    const partners = partnersOf(figure);
    const full = range(figure);
    const partnersFull = partners.map(range);
    let followed = true;

    drag(figure, 0.3, 0.6);
    const zoomed = range(figure);
    const wanted = [full[0] + 0.3 * width(full), full[0] + 0.6 * width(full)];
    counts.zoomed += close(zoomed, wanted, 0.01 * width(full));
    followed = followed && partners.every((p) => close(range(p), zoomed, 1e-9 * width(full)));

    send(figure, 'mousemove', 0.5);
    counts.read += hasReading(figure);
    followed = followed && partners.every(hasReading);

    drag(figure, 0.5, 0.4, {shiftKey: true});
    const panned = range(figure);
    counts.panned += Math.abs(width(panned) - width(zoomed)) < 1e-6 * width(zoomed) &&
        panned[0] > zoomed[0] + 0.05 * width(zoomed);
    followed = followed && partners.every((p) => close(range(p), panned, 1e-9 * width(full)));

    send(figure, 'dblclick', 0.5);
    counts.reset += close(range(figure), full, 1e-9 * width(full));
    followed = followed && partners.every((p, i) => close(range(p), partnersFull[i], 0));
    counts.followed += followed;
  }
  Object.assign(document.body.dataset, counts);
})();
)js";

/// Of each chart: moves one finger over it, two fingers apart on it, and presses its button. Counts
/// data-scrolled (one finger is left to the page, which may scroll, and the range stays),
/// data-pinched (what was between the fingers is spread) and data-unzoomed.
inline constexpr const char* touch_script = R"js(
(() => {
  const counts = {scrolled: 0, pinched: 0, unzoomed: 0};
  for (const figure of document.querySelectorAll('figure.panel')) {
    const box = figure.querySelector('.chart');
    const {left, top, width, height} = figure.chart.area;
    const send = (type, parts) => {
      const frame = box.getBoundingClientRect();
      const touches = parts.map((part) => ({
        clientX: frame.left + left + part * width, clientY: frame.top + top + height / 2}));
      const event = Object.assign(new Event(type, {bubbles: true, cancelable: true}), {touches});
      box.dispatchEvent(event);
      return event.defaultPrevented;
    };
    const full = figure.chart.xAxisRange();
    const size = full[1] - full[0];
    const taken = [send('touchstart', [0.2]), send('touchmove', [0.8]), send('touchend', [])];
    counts.scrolled += !taken.includes(true) && String(figure.chart.xAxisRange()) === String(full) &&
        getComputedStyle(box).touchAction === 'pan-x pan-y';
    send('touchstart', [0.4, 0.6]);
    const held = send('touchmove', [0.1, 0.9]);
    send('touchend', []);
    const wanted = [full[0] + 0.375 * size, full[0] + 0.625 * size];
    counts.pinched += held && figure.chart.xAxisRange().every(
        (end, i) => Math.abs(end - wanted[i]) < 1e-6 * size);
    const button = figure.querySelector('.reset');
    const shown = !button.hidden;
    button.click();
    counts.unzoomed += shown && button.hidden && String(figure.chart.xAxisRange()) === String(full);
  }
  Object.assign(document.body.dataset, counts);
})();
)js";

/// Of each chart: puts the focus on it and presses keys. Counts data-focused (it takes the focus, and
/// shows it), data-named (screen readers have a label and the keys), data-said (they say what is read),
/// data-read, data-crossed (of a map alone the arrows go up and down too), data-zoomed, data-panned and
/// data-reset.
inline constexpr const char* keyboard_script = R"js(
(() => {
  const counts = {focused: 0, named: 0, said: 0, read: 0, crossed: 0, zoomed: 0, panned: 0, reset: 0};
  for (const figure of document.querySelectorAll('figure.panel')) {
    const box = figure.querySelector('.chart');
    const press = (key, options = {}) => box.dispatchEvent(
        new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true, ...options}));
    const range = () => figure.chart.xAxisRange();
    const full = range();
    const size = ([low, high]) => high - low;
    box.focus({focusVisible: true});
    counts.focused += document.activeElement === box &&
        parseFloat(getComputedStyle(box).outlineWidth) >= 2;
    counts.named += box.getAttribute('aria-label').includes(figure.querySelector('h3').textContent) &&
        document.getElementById(box.getAttribute('aria-describedby')) !== null;
    counts.said += figure.querySelector('.abscissa').closest('[aria-live="polite"]') !== null;
    press('ArrowRight');
    const first = figure.querySelector('.abscissa').textContent;
    press('ArrowRight');
    const second = figure.querySelector('.abscissa').textContent;
    counts.read += /[0-9]/.test(first) && /[0-9]/.test(second) && first !== second;
    press('ArrowUp');
    const third = figure.querySelector('.abscissa').textContent;
    counts.crossed += (third !== second) === figure.chart.hasTiles;
    press('+');
    const near = range();
    counts.zoomed += Math.abs(size(near) - 0.5 * size(full)) < 1e-6 * size(full);
    press('ArrowRight', {shiftKey: true});
    counts.panned += Math.abs(range()[0] - near[0] - 0.2 * size(near)) < 1e-6 * size(full);
    press('Escape');
    const escaped = String(range()) === String(full);
    press('+');
    press('-');
    press('0');
    counts.reset += escaped && String(range()) === String(full);
  }
  Object.assign(document.body.dataset, counts);
})();
)js";

/// Leaves data-dark, and the least contrast against the paper, in tenths, of the curves' colours in
/// data-curves and of the charts' texts in data-texts. Source: relative luminance of WCAG 2.1.
inline constexpr const char* contrast_script = R"js(
(() => {
  const probe = document.body.appendChild(document.createElement('i'));
  const luminance = (colour) => {
    probe.style.color = colour;
    const linear = getComputedStyle(probe).color.match(/[0-9.]+/g).slice(0, 3).map((c) => {
      const part = c / 255;
      return part <= 0.04045 ? part / 12.92 : Math.pow((part + 0.055) / 1.055, 2.4);
    });
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const contrast = (colour) => {
    const [dark, light] = [luminance(colour), luminance('var(--paper)')].sort((a, b) => a - b);
    return (light + 0.05) / (dark + 0.05);
  };
  const tenths = (colours) => Math.floor(10 * Math.min(...colours.map(contrast)));
  document.body.dataset.dark = String(matchMedia('(prefers-color-scheme: dark)').matches);
  document.body.dataset.curves =
      tenths([...Array(8).keys()].map((i) => `var(--series-${i})`).concat(['var(--ink)']));
  document.body.dataset.texts = tenths(
      [...document.querySelectorAll('.plot text')].map((text) => getComputedStyle(text).fill)
          .concat(['var(--muted)', 'var(--ink)']));
  probe.remove();
})();
)js";

}  // namespace sonoglide::browser
