'use strict';

// Draws every <figure class="panel"> from the JSON inside it, and marks what is wider than the page.
(() => {
  const figures = [...document.querySelectorAll('figure.panel')].filter(
      (figure) => figure.querySelector('script[type="application/json"]'));
  for (const figure of figures) {
    const data = JSON.parse(figure.querySelector('script[type="application/json"]').textContent);
    Panel.all.push(new Panel(figure, data));
  }

  // A word with a hyphen, as Cortex-M0 or --law, stays in one line.
  const mostLetters = 20;
  for (const text of document.querySelectorAll('th, td, p')) {
    if (text.children.length > 0 || !/-[A-Za-z]/.test(text.textContent)) continue;
    const parts = text.textContent.split(/(\S*-[A-Za-z]\S*)/);
    text.replaceChildren(...parts.map((part, i) => {
      if (i % 2 === 0 || part.length > mostLetters) return part;
      const word = document.createElement('span');
      word.className = 'whole';
      word.textContent = part;
      return word;
    }));
  }

  // The name of a key may go on in the next line, so that a table is no wider than it must be.
  for (const cell of document.querySelectorAll('th, td')) {
    if (cell.children.length === 0) cell.innerHTML = cell.innerHTML.replace(/_(?=\w)/g, '_<wbr>');
  }

  markWide('.scroll');

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
