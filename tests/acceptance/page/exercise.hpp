/// A script that uses every chart of a report as a reader would, and notes what happened.
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
    const canvas = figure.querySelectorAll('canvas')[1];
    const box = canvas.getBoundingClientRect();
    const area = figure.chart.getArea();
    canvas.dispatchEvent(new MouseEvent(type, {
      bubbles: true, cancelable: true, view: window, button: 0, detail: 1,
      clientX: box.left + area.x + fraction * area.w, clientY: box.top + area.y + area.h / 2,
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
  const hasReading = (figure) => readings(figure).some((text) => /[0-9]/.test(text)) &&
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

}  // namespace sonoglide::browser
