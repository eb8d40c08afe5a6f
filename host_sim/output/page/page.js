'use strict';

// Draws every <figure class="panel"> from the JSON inside it, and marks what is wider than the page.
(() => {
  const figures = [...document.querySelectorAll('figure.panel')].filter(
      (figure) => figure.querySelector('script[type="application/json"]'));
  for (const figure of figures) {
    const data = JSON.parse(figure.querySelector('script[type="application/json"]').textContent);
    Panel.all.push(new Panel(figure, data));
  }

  const markWide = (box) => {
    const hidden = box.scrollWidth - box.clientWidth;
    box.classList.toggle('more-right', hidden > 1 && box.scrollLeft < hidden - 1);
    box.classList.toggle('more-left', hidden > 1 && box.scrollLeft > 1);
    if (hidden > 1) box.tabIndex = 0;
    else box.removeAttribute('tabindex');
  };
  const boxes = [...document.querySelectorAll('.scroll')];
  const sizes = new ResizeObserver((entries) => entries.forEach(({target}) => markWide(target)));
  for (const box of boxes) {
    box.addEventListener('scroll', () => markWide(box), {passive: true});
    sizes.observe(box);
    markWide(box);
  }

  // On paper every table is open, and charts have letters for the width of a sheet.
  const sheetWidth = 680;
  let opened = [];
  addEventListener('beforeprint', () => {
    opened = [...document.querySelectorAll('details:not([open])')];
    opened.forEach((details) => { details.open = true; });
    Panel.all.forEach((panel) => panel.draw(sheetWidth));
  });
  addEventListener('afterprint', () => {
    opened.forEach((details) => { details.open = false; });
    Panel.all.forEach((panel) => panel.draw());
  });

  document.body.dataset.panels = String(figures.length);
  document.body.dataset.drawn = String(Panel.all.filter((panel) => panel.isDrawn()).length);
})();
